use crossbar_base::geom::exact::ratio::{to_f32, to_f64};
use num_bigint::BigUint;

fn f32_of(num: u64, den: u64) -> f32 {
    to_f32(&BigUint::from(num), &BigUint::from(den))
}

#[test]
fn rounds_to_nearest_even() {
    assert_eq!(f32_of(1, 3), 1.0 / 3.0);
    assert_eq!(f32_of((1 << 24) + 1, 1), 16_777_216.0);
    assert_eq!(f32_of((1 << 24) + 3, 1), 16_777_220.0);
    assert_eq!(f32_of((1 << 25) - 1, 1), 33_554_432.0);
    assert_eq!(f32_of(0, 7), 0.0);
    assert_eq!(to_f64(&BigUint::from(2_u8), &BigUint::from(3_u8)), 2.0 / 3.0);
}

#[test]
fn rounds_at_both_ends_of_the_range() {
    let one = BigUint::from(1_u8);
    let least = BigUint::from(1_u8) << 149;
    assert_eq!(to_f32(&one, &least).to_bits(), 1);
    assert_eq!(to_f32(&one, &(&least << 1)).to_bits(), 0, "half of the least goes to even");
    assert_eq!(to_f32(&BigUint::from(3_u8), &(&least << 1)).to_bits(), 2);
    assert_eq!(to_f32(&one, &(BigUint::from(1_u8) << 126)), f32::MIN_POSITIVE);
    let below = (BigUint::from(1_u8) << 128) - (BigUint::from(1_u8) << 103);
    assert_eq!(to_f32(&below, &one), f32::INFINITY);
    assert_eq!(to_f32(&(below - 1_u8), &one), f32::MAX);
    assert_eq!(to_f64(&one, &(BigUint::from(1_u8) << 1074)).to_bits(), 1);
    assert_eq!(to_f64(&(BigUint::from(1_u8) << 1024), &one), f64::INFINITY);
}
