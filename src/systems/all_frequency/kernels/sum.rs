//! Equation 13 as a program: four numbers of a vertex's T_p, over sixteen representatives of a segment per pass.
//!
//! A fragment is a vertex. TEX0 addresses texels of the textures of vertices.
//!
//! - texture 0: x and y of the texel with the first representative of the vertex's cluster;
//! - textures 1 to 4: the weights of the sixteen, four per texel;
//! - texture 5: four numbers of T for each representative, with those of a cluster side by side;
//! - texture 6: the sum so far; not in the first program.
//!
//! All textures are rectangles. Sums run from the first representative to the last. Addresses are computed before the
//! first read that needs one, so that texture reads depend on one another over only two levels.

use std::fmt::Write as _;

use super::layout::COMPONENTS;
use crate::card::WrittenKernel;

/// Number of representatives per pass.
pub const SUMMED: usize = 16;
/// Sampler of the representatives.
pub const OF_REPRESENTATIVES: usize = 5;
/// Sampler of the sum so far.
pub const OF_SUM: usize = 6;

/// A program for weighted sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SumKernel {
    /// True if the sums begin at 0; otherwise they continue the sum so far.
    pub is_first: bool,
}

impl SumKernel {
    /// Number of textures that it reads.
    pub const fn samplers(&self) -> usize {
        if self.is_first { OF_SUM } else { OF_SUM + 1 }
    }
}

impl WrittenKernel for SumKernel {
    fn name(&self) -> String {
        if self.is_first { "sum_first" } else { "sum_next" }.to_owned()
    }

    fn text(&self) -> String {
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
}
