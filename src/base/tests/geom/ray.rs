use crossbar_base::geom::Ray;

#[test]
fn refuses_what_is_no_ray() {
    assert_eq!(Ray::new([0.0; 3], [0.0, -0.0, 0.0]).unwrap_err().to_string(), "expected a direction, found (0, 0, 0)");
    let found = Ray::new([0.0, f32::NAN, 0.0], [1.0; 3]);
    assert_eq!(found.unwrap_err().to_string(), "expected six finite numbers, found origin y not finite");
    assert!(Ray::new([0.0; 3], [0.0, 0.0, f32::from_bits(1)]).is_ok());
}
