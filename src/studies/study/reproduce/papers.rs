//! The six papers.

/// Paper, in the order of the systems; displayed with the name that sentences use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display, strum::VariantArray)]
pub enum Paper {
    /// Carr, Hall and Hart 2002.
    #[strum(to_string = "Ray Engine")]
    RayEngine,
    /// Carr, Hall and Hart 2003, sections 1 to 3.
    #[strum(to_string = "radiosity")]
    Radiosity,
    /// Carr, Hall and Hart 2003, sections 4 and 5.
    #[strum(to_string = "subsurface scattering")]
    Subsurface,
    /// Sloan, Hall, Hart and Snyder 2003.
    #[strum(to_string = "CPCA")]
    Cpca,
    /// Liu, Sloan, Shum and Snyder 2004.
    #[strum(to_string = "all-frequency transfer")]
    AllFrequency,
    /// "Real-time all-frequency bi-scale radiance transfer".
    #[strum(to_string = "bi-scale transfer")]
    BiScale,
}

impl Paper {
    /// Name on the command line; names of the paper's entries and figures begin with it.
    pub const fn id(self) -> &'static str {
        match self {
            Self::RayEngine => "ray-engine",
            Self::Radiosity => "radiosity",
            Self::Subsurface => "subsurface",
            Self::Cpca => "cpca",
            Self::AllFrequency => "all-frequency",
            Self::BiScale => "bi-scale",
        }
    }

    /// Text of the file with the paper's figures.
    pub(super) const fn file(self) -> &'static str {
        match self {
            Self::RayEngine => include_str!("../../papers/ray_engine.toml"),
            Self::Radiosity => include_str!("../../papers/radiosity.toml"),
            Self::Subsurface => include_str!("../../papers/subsurface.toml"),
            Self::Cpca => include_str!("../../papers/cpca.toml"),
            Self::AllFrequency => include_str!("../../papers/all_frequency.toml"),
            Self::BiScale => include_str!("../../papers/bi_scale.toml"),
        }
    }
}
