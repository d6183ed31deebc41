//! Tests docs/numbers.md against the emulator: reimplements its sections from the text alone, in host arithmetic, and
//! compares on random inputs.
//!
//! Uses only types of the modules under test; tables are parsed from the page itself.

#[path = "numbers_page/blending.rs"]
mod blending;
#[path = "numbers_page/clipping.rs"]
mod clipping;
#[path = "numbers_page/colors.rs"]
mod colors;
#[path = "numbers_page/constants.rs"]
mod constants;
#[path = "common/environment.rs"]
mod environment;
#[path = "numbers_page/filters.rs"]
mod filters;
#[path = "numbers_page/formats.rs"]
mod formats;
#[path = "common/random.rs"]
mod random;
#[path = "numbers_page/reads.rs"]
mod reads;
#[path = "common/running.rs"]
mod running;
#[path = "numbers_page/targets.rs"]
mod targets;
#[path = "numbers_page/texels.rs"]
mod texels;

use environment::by_form;
use random::Random;

const PAGE: &str = include_str!("../../docs/numbers.md");

/// Number of probes of a test: `short`, or fifty times as many with `CROSSBAR_FULL=1`.
fn probes(short: usize) -> usize {
    by_form(short, 50 * short)
}

impl Random {
    /// A single of any kind: near 0 or 1, a multiple of 1/255, any pattern, or a special one.
    fn single(&mut self) -> f32 {
        match self.below(6) {
            0 => self.between(-1.5, 1.5),
            1 => self.below(256_u16) as f32 / 255.0,
            2 => f32::from_bits(self.next() as u32),
            3 => self.of(&[0.0, -0.0, 1.0, -1.0, 0.5, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40]),
            4 => self.between(-1.0, 2.0) / 65536.0,
            _ => self.between(0.0, 1.0),
        }
    }
}

/// 2^n as a double.
fn power(n: i32) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52)
}

/// The bits of a number, with canonical NaN.
fn clean(x: f32) -> u32 {
    if x.is_nan() { 0x7fc0_0000 } else { x.to_bits() }
}
