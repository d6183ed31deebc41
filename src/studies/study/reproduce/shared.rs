//! Intermediate results shared by several entries, computed on first use.

use std::cell::OnceCell;

use super::bi_scale::BiScaleShared;
use super::cpca::CpcaShared;
use super::once::get_or_try;
use super::subsurface::{CARD, GatherCost, all_costs};
use super::tables::{SpeedUps, TeapotRoom, work_out};
use super::{ModelSize, ReproduceError};

/// Renderings and runs of the engine that entries share.
#[derive(Default)]
pub(super) struct Shared {
    pub(super) models: ModelSize,
    pub(super) cpca: CpcaShared,
    pub(super) bi_scale: BiScaleShared,
    teapot: OnceCell<TeapotRoom>,
    speed_ups: OnceCell<SpeedUps>,
    gather: OnceCell<Vec<GatherCost>>,
}

impl Shared {
    /// Creates empty cells.
    pub(super) fn new(models: ModelSize) -> Self {
        Self { models, ..Self::default() }
    }

    /// Teapot room of Tables 1 to 5.
    pub(super) fn teapot(&self) -> Result<&TeapotRoom, ReproduceError> {
        get_or_try(&self.teapot, TeapotRoom::new)
    }

    /// Rows of Tables 3 to 5 with their explanations.
    pub(super) fn speed_ups(&self) -> Result<&SpeedUps, ReproduceError> {
        get_or_try(&self.speed_ups, || work_out(self.teapot()?))
    }

    /// Cost of pass 2 of system 3 on the card of its Table 1, in each of its variants.
    pub(super) fn gather(&self) -> Result<&[GatherCost], ReproduceError> {
        Ok(get_or_try(&self.gather, || all_costs(CARD))?)
    }
}
