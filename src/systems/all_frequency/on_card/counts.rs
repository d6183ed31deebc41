//! Counts of colors out of a target's range.

/// Counts of clamped colors. Truncated factors have negative lobes, which targets and vertex colors in fractions clamp
/// to 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FactoredCounts {
    /// Pixels that show the mesh; `None` if the device has no floating-point target by which to count.
    pub covered: Option<u64>,
    /// Covered pixels with a negative channel before clamping.
    pub below_zero: Option<u64>,
    /// Vertices with a negative channel; `None` if products are computed per pixel.
    pub vertices_below_zero: Option<u64>,
    /// Vertices with a channel above 1, which bytes clamp.
    pub vertices_above_one: Option<u64>,
}
