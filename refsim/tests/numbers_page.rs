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
#[path = "numbers_page/filters.rs"]
mod filters;
#[path = "numbers_page/formats.rs"]
mod formats;
#[path = "numbers_page/reads.rs"]
mod reads;
#[path = "common/running.rs"]
mod running;
#[path = "numbers_page/targets.rs"]
mod targets;
#[path = "numbers_page/texels.rs"]
mod texels;

/// The page.
const PAGE: &str = include_str!("../../docs/numbers.md");

/// Number of probes of a test: fifty times as many in the full form.
fn probes(short: usize) -> usize {
    if std::env::var_os("CROSSBAR_FULL").is_some() { 50 * short } else { short }
}

/// Deterministic random numbers.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed ^ (mixed >> 32)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn choose<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// Uniform between two numbers.
    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.next() >> 40) as f32 / 16_777_216.0)
    }

    /// A single of any kind: near 0 or 1, a multiple of 1/255, any pattern, or a special one.
    fn single(&mut self) -> f32 {
        match self.below(6) {
            0 => self.between(-1.5, 1.5),
            1 => self.below(256) as f32 / 255.0,
            2 => f32::from_bits(self.next() as u32),
            3 => self.choose(&[0.0, -0.0, 1.0, -1.0, 0.5, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 1e-40]),
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
