//! Tests of the oracle: every planted error is found, and nothing else is reported.

use crossbar::geom::teapot::teapot;
use crossbar::geom::{Hit, Mesh, Ray, Sides, exact};
use crossbar::oracle::{Aim, DisagreementKind, HardRay, Oracle, Tolerance, hard_rays};

/// A square in z = 0 seen from above, a triangle that touches its corner, one far below, and one that faces down.
fn scene() -> Mesh {
    let positions = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [-5.0, -5.0, -2.0],
        [5.0, -5.0, -2.0],
        [0.0, 5.0, -2.0],
        [3.0, 3.0, 0.0],
        [3.0, 4.0, 0.0],
        [4.0, 3.0, 0.0],
    ];
    Mesh::new(positions, vec![[0, 1, 2], [0, 2, 3], [0, 4, 5], [6, 7, 8], [9, 10, 11]]).expect("a mesh")
}

fn down(x: f32, y: f32) -> Ray {
    Ray::new([x, y, 3.0], [0.0, -0.0, -1.0]).expect("a ray")
}

fn hit(triangle: u32, t: f32) -> Option<Hit> {
    Some(Hit { triangle, t })
}

#[test]
fn every_way_to_be_wrong_has_its_kind() {
    let mesh = scene();
    let inside = down(0.75, 0.25);
    let past = down(9.0, 0.0);
    let cases = [
        (inside, hit(0, 3.0), None),
        (inside, hit(0, 3.000_000_2), None),
        (inside, hit(0, 3.000_000_5), Some(DisagreementKind::TOff)),
        (inside, hit(0, f32::NAN), Some(DisagreementKind::TOff)),
        (inside, None, Some(DisagreementKind::Leak)),
        (inside, hit(3, 5.0), Some(DisagreementKind::LeakThrough)),
        (inside, hit(1, 3.0), Some(DisagreementKind::WrongNeighbour)),
        (inside, hit(2, 3.0), Some(DisagreementKind::WrongNeighbour)),
        (inside, hit(4, 3.0), Some(DisagreementKind::WrongTriangle)),
        (inside, hit(5, 3.0), Some(DisagreementKind::NoSuchTriangle)),
        (down(0.5, 0.5), hit(0, 3.0), None),
        (down(0.5, 0.5), hit(1, 3.0), None),
        (down(0.0, 0.0), hit(1, 3.0), None),
        (past, None, None),
        (past, hit(0, 3.0), Some(DisagreementKind::FalseHit)),
        (past, hit(77, 3.0), Some(DisagreementKind::NoSuchTriangle)),
        (down(3.25, 3.25), None, None),
        (down(3.25, 3.25), hit(4, 3.0), Some(DisagreementKind::BackFace)),
    ];
    let oracle = Oracle::new(&mesh, Sides::Front, Tolerance::ulps(1));
    for (ray, found, kind) in cases {
        let report = oracle.judge(&[ray], &[found]).expect("one answer a ray");
        assert_eq!(report.disagreements().first().map(|wrong| wrong.kind), kind, "{ray:?} {found:?}: {report}");
    }
    let both = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T);
    both.assert_agrees(&[down(3.25, 3.25)], |_| hit(4, f32::INFINITY));
}

