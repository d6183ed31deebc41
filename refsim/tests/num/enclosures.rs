//! Enclosures of transcendental functions: finer ones lie within coarser ones.

#[path = "../../lanes/src/num/transcendental/enclose.rs"]
mod enclose;

use enclose::{Enclosure, circular, exp2_long, exp2_quick, log2_long, log2_quick};
use num_bigint::BigInt;
use refsim::num::series;

#[test]
fn pi_is_pi() {
    // 3.14159265358979323846264338327950288419716939937510582097494459230781640628620899
    let digits = "314159265358979323846264338327950288419716939937510582097494";
    let scaled: BigInt = (series::pi(256) * BigInt::from(10).pow(59)) >> 256;
    assert_eq!(scaled.to_string(), digits);
}

#[test]
fn enclosures_nest() {
    for sig in [1u64, 3, 0x00c9_0fdb, 0x00ff_ffff, 0x0080_0001, 12345] {
        for exp in [-149, -60, -24, -23, -22, -10, -1, 0, 5, 40, 104] {
            for (sine, sign) in [(false, false), (false, true), (true, false), (true, true)] {
                let [coarse, fine] = [128, 512].map(|places| circular(sine, sign, sig, exp, 1, places));
                let shift = 512 - 128;
                assert!(&coarse.low << shift <= fine.low && fine.high <= &coarse.high << shift, "{sig} {exp} {sine}");
            }
        }
    }
}

/// Returns `true` if the finer enclosure lies within the coarser one. A wrong constant or error bound fails here;
/// rounded results would hide it except for one operand in a billion.
fn nested<T: Into<BigInt>>(coarse: Enclosure<T>, fine: Enclosure<BigInt>) -> bool {
    let shift = (coarse.exp - fine.exp).unsigned_abs();
    let (low, high): (BigInt, BigInt) = (coarse.low.into(), coarse.high.into());
    low << shift <= fine.low && fine.high <= high << shift
}

/// Odd significands of up to 32 bits, dense and sparse.
fn significands() -> impl Iterator<Item = u64> {
    let scattered = (1..400u64).map(|i| (i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) | 1);
    scattered.chain((1..24).flat_map(|k| [(1 << k) + 1, (1 << k) - 1, 3 << k | 1]))
}

#[test]
fn exponential_enclosures_nest() {
    for sig in significands() {
        for exp in [-1, -2, -7, -16, -31, -40, -64, -65, -100, -149] {
            for sign in [false, true] {
                let long = exp2_long(sign, sig, exp, 1, 256);
                assert!(nested(exp2_quick(sign, sig, exp, 1), long.clone()), "{sign} {sig} {exp}: quick");
                assert!(nested(exp2_long(sign, sig, exp, 1, 128), long), "{sign} {sig} {exp}: 128 places");
            }
        }
    }
}

#[test]
fn logarithm_enclosures_nest() {
    for sig in significands().filter(|sig| *sig > 1) {
        let long = log2_long(sig, 256);
        assert!(nested(log2_quick(sig), long.clone()), "{sig}: quick");
        assert!(nested(log2_long(sig, 128), long), "{sig}: 128 places");
    }
}
