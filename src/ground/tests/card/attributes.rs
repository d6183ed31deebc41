use crossbar_ground::card::through_half;

#[test]
fn halves_have_eleven_bits() {
    assert_eq!(through_half(1.0 / 3.0), 0.333_251_95);
    assert_eq!([0.0, 1.5, -2048.0].map(through_half), [0.0, 1.5, -2048.0]);
    assert_eq!(through_half(1e6), f32::INFINITY);
}