#[test]
fn what_t_cannot_tell_apart_is_a_near_tie() {
    let next = f32::from_bits(1.0f32.to_bits() + 2);
    let sheet = |z: f32| [[0.0, 0.0, z], [4.0, 0.0, z], [0.0, 4.0, z]];
    let positions = [sheet(next), sheet(1.0)].into_iter().flatten().collect();
    let mesh = Mesh::new(positions, vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
    let ray = Ray::new([1.0, 1.0, 4.0], [0.0, 0.0, -1.0]).expect("a ray");
    let kind = |tolerance| {
        let report = Oracle::new(&mesh, Sides::Front, tolerance).examine(&[ray], |_| hit(1, 3.0));
        report.disagreements().first().map(|wrong| wrong.kind)
    };
    assert_eq!(kind(Tolerance::ulps(1)), Some(DisagreementKind::NearTie), "4 - (1 + 2 ULPs) is 3 less one ULP");
    assert_eq!(kind(Tolerance::ulps(0)), Some(DisagreementKind::LeakThrough));
    assert_eq!(kind(Tolerance::ulps(0).or_absolute(1e-6)), Some(DisagreementKind::NearTie));
}

#[test]
fn tolerances_near_zero_can_be_a_distance() {
    let mesh = scene();
    let ray = Ray::new([0.25, 0.125, 0.0], [0.5, 0.5, -1.0]).expect("a ray");
    let off = |tolerance: Tolerance, t| {
        Oracle::new(&mesh, Sides::Front, tolerance).examine(&[ray], |_| hit(0, t)).count(DisagreementKind::TOff)
    };
    assert_eq!(off(Tolerance::ulps(100), 1e-9), 1);
    assert_eq!(off(Tolerance::ulps(100).or_absolute(1e-8), 1e-9), 0);
    assert_eq!(off(Tolerance::ulps(0), -0.0), 0, "both zeros are one t");
}

#[test]
fn the_report_reads_well() {
    let mesh = scene();
    let rays = [down(0.75, 0.25), down(0.5, 0.5), down(9.0, 0.0), down(0.75, 0.5), down(0.5, 0.25), down(0.25, 0.75)];
    let found = [hit(3, 5.0), None, hit(2, 1e-7), hit(0, f32::NAN), hit(0, 3.000_001), hit(1, 3.0)];
    let oracle = Oracle::new(&mesh, Sides::Front, Tolerance::ulps(1));
    let report = oracle.judge(&rays, &found).expect("one answer a ray");
    insta::assert_snapshot!("report", report);
    let leaks = report.only(DisagreementKind::is_leak);
    assert_eq!((leaks.leaks(), leaks.disagreements().len()), (2, 2));
}

/// The text for a ray in a report can be pasted into a test: it has the same bits, and states the aim of the ray.
#[test]
fn disagreements_can_be_pasted() {
    let mesh = teapot(2).expect("a teapot");
    let rays = hard_rays(&mesh, 20, 1);
    let report = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T).examine(&rays, |_| None);
    for wrong in report.disagreements() {
        assert_eq!(wrong.aim, Some(rays[wrong.ray].aim));
        assert!(wrong.to_string().starts_with(&format!("ray {}, {}, from ", wrong.ray, rays[wrong.ray].aim.words())));
        let literal = wrong.literal();
        let numbers: Vec<u32> = literal
            .split(|c: char| !c.is_ascii_alphanumeric() && !".-".contains(c))
            .filter_map(|word| word.parse::<f32>().ok())
            .map(f32::to_bits)
            .collect();
        let triangle = wrong.expected.as_ref().expect("a surface").triangle;
        let corners = mesh.corners(triangle).expect("a triangle");
        // The type `[[f32; 3]; 3]` contributes two numbers itself.
        let expected = [wrong.origin, wrong.direction].into_iter().flatten().chain([3.0, 3.0]);
        let expected: Vec<u32> = expected.chain(corners.into_iter().flatten()).map(f32::to_bits).collect();
        assert_eq!(numbers, expected, "{literal}");
    }
    let unknown = Oracle::new(&mesh, Sides::Both, Tolerance::ANY_T).examine(&[rays[0].ray], |_| None);
    assert!(unknown.disagreements().iter().all(|wrong| wrong.aim.is_none()));
}

#[test]
fn long_reports_are_cut() {
    let mesh = scene();
    let rays = vec![down(0.5, 0.25); 1500];
    let report = Oracle::new(&mesh, Sides::Front, Tolerance::ANY_T).examine(&rays, |_| None);
    let text = report.to_string();
    assert_eq!(text.lines().count(), 3 + 10 * 2, "{text}");
    assert!(text.ends_with("and 1490 more"), "{text}");
    assert_eq!(report.disagreements().len(), 1500);
}

