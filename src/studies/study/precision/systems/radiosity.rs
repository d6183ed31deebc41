//! Matrix radiosity: iterations of equation 4 on the card, on the Cornell box.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::run::{SystemInput, SystemRun};
use crate::radiosity::packing::Packing;
use crate::radiosity::{CardSolver, FormFactors, Patches, Storage, Subdivision, System, rooms};
use crate::study::StudyError;
use crate::study::precision::goal::Goal;
use crate::study::radiosity::no_card;

/// Maximum number of patches. Programs are unrolled over patches, so each patch adds instructions.
const PATCHES: usize = 24;
/// Iterations from darkness, each of which adds one reflection of light.
const ITERATIONS: usize = 12;

/// Cornell box of few patches, with one texel of three channels per patch.
#[derive(Debug)]
pub(super) struct CornellBox {
    /// The Cornell box under its own light, and under a light of another color that is half as bright.
    systems: [System; 2],
}

impl CornellBox {
    pub(super) fn new() -> Result<Self, StudyError> {
        let patches = Patches::new(&rooms::cornell(rooms::CornellBox::default()), Subdivision::AtMost(PATCHES))?;
        let mut factors = FormFactors::unoccluded(&patches)?;
        factors.enforce_closure()?;
        let system = System::new(factors, patches.reflectances(), patches.emittances())?;
        let mut other = system.clone();
        other.set_emittance(patches.emittances().into_iter().map(|[r, g, b]| [0.2 * r, 0.5 * g, 0.4 * b]).collect())?;
        Ok(Self { systems: [system, other] })
    }
}

impl SystemRun for CornellBox {
    fn title(&self) -> &'static str {
        "Matrix radiosity in the Cornell box"
    }

    fn unit(&self) -> &'static str {
        "patch"
    }

    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let mut card = CardSolver::new(
            profile.clone(),
            executor.clone(),
            &self.systems[input as usize],
            Packing::Rgb,
            Storage::Fp32,
        )
        .map_err(no_card)?;
        (0..ITERATIONS).try_for_each(|_| card.iterate()).map_err(no_card)?;
        Ok(card.read().map_err(no_card)?.iter().map(|rgb| rgb.map(f64::from)).collect())
    }

    fn size(&self) -> Option<[u32; 2]> {
        None
    }

    /// Default goal: radiosities within 1 %.
    fn default_goal(&self) -> Goal {
        Goal::at_most("largest_relative", 0.01)
    }
}
