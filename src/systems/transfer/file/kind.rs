//! The system that a `.prt` file belongs to.

use super::VERSION;

/// The system that a `.prt` file belongs to: the number of its conventions, which docs/prt-format.md specifies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::FromRepr)]
#[repr(u32)]
pub enum PrtKind {
    /// [`PrtFile`](super::PrtFile): real orthonormal harmonics, function l(l+1)+m, no Condon-Shortley sign (l = 1 is y,
    /// z, x), light in the axes of the mesh, exit radiance in those of the vertex with its normal as z.
    #[strum(to_string = "low-frequency transfer")]
    LowFrequency = 1,
    /// [`AllFrequencyFile`](crate::all_frequency::file::AllFrequencyFile).
    #[strum(to_string = "transfer of all frequencies")]
    AllFrequency = 2,
    /// [`BiScaleFile`](crate::bi_scale::file::BiScaleFile).
    #[strum(to_string = "bi-scale transfer")]
    BiScale = 3,
}

impl PrtKind {
    /// The latest version of any kind.
    pub(super) const LATEST_VERSION: u32 = Self::BiScale.latest_version();

    /// The latest version of such files.
    pub const fn latest_version(self) -> u32 {
        match self {
            Self::LowFrequency | Self::AllFrequency => VERSION,
            Self::BiScale => 2,
        }
    }

    /// The command that takes such files.
    pub const fn command(self) -> &'static str {
        match self {
            Self::LowFrequency => "cpca",
            Self::AllFrequency => "all-frequency",
            Self::BiScale => "bi-scale",
        }
    }
}
