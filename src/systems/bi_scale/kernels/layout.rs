//! The layout of local light in texture coordinate sets, and the vertex program that forwards it.

use std::fmt::Write as _;

use refsim::isa::Version;

use crate::card::{TO_CLIP, WrittenKernel, local_view};

/// The last set holds texture coordinates u, v and the view along bitangent and tangent; the fourth component of the
/// first set is the view along the normal. Every other set has a direction's red, green and blue in its first three
/// components; the fourth components of three sets hold one more direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LocalLayout {
    /// Number of texture coordinate sets, of four numbers each: 3 or more.
    pub sets: usize,
}

/// Interpolated numbers besides local light: u, v and three components of the view.
const BESIDE: usize = 5;

impl LocalLayout {
    /// Number of directions per pass: each uses three of the numbers that remain besides u, v and the view.
    pub const fn directions(self) -> usize {
        (4 * self.sets).saturating_sub(BESIDE) / 3
    }

    /// Number of passes for `directions` directions. Panics if there are fewer than three sets.
    pub const fn passes(self, directions: usize) -> usize {
        directions.div_ceil(self.directions())
    }

    /// The set of u, v and the view.
    pub const fn last(self) -> usize {
        self.sets - 1
    }

    /// The set and component of a direction's channel. Panics if there is no such direction or channel.
    pub fn place(self, direction: usize, channel: usize) -> (usize, usize) {
        assert!(direction < self.directions() && channel < 3, "direction {direction}, channel {channel}");
        match direction.checked_sub(self.last()) {
            None => (direction, channel),
            Some(loose) => (1 + 3 * loose + channel, 3),
        }
    }
}

/// A vertex program that forwards local light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LocalVertexKernel {
    /// The layout of the numbers.
    pub layout: LocalLayout,
    /// [`Version::Vs2_0`] or [`Version::Vs1_1`].
    pub version: Version,
}

impl LocalVertexKernel {
    /// Number of vertex attributes: position, sets, texture coordinates, tangent, normal.
    pub const fn attributes(&self) -> usize {
        1 + self.layout.last() + 3
    }

    /// Instruction slots.
    pub const fn slots(&self) -> usize {
        4 + self.layout.last() + 8
    }
}

impl WrittenKernel for LocalVertexKernel {
    fn name(&self) -> String {
        format!("local light of {} directions, {}", self.layout.directions(), self.version)
    }

    fn text(&self) -> String {
        let last = self.layout.last();
        let mut text = format!("{}\n; {}\ndcl_position v0\n", self.version, self.name());
        for set in 0..=last {
            let _ = writeln!(text, "dcl_texcoord{set} v{}", 1 + set);
        }
        let (tangent, normal) = (2 + last, 3 + last);
        let _ = write!(text, "dcl_tangent v{tangent}\ndcl_normal v{normal}\n");
        text.push_str(TO_CLIP);
        for set in 0..last {
            let _ = writeln!(text, "mov oT{set}{}, v{}", if set == 0 { ".xyz" } else { "" }, 1 + set);
        }
        let _ = writeln!(text, "mov oT{last}.xy, v{}", 1 + last);
        text.push_str(&local_view(tangent, normal));
        let _ = write!(text, "dp3 oT{last}.z, r0, r2\ndp3 oT{last}.w, r0, r1\ndp3 oT0.w, r0, v{normal}\n");
        text
    }
}
