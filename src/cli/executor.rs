//! `--executor`, `--adapter`, `--native`: how the card's programs are run.

#[cfg(feature = "wgpu")]
use std::io::Write as _;

use clap::ValueEnum;
use refsim::machine::{Executor, ExecutorKind};

use super::Problem;

/// The executor of the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DeviceExecutor {
    /// The reference: a fragment at a time, by integers
    Scalar,
    /// Many fragments at once
    Batch,
    /// A GPU of this computer
    Wgpu,
}

/// Which GPU, and how it computes.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct GpuArgs {
    /// For wgpu: the adapter, by its name or a part of it; see `crossbar devices --adapters` [default: the best]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,

    /// For wgpu: leave single precision to the adapter's own floats where a probe finds them exact
    #[arg(long)]
    native: bool,
}

impl GpuArgs {
    /// Whether they say anything.
    pub(super) fn is_given(&self) -> bool {
        self.adapter.is_some() || self.native
    }

    #[cfg(feature = "wgpu")]
    fn open(&self) -> Result<Executor, Problem> {
        use refsim::exec::{gpu::Gpu, wgsl::NumberMode};
        let refused = |e: refsim::exec::gpu::GpuError| {
            Problem::usage(e.to_string(), "`crossbar devices --adapters` lists the adapters")
        };
        let gpu = Gpu::open(self.adapter.as_deref()).map_err(refused)?;
        if self.native
            && let Some(departures) = gpu.probed().map_err(refused)?.departures()
        {
            // Nothing is to be done if nobody reads this.
            writeln!(std::io::stderr().lock(), "note: {departures}").ok();
        }
        let mode = if self.native { NumberMode::Native } else { NumberMode::Integer };
        Ok(Executor::Gpu { gpu: std::sync::Arc::new(gpu), mode })
    }

    #[cfg(not(feature = "wgpu"))]
    fn open(&self) -> Result<Executor, Problem> {
        Err(super::devices::no_adapters())
    }
}

impl DeviceExecutor {
    /// The executor, ready to work.
    pub(super) fn open(self, gpu: &GpuArgs) -> miette::Result<Executor> {
        if self != Self::Wgpu && gpu.is_given() {
            let help = "add `--executor wgpu`, or leave them out";
            return Err(Problem::usage("`--adapter` and `--native` are for the wgpu executor", help).into());
        }
        Ok(match self {
            Self::Scalar => ExecutorKind::Scalar.into(),
            Self::Batch => ExecutorKind::Batch.into(),
            Self::Wgpu => gpu.open()?,
        })
    }
}

/// What decides hits: exact arithmetic, or an executor of the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Decider {
    /// Exact arithmetic: the truth
    Exact,
    /// The emulated card, a fragment at a time
    Scalar,
    /// The emulated card, many fragments at once; the bits are those of scalar
    Batch,
    /// The emulated card, on a GPU of this computer; the bits are those of scalar
    Wgpu,
}

impl Decider {
    /// What was asked for; a card that was named is asked, unless the executor says otherwise.
    pub(super) fn choose(executor: Option<Self>, device: Option<&str>) -> Self {
        executor.unwrap_or(if device.is_some() { Self::Batch } else { Self::Exact })
    }

    /// The executor of the card, or `None` for exact arithmetic.
    pub(super) fn open(self, gpu: &GpuArgs) -> miette::Result<Option<Executor>> {
        let executor = match self {
            // Batch refuses the same options.
            Self::Exact => return DeviceExecutor::Batch.open(gpu).map(|_| None),
            Self::Scalar => DeviceExecutor::Scalar,
            Self::Batch => DeviceExecutor::Batch,
            Self::Wgpu => DeviceExecutor::Wgpu,
        };
        executor.open(gpu).map(Some)
    }
}
