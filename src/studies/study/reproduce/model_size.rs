//! Size of stand-in models.

/// Size of the stand-ins for a paper's models, where an entry has a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ModelSize {
    /// Reduced: seconds per entry. Rows are then those of a recorded run at full size, where there is one.
    #[default]
    Reduced,
    /// As printed: half a minute to three hours of processor time per entry.
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
