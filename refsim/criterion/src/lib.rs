//! Criterion benchmarks in modelled time.
//!
//! [`ModelledTime::on_card`] records a run on a [`Machine`] and returns its duration on the card's timeline, and
//! [`ModelledTime::bench`] reports it to criterion. The benchmark thus measures the emulated card, not the emulator.
//!
//! ```no_run
//! use refsim::{device::Profile, texture::TexelFormat};
//! use refsim_criterion::ModelledTime;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let time = ModelledTime::on_card(Profile::named("nv20")?, |machine| {
//!     let target = machine.create_target(TexelFormat::Bgra8, 256, 256)?;
//!     machine.clear_target(target, [0; 4]) // a real benchmark draws here
//! })?;
//! ModelledTime::bench("nv20", "65536 texels", 65536, time);
//! # Ok(())
//! # }
//! ```
//!
//! For recorded logs see [`ModelledTime::of`]; to combine several kinds of benchmarks see [`ModelledTime::criterion`]
//! and [`ModelledTime::measure`].

use std::thread;
use std::time::Duration;

use criterion::measurement::{Measurement, ValueFormatter};
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{ExecutorKind, Machine, MachineError};
use refsim::timing::replay::{Options, ReplayError, replay};
use refsim::timing::{Level, Model, Picoseconds, TimingError};

/// Error of measuring a run in modelled time.
#[non_exhaustive]
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The device lacks timing figures.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// The machine returned an error.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The recorded log cannot be replayed.
    #[error(transparent)]
    Replay(#[from] ReplayError),
}

/// A criterion measurement in picoseconds of a timeline. It has no clock to start: benchmarks report their result
/// through `Bencher::iter_custom`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ModelledTime;

/// Host time to spend per iteration. Criterion chooses the number of iterations by the host's clock; if iterations took
/// no time, it would double their number until the count and the picoseconds overflow.
const HOST_TIME: Duration = Duration::from_micros(100);

/// [`ModelledTime::criterion`] without command line arguments.
fn settings() -> Criterion<ModelledTime> {
    Criterion::default()
        .with_measurement(ModelledTime)
        .sample_size(10)
        .nresamples(1000)
        .warm_up_time(Duration::from_millis(1))
        .measurement_time(Duration::from_millis(10))
}

impl ModelledTime {
    /// Creates a criterion instance for modelled time. All samples are equal, so ten are enough; command line arguments
    /// are applied.
    pub fn criterion() -> Criterion<Self> {
        settings().configure_from_args()
    }

    /// The duration of `run` on `card` according to the pipeline model. The batch executor draws.
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

    /// Reports a run of `elements` items, for example fragments, as the benchmark `name` of `group`.
    pub fn bench(group: &str, name: &str, elements: u64, run: Picoseconds) {
        let mut criterion = Self::criterion();
        let mut group = criterion.benchmark_group(group);
        Self::measure(&mut group, BenchmarkId::from_parameter(name), elements, run);
        group.finish();
    }

    /// Adds a run of `elements` items to a group. For runs of up to 90 s, criterion's estimate equals `run`, without
    /// variance.
    pub fn measure(group: &mut BenchmarkGroup<'_, Self>, id: BenchmarkId, elements: u64, run: Picoseconds) {
        group.throughput(Throughput::Elements(elements));
        group.bench_function(id, |bencher| {
            bencher.iter_custom(|times| {
                thread::sleep(HOST_TIME.saturating_mul(u32::try_from(times).unwrap_or(u32::MAX)));
                Picoseconds(run.0.saturating_mul(times))
            });
        });
    }

    /// Duration of a recorded run: the makespan of its timeline.
    ///
    /// # Errors
    /// If the log is not a valid recording of a machine.
    pub fn of(log: &[Event], model: &Model, options: &Options<'_>) -> Result<Picoseconds, ReplayError> {
        Ok(replay(log, model, options)?.timeline.makespan())
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

/// Factor and unit for a readable number of picoseconds.
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
        // Converts picoseconds to millions of items per second.
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
    fn criterion_estimates_the_time_of_the_run_without_variance() {
        // The GeForce3's full-screen quad, a run below a nanosecond, and a run of a minute.
        for time in [85_710_000, 7, 60_000_000_000_000] {
            let folder = tempfile::tempdir().expect("a folder");
            let mut criterion = settings().output_directory(folder.path());
            let mut group = criterion.benchmark_group("card");
            // If the host is busy during warm-up, criterion chooses samples without a slope.
            group.sampling_mode(criterion::SamplingMode::Linear);
            ModelledTime::measure(&mut group, BenchmarkId::from_parameter("run"), 65_536, Picoseconds(time));
            group.finish();
            let text = std::fs::read_to_string(folder.path().join("card/run/new/estimates.json")).expect("estimates");
            let estimates: serde_json::Value = serde_json::from_str(&text).expect("JSON");
            let time = time as f64;
            for estimate in ["mean", "median", "slope"] {
                let found = &estimates[estimate];
                let interval = &found["confidence_interval"];
                let figures = [&found["point_estimate"], &interval["lower_bound"], &interval["upper_bound"]];
                assert_eq!(figures.map(serde_json::Value::as_f64), [Some(time); 3], "{estimate} of {time} ps");
            }
            assert_eq!(estimates["std_dev"]["point_estimate"].as_f64(), Some(0.0), "{time} ps");
        }
    }
}
