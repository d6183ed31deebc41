//! Dynamic relighting: a new emission or reflectance with the same form factors (section 1: "while the geometry is
//! fixed, the emittance is not").

use crate::names::did_you_mean;
use crate::radiosity::{Patches, System};
use crate::scene::{Color, Scene};
use crate::study::StudyError;

/// Change of a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Change {
    /// New radiance.
    Emission { material: String, radiance: Color },
    /// New reflectance, in [0, 1).
    Reflectance { material: String, reflectance: Color },
}

/// Solution after changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Relit {
    /// Radiosity of each patch.
    pub(super) radiosity: Vec<[f64; 3]>,
    /// Iterations from the previous solution; `None` if the tolerance was not reached.
    pub(super) from_last: Option<usize>,
    /// Iterations from 0; `None` if the tolerance was not reached.
    pub(super) from_nothing: Option<usize>,
}

/// Applies the changes to a system; `None` if there are no changes.
pub(super) fn apply(
    changes: &[Change],
    scene: &Scene,
    patches: &Patches,
    system: &System,
) -> Result<Option<System>, StudyError> {
    if changes.is_empty() {
        return Ok(None);
    }
    let (mut emittance, mut reflectance) = (system.emittance().to_vec(), system.reflectance().to_vec());
    for change in changes {
        let (name, values, value) = match change {
            Change::Emission { material, radiance } => {
                (material, &mut emittance, radiance.map(|l| std::f64::consts::PI * f64::from(l)))
            }
            Change::Reflectance { material, reflectance: rho } => (material, &mut reflectance, rho.map(f64::from)),
        };
        let Some(material) = scene.materials().iter().position(|m| m.name == *name) else {
            let known: Vec<&str> = scene.materials().iter().map(|m| m.name.as_str()).collect();
            let help = format!("{}its materials are {}", did_you_mean(name, known.iter().copied()), known.join(", "));
            let what = format!("the scene has no material `{name}`");
            return Err(StudyError::new("radiosity::material", what).with_help(help));
        };
        let painted = patches.list().iter().zip(values.iter_mut()).filter(|(p, _)| p.material as usize == material);
        painted.for_each(|(_, old)| *old = value);
    }
    let mut changed = system.clone();
    changed.set_emittance(emittance)?;
    changed.set_reflectance(reflectance)?;
    Ok(Some(changed))
}
