//! Compares the triangulation of polygons with the even-odd rule and with segment intersections, both in integers.

use std::cmp::Ordering;

use crossbar::geom::exact::winding;
use crossbar::geom::polygon::{PolygonFault, triangulate};
use num_bigint::BigInt;
use proptest::prelude::*;

type Point = [i64; 2];

fn cross([a, b, c]: [Point; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// Returns `true` if two segments, a + s u and b + t v, meet: s and t lie in [0, 1].
fn meet([a, a_end]: [Point; 2], [b, b_end]: [Point; 2]) -> bool {
    let (u, v, w) = (minus(a_end, a), minus(b_end, b), minus(b, a));
    let det = |p: Point, q: Point| p[0] * q[1] - p[1] * q[0];
    let (mut s, mut t, mut d) = (det(w, v), det(w, u), det(u, v));
    if d != 0 {
        if d < 0 {
            (s, t, d) = (-s, -t, -d);
        }
        return (0..=d).contains(&s) && (0..=d).contains(&t);
    }
    let along = |p: Point| p[0] * u[0] + p[1] * u[1];
    let (mut ends, length) = ([along(w), along(minus(b_end, a))], along(u));
    ends.sort_unstable();
    det(w, u) == 0 && ends[0] <= length && ends[1] >= 0
}

/// Returns `true` if no edges meet, except consecutive edges at their common corner.
fn is_simple(outline: &[Point]) -> bool {
    let n = outline.len();
    let edge = |i: usize| [outline[i % n], outline[(i + 1) % n]];
    let follows = |i: usize| {
        let [[a, b], [_, c]] = [edge(i), edge(i + 1)];
        let (back, on) = (minus(a, b), minus(c, b));
        a != b && !(cross([a, b, c]) == 0 && back[0] * on[0] + back[1] * on[1] > 0)
    };
    (0..n).all(|i| follows(i) && (i + 2..n).all(|j| (i, j) == (0, n - 1) || !meet(edge(i), edge(j))))
}

/// Uncrosses edges until none are left: the polygon becomes shorter each time.
fn uncrossed(mut outline: Vec<Point>) -> Option<Vec<Point>> {
    let n = outline.len();
    for _ in 0..2000 {
        let at = |i: usize| outline[i % n];
        let crossing = (0..n).flat_map(|i| (i + 2..n).map(move |j| (i, j))).find(|&(i, j)| {
            let sides = |a, b, c, d| cross([a, b, c]).signum() * cross([a, b, d]).signum() < 0;
            let [a, b, c, d] = [at(i), at(i + 1), at(j), at(j + 1)];
            sides(a, b, c, d) && sides(c, d, a, b)
        });
        let Some((i, j)) = crossing else { break };
        outline[i + 1..=j].reverse();
    }
    is_simple(&outline).then_some(outline)
}

/// Simple polygons on coarse grids (with many collinear corners) to fine grids.
fn simple() -> impl Strategy<Value = Vec<Point>> {
    let points = |side: i64| prop::collection::vec(prop::array::uniform2(0..side), 3..=40);
    prop::sample::select(vec![5_i64, 12, 60, 1000])
        .prop_flat_map(points)
        .prop_map(|mut points| {
            let mut seen = std::collections::BTreeSet::new();
            points.retain(|point| seen.insert(*point));
            points
        })
        .prop_filter_map("not simple", |points| (points.len() >= 3).then(|| uncrossed(points)).flatten())
}

/// A plane: an origin and two vectors, as integers times a power of two.
fn plane() -> impl Strategy<Value = ([[i64; 3]; 3], i32)> {
    let vector = |most: i64| prop::array::uniform3(-most..=most);
    ((vector(1000), vector(9), vector(9)).prop_map(|(o, u, v)| [o, u, v]), -30..30)
        .prop_filter("a plane", |([_, u, v], _)| {
            (0..3).any(|axis| u[axis] * v[(axis + 1) % 3] != u[(axis + 1) % 3] * v[axis])
        })
}

fn placed(outline: &[Point], ([o, u, v], exponent): &([[i64; 3]; 3], i32)) -> Vec<[f32; 3]> {
    let scale = f32::from_bits((127 + exponent).cast_unsigned() << 23);
    let coordinate = |[x, y]: Point, axis: usize| (o[axis] + x * u[axis] + y * v[axis]) as f32 * scale;
    outline.iter().map(|&point| [0, 1, 2].map(|axis| coordinate(point, axis))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Each point off all edges lies in one triangle if a ray from it crosses the outline an odd number of times,
    /// otherwise in no triangle.
    #[test]
    fn triangles_cover_the_inside_once(
        outline in simple(),
        start in any::<prop::sample::Index>(),
        turned in any::<bool>(),
        plane in plane(),
        points in prop::collection::vec(prop::array::uniform2(0.0..1.0_f64), 200),
    ) {
        let mut outline = outline;
        let n = outline.len();
        outline.rotate_left(start.index(n));
        if turned {
            outline.reverse();
        }
        let (triangles, fault) = triangulate(&placed(&outline, &plane));
        prop_assert_eq!((triangles.len(), fault), (n - 2, None));
        // The grid is 64 times finer, so that most points lie on no edge.
        let fine: Vec<Point> = outline.iter().map(|point| point.map(|x| 64 * x)).collect();
        let largest = fine.iter().flatten().max().copied().unwrap_or_default() as f64;
        for point in points {
            let p = point.map(|x| (x * largest) as i64);
            let sides: Vec<[i64; 3]> = triangles
                .iter()
                .map(|&[a, b, c]| [[a, b], [b, c], [c, a]].map(|[a, b]| cross([fine[a], fine[b], p]).signum()))
                .collect();
            if sides.iter().flatten().any(|&side| side == 0) {
                continue;
            }
            let crossed = (0..n).filter(|&i| {
                let (a, b) = (fine[i], fine[(i + 1) % n]);
                (a[1] > p[1]) != (b[1] > p[1]) && (cross([a, b, p]) > 0) == (b[1] > a[1])
            });
            let inside = crossed.count() % 2;
            let holding = sides.iter().filter(|[a, b, c]| a == b && b == c).count();
            prop_assert_eq!(holding, inside, "{:?} in {:?} of {:?}", p, triangles, outline);
        }
    }

    #[test]
    fn contacts_are_found(
        outline in prop::collection::vec(prop::array::uniform2(0_i64..7), 4..9),
        plane in plane(),
    ) {
        let (triangles, fault) = triangulate(&placed(&outline, &plane));
        prop_assert_eq!(triangles.len(), outline.len() - 2);
        let repeated = (1..outline.len()).any(|i| outline[..i].contains(&outline[i]));
        let expected = if repeated { Some(PolygonFault::Repeated) } else { Some(PolygonFault::Crossing) };
        prop_assert_eq!(fault, expected.filter(|_| !is_simple(&outline)), "{:?}", outline);
    }

    /// Any f32 is an integer times 2^-149.
    #[test]
    fn the_sign_of_an_area_is_exact(
        corners in prop::collection::vec(prop::array::uniform2(any::<f32>()), 3..6),
        near in any::<bool>(),
    ) {
        let corners: Vec<[f32; 2]> = corners
            .into_iter()
            // Corners so close to one line that f64 cannot determine the sign.
            .map(|[x, y]| if near { [x, (x * 3.0).next_up()] } else { [x, y] })
            .filter(|corner| corner.iter().all(|value| value.is_finite()))
            .collect();
        let whole = |value: f32| {
            let (bits, sign) = (value.abs().to_bits(), if value < 0.0 { -1 } else { 1 });
            let mantissa = bits & 0x7f_ffff | u32::from(bits >> 23 > 0) << 23;
            (BigInt::from(mantissa) * sign) << (bits >> 23).saturating_sub(1)
        };
        let n = corners.len();
        let twice: BigInt = (0..n)
            .map(|i| {
                let ([ax, ay], [bx, by]) = (corners[i].map(whole), corners[(i + 1) % n].map(whole));
                ax * by - ay * bx
            })
            .sum();
        prop_assert_eq!(winding(&corners), twice.cmp(&BigInt::ZERO));
    }

    #[test]
    fn any_corners_give_triangles(corners in prop::collection::vec(prop::array::uniform3(any::<f32>()), 0..12)) {
        let (triangles, _) = triangulate(&corners);
        prop_assert_eq!(triangles.len(), corners.len().saturating_sub(2));
    }
}

#[test]
fn faults_have_names() {
    let flat = |corners: &[[f32; 2]]| corners.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>();
    let fault = |corners: &[[f32; 3]]| triangulate(corners).1;
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert_eq!(fault(&flat(&square)), None);
    // A corner in line with its neighbors is legal, and so are three collinear corners.
    assert_eq!(fault(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]])), None);
    assert_eq!(fault(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]])), None);
    assert_eq!(fault(&flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])), Some(PolygonFault::Repeated));
    assert_eq!(fault(&flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]])), Some(PolygonFault::Crossing));
    assert_eq!(fault(&flat(&[[0.0, 0.0], [3.0, 0.0], [1.0, 0.0], [2.0, 0.0]])), Some(PolygonFault::Crossing));
    let mut lifted = flat(&square);
    lifted[2][2] = 1e-3;
    assert_eq!(fault(&lifted), Some(PolygonFault::Bent));
    // Rounding in a file does not make a face non-planar.
    lifted[2][2] = 1e-6;
    assert_eq!(fault(&lifted), None);
    // The hole of a ring, joined to its outline by a bridge edge in both directions, stays open.
    let ring = flat(&[
        [0.0, 0.0],
        [4.0, 0.0],
        [4.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 3.0],
        [3.0, 3.0],
        [3.0, 1.0],
        [1.0, 1.0],
    ]);
    let (triangles, fault) = triangulate(&ring);
    let area = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [ring[a], ring[b], ring[c]];
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    assert_eq!((fault, triangles.iter().map(|&t| area(t).abs()).sum::<f32>()), (Some(PolygonFault::Repeated), 24.0));
}

#[test]
fn long_outlines_take_bounded_time() {
    // Teeth of a comb: every second corner is reflex.
    let comb = |teeth: u16| -> Vec<[f32; 3]> {
        let outline = (0..teeth).map(|i| [f32::from(i), f32::from(i % 2), 0.0]);
        outline.chain([[f32::from(teeth), -1.0, 0.0], [-1.0, -1.0, 0.0]]).collect()
    };
    let (triangles, fault) = triangulate(&comb(4094));
    assert_eq!((triangles.len(), fault), (4094, None));
    assert_eq!(triangulate(&comb(4095)).1, Some(PolygonFault::TooLong));
    let round = |n: i32| (0..n).map(|i| [i as f32, (i * i) as f32, 0.0]).collect::<Vec<_>>();
    assert_eq!(triangulate(&round(4000)).0[3997], [0, 3998, 3999], "a convex one is a fan");
    assert_eq!(winding(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), Ordering::Greater);
}
