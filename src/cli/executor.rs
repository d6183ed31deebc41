//! `--executor`, `--adapter`: how the card's programs are run.

use clap::ValueEnum;
use refsim::machine::{Executor, ExecutorKind};

use super::Problem;
#[cfg(feature = "wgpu")]
use super::ProgressBar;

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

/// Which GPU.
#[derive(Clone, Debug, Default, clap::Args)]
pub(super) struct GpuArgs {
    /// For wgpu: the adapter, by its name or a part of it; see `crossbar devices --adapters` [default: the best]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

impl GpuArgs {
    /// Returns `true` if any is given.
    pub(super) fn is_given(&self) -> bool {
        self.adapter.is_some()
    }

    #[cfg(feature = "wgpu")]
    fn open(&self) -> Result<Executor, Problem> {
        use refsim::exec::gpu::Gpu;
        let refused = |e: refsim::exec::gpu::GpuError| {
            Problem::usage(e.to_string(), "`crossbar devices --adapters` lists the adapters")
        };
        let gpu = Gpu::open(self.adapter.as_deref()).map_err(refused)?;
        let gpu = gpu.observed(Box::new(|| Box::new(ProgressBar::unending("compiling a shader for the GPU"))));
        Ok(Executor::Gpu { gpu: std::sync::Arc::new(gpu) })
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
            let help = "add `--executor wgpu`, or leave it out";
            return Err(Problem::usage("`--adapter` is for the wgpu executor", help).into());
        }
        Ok(match self {
            Self::Scalar => ExecutorKind::Scalar.into(),
            Self::Batch => ExecutorKind::Batch.into(),
            Self::Wgpu => gpu.open()?,
        })
    }
}

/// Arithmetic that decides hits: exact, or an executor of the card.
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
    /// The requested caster; a card that was named, unless the executor says otherwise.
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
