//! The pixel program of the display (equation 3; section V, Rendering): b(u, e) times local light, for the directions
//! of a pass. The program finds the four samples of the view around e in the square from which directions are mapped:
//! "we map the view direction back to the direction sphere and retrieve the four adjacent samples".
//!
//! - t0 and up: the numbers of [`LocalLayout`].
//! - s0: the bidirectional texture in a volume ([`BlockGrid`]), filtered by the sampler within a block. Layers are read
//!   at their centers, so the sampler does not interpolate between layers.
//! - c[`FIRST_ORIGIN`] and up: the origin of each direction's block, in coordinates of the volume.
//! - Output: the sum over the directions of the pass; alpha is 1.
//!
//! The arc tangent of the map from the sphere to the square is an odd polynomial of degree 15, whose error is below
//! 5e-8 of an eighth of a turn.

use std::fmt::Write as _;

use refsim::isa::Version;

use super::blocks::{BlockEdges, BlockGrid};
use super::layout::LocalLayout;
use crate::card::WrittenKernel;

/// The constant register of the first direction's block origin.
pub const FIRST_ORIGIN: usize = 8;

/// Minimax coefficients of atan(t) / (pi / 4) for t from 0 to 1, as t times a polynomial in t^2.
const ARC_TANGENT: [f64; 8] = [
    1.273_238_7,
    -0.424_368_97,
    0.253_967_56,
    -0.177_090_17,
    0.122_768_27,
    -0.071_189_79,
    0.027_836_784,
    -0.005_162_436,
];
/// Lower bound to which squared lengths, in units of the body's frame, are clamped.
const LEAST: f64 = 1.0 / 1_099_511_627_776.0;

/// A program for the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DisplayKernel {
    /// The layout of the interpolated numbers.
    pub layout: LocalLayout,
    /// The layout of blocks in the volume.
    pub grid: BlockGrid,
    /// Directions of the pass.
    pub directions: usize,
    /// [`Version::Ps2B`] or [`Version::Ps2A`].
    pub version: Version,
}

impl DisplayKernel {
    fn push_constants(&self, text: &mut String) {
        let (side, [width, height, layers]) = (self.grid.views as f64, self.grid.extents().map(|side| side as f64));
        let (size, border) = (self.grid.size as f64, self.grid.border() as f64);
        let _ = writeln!(text, "def c0, 1, 0, {LEAST}, 0");
        for (register, four) in ARC_TANGENT.as_chunks::<4>().0.iter().enumerate() {
            let [a, b, c, d] = four;
            let _ = writeln!(text, "def c{}, {a}, {b}, {c}, {d}", 1 + register);
        }
        let _ = write!(
            text,
            "def c3, {}, {}, {}, {side}\ndef c4, {}, {}, {}, {}\ndef c5, {}, {}, 0, 0\ndef c6, {}, {}, 0, 0\n",
            side / 2.0,
            side / 2.0 - 0.5,
            side - 1.0,
            1.0 / layers,
            0.5 / layers,
            0.5 / size,
            1.0 - 0.5 / size,
            size / width,
            size / height,
            border / width,
            border / height,
        );
    }

    /// Computes the view's point in the square in r4.xy. Views below the horizon are moved to the horizon.
    fn push_square(&self, text: &mut String) {
        let last = self.layout.last();
        let _ = write!(
            text,
            "; 1 - z of the view's direction, without cancellation; its root is the radius\n\
             mov r0.xy, t{last}.wzyx\nmov r0.z, t0.w\ndp3 r1.x, r0, r0\nmax r1.x, r1.x, c0.z\nrsq r1.y, r1.x\n\
             mul r1.y, r1.x, r1.y\nmul r1.z, r0.x, r0.x\nmad r1.z, r0.y, r0.y, r1.z\nmad r1.w, r1.y, r0.z, r1.x\n\
             max r1.w, r1.w, c0.z\nrcp r1.w, r1.w\nmul r1.z, r1.z, r1.w\ncmp r1.z, r0.z, r1.z, c0.x\n\
             max r1.z, r1.z, c0.z\nrsq r1.w, r1.z\nmul r1.w, r1.z, r1.w\n\
             ; the smaller over the larger of |x| and |y|\n\
             abs r2.xy, r0\nmax r2.z, r2.x, r2.y\nmin r2.w, r2.x, r2.y\nmax r2.z, r2.z, c0.z\nrcp r2.z, r2.z\n\
             mul r2.z, r2.w, r2.z\nmul r2.w, r2.z, r2.z\n\
             mad r3.x, c2.w, r2.w, c2.z\nmad r3.x, r3.x, r2.w, c2.y\nmad r3.x, r3.x, r2.w, c2.x\n\
             mad r3.x, r3.x, r2.w, c1.w\nmad r3.x, r3.x, r2.w, c1.z\nmad r3.x, r3.x, r2.w, c1.y\n\
             mad r3.x, r3.x, r2.w, c1.x\nmul r3.x, r3.x, r2.z\nmul r3.x, r3.x, r1.w\n\
             add r2.x, r2.x, -r2.y\ncmp r4.x, r2.x, r1.w, r3.x\ncmp r4.y, r2.x, r3.x, r1.w\ncmp r4.xy, r0, r4, -r4\n"
        );
    }

