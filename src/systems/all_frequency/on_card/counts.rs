//! Colors that a picture cannot show.

/// What happened to colors. Truncated factors have negative lobes: targets and vertices of fractions clamp them, so
/// they are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FactoredCounts {
    /// Pixels that show the mesh; `None`: the device has no target of floats to count in.
    pub covered: Option<u64>,
    /// Of them those with a channel below 0 before the target clamps.
    pub below_zero: Option<u64>,
    /// Vertices with a channel below 0; `None` where products are made per pixel.
    pub vertices_below_zero: Option<u64>,
    /// Vertices with a channel above 1, which bytes clamp.
    pub vertices_above_one: Option<u64>,
}
