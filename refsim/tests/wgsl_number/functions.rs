//! The functions beside `n_alu`: exact dots, conversions, rounding of given parts, single precision by name.

use refsim::exec::unorm_steps;
use refsim::exec::wgsl::number::format_words;
use refsim::num::{DotOrder, Format, Rounding, Unpacked, from_parts, from_ratio, ops, unpack};

use crate::device::{adapter, text};
use crate::operands::{Words, edges, formats, pattern};

/// Number of a function in `functions.wgsl`, places of two formats, operands.
struct Call {
    function: u32,
    formats: [usize; 2],
    operands: [u32; 8],
}

/// `floor(a 2^k)` as an `i32`, saturated.
fn scaled_floor(a: u32, k: i32) -> u32 {
    let Unpacked::Finite { sign, sig, exp } = unpack(&Format::FP32, a) else {
        return if Format::FP32.is_nan(a) { 0 } else { i32::MAX.cast_unsigned() + (a >> 31) };
    };
    let value = if sign { -i128::from(sig) } else { i128::from(sig) };
    let exp = exp + k;
    let floor = if exp >= 0 { value << exp.min(60) } else { value >> exp.unsigned_abs().min(100) };
    (floor.clamp(i32::MIN.into(), i32::MAX.into()) as i32).cast_unsigned()
}

impl Call {
    fn random(words: &mut Words, all: &[Format], edges_of: &[Vec<u32>]) -> Self {
        let function = 2 + words.below(10) as u32;
        let mut places = [words.below(all.len()), words.below(all.len())];
        if function >= 8 {
            // FP32 with the default rules is among the formats.
            places = [all.iter().position(|f| *f == Format::FP32).expect("single precision"); 2];
        }
        let mut operands = [0; 8];
        for operand in &mut operands {
            *operand = pattern(words, &all[places[0]], &edges_of[places[0]]);
        }
        match function {
            2..=4 => {
                // Sums that cancel, in part or in all.
                let [first, second] = [words.below(3), words.below(4)];
                if first != second && words.below(2) == 0 {
                    operands[second] = operands[first] ^ all[places[0]].sign_bit();
                    operands[second + 4] = operands[first + 4];
                }
            }
            6 => {
                let close = 0x3f80_0000 - (words.next() >> words.below(32)).min(0x3f80_0000);
                operands[..2].copy_from_slice(&[[255, 31, 63, 15, 1, 65535][words.below(6)], close]);
            }
            7 => {
                let [high, low] = [words.next() >> words.below(32), words.next()];
                operands[0] = low;
                operands[1] = if words.below(2) == 0 { 0 } else { high };
                // With more to follow, the unit must be small enough to tell.
                operands[2] = words.below(2) as u32;
                operands[3] = (words.around(150) - 50).cast_unsigned();
            }
            8 => operands[2] = words.below(4) as u32,
            9 => operands[1] = words.around(30).cast_unsigned(),
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
            6 => from_ratio(f, false, unorm_steps(b, a).into(), a.into()).bits,
            7 => from_parts(f, c & 1 == 1, u128::from(b) << 32 | u128::from(a), d.cast_signed(), c & 2 == 2).bits,
            8 => match c {
                0 => ops::add(f, a, b).bits,
                1 => ops::sub(f, a, b).bits,
                2 => ops::mul(f, a, b).bits,
                _ => ops::div(f, a, b).bits,
            },
            9 => scaled_floor(a, b.cast_signed()),
            10 => {
                let value = a.cast_signed();
                from_ratio(f.with_rounding(Rounding::NearestEven), value < 0, value.unsigned_abs().into(), 1).bits
            }
            _ => ops::lt(f, a, b).bits | ops::le(f, a, b).bits << 1 | ops::eq(f, a, b).bits << 2,
        }
    }
}

#[test]
fn functions_beside_the_switch() {
    let Some(gpu) = adapter() else { return };
    let all = formats();
    let edges_of: Vec<Vec<u32>> = all.iter().map(edges).collect();
    let table: Vec<u32> = all.iter().flat_map(format_words).collect();
    let shader = text(include_str!("functions.wgsl"));
    let mut words = Words(3);
    let rounds = if std::env::var("CROSSBAR_LONG").is_ok() { 40 } else { 1 };
    for _ in 0..rounds {
        let calls: Vec<Call> = (0..100_000).map(|_| Call::random(&mut words, &all, &edges_of)).collect();
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
