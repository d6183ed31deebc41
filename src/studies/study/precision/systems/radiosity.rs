//! Matrix radiosity: iterations of equation 4 on the card, on the Cornell box.

use super::subject::System as StudiedSystem;
use crate::radiosity::packing::Packing;
use crate::radiosity::{CardSolver, FormFactors, Patches, Storage, Subdivision, System, rooms};
use crate::study::StudyError;
use crate::study::precision::goal::Goal;
use crate::study::radiosity::no_card;

/// Maximum number of patches. Programs are unrolled over patches, so each patch adds instructions.
const PATCHES: usize = 24;
/// Iterations from darkness, each of which adds one reflection of light.
const ITERATIONS: usize = 12;

/// Cornell box of few patches, with one texel of three channels per patch: under its own light, and under a light of
/// another color that is half as bright. By default, radiosities are within 1 %.
pub(super) fn cornell_box() -> Result<StudiedSystem, StudyError> {
    let patches = Patches::new(&rooms::cornell(rooms::CornellBox::default()), Subdivision::AtMost(PATCHES))?;
    let mut factors = FormFactors::unoccluded(&patches)?;
    factors.enforce_closure()?;
    let system = System::new(factors, patches.reflectances(), patches.emittances())?;
    let mut other = system.clone();
    other.set_emittance(patches.emittances().into_iter().map(|[r, g, b]| [0.2 * r, 0.5 * g, 0.4 * b]).collect())?;
    let systems = [system, other];
    let values = StudiedSystem::picture("Matrix radiosity in the Cornell box", move |input, profile, executor| {
        let (profile, executor, system) = (profile.clone(), executor.clone(), &systems[input]);
        let mut card = CardSolver::new(profile, executor, system, Packing::Rgb, Storage::Fp32).map_err(no_card)?;
        (0..ITERATIONS).try_for_each(|_| card.iterate()).map_err(no_card)?;
        Ok(card.read().map_err(no_card)?.iter().map(|rgb| rgb.map(f64::from)).collect())
    });
    Ok(values.of_patches(Goal::at_most("largest_relative", 0.01)))
}
