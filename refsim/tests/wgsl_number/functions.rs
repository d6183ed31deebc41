//! Tests functions other than `n_alu`: exact dot products, conversions, rounding of parts, single precision.

use refsim::exec::gpu::Gpu;
use refsim::exec::wgsl::number::format_words;
use refsim::num::{DotOrder, Format, FormatKind, from_parts, ops};
use std::sync::Arc;

use crate::device::text;
use crate::environment::by_form;
use crate::operands::{edges, formats, pattern};
use crate::random::Random;

/// Number of a function in `functions.wgsl`, indices of two formats, operands.
struct Call {
    function: u32,
    formats: [usize; 2],
    operands: [u32; 8],
}

impl Call {
    fn random(words: &mut Random, all: &[Format], edges_of: &[Vec<u32>]) -> Self {
        let function = [2, 3, 4, 5, 7, 8][words.below(6)];
        let mut places = [words.below(all.len()), words.below(all.len())];
        if function == 5 {
            // `n_term` does not support units of cards, whose results are normalized earlier.
            let ideal = all.iter().filter(|f| !f.unit.is_card()).count();
            places = [words.below(ideal), words.below(ideal)];
        }
        if function == 8 {
            // FP32 with the default rules is among the formats.
            places = [all.iter().position(|f| *f == Format::FP32).expect("single precision"); 2];
        }
        let mut operands = [0; 8];
        for operand in &mut operands {
            *operand = pattern(words, &all[places[0]], &edges_of[places[0]]);
        }
        match function {
            2..=4 => {
                // Sums that cancel, partially or completely.
                let [first, second] = [words.below(3), words.below(4)];
                if first != second && words.coin() {
                    operands[second] = operands[first] ^ all[places[0]].sign_bit();
                    operands[second + 4] = operands[first + 4];
                }
            }
            7 => {
                let [high, low] = [words.bits() >> words.below(32), words.bits()];
                operands[0] = low;
                operands[1] = if words.coin() { 0 } else { high };
                operands[2] = words.below(2) as u32;
                let exponent = match all[places[0]].kind {
                    // Near the unit, where wrapping keeps the last bits.
                    FormatKind::Fixed { frac_bits, .. } if words.coin() => words.around(3) - i32::from(frac_bits),
                    _ => words.around(150) - 50,
                };
                operands[3] = exponent.cast_unsigned();
            }
            8 => operands[2] = words.below(4) as u32,
            _ => {}
        }
        Call { function, formats: places, operands }
    }

    fn expected(&self, all: &[Format]) -> u32 {
        let [f, g] = self.formats.map(|k| &all[k]);
        let [a, b, c, d, ..] = self.operands;
        match self.function {
            2..=4 => {
                let terms: Vec<_> =
                    (0..self.function as usize).map(|k| (self.operands[k], self.operands[k + 4])).collect();
                ops::dot(f, DotOrder::Exact, &terms).bits
            }
            5 => ops::convert(f, g, a).bits,
            7 => from_parts(f, c & 1 == 1, u128::from(b) << 32 | u128::from(a), d.cast_signed(), c & 2 == 2).bits,
            _ => match c {
                0 => ops::add(f, a, b).bits,
                1 => ops::sub(f, a, b).bits,
                2 => ops::mul(f, a, b).bits,
                _ => ops::div(f, a, b).bits,
            },
        }
    }
}

pub(crate) fn functions_beside_the_switch(gpu: &Arc<Gpu>) {
    let all = formats();
    let edges_of: Vec<Vec<u32>> = all.iter().map(edges).collect();
    let table: Vec<u32> = all.iter().flat_map(format_words).collect();
    let shader = text(include_str!("functions.wgsl"), "run_functions");
    let mut words = Random::new(3);
    let rounds = by_form(1, 80);
    for _ in 0..rounds {
        let calls: Vec<Call> = (0..50_000).map(|_| Call::random(&mut words, &all, &edges_of)).collect();
        let items: Vec<u32> = calls
            .iter()
            .flat_map(|c| [c.function, c.formats[0] as u32, c.formats[1] as u32].into_iter().chain(c.operands))
            .collect();
        let groups = [calls.len().div_ceil(64) as u32, 1, 1];
        let found = gpu.compute(&shader, "run_functions", &[&table, &items], calls.len(), groups);
        for (call, bits) in calls.iter().zip(found.expect("the shader runs")) {
            let expected = call.expected(&all);
            let [f, g] = call.formats.map(|k| all[k]);
            assert_eq!(
                bits, expected,
                "function {} in {f} (to {g}) of {:08x?}: {bits:08x} for {expected:08x}",
                call.function, call.operands
            );
        }
    }
}
