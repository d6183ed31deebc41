//! The vertex program of the display: local light goes through, texture coordinates and the local view are added.
//!
//! - v0 position, w = 1; v1 on the sets of [`LocalLayout`] but the last; then u, v; then tangent and normal.
//! - c0 to c3 rows of the projection; c4 the eye.
//! - oT0 on: the sets.

use std::fmt::Write as _;

use refsim::isa::Version;

use super::layout::LocalLayout;
use crate::card::{TO_CLIP, WrittenKernel, local_view};

/// A vertex program that hands local light on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LocalVertexKernel {
    /// The places of the numbers.
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
