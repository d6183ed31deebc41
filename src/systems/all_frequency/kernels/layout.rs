//! The layout of a vertex's terms and view in texture coordinate sets.

/// The representation of the view that is interpolated (section 6 says "compute the local view direction", but not
/// where).
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub enum ViewNumbers {
    /// Two coordinates in the parabolic map, computed at the vertices: nothing is normalised per pixel.
    #[default]
    Coordinates,
    /// The local view vector, unnormalised. The pixel program divides by its length plus z, so that the direction is
    /// exact on a flat triangle with a constant frame.
    Vector,
}

impl ViewNumbers {
    /// The number of interpolated numbers.
    pub fn count(self) -> usize {
        match self {
            Self::Coordinates => 2,
            Self::Vector => 3,
        }
    }
}

/// Components of a coordinate set.
pub(super) const COMPONENTS: [char; 4] = ['x', 'y', 'z', 'w'];

/// The layout of m terms per channel and of the view in coordinate sets: full sets of four terms per channel, then the
/// view, then the remaining terms of each channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SetLayout {
    /// The number m of terms.
    pub terms: usize,
    /// Channels per pass: 1 or 3.
    pub channels: usize,
    /// The representation of the view.
    pub view: ViewNumbers,
}

impl SetLayout {
    /// Number of full sets per channel.
    pub fn quads(&self) -> usize {
        self.terms / 4
    }

    /// Number of remaining terms per channel, which fill no set.
    pub fn loose(&self) -> usize {
        self.terms % 4
    }

    /// Number of interpolated numbers.
    pub fn numbers(&self) -> usize {
        self.channels * self.terms + self.view.count()
    }

    /// Number of coordinate sets.
    pub fn sets(&self) -> usize {
        self.numbers().div_ceil(4)
    }

    /// The set whose first components hold the view.
    pub fn view_set(&self) -> usize {
        self.channels * self.quads()
    }

    /// The set and component of a term. Panics if there is no such term or channel.
    pub fn place(&self, term: usize, channel: usize) -> (usize, usize) {
        assert!(term < self.terms && channel < self.channels, "term {term} of channel {channel}");
        let quad = term / 4;
        if quad < self.quads() {
            return (channel * self.quads() + quad, term % 4);
        }
        let loose = self.view.count() + channel * self.loose() + term % 4;
        (self.view_set() + loose / 4, loose % 4)
    }
}
