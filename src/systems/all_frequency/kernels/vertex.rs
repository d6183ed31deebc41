//! The vertex program that section 6 proposes: it forwards transferred radiance and adds the local view.
//!
//! - v0: position, w = 1; v1 and up: the numbers of [`SetLayout`], one set each; then the tangent and the normal.
//! - c0 to c3: rows of the projection; c4: the eye.
//! - oT0 and up: the sets.

use std::fmt::Write as _;

use refsim::isa::Version;

use super::layout::{SetLayout, ViewNumbers};
use crate::card::{TO_CLIP, WrittenKernel, local_view};

/// A vertex program that forwards transferred radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TransferredVertexKernel {
    /// The layout of the numbers.
    pub layout: SetLayout,
    /// [`Version::Vs2_0`] or [`Version::Vs1_1`].
    pub version: Version,
}

impl TransferredVertexKernel {
    /// Number of vertex attributes.
    pub fn attributes(&self) -> usize {
        1 + self.layout.sets() + 2
    }

    /// Number of instruction slots.
    pub fn slots(&self) -> usize {
        self.text().lines().filter(|line| !line.starts_with([';', 'v', 'd']) || line.starts_with("dp")).count()
    }

    /// Mask of the components of a set that do not hold the view; `None` if there are none.
    fn rest_of(&self, set: usize) -> Option<&'static str> {
        match self.layout.view {
            _ if set != self.layout.view_set() => Some(""),
            _ if self.layout.loose() == 0 => None,
            ViewNumbers::Coordinates => Some(".zw"),
            ViewNumbers::Vector => Some(".w"),
        }
    }

    /// Writes the view vector along tangent, bitangent and normal.
    fn push_view(&self, text: &mut String) {
        let (tangent, normal, set) =
            (1 + self.layout.sets(), 2 + self.layout.sets(), format!("oT{}", self.layout.view_set()));
        let local = if self.layout.view == ViewNumbers::Vector { set.as_str() } else { "r3" };
        text.push_str(&local_view(tangent, normal));
        let _ = write!(text, "dp3 {local}.x, r0, r1\ndp3 {local}.y, r0, r2\ndp3 {local}.z, r0, v{normal}\n");
        if self.layout.view == ViewNumbers::Coordinates {
            let _ = write!(
                text,
                "; x and y over |v| + z, from [-1, 1] to [0, 1]\ndp3 r3.w, r3, r3\nrsq r4.x, r3.w\n\
                 mad r4.x, r3.w, r4.x, r3.z\nmax r4.x, r4.x, c5.x\nrcp r4.x, r4.x\nmul r4.x, r4.x, c5.y\n\
                 mad {set}.xy, r3, r4.x, c5.y\n"
            );
        }
    }
}

impl WrittenKernel for TransferredVertexKernel {
    fn name(&self) -> String {
        let SetLayout { terms, channels, view } = self.layout;
        format!("transferred_{terms}x{channels}, {view} by the program, {}", self.version)
    }

    fn text(&self) -> String {
        let sets = self.layout.sets();
        let mut text = format!("{}\n; {}\n", self.version, self.name());
        if self.layout.view == ViewNumbers::Coordinates {
            // 2^-20, a lower bound of |v| + z in units of the body's frame, so that views along -z have finite
            // coordinates.
            text.push_str("def c5, 0.00000095367431640625, 0.5, 0, 0\n");
        }
        text.push_str("dcl_position v0\n");
        for set in 0..sets {
            let _ = writeln!(text, "dcl_texcoord{set} v{}", 1 + set);
        }
        let _ = writeln!(text, "dcl_tangent v{}\ndcl_normal v{}", 1 + sets, 2 + sets);
        text.push_str(TO_CLIP);
        for set in 0..sets {
            let _ = match self.rest_of(set) {
                None => Ok(()),
                Some(mask) => writeln!(text, "mov oT{set}{mask}, v{}", 1 + set),
            };
        }
        self.push_view(&mut text);
        text
    }
}
