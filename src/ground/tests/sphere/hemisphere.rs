use crossbar_ground::sphere::Hemisphere;

#[test]
fn a_constant_has_half_of_its_energy_on_the_hemisphere() {
    let hemisphere = Hemisphere::new(1);
    assert!((hemisphere.energy(&[1.0]) - 0.5).abs() < 1e-15 && (hemisphere.drop_costs()[0] - 0.5).abs() < 1e-15);
}

#[test]
fn what_cannot_be_dropped_is_refused() {
    let error = |dropped: &[usize]| Hemisphere::without(2, dropped).map(|_| ()).expect_err("refused");
    assert_eq!(error(&[4]).to_string(), "expected distinct functions below 4 to drop, found 4");
    assert_eq!(error(&[1, 1]).to_string(), "expected distinct functions below 4 to drop, found 1");
    assert_eq!(error(&[0, 1, 2, 3]).to_string(), "expected functions that are kept, found all 4 dropped");
}
