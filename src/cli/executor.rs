//! `--executor`: the executor of the card's programs.

use clap::ValueEnum;
use refsim::machine::{Executor, ExecutorKind};

#[cfg(feature = "wgpu")]
use super::ProgressBar;
use super::{Problem, given};
use crate::study::caster::CasterOptions;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum DeviceExecutor {
    /// The reference: one fragment at a time, in integer arithmetic
    Scalar,
    /// Many fragments at once; same bits as scalar
    Batch,
    /// A GPU of this computer; same bits as scalar
    Wgpu,
}

/// Opens the GPU that the environment variable `CROSSBAR_ADAPTER` names, or the best one.
#[cfg(feature = "wgpu")]
fn open_gpu() -> Result<Executor, Problem> {
    use refsim::exec::gpu::Gpu;
    let refused = |e: refsim::exec::gpu::GpuError| {
        Problem::usage(e.to_string(), "`crossbar devices --adapters` lists the adapters")
    };
    let gpu = Gpu::open(std::env::var("CROSSBAR_ADAPTER").ok().as_deref()).map_err(refused)?;
    let gpu = gpu.observed(Box::new(|| Box::new(ProgressBar::unending("compiling a shader for the GPU"))));
    Ok(Executor::Gpu { gpu: std::sync::Arc::new(gpu) })
}

#[cfg(not(feature = "wgpu"))]
fn open_gpu() -> Result<Executor, Problem> {
    Err(super::devices::no_adapters())
}

impl DeviceExecutor {
    pub(super) fn open(self) -> Result<Executor, Problem> {
        Ok(match self {
            Self::Scalar => ExecutorKind::Scalar.into(),
            Self::Batch => ExecutorKind::Batch.into(),
            Self::Wgpu => open_gpu()?,
        })
    }
}

/// Arithmetic that decides hits: exact, or an executor of the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Decider {
    /// Exact arithmetic: the reference for hits
    Exact,
    /// The emulated card, one fragment at a time
    Scalar,
    /// The emulated card, many fragments at once; same bits as scalar
    Batch,
    /// The emulated card, on a GPU of this computer; same bits as scalar
    Wgpu,
}

impl Decider {
    /// The requested executor; without a request, the card's if one is named, else `None`, exact arithmetic.
    pub(super) fn choose(executor: Option<Self>, device: Option<&str>) -> Result<Option<Executor>, Problem> {
        let idle = device.is_some() && executor == Some(Self::Exact);
        let help = "use `--executor scalar`, `batch` or `wgpu`, or remove `--executor`";
        given::refuse([("--device", idle)], "the arithmetic of a card", help)?;
        executor.unwrap_or(if device.is_some() { Self::Batch } else { Self::Exact }).open()
    }

    /// The executor of the card, or `None` for exact arithmetic.
    pub(super) fn open(self) -> Result<Option<Executor>, Problem> {
        let executor = match self {
            Self::Exact => return Ok(None),
            Self::Scalar => DeviceExecutor::Scalar,
            Self::Batch => DeviceExecutor::Batch,
            Self::Wgpu => DeviceExecutor::Wgpu,
        };
        executor.open().map(Some)
    }
}

/// Executor of the Ray Engine's card, for a command whose `--executor` also decides hits without a caster.
pub(super) fn engine_executor(caster: &CasterOptions, executor: Option<Decider>) -> Result<Executor, Problem> {
    if caster.is_named() && !caster.is_engine() && executor.is_some() {
        let help = "remove `--executor`, or add `--caster engine`";
        return Err(Problem::usage("with `--caster`, `--executor` is for the Ray Engine only", help));
    }
    let decider = executor.filter(|_| caster.is_engine()).unwrap_or(Decider::Batch);
    let help = "use `--executor scalar`, `batch` or `wgpu`";
    decider.open()?.ok_or_else(|| Problem::usage("the Ray Engine does not run in exact arithmetic", help))
}
