use crossbar_base::compare::f32_ulps;

#[test]
fn steps_go_from_number_to_number() {
    let least = f32::from_bits(1);
    assert_eq!(f32_ulps(1.0, 1.0_f32.next_up()), Some(1));
    assert_eq!(f32_ulps(-least, least), Some(2), "over both zeros");
    assert_eq!((f32_ulps(0.0, -0.0), f32_ulps(f32::NAN, -f32::NAN)), (Some(0), Some(0)));
    assert_eq!((f32_ulps(f32::INFINITY, f32::INFINITY), f32_ulps(f32::MAX, f32::INFINITY)), (Some(0), None));
    assert_eq!(f32_ulps(f32::NAN, 1.0), None);
}

#[cfg(feature = "refsim")]
#[test]
fn steps_are_those_of_the_emulated_format() {
    use crossbar_base::compare::{Number, ulps};
    let mut bits = [0_u32, 1, 0x7f_ffff, 0x80_0000, 0x3f80_0000, 0x7f7f_ffff, 0x7f80_0000, 0x7fc0_0000].to_vec();
    bits.extend((0..200_u32).map(|i| i.wrapping_mul(0x9e37_79b9)));
    bits.extend(bits.clone().into_iter().map(|bits| bits ^ 0x8000_0000));
    for &left in &bits {
        for &right in &bits {
            let [left, right] = [left, right].map(f32::from_bits);
            let steps = ulps(&Number::from(left), &Number::from(right)).0;
            assert_eq!(f32_ulps(left, right).map(|steps| steps as f64), steps, "{left:e} {right:e}");
        }
    }
}
