//! Parameters of the study.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::{GatherWay, SubsurfaceOptions};
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::study::caster::CasterChoice;
use crate::subsurface::Material;
use crate::subsurface::on_card::Light;
use crate::transfer::light::CubeLight;

/// A model of a medium, its lights, and the ways in which the card gathers.
#[derive(Debug)]
pub struct Parameters {
    /// The model's name.
    pub model: String,
    /// Its surface.
    pub mesh: Mesh,
    /// Its medium.
    pub material: Material,
    /// The light.
    pub lighting: Lighting,
    /// How light is gathered: a row of the table for each.
    pub ways: Vec<GatherWay>,
    /// The card.
    pub profile: Profile,
    /// The switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// The executor of the card.
    pub executor: Executor,
    /// What casts the shadow rays of an environment map.
    pub caster: CasterChoice,
    /// The camera of the pictures.
    pub camera: Camera,
    /// The options.
    pub options: SubsurfaceOptions,
}

/// The light on the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Lighting {
    /// Lights, by pass 1.
    Lights(Vec<Light>),
    /// Distant light of an environment map, per texel and with shadows, in place of pass 1.
    Environment(CubeLight),
}
