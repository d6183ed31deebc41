//! Sums over lists of places (section V, Algorithm 2): of light over the columns of a bicluster, weighted by their
//! values, or of biclusters over those of a row. A fragment is a sum; red, green and blue are summed side by side.
//!
//! - t0: where the first texel of its list stands in texture 0; t1: its own place, for the sum so far.
//! - c0: 1 / width and 1 / (width x height) of texture 1, which are powers of two; c1: from texel to texel of a list.
//! - texture 0: lists. A texel holds four places, or two places each with its value; a place is that of a texel of
//!   texture 1, counted row by row, plus one half.
//! - texture 1: what is summed, repeated along its rows: its two coordinates are products of one number with c0,
//!   without rounding while places have 23 bits.
//! - texture 2: the sum so far; not in the first program.
//!
//! One addition after the other, beginning with 0, as the host's sums. Places that fill up a texel are those of a texel
//! of 0, which changes no sum.

use std::fmt::Write as _;

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;

use crate::card::{KernelError, checked};

/// The texture of lists.
pub const LISTS: usize = 0;
/// The texture of what is summed.
pub const SOURCE: usize = 1;
/// The texture of the sum so far.
pub const SUM: usize = 2;

/// A program for sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ListSumKernel {
    /// Texels of lists that it reads.
    pub texels: usize,
    /// Whether each place has a value.
    pub is_weighted: bool,
    /// Whether sums begin.
    pub is_first: bool,
    /// [`Version::Ps2B`] or [`Version::Ps2A`].
    pub version: Version,
}

/// Instructions beside those for texels: the sum's beginning or its read, coordinates, the result.
const BESIDE: usize = 3;

impl ListSumKernel {
    /// Places in a texel.
    pub const fn places_per_texel(is_weighted: bool) -> usize {
        if is_weighted { 2 } else { 4 }
    }

    /// Instructions for a texel: its read, the way to the next; each place's coordinates, read, product and sum.
    const fn per_texel(is_weighted: bool) -> usize {
        2 + Self::places_per_texel(is_weighted) * if is_weighted { 4 } else { 3 }
    }

    /// The most texels that so many instructions hold.
    pub const fn most_texels(is_weighted: bool, instructions: usize) -> usize {
        instructions.saturating_sub(BESIDE) / Self::per_texel(is_weighted)
    }

    /// A name for messages.
    pub fn name(&self) -> String {
        let Self { texels, is_weighted, is_first, version } = *self;
        let what = if is_weighted { "weighted sum" } else { "sum" };
        let from = if is_first { "from 0" } else { "from the sum so far" };
        format!("{what} over {texels} texels of lists {from}, {version}")
    }

    /// The program.
    pub fn text(&self) -> String {
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

    /// The program, accepted by a device.
    ///
    /// # Errors
    /// [`KernelError`] if it breaks a rule of the device.
    pub fn checked(&self, profile: &Profile) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`", self.name()), &self.text())
    }
}
