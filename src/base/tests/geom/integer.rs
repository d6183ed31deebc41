use crossbar_base::geom::exact::integer::{intersect, is_degenerate};
use crossbar_base::geom::{Ray, Sides};

const UNIT: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn at(origin: [f32; 3], direction: [f32; 3], sides: Sides) -> Option<f32> {
    let ray = Ray::new(origin, direction).expect("a ray");
    intersect(&ray, &UNIT, sides).map(|t| t.to_f32())
}

#[test]
fn edges_and_corners_belong_to_the_triangle() {
    for target in [[0.25, 0.25], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [0.0, 0.5], [0.5, 0.0]] {
        let origin = [target[0], target[1], 2.0];
        assert_eq!(at(origin, [0.0, 0.0, -0.5], Sides::Front), Some(4.0), "{target:?}");
    }
    let beyond = 0.5_f32.next_up();
    assert_eq!(at([0.5, beyond, 2.0], [0.0, 0.0, -1.0], Sides::Both), None);
    assert_eq!(at([-f32::from_bits(1), 0.5, 2.0], [0.0, 0.0, -1.0], Sides::Both), None);
}

#[test]
fn the_front_is_where_corners_run_counter_clockwise() {
    assert_eq!(at([0.25, 0.25, -1.0], [0.0, 0.0, 1.0], Sides::Front), None);
    assert_eq!(at([0.25, 0.25, -1.0], [0.0, 0.0, 1.0], Sides::Both), Some(1.0));
}

#[test]
fn t_starts_at_zero_and_a_plane_is_no_hit() {
    assert_eq!(at([0.25, 0.25, 0.0], [0.0, 0.0, -1.0], Sides::Front), Some(0.0));
    assert_eq!(at([0.25, 0.25, -f32::from_bits(1)], [0.0, 0.0, -1.0], Sides::Front), None);
    assert_eq!(at([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0], Sides::Both), None, "the ray lies in the plane");
    let line = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]];
    let ray = Ray::new([1.0, 1.0, 2.0], [0.0, 0.0, -1.0]).expect("a ray");
    assert_eq!(intersect(&ray, &line, Sides::Both), None, "a triangle without area");
    assert!(is_degenerate(&line) && !is_degenerate(&UNIT));
}

#[test]
fn the_ends_of_the_range_do_no_harm() {
    let (least, most) = (f32::from_bits(1), f32::MAX);
    assert_eq!(at([least, least, most], [0.0, 0.0, -least], Sides::Front), Some(f32::INFINITY));
    let ray = Ray::new([least, least, most], [0.0, 0.0, -least]).expect("a ray");
    let t = intersect(&ray, &UNIT, Sides::Front).expect("a hit").to_f64();
    assert_eq!(t, f64::from(most) / f64::from(least));
    assert_eq!(at([0.0, 0.0, least], [0.0, 0.0, -most], Sides::Front), Some(0.0), "below the format");
}
