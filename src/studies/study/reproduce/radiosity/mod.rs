//! Matrix radiosity, section 3.1: Figure 3, the printed rates, Figure 4.

mod figure_3;
mod figure_4;
mod host;
mod rates;

use refsim::device::Profile;

use super::{EntryFindings, ReproduceError, pipeline::failed};
use crate::radiosity::on_card::Storage;
use crate::radiosity::packing::Packing;
use crate::radiosity::rate::{TimedIteration, Timing, timed_iteration};

pub(super) use figure_3::findings as figure_3;
pub(super) use figure_4::findings as figure_4;
pub(super) use rates::findings as rates;

/// Card of the paper.
const CARD: &str = "nv35";
/// Patches of the paper's scene, which are not printed: the smallest number consistent with both pairs of printed rates
/// (docs/papers/radiosity.md). The table of [`rates`] shows other numbers.
const PATCHES: u32 = 1540;
/// Section 3.1: Jacobi iterations per second on the card, and MFLOP/s.
const PRINTED_CARD: (f64, f64) = (29.7, 141.0);
/// Gauss-Seidel iterations per second on the host, and MFLOP/s.
const PRINTED_HOST: (f64, f64) = (40.0, 190.0);

/// Times an iteration of `patches` patches on the paper's card, by the pipeline model.
fn iteration(patches: u32, packing: Packing, storage: Storage) -> Result<TimedIteration, ReproduceError> {
    let timing = Timing { patches: patches as usize, packing, storage, cache: false };
    timed_iteration(&Profile::named(CARD)?, &timing).map_err(|e| failed(CARD)(&e))
}
