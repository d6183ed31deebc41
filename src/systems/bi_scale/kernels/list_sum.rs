//! Sums over lists of texels (section V, Algorithm 2): sums of light over a bicluster's columns, weighted by their
//! values, or sums over a row's biclusters. A fragment computes one sum for red, green and blue in parallel.
//!
//! - t0: coordinates of the first texel of the fragment's list in texture 0; t1: coordinates of the fragment's sum so
//!   far.
//! - c0: 1 / width and 1 / (width x height) of texture 1, which are powers of two; c1: the step between texels of a
//!   list.
//! - texture 0: the lists. A texel has four places, or two places with a value each. A place is the index of a texel of
//!   texture 1, counted row by row, plus one half.
//! - texture 1: the summands, with wrapped addressing along u: both coordinates are the place times c0, which is exact
//!   for places of at most 23 bits.
//! - texture 2: the sum so far; not in the first program.
//!
//! Additions are sequential from 0, as in the host's sums. Unused places of a list's last texel point to a texel of 0,
//! which changes no sum.

use std::fmt::Write as _;

use refsim::isa::Version;

use crate::card::WrittenKernel;

/// Sampler of the lists.
pub const LISTS: usize = 0;
/// Sampler of the summands.
pub const SOURCE: usize = 1;
/// Sampler of the sum so far.
pub const SUM: usize = 2;

/// A program that sums over lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ListSumKernel {
    /// Number of list texels read per fragment.
    pub texels: usize,
    /// True if each place has a value that multiplies its texel.
    pub is_weighted: bool,
    /// True if the sums begin at 0; otherwise they continue texture 2.
    pub is_first: bool,
    /// [`Version::Ps2B`] or [`Version::Ps2A`].
    pub version: Version,
}

/// Instructions that do not depend on the number of texels: the first value, coordinates, the result.
const BESIDE: usize = 3;

impl ListSumKernel {
    /// Number of places in a texel.
    pub const fn places_per_texel(is_weighted: bool) -> usize {
        if is_weighted { 2 } else { 4 }
    }

    /// Instructions per texel: a read and the step to the next texel; and for each place, coordinates, read, product
    /// and sum.
    const fn per_texel(is_weighted: bool) -> usize {
        2 + Self::places_per_texel(is_weighted) * if is_weighted { 4 } else { 3 }
    }

    /// The largest number of texels for a number of instructions.
    pub const fn most_texels(is_weighted: bool, instructions: usize) -> usize {
        instructions.saturating_sub(BESIDE) / Self::per_texel(is_weighted)
    }

    fn push_plain(&self, text: &mut String) {
        let components = ['x', 'y', 'z', 'w'].into_iter().zip(2..);
        for (component, register) in components.clone() {
            let _ = writeln!(text, "mul r{register}, r1.{component}, c0");
        }
        for (_, register) in components.clone() {
            let _ = writeln!(text, "texld r{register}, r{register}, s{SOURCE}");
        }
        for (_, register) in components {
            let _ = writeln!(text, "add r10, r10, r{register}");
        }
    }

    fn push_weighted(&self, text: &mut String) {
        let pairs = [('x', 'y', 2), ('z', 'w', 3)];
        for (place, _, register) in pairs {
            let _ = writeln!(text, "mul r{register}, r1.{place}, c0");
        }
        for (_, _, register) in pairs {
            let _ = writeln!(text, "texld r{register}, r{register}, s{SOURCE}");
        }
        for (_, value, register) in pairs {
            let _ = write!(text, "mul r{register}, r{register}, r1.{value}\nadd r10, r10, r{register}\n");
        }
    }
}

impl WrittenKernel for ListSumKernel {
    fn name(&self) -> String {
        let Self { texels, is_weighted, is_first, version } = *self;
        let what = if is_weighted { "weighted sum" } else { "sum" };
        let from = if is_first { "from 0" } else { "from the sum so far" };
        format!("{what} over {texels} texels of lists {from}, {version}")
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n; {}\ndef c2, 0, 0, 0, 0\ndcl t0\n", self.version, self.name());
        if !self.is_first {
            text.push_str("dcl t1\n");
        }
        let _ = write!(text, "dcl_2d s{LISTS}\ndcl_2d s{SOURCE}\n");
        if self.is_first {
            text.push_str("mov r0, t0\nmov r10, c2\n");
        } else {
            let _ = write!(text, "dcl_2d s{SUM}\nmov r0, t0\ntexld r10, t1, s{SUM}\n");
        }
        for _ in 0..self.texels {
            let _ = write!(text, "texld r1, r0, s{LISTS}\nadd r0, r0, c1\n");
            if self.is_weighted {
                self.push_weighted(&mut text);
            } else {
                self.push_plain(&mut text);
            }
        }
        text.push_str("mov oC0, r10\n");
        text
    }
}
