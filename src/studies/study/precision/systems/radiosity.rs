//! Matrix radiosity: iterations of equation 4 on the card, on the Cornell box.

use refsim::device::Profile;
use refsim::machine::Executor;

use super::{SystemRun, at_most};
use crate::radiosity::packing::Packing;
use crate::radiosity::{CardSolver, FormFactors, Patches, Storage, Subdivision, System, rooms};
use crate::study::StudyError;
use crate::study::precision::goal::Goal;

/// Patches, at most. Programs are unrolled over them, so that their number is that of instructions too.
const PATCHES: usize = 24;
/// Iterations from darkness: light has been reflected so often.
const ITERATIONS: usize = 12;

/// Cornell box in few patches, a texel of three channels each.
#[derive(Debug)]
pub(super) struct CornellBox {
    system: System,
}

impl CornellBox {
    pub(super) fn new() -> Result<Self, StudyError> {
        let patches = Patches::new(&rooms::cornell(rooms::CornellBox::default()), Subdivision::AtMost(PATCHES))?;
        let mut factors = FormFactors::unoccluded(&patches)?;
        factors.enforce_closure()?;
        Ok(Self { system: System::new(factors, patches.reflectances(), patches.emittances())? })
    }
}

impl SystemRun for CornellBox {
    fn title(&self) -> &'static str {
        "Matrix radiosity in the Cornell box"
    }

    fn unit(&self) -> &'static str {
        "patch"
    }

    fn values(&self, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError> {
        let mut card = CardSolver::new(profile.clone(), executor.clone(), &self.system, Packing::Rgb, Storage::Fp32)?;
        for _ in 0..ITERATIONS {
            card.iterate()?;
        }
        Ok(card.read()?.iter().map(|rgb| rgb.map(f64::from)).collect())
    }

    /// Radiosities within 1 %.
    fn default_goal(&self) -> Goal {
        at_most("largest_relative", 0.01)
    }
}
