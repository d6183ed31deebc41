//! Tests of `refsim::num`: against other implementations, exact arithmetic, and stated properties.
//!
//! | file | what is compared with what |
//! |---|---|
//! | `values` | values that can be checked by hand, and messages |
//! | `half` | every fp16 operand pair with rustc_apfloat |
//! | `fixed` | fixed point of up to 32 bits with plain integers |
//! | `wide` | fp24 with double precision, fp32 with the host, fused operations with rustc_apfloat |
//! | `small` | every operation of every format of at most 6 bits with exact rational arithmetic |
//! | `aligned` | sums by one adder, and truncated products, with exact fractions |
//! | `transcendental` | `exp2` and `log2` with separate series and roots |
//! | `enclosures` | enclosures of transcendental functions with finer ones |
//! | `tables` | short floats, scales and MX blocks with ml_dtypes and gfloat |
//! | `laws` | properties of all formats and values |
//!
//! By default each test covers a sample of its range; `CROSSBAR_FULL=1` covers everything.

mod aligned;
mod enclosures;
#[path = "../common/environment.rs"]
mod environment;
mod fixed;
mod half;
mod laws;
#[path = "../common/random.rs"]
mod random;
mod rational;
mod small;
mod small_ops;
mod tables;
mod transcendental;
mod values;
mod wide;

use random::Random;

impl Random {
    /// A pattern of a float format: uniform bits, or an interesting exponent and mantissa.
    fn float_bits(&mut self, exp_bits: u32, man_bits: u32) -> u32 {
        let random = self.next();
        let width = 1 + exp_bits + man_bits;
        let mask = u32::MAX >> (32 - width);
        if random & 1 == 0 {
            return (random >> 32) as u32 & mask;
        }
        let bias = (1u32 << (exp_bits - 1)) - 1;
        let top = (1u32 << exp_bits) - 1;
        let near = bias.wrapping_add((random >> 8) as u32 % 9).wrapping_sub(4);
        let exponents = [0, 1, 2, near, near, bias, bias + 1, bias - man_bits.min(bias), top - 2, top - 1, top];
        let field = exponents[(random >> 16) as usize % exponents.len()].min(top);
        let ones = (1u32 << man_bits) - 1;
        let raw = (random >> 32) as u32 & ones;
        let mantissas = [0, 1, ones, ones - 1, 1 << (man_bits - 1), raw, raw, raw & (ones << (man_bits / 2) & ones)];
        let man = mantissas[(random >> 24) as usize % mantissas.len()];
        ((random >> 1) as u32 & 1) << (width - 1) | field << man_bits | man
    }
}
