//! Size of stand-in models.

/// Size of the stand-ins for a paper's models, for entries that have a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ModelSize {
    /// Small models: seconds per entry, for tests.
    Reduced,
    /// As printed: half a minute to three hours of processor time per entry.
    #[default]
    Printed,
}

impl ModelSize {
    /// One of two values: for models as printed, or for reduced models.
    pub(super) fn pick<T>(self, printed: T, reduced: T) -> T {
        match self {
            Self::Printed => printed,
            Self::Reduced => reduced,
        }
    }
}