    /// Computes the coordinates of the four layers' centers in r7, and their weights in r8.
    fn push_samples(&self, text: &mut String) {
        text.push_str(
            "; cells around the point, and weights\nmad r4.xy, r4, c3.x, c3.y\nmax r4.xy, r4, c0.y\n\
             min r4.xy, r4, c3.z\nfrc r5.xy, r4\nadd r4.xy, r4, -r5\nadd r6.xy, r4, c0.x\nmin r6.xy, r6, c3.z\n\
             mad r7.x, r4.y, c3.w, r4.x\nmad r7.y, r4.y, c3.w, r6.x\nmad r7.z, r6.y, c3.w, r4.x\n\
             mad r7.w, r6.y, c3.w, r6.x\nmad r7, r7, c4.x, c4.y\nadd r6.xy, c0.x, -r5\nmul r8.x, r6.x, r6.y\n\
             mul r8.y, r5.x, r6.y\nmul r8.z, r6.x, r5.y\nmul r8.w, r5.x, r5.y\n",
        );
    }

    /// Computes the four positions in a block at the volume's corner in r0 to r3.
    fn push_coordinates(&self, text: &mut String) {
        let _ = writeln!(text, "; the place in a block\nfrc r9.xy, t{}", self.layout.last());
        if self.grid.edges == BlockEdges::Touching {
            text.push_str("max r9.xy, r9, c4.z\nmin r9.xy, r9, c4.w\n");
        }
        text.push_str("mov r0, c0.y\nmul r0.xy, r9, c5\nadd r0.xy, r0, c6\n");
        for (register, component) in ['y', 'z', 'w'].into_iter().enumerate() {
            let register = 1 + register;
            let _ = write!(text, "mov r{register}, r0\nmov r{register}.z, r7.{component}\n");
        }
        text.push_str("mov r0.z, r7.x\n");
    }

    /// Interpolates b of a direction between four views, multiplies it by the direction's light, and adds it to r11.
    fn push_direction(&self, text: &mut String, direction: usize) {
        let origin = FIRST_ORIGIN + direction;
        for (from, into) in (0..4).zip(4..) {
            // r7 and r9 are free here; r4 to r7 hold coordinates, then texels.
            let _ = writeln!(text, "add r{into}, r{from}, c{origin}");
        }
        for register in 4..8 {
            let _ = writeln!(text, "texld r{register}, r{register}, s0");
        }
        text.push_str("mul r9, r4, r8.x\nmad r9, r5, r8.y, r9\nmad r9, r6, r8.z, r9\nmad r9, r7, r8.w, r9\n");
        let is_first = direction == 0;
        if direction < self.layout.last() {
            let _ = if is_first {
                writeln!(text, "mul r11.xyz, r9, t{direction}")
            } else {
                writeln!(text, "mad r11.xyz, r9, t{direction}, r11")
            };
            return;
        }
        for (channel, component) in ['x', 'y', 'z'].into_iter().enumerate() {
            let (set, _) = self.layout.place(direction, channel);
            let _ = writeln!(text, "mad r11.{component}, r9.{component}, t{set}.w, r11.{component}");
        }
    }
}

impl WrittenKernel for DisplayKernel {
    fn name(&self) -> String {
        let Self { directions, grid, version, .. } = self;
        format!(
            "{directions} directions of {0} x {0} with {1} x {1} views, {2} x {2} texels {3}, {version}",
            grid.lights, grid.views, grid.size, grid.edges
        )
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n; {}\n", self.version, self.name());
        self.push_constants(&mut text);
        for set in 0..self.layout.sets {
            let _ = writeln!(text, "dcl t{set}");
        }
        text.push_str("dcl_volume s0\n");
        self.push_square(&mut text);
        self.push_samples(&mut text);
        self.push_coordinates(&mut text);
        for direction in 0..self.directions {
            self.push_direction(&mut text, direction);
        }
        text.push_str("mov r11.w, c0.x\nmov oC0, r11\n");
        text
    }
}
