//! The layout of local light in texture coordinate sets.

/// The last set holds texture coordinates u, v and the view along bitangent and tangent; the fourth component of the
/// first set is the view along the normal. Every other set has a direction's red, green and blue in its first three
/// components; what is left of three sets holds one direction more.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LocalLayout {
    /// Sets of four numbers: 3 or more.
    pub sets: usize,
}

/// Numbers of a pixel beside local light: u, v and three of the view.
const BESIDE: usize = 5;

impl LocalLayout {
    /// Number of directions per pass: three numbers each of those that u, v and the view leave free.
    pub const fn directions(self) -> usize {
        (4 * self.sets).saturating_sub(BESIDE) / 3
    }

    /// Number of passes for `directions` directions.
    ///
    /// # Panics
    /// If there are fewer than three sets.
    pub const fn passes(self, directions: usize) -> usize {
        directions.div_ceil(self.directions())
    }

    /// The set of u, v and the view.
    pub const fn last(self) -> usize {
        self.sets - 1
    }

    /// The set and component of a direction's channel.
    ///
    /// # Panics
    /// If there is no such direction or channel.
    pub fn place(self, direction: usize, channel: usize) -> (usize, usize) {
        assert!(direction < self.directions() && channel < 3, "direction {direction}, channel {channel}");
        match direction.checked_sub(self.last()) {
            None => (direction, channel),
            Some(loose) => (1 + 3 * loose + channel, 3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_number_has_a_place_of_its_own() {
        for sets in 3..=16 {
            let layout = LocalLayout { sets };
            let beside = [(0, 3), (layout.last(), 0), (layout.last(), 1), (layout.last(), 2), (layout.last(), 3)];
            let of = (0..layout.directions()).flat_map(|d| (0..3).map(move |channel| layout.place(d, channel)));
            let places: BTreeSet<_> = of.chain(beside).collect();
            assert_eq!(places.len(), 3 * layout.directions() + BESIDE, "{sets} sets");
            assert!(places.iter().all(|&(set, component)| set < sets && component < 4));
            assert!(4 * sets - places.len() < 3, "{sets} sets: room for one more");
        }
    }

    /// Eight sets of ps_2_x; fifteen of shader model 4: Direct3D 10 has 16 outputs of a vertex program, of which
    /// position takes one, and Mesa's driver for these cards (nv50_screen.c) gives fragment programs 15 inputs.
    #[test]
    fn passes_for_the_papers_directions() {
        let passes = |sets, directions| LocalLayout { sets }.passes(directions);
        assert_eq!([8, 15, 16].map(|sets| LocalLayout { sets }.directions()), [9, 18, 19]);
        assert_eq!([64, 144].map(|directions| passes(8, directions)), [8, 16]);
        assert_eq!([64, 144].map(|directions| passes(15, directions)), [4, 8]);
        assert_eq!([64, 144].map(|directions| passes(16, directions)), [4, 8]);
    }
}
