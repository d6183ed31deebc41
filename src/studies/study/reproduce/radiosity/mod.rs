//! Matrix radiosity, section 3.1: Figure 3, the printed rates, Figure 4.

pub(super) mod figure_3;
pub(super) mod figure_4;
mod host;
pub(super) mod rates;

use refsim::device::Profile;

use super::{EntryFindings, StudyError, TimedWork, error::RunResult, printed_value, shared::Shared};
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;
use crate::radiosity::rate::{TimedIteration, Timing, timed_iteration};

const CARD: &str = "nv35";
/// Number of patches of the paper's scene, which is not printed: the smallest number consistent with both pairs of
/// printed rates (docs/papers/radiosity.md). The table of [`rates`] shows other numbers.
const PATCHES: u32 = 1540;
/// Printed rates of section 3.1.
struct PrintedRates {
    /// Iterations per second.
    per_s: f64,
    /// Millions of operations per second.
    mflops: f64,
}

impl PrintedRates {
    /// Rates of Jacobi's iteration on the card, and of Gauss and Seidel's iteration on the host.
    fn both() -> Result<[Self; 2], StudyError> {
        let of = |name: &str| {
            let value = |what: &str| printed_value(&format!("radiosity/{name}-{what}"));
            Ok::<_, StudyError>(Self { per_s: value("rate")?, mflops: value("operations")? })
        };
        Ok([of("jacobi")?, of("gauss-seidel")?])
    }
}

pub(super) fn timed() -> Result<TimedWork, StudyError> {
    TimedWork::new("radiosity/jacobi-rate", CARD, iteration(PATCHES, Packing::Rgb, Storage::Fp32)?.time)
}

/// Times an iteration with `patches` patches on the paper's card, in the pipeline model.
fn iteration(patches: u32, packing: Packing, storage: Storage) -> Result<TimedIteration, StudyError> {
    let timing = Timing { patches: patches as usize, packing, storage, cache: false };
    timed_iteration(&Profile::named(CARD)?, &timing).on(CARD)
}
