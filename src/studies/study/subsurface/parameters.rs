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

/// A model made of a medium, its lights, and the ways in which the card gathers.
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
    /// Ways of gathering; each has a row in the table.
    pub ways: Vec<GatherWay>,
    /// The card.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// The executor of the card.
    pub executor: Executor,
    /// Caster of the shadow rays of an environment map.
    pub caster: CasterChoice,
    /// The camera of the pictures.
    pub camera: Camera,
    /// The options.
    pub options: SubsurfaceOptions,
}

/// The light on the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Lighting {
    /// Lights drawn by pass 1.
    Lights(Vec<Light>),
    /// Distant light of an environment map, per texel and with shadows; replaces pass 1.
    Environment(CubeLight),
}
