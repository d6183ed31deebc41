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
