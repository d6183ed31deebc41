//! Formats and operands: edges, patterns near them, and pseudo-random ones.

use crate::random::Random;
use refsim::num::{Denormals, Format, FormatKind, Overflow, Rounding, Specials};

impl Random {
    /// An integer within `-reach..=reach`.
    pub(crate) fn around(&mut self, reach: u32) -> i32 {
        self.below(2 * reach + 1).cast_signed() - reach.cast_signed()
    }
}

/// Boundary patterns: zeros, limits, ones, halves, infinities, NaN, and their neighbors.
pub(crate) fn edges(format: &Format) -> Vec<u32> {
    let mut bits =
        vec![0, 1, format.one(), format.max_finite(), format.min_finite(), format.one() / 2, format.sign_bit()];
    bits.extend(format.infinity(false));
    bits.extend(format.canonical_nan());
    if let FormatKind::Float { man_bits, .. } = format.kind {
        bits.push(1 << man_bits);
        bits.push(format.one() - (1 << man_bits));
        bits.push(format.one() + (1 << man_bits));
        bits.push((format.sign_bit() - (1 << man_bits)) | 1);
    }
    let mut all = Vec::new();
    for b in bits {
        for near in [b.wrapping_sub(1), b, b.wrapping_add(1)] {
            all.extend([near & format.mask(), (near ^ format.sign_bit()) & format.mask()]);
        }
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// A random pattern: arbitrary, near 1, small, or a boundary pattern.
pub(crate) fn pattern(words: &mut Random, format: &Format, edges: &[u32]) -> u32 {
    let word = words.bits();
    let bits = match words.below(8) {
        0 | 1 => edges[words.below(edges.len())],
        2 => format.one() ^ (word >> 12) & (format.mask() >> 4),
        3 => word >> words.below(32),
        4 => !(word >> words.below(32)),
        5 => word & (word << 7) & (word << 3),
        _ => word,
    };
    bits & format.mask()
}

/// The units of cards in which shaders compute.
pub(crate) fn cards() -> Vec<Format> {
    let names = ["gt200", "gt200-zero-wins", "gt200:rtz", "gt200-zero-wins:rtz"];
    names.map(|name| format!("e8m23:{name}").parse().expect("a format")).to_vec()
}

/// Every rule on a few layouts, many layouts, and the units of cards.
pub(crate) fn formats() -> Vec<Format> {
    let fixed =
        [(3, 12), (1, 10), (0, 31), (31, 0), (1, 2), (0, 1), (7, 8), (15, 16), (1, 30), (16, 15), (0, 8), (8, 23)];
    let float = [(8, 23), (5, 10), (7, 16), (8, 7), (3, 2), (2, 1), (2, 23), (8, 1), (4, 3), (6, 9), (8, 22), (3, 20)];
    let finite = ["e4m3fn", "e2m1fn", "e3m2fn", "e7m23fn", "e4m3fnuz", "e5m2fnuz", "e7m16fnuz", "e2m1fnuz"];
    let rounding = Rounding::ALL.map(|(_, rounding)| rounding);
    let mut all = Vec::new();
    for (i, (int, frac)) in fixed.into_iter().enumerate() {
        let Some(format) = Format::fixed(int, frac) else { continue };
        for (j, r) in rounding.into_iter().enumerate() {
            let wrap = if (i + j) % 2 == 0 { Overflow::Saturate } else { Overflow::Wrap };
            all.push(format.with_rounding(r).with_overflow(wrap));
        }
        all.push(format.with_overflow(Overflow::Wrap));
    }
    for (i, (int, frac)) in [(3, 8), (0, 8), (7, 8), (13, 2), (0, 2), (2, 5)].into_iter().enumerate() {
        let Some(format) = Format::normalized(int, frac) else { continue };
        for (j, r) in rounding.into_iter().enumerate() {
            let wrap = if (i + j) % 2 == 0 { Overflow::Saturate } else { Overflow::Wrap };
            all.push(format.with_rounding(r).with_overflow(wrap));
        }
    }
    let overflow = [Overflow::Infinity, Overflow::Saturate, Overflow::Nv30];
    let float = float.into_iter().filter_map(|(exp, man)| Format::float(exp, man));
    for (i, format) in float.chain(finite.map(|text| text.parse().expect("a format"))).enumerate() {
        all.push(format);
        for (j, r) in rounding.into_iter().enumerate() {
            let k = i + j;
            let denormals = if k % 2 == 0 { Denormals::Flush } else { Denormals::Keep };
            let specials = if (k / 2) % 2 == 0 { Specials::Nv } else { Specials::Ieee };
            let other = format.with_rounding(r).with_overflow(overflow[k % 3]);
            all.push(other.with_denormals(denormals).with_specials(specials));
        }
    }
    all.extend(cards());
    all
}
