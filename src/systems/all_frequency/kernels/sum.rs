//! Equation 13 as a program: four numbers of T_p of a vertex, sixteen representatives of a segment at once.
//!
//! A fragment is a vertex. TEX0 counts texels of the textures of vertices.
//!
//! - texture 0: x, y of the texel of the first representative of the vertex's cluster;
//! - textures 1 to 4: the weights on the sixteen, four per texel;
//! - texture 5: four numbers of T of each representative, those of a cluster side by side;
//! - texture 6: the sum so far; not in the first program.
//!
//! All textures are rectangles. Sums run from the first representative to the last. Addresses are made before the first
//! read that needs one, so that reads depend on one another over two levels.

use std::fmt::Write as _;

use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use super::layout::COMPONENTS;
use crate::card::{KernelError, checked};

/// Representatives of a pass.
pub const SUMMED: usize = 16;
/// The texture of the representatives.
pub const OF_REPRESENTATIVES: usize = 5;
/// The texture of the sum so far.
pub const OF_SUM: usize = 6;

/// A program for weighted sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SumKernel {
    /// Whether sums begin.
    pub is_first: bool,
}

impl SumKernel {
    /// Textures that it reads.
    pub const fn samplers(&self) -> usize {
        if self.is_first { OF_SUM } else { OF_SUM + 1 }
    }

    /// A name for messages.
    pub const fn name(&self) -> &'static str {
        if self.is_first { "sum_first" } else { "sum_next" }
    }

    /// The program.
    pub fn text(&self) -> String {
        let mut text = format!("!!ARBfp1.0\n# {}\nTEMP base, sum, w0, w1, w2, w3;\n", self.name());
        let names: Vec<String> = (0..SUMMED).map(|k| format!("m{k}")).collect();
        let _ = writeln!(text, "TEMP {};", names.join(", "));
        text.push_str("TEX base, fragment.texcoord[0], texture[0], RECT;\n");
        for quad in 0..SUMMED / 4 {
            let _ = writeln!(text, "TEX w{quad}, fragment.texcoord[0], texture[{}], RECT;", 1 + quad);
        }
        if self.is_first {
            text.push_str("MOV sum, {0, 0, 0, 0};\n");
        } else {
            let _ = writeln!(text, "TEX sum, fragment.texcoord[0], texture[{OF_SUM}], RECT;");
        }
        for k in 0..SUMMED {
            let _ = writeln!(text, "ADD m{k}, base, {{{k}, 0, 0, 0}};");
        }
        for k in 0..SUMMED {
            let _ = writeln!(text, "TEX m{k}, m{k}, texture[{OF_REPRESENTATIVES}], RECT;");
        }
        for k in 0..SUMMED {
            let _ = writeln!(text, "MAD sum, w{}.{}, m{k}, sum;", k / 4, COMPONENTS[k % 4]);
        }
        text.push_str("MOV result.color, sum;\nEND\n");
        text
    }

    /// The program, accepted by a device.
    ///
    /// # Errors
    /// [`KernelError`] if it breaks a rule of the device.
    pub fn checked(&self, profile: &Profile) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`", self.name()), &self.text())
    }
}
