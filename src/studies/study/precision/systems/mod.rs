//! The six systems as subjects, each with a small input. The host computes the input, which is the same for every
//! format; the study varies the pixel programs of the card.

mod all_frequency;
mod bi_scale;
mod cpca;
mod radiosity;
mod ray_engine;
mod subject;
mod subsurface;

use refsim::device::Profile;

use super::subject::PrecisionSubject;
use crate::study::StudyError;

/// System of the papers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum PaperSystem {
    /// The Ray Engine's intersection program, on the teapot.
    RayEngine,
    /// Equation 4 of matrix radiosity, on the Cornell box.
    Radiosity,
    /// The three passes of subsurface scattering, in a bunny of marble.
    Subsurface,
    /// Clustered principal components, glossy, on the bunny.
    Cpca,
    /// Products of all-frequency transfer per pixel, on the bunny.
    AllFrequency,
    /// Display of bi-scale transfer, on the bunny.
    BiScale,
}

impl PaperSystem {
    /// The paper's card.
    pub fn card(self) -> &'static str {
        match self {
            Self::RayEngine => "r200",
            Self::Radiosity | Self::Subsurface => "nv35",
            Self::Cpca => "r300",
            Self::AllFrequency => "r350",
            Self::BiScale => "gt200",
        }
    }

    /// Subject on a device. Fails if the device cannot run the system.
    pub fn subject(self, profile: Profile) -> Result<Box<dyn PrecisionSubject>, StudyError> {
        Ok(Box::new(match self {
            Self::RayEngine => ray_engine::subject(profile)?,
            Self::Radiosity => radiosity::cornell_box()?.subject(profile)?,
            Self::Subsurface => subsurface::marble()?.subject(profile)?,
            Self::Cpca => cpca::glossy_bunny()?.subject(profile)?,
            Self::AllFrequency => all_frequency::factored_bunny()?.subject(profile)?,
            Self::BiScale => bi_scale::textured_bunny()?.subject(profile)?,
        }))
    }
}
