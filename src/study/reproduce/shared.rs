//! What several entries need: worked out once, by the first that asks.

use std::cell::OnceCell;

use super::ReproduceError;
use super::subsurface::{CARD, GatherCost, all_costs};
use super::tables::{SpeedUps, TeapotRoom, work_out};

/// Renderings and runs of the engine that entries share.
#[derive(Default)]
pub(super) struct Shared {
    teapot: OnceCell<TeapotRoom>,
    speed_ups: OnceCell<SpeedUps>,
    gather: OnceCell<Vec<GatherCost>>,
}

impl Shared {
    /// The teapot room of Tables 1 to 5.
    pub(super) fn teapot(&self) -> Result<&TeapotRoom, ReproduceError> {
        get_or_try(&self.teapot, TeapotRoom::new)
    }

    /// The rows of Tables 3 to 5 and what explains them.
    pub(super) fn speed_ups(&self) -> Result<&SpeedUps, ReproduceError> {
        get_or_try(&self.speed_ups, || work_out(self.teapot()?))
    }

    /// Pass 2 of system 3 on the card of its Table 1, in each of its variants.
    pub(super) fn gather(&self) -> Result<&[GatherCost], ReproduceError> {
        Ok(get_or_try(&self.gather, || all_costs(CARD))?)
    }
}

/// The value of a cell; computed if it has none yet, and left empty if that fails.
fn get_or_try<T, E>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
    if let Some(value) = cell.get() {
        return Ok(value);
    }
    let value = make()?;
    Ok(cell.get_or_init(|| value))
}
