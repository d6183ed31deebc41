//! Size of stand-in models.

/// Size of the stand-ins for a paper's models, where an entry has a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ModelSize {
    /// Reduced: seconds per entry.
    #[default]
    Reduced,
    /// As printed: minutes to hours per entry.
    Printed,
}

impl ModelSize {
    /// Side of the pictures, in pixels.
    pub(super) const fn picture_side(self) -> u32 {
        match self {
            Self::Reduced => 320,
            Self::Printed => 640,
        }
    }
}
