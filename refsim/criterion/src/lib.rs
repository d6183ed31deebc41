//! Criterion benchmarks in modelled time.
//!
//! [`ModelledTime::on_card`] records what a [`Machine`] does and gives its time by the card's timeline, which
//! [`ModelledTime::bench`] hands to criterion: what is measured is the emulated card, not the emulator.
//!
//! ```no_run
//! use refsim::{device::Profile, texture::TexelFormat};
//! use refsim_criterion::ModelledTime;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let time = ModelledTime::on_card(Profile::named("nv20")?, |machine| {
//!     let target = machine.create_target(TexelFormat::Bgra8, 256, 256)?;
//!     machine.clear_target(target, [0; 4]) // draws, in earnest
//! })?;
//! ModelledTime::bench("nv20", "65536 texels", 65536, time);
//! # Ok(())
//! # }
//! ```
//!
//! Logs that are there already go through [`ModelledTime::of`], benchmarks of several kinds through
//! [`ModelledTime::criterion`].

use std::time::Duration;

use criterion::measurement::{Measurement, ValueFormatter};
use criterion::{Criterion, Throughput};
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{ExecutorKind, Machine, MachineError};
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::{Level, Model, Picoseconds, TimingError};

/// Why a run has no modelled time.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The device has no time.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// The machine refuses what it is asked.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// What was recorded cannot be replayed.
    #[error(transparent)]
    Replay(#[from] ReplayError),
}

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

    /// How long `run` takes on `card`: clocks of each unit, drawn by the batch executor.
    ///
    /// # Errors
    /// [`RunError`].
    pub fn on_card<T>(
        card: Profile,
        run: impl FnOnce(&mut Machine) -> Result<T, MachineError>,
    ) -> Result<Picoseconds, RunError> {
        let model = Model::new(Level::Pipeline, &card)?;
        let mut machine = Machine::new(card, ExecutorKind::Batch);
        machine.record(true);
        run(&mut machine)?;
        Ok(Self::of(&machine.take_log(), &model, &Options::default())?)
    }

    /// Reports a run that does `elements` things, fragments for example, as the benchmark `name` of `group`.
    pub fn bench(group: &str, name: &str, elements: u64, run: Picoseconds) {
        let mut criterion = Self::criterion();
        let mut group = criterion.benchmark_group(group);
        group.throughput(Throughput::Elements(elements));
        group.bench_function(name, |bencher| bencher.iter_custom(|times| Self::repeat(run, times)));
        group.finish();
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
    fn a_run_on_a_card_takes_its_time_and_refusals_come_back() {
        use refsim::texture::TexelFormat;
        let card = || Profile::named("nv20").expect("a card");
        let run = |size: u32| {
            ModelledTime::on_card(card(), |machine| {
                let target = machine.create_target(TexelFormat::Bgra8, size, size)?;
                machine.clear_target(target, [0; 4])?;
                machine.read_back(target).map(drop)
            })
        };
        let (small, large) = (run(64).expect("a time"), run(256).expect("a time"));
        assert!(Picoseconds::ZERO < small && small < large, "{small:?} {large:?}");
        assert!(matches!(run(1 << 20), Err(RunError::Machine(_))));
        let ideal = Profile::named("ideal-fp32").expect("a device");
        assert!(matches!(ModelledTime::on_card(ideal, |_| Ok(())), Err(RunError::Timing(_))));
    }

    #[test]
    fn samples_add_up() {
        let twice = ModelledTime::repeat(Picoseconds(21), 2);
        assert_eq!(ModelledTime.to_f64(&ModelledTime.add(&twice, &ModelledTime.zero())), 42.0);
        assert_eq!(ModelledTime::repeat(Picoseconds(u64::MAX), 2), Picoseconds(u64::MAX));
    }
}