#[test]
fn answers_are_counted() {
    let mesh = scene();
    let oracle = Oracle::new(&mesh, Sides::Front, Tolerance::ANY_T);
    let found = oracle.judge(&[down(0.0, 0.0)], &[]).unwrap_err();
    assert_eq!(found.to_string(), "expected an answer for each of 1 rays (`None` for no hit), found 0");
    insta::assert_snapshot!("count_of_answers", found);
    let nothing = Mesh::default();
    Oracle::new(&nothing, Sides::Both, Tolerance::ANY_T).assert_agrees(&[down(0.0, 0.0)], |_| None);
    assert!(hard_rays(&nothing, 100, 1).is_empty());
}

#[test]
fn assertions_say_what_differs() {
    let payload = std::panic::catch_unwind(|| {
        let mesh = scene();
        let rays = [HardRay { ray: down(0.5, 0.25), aim: Aim::Edge }];
        Oracle::new(&mesh, Sides::Front, Tolerance::ANY_T).assert_watertight(&rays, |_| hit(3, 5.0));
    });
    let payload = payload.expect_err("it panics");
    let said = payload.downcast_ref::<String>().expect("words");
    assert!(
        said.ends_with("| aim | rays | leak through to what is behind |\n|---|---|---|\n| edge | 1 | 1 |"),
        "{said}"
    );
}

#[test]
fn hard_rays_are_what_they_say() {
    let mesh = teapot(3).expect("a teapot");
    let rays = hard_rays(&mesh, 100, 7);
    assert_eq!(rays, hard_rays(&mesh, 100, 7));
    assert_ne!(rays, hard_rays(&mesh, 100, 8));
    for aim in Aim::ALL {
        let count = rays.iter().filter(|hard| hard.aim == aim).count();
        assert!((90..=100).contains(&count), "{aim:?}: {count}");
    }
    let mut zeros = std::collections::BTreeSet::new();
    for hard in rays.iter().filter(|hard| hard.aim == Aim::Axis) {
        let signs = hard.ray.direction().map(|x| (x == 0.0, x.is_sign_negative()));
        assert_eq!(signs.iter().filter(|(zero, _)| *zero).count(), 2);
        zeros.insert(signs);
    }
    assert_eq!(zeros.len(), 3 * 8, "three axes, two ways, four pairs of zeros");
    let hit = |aim| {
        let of_aim = rays.iter().filter(|hard| hard.aim == aim);
        of_aim.filter(|hard| exact::nearest(&mesh, &hard.ray, Sides::Both).is_some()).count()
    };
    for aim in [Aim::Edge, Aim::Vertex, Aim::Axis, Aim::Surface, Aim::Far] {
        assert!(hit(aim) > 25, "{aim:?}: {}", hit(aim));
    }
}

#[test]
fn exact_hits_agree_with_the_oracle_and_damaged_ones_do_not() {
    let mesh = teapot(2).expect("a teapot");
    let rays: Vec<Ray> = hard_rays(&mesh, 60, 3).iter().map(|hard| hard.ray).collect();
    for sides in [Sides::Front, Sides::Both] {
        let oracle = Oracle::new(&mesh, sides, Tolerance::ulps(0));
        let nearest = |ray: &Ray| exact::nearest(&mesh, ray, sides);
        let first = |ray: &Ray| nearest(ray).map(|hit| Hit { triangle: hit.triangle, t: hit.t.to_f32() });
        let last =
            |ray: &Ray| nearest(ray).map(|hit| Hit { triangle: hit.ties[hit.ties.len() - 1], t: hit.t.to_f32() });
        oracle.assert_agrees(&rays, first);
        oracle.assert_agrees(&rays, last);
        let blind = oracle.examine(&rays, |_| None);
        let missed = [DisagreementKind::Leak, DisagreementKind::Silhouette, DisagreementKind::Start];
        assert_eq!(missed.map(|kind| blind.count(kind)).iter().sum::<usize>(), blind.surface());
        assert_eq!(blind.disagreements().len(), blind.surface());
    }
}
