//! Cost of an intersection: slots of the pixel program, and clocks of a pipeline.

use refsim::device::Profile;
use refsim::event::{FlowConstants, ProgramWork};
use refsim::timing::{Level, Model};

use crate::geom::exact::Sides;
use crate::ray_engine::{EdgeRule, EngineError, Kernel};

/// Cost of the pixel program of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntersectionCost {
    /// Arithmetic slots; a pair of a color and an alpha instruction counts as one.
    pub arithmetic: u32,
    /// Texture slots.
    pub texture: u32,
    /// Clocks of one pixel pipeline; `None` for devices without figures of time.
    pub clocks: Option<u64>,
}

impl IntersectionCost {
    /// Cost of the program that a device runs on rays with one common origin, or with any origins.
    pub(super) fn of(profile: &Profile, one_origin: bool, sides: Sides, edges: EdgeRule) -> Result<Self, EngineError> {
        let kernel = match edges {
            EdgeRule::Paper => Kernel::choose(profile, one_origin, sides)?,
            EdgeRule::SharedEdges => Kernel::with_shared_edges(profile, one_origin, sides)?,
        };
        let [first, second] = kernel.pixel.facts().slots;
        let work = ProgramWork::new(&kernel.pixel, FlowConstants::default());
        let model = Model::new(Level::Pipeline, profile).ok();
        Ok(Self {
            arithmetic: first.arithmetic + second.arithmetic,
            texture: first.texture + second.texture,
            clocks: model.map(|model| model.fragment(&work).total().0),
        })
    }
}
