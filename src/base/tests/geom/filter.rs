use crossbar_base::geom::exact::Guess;
use crossbar_base::geom::exact::filter::guess;
use crossbar_base::geom::{Ray, Sides};

#[test]
fn clear_cases_need_no_integers() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let ray = |origin, direction| Ray::new(origin, direction).expect("a ray");
    let hit = guess(&ray([0.2, 0.3, 2.0], [0.0, 0.0, -1.0]), &triangle, Sides::Front);
    let Guess::Hit { low, high } = hit else { panic!("expected a hit, found {hit:?}") };
    assert!(low <= 2.0 && 2.0 <= high && high - low < 1e-13, "{low} {high}");
    let miss = ray([0.7, 0.7, 2.0], [0.0, 0.0, -1.0]);
    assert_eq!(guess(&miss, &triangle, Sides::Both), Guess::Miss);
    let behind = ray([0.2, 0.3, -1.0], [0.0, 0.0, -1.0]);
    assert_eq!(guess(&behind, &triangle, Sides::Both), Guess::Miss);
}
