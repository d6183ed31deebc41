use approx::assert_abs_diff_eq;
use crossbar_base::geom::classify::{Candidate, HitVerdict, Judgement, TError, classify, t_error};
use crossbar_base::geom::exact::{self, Sides};
use crossbar_base::geom::{ExactT, Mesh, Ray};
use num_bigint::BigUint;

/// Two triangles that share an edge in z = 0, a triangle that touches a corner, and a distant one.
fn scene() -> Mesh {
    let positions = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [5.0, 5.0, 5.0],
        [6.0, 5.0, 5.0],
        [5.0, 6.0, 5.0],
    ];
    Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3], [0, 4, 5], [6, 7, 8]]).expect("a mesh")
}

fn judge(origin: [f32; 3], candidate: Candidate) -> Judgement {
    let mesh = scene();
    let ray = Ray::new(origin, [0.0, 0.0, -1.0]).expect("a ray");
    let nearest = exact::nearest(&mesh, &ray, Sides::Both);
    classify(&mesh, nearest.as_ref(), candidate)
}

#[test]
fn every_verdict_has_its_case() {
    let hit = |triangle, t| Candidate { triangle: Some(triangle), t };
    let none = Candidate { triangle: None, t: 0.0 };
    let inside = [0.75, 0.25, 3.0];
    assert_eq!(judge(inside, hit(0, 3.0)).verdict, HitVerdict::Right);
    assert_eq!(judge(inside, none), Judgement { verdict: HitVerdict::Leak, t_error: None });
    assert_eq!(judge(inside, hit(1, 3.0)).verdict, HitVerdict::WrongTriangle { adjacent: true });
    assert_eq!(judge(inside, hit(2, 3.0)).verdict, HitVerdict::WrongTriangle { adjacent: true });
    assert_eq!(judge(inside, hit(3, 3.0)).verdict, HitVerdict::WrongTriangle { adjacent: false });
    assert_eq!(judge(inside, hit(77, 3.0)).verdict, HitVerdict::WrongTriangle { adjacent: false });
    assert_eq!(judge([9.0, 0.0, 3.0], hit(0, 1.0)).verdict, HitVerdict::FalseHit);
    assert_eq!(judge([9.0, 0.0, 3.0], none).verdict, HitVerdict::Right);
}

#[test]
fn either_triangle_of_a_tie_is_right() {
    for triangle in [0, 1] {
        let candidate = Candidate { triangle: Some(triangle), t: 3.0 };
        assert_eq!(judge([0.5, 0.5, 3.0], candidate).verdict, HitVerdict::Right);
    }
}

#[test]
fn the_error_of_t_is_exact() {
    let t = ExactT::new(BigUint::from(1_u8), BigUint::from(3_u8)).expect("a fraction");
    let found = t_error(&t, 0.333_333_34);
    assert_abs_diff_eq!(found.absolute, f64::from(0.333_333_34_f32) - 1.0 / 3.0, epsilon = 1e-16);
    assert_abs_diff_eq!(found.relative / found.absolute, 3.0, epsilon = 1e-12);
    assert_eq!(t_error(&t, f32::NAN).absolute, f64::INFINITY);
    assert_abs_diff_eq!(t_error(&t, -1.0).absolute, 4.0 / 3.0, epsilon = 1e-15);
    let zero = ExactT::new(BigUint::from(0_u8), BigUint::from(3_u8)).expect("a fraction");
    assert_eq!(t_error(&zero, 0.0), TError { absolute: 0.0, relative: 0.0 });
    assert_eq!(t_error(&zero, 1.0), TError { absolute: 1.0, relative: f64::INFINITY });
}
