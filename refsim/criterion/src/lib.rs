//! Criterion benchmarks in modelled time.
//!
//! Record what a [`Machine`](refsim::machine::Machine) does, and give [`ModelledTime`] the log: a benchmark then
//! measures the timeline of the run on the emulated card, not the emulator.
//!
//! ```no_run
//! use refsim::{device::Profile, event::Event, timing::{Level, Model}};
//! use refsim_criterion::ModelledTime;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let log: Vec<Event> = Vec::new(); // `Machine::take_log` after `Machine::record(true)`
//! let model = Model::new(Level::Pipeline, &Profile::named("nv20")?)?;
//! let time = ModelledTime::of(&log, &model, &Default::default())?;
//!
//! let mut criterion = ModelledTime::criterion();
//! criterion.bench_function("nothing", |bencher| bencher.iter_custom(|times| ModelledTime::repeat(time, times)));
//! # Ok(())
//! # }
//! ```

use std::time::Duration;

use criterion::measurement::{Measurement, ValueFormatter};
use criterion::{Criterion, Throughput};
use refsim::event::Event;
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::{Model, Picoseconds};

/// Picoseconds of a timeline, as criterion measures them. There is no clock to start: benchmarks hand over what they
/// found (`Bencher::iter_custom`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ModelledTime;

impl ModelledTime {
    /// Criterion in modelled time. Every sample is the same one, so that ten are enough; arguments of the command line
    /// are heeded.
    pub fn criterion() -> Criterion<Self> {
        Criterion::default()
            .with_measurement(Self)
            .sample_size(10)
            .nresamples(1000)
            .warm_up_time(Duration::from_millis(1))
            .measurement_time(Duration::from_millis(10))
            .configure_from_args()
    }

    /// How long a recorded run takes: the makespan of its timeline.
    ///
    /// # Errors
    /// If the log is not one that a machine has recorded.
    pub fn of(log: &[Event], model: &Model, options: &Options<'_>) -> Result<Picoseconds, ReplayError> {
        Ok(replay(log, model, options)?.timeline.makespan())
    }

    /// The time of so many equal runs.
    pub fn repeat(run: Picoseconds, times: u64) -> Picoseconds {
        Picoseconds(run.0.saturating_mul(times))
    }
}

impl Measurement for ModelledTime {
    type Intermediate = ();
    type Value = Picoseconds;

    fn start(&self) {}

    fn end(&self, (): ()) -> Picoseconds {
        Picoseconds::ZERO
    }

    fn add(&self, a: &Picoseconds, b: &Picoseconds) -> Picoseconds {
        *a + *b
    }

    fn zero(&self) -> Picoseconds {
        Picoseconds::ZERO
    }

    fn to_f64(&self, value: &Picoseconds) -> f64 {
        value.0 as f64
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        &Formatter
    }
}

struct Formatter;

/// Picoseconds in a unit of readable size.
fn unit(typical: f64) -> (f64, &'static str) {
    match typical {
        t if t < 1e3 => (1.0, "ps"),
        t if t < 1e6 => (1e-3, "ns"),
        t if t < 1e9 => (1e-6, "us"),
        t if t < 1e12 => (1e-9, "ms"),
        _ => (1e-12, "s"),
    }
}

impl ValueFormatter for Formatter {
    fn scale_values(&self, typical: f64, values: &mut [f64]) -> &'static str {
        let (factor, unit) = unit(typical);
        values.iter_mut().for_each(|v| *v *= factor);
        unit
    }

    fn scale_throughputs(&self, _typical: f64, throughput: &Throughput, values: &mut [f64]) -> &'static str {
        let (count, unit) = match *throughput {
            Throughput::Bytes(n) | Throughput::BytesDecimal(n) => (n, "MB/s modelled"),
            Throughput::Bits(n) => (n, "Mbit/s modelled"),
            Throughput::Elements(n) | Throughput::ElementsAndBytes { elements: n, .. } => (n, "Melem/s modelled"),
        };
        // Picoseconds to things a second, in millions.
        values.iter_mut().for_each(|v| *v = count as f64 / *v * 1e6);
        unit
    }

    fn scale_for_machines(&self, _values: &mut [f64]) -> &'static str {
        "ps"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_shown_in_a_readable_unit() {
        let shown = |picoseconds: f64| {
            let mut values = [picoseconds];
            let unit = Formatter.scale_values(picoseconds, &mut values);
            (values[0], unit)
        };
        assert_eq!(shown(999.0), (999.0, "ps"));
        assert_eq!(shown(2.5e9), (2.5, "ms"));
        let mut values = [2e6];
        let unit = Formatter.scale_throughputs(2e6, &Throughput::Elements(4), &mut values);
        assert_eq!((values[0], unit), (2.0, "Melem/s modelled"), "4 in 2 microseconds");
    }

    #[test]
    fn samples_add_up() {
        let twice = ModelledTime::repeat(Picoseconds(21), 2);
        assert_eq!(ModelledTime.to_f64(&ModelledTime.add(&twice, &ModelledTime.zero())), 42.0);
        assert_eq!(ModelledTime::repeat(Picoseconds(u64::MAX), 2), Picoseconds(u64::MAX));
    }
}
