//! Parameters of the study.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::method::SolveMethod;
use super::options::RadiosityOptions;
use crate::scene::{Camera, Scene};
use crate::study::caster::CasterChoice;

/// Parameters of the study: scene, methods and output.
#[derive(Debug)]
pub struct Parameters {
    /// Scene.
    pub scene: Scene,
    /// Methods; each has a row in the table.
    pub methods: Vec<SolveMethod>,
    /// Card for the methods that run on one.
    pub profile: Profile,
    /// Switches of the card that were set.
    pub switches: Vec<(String, String)>,
    /// Executor of the card.
    pub executor: Executor,
    /// Camera of the pictures.
    pub camera: Camera,
    /// Casters of the rays for form factors, at least one. Several engines are compared; the room of the first is
    /// solved.
    pub casters: Vec<CasterChoice>,
    /// Options.
    pub options: RadiosityOptions,
}

impl Parameters {
    pub(super) fn caster(&self) -> &CasterChoice {
        self.casters.first().unwrap_or(&CasterChoice::Host)
    }
}
