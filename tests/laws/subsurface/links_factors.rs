//! Laws of throughput factors: reciprocity, the tolerance, independent integrals, spheres, bad input.

use crate::environment::by_form;
use approx::assert_relative_eq;
use crossbar::atlas::Atlas;
use crossbar::subsurface::links::{LinkChoice, Links};
use crossbar::subsurface::multipole::{ClusterId, Factors, SurfaceMoments};
use crossbar::subsurface::{Dipole, Reference};

use glam::DVec3;

use super::links_models::{atlas, figure_7, fine_tolerance, level, medium, root, sphere, surface, texels};
use super::polygon::point_to_polygon;

#[test]
fn factors_times_areas_are_symmetric_between_texels() {
    let atlas = atlas(&sphere(3, 0.2), 16);
    for mm_per_unit in [0.5, 3.0, 20.0] {
        let surface = surface(&atlas, mm_per_unit);
        let factors = Factors::new(&surface, [figure_7()], 0.01).expect("a tolerance");
        let mut receiver = factors.receiver();
        for [x, y] in texels(16) {
            for [u, v] in texels(16).skip((16 * y + x) as usize) {
                let [i, j] = [[x, y], [u, v]].map(|[x, y]| ClusterId { level: 0, y, x });
                let there = surface.cluster_area(i) * receiver.factor([x, y], j)[0];
                let back = surface.cluster_area(j) * receiver.factor([u, v], i)[0];
                assert_relative_eq!(there, back, max_relative = 4e-16);
            }
        }
    }
}

/// Factors of several channels together are within the tolerance of finer factors of each channel alone, which are
/// compared with contour integrals below.
fn keep_their_tolerance<const N: usize>(surface: &SurfaceMoments, dipoles: [Dipole; N]) {
    let coarse = Factors::new(surface, dipoles, 0.01).expect("a tolerance");
    let fine = dipoles.map(|dipole| Factors::new(surface, [dipole], fine_tolerance()).expect("a tolerance"));
    let (mut fine, mut coarse) = (fine.each_ref().map(|fine| fine.receiver()), coarse.receiver());
    for texel in texels(32).step_by(307) {
        for cluster in (0..6).flat_map(|k| level(surface, k).into_iter().step_by(if k == 0 { 5 } else { 1 })) {
            let found = coarse.factor(texel, cluster);
            for ((fine, found), dipole) in fine.iter_mut().zip(found).zip(dipoles) {
                let [exact] = fine.factor(texel, cluster);
                let allowed = 0.01 * (exact + 1e-5 * dipole.total());
                assert!((found - exact).abs() <= allowed, "{texel:?} {cluster:?}: {found} for {exact}, {dipole:?}");
            }
        }
    }
}

/// Factors keep the tolerance, and so do links, whose texels gather together in squares; by default tests only the
/// smallest scale, and the last medium. A difference is relative to the factor and 1e-5 of the light that the plane
/// returns.
#[test]
fn factors_and_links_keep_their_tolerance() {
    let atlas = atlas(&sphere(6, 0.2), 32);
    let all = [(1.5, figure_7()), (5.0, figure_7()), (15.0, figure_7()), (8.0, medium(0.74, 0.9))];
    for (mm_per_unit, dipole) in all.into_iter().step_by(by_form(3, 1)) {
        let surface = surface(&atlas, mm_per_unit);
        keep_their_tolerance(&surface, [dipole]);
        let fine = Factors::new(&surface, [dipole], fine_tolerance()).expect("a tolerance");
        let mut receiver = fine.receiver();
        for choice in [LinkChoice::Fixed { level: 2 }, LinkChoice::Adaptive { count: 64 }] {
            let links = Links::new(&surface, &[dipole], choice, 0.01).expect("links");
            let mut worst: f64 = 0.0;
            for texel in texels(32).step_by(211) {
                // Links that are not used have the factor 0.
                for (cluster, factor) in links.of(texel).filter(|(_, factor)| factor[0] > 0.0) {
                    let [exact] = receiver.factor(texel, cluster);
                    worst = worst.max((f64::from(factor[0]) - exact).abs() / (exact + 1e-5 * dipole.total()));
                }
            }
            assert!(worst <= 0.01, "{mm_per_unit} mm, {choice:?}: {worst}");
            assert!(worst > 1e-4, "{mm_per_unit} mm, {choice:?}: {worst} leaves nothing to test");
        }
    }
}

/// The medium Skin1, whose channels have very different mean free paths and diffusion lengths.
#[test]
fn channels_together_keep_the_tolerance_of_each() {
    let surface = surface(&atlas(&sphere(4, 0.2), 32), 10.0);
    keep_their_tolerance(&surface, [medium(0.74, 0.032), medium(0.88, 0.17), medium(1.01, 0.48)]);
}

/// Compares factors with 1 / A_i times the integral over texel i, by many points, of exact contour integrals over the
/// polygons of texel j.
#[test]
fn factors_agree_with_contour_integrals() {
    let atlas = atlas(&sphere(2, 0.0), 16);
    let dipole = figure_7();
    for mm_per_unit in [1.0, 4.0] {
        let surface = surface(&atlas, mm_per_unit);
        let factors = Factors::new(&surface, [dipole], 1e-3).expect("a tolerance");
        let points = 24;
        for (i, j) in [(0, 0), (37, 37), (37, 38), (40, 57), (100, 117), (5, 200)] {
            let part = atlas.part(j);
            let polygons: Vec<Vec<_>> =
                part.polygons().map(|ring| ring.iter().map(|corner| mm_per_unit * *corner).collect()).collect();
            let mut sum = 0.0;
            for point in atlas.points(i, points) {
                sum += polygons.iter().map(|ring| point_to_polygon(&dipole, mm_per_unit * point, ring)).sum::<f64>();
            }
            let exact = sum / f64::from(points * points);
            let [found] = factors.factor([i % 16, i / 16], ClusterId { level: 0, y: j / 16, x: j % 16 });
            // The outer sum has an error below 2e-3, because doubling the points changes it by less.
            assert_relative_eq!(found, exact, max_relative = 3e-3);
        }
    }
}

/// Mean over texel i of contour integrals over texel j, by bisection along the texel and across it, to about 1e-3 of an
/// estimate.
pub(super) fn mean_of_contours(
    atlas: &Atlas,
    mm_per_unit: f64,
    dipole: &Dipole,
    [i, j]: [u32; 2],
    estimate: f64,
) -> f64 {
    let polygons = |texel: u32| {
        let part = atlas.part(texel);
        let in_mm = |ring: &[DVec3]| ring.iter().map(|corner| mm_per_unit * *corner).collect::<Vec<_>>();
        part.polygons().map(in_mm).collect::<Vec<_>>()
    };
    let (own, other) = (polygons(i), polygons(j));
    let (mut sum, mut area) = (0.0, 0.0);
    for ring in &own {
        let pairs = ring.iter().flat_map(|&a| ring.iter().map(move |&b| [a, b]));
        let longest = pairs.max_by(|p, q| p[0].distance(p[1]).total_cmp(&q[0].distance(q[1])));
        let [from, to] = longest.expect("corners");
        let sides = || ring.iter().zip(ring.iter().cycle().skip(1));
        let normal: DVec3 = sides().map(|(&a, &b)| (a - from).cross(b - from)).sum();
        let (along, length) = ((to - from).normalize(), from.distance(to));
        let across = normal.normalize().cross(along);
        let place = |p: DVec3| [(p - from).dot(along), (p - from).dot(across)];
        let sides: Vec<_> = sides().map(|(&a, &b)| [place(a), place(b)]).collect();
        let allowed = 1e-3 * estimate * normal.length() / 2.0;
        let mut strip = |x: f64| {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for [p, q] in sides.iter().filter(|[p, q]| p[0] != q[0] && (p[0] - x) * (q[0] - x) <= 0.0) {
                let y = p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
                (low, high) = (low.min(y), high.max(y));
            }
            let mut from_point = |y: f64| {
                let point = from + x * along + y * across;
                other.iter().map(|ring| point_to_polygon(dipole, point, ring)).sum::<f64>()
            };
            bisected(&mut from_point, [low, high], allowed / length, 12)
        };
        let mut ends: Vec<f64> = sides.iter().map(|[p, _]| p[0]).collect();
        ends.sort_by(f64::total_cmp);
        for ends in ends.windows(2).filter(|ends| ends[1] > ends[0]) {
            sum += bisected(&mut strip, [ends[0], ends[1]], allowed, 17);
        }
        area += normal.length() / 2.0;
    }
    sum / area
}

/// An integral by three Gauss points on parts, which are halved at least three times and until the halves agree with
/// the whole.
fn bisected(value: &mut dyn FnMut(f64) -> f64, [from, to]: [f64; 2], allowed: f64, most: u32) -> f64 {
    let mut sum = 0.0;
    let mut pending = vec![([from, to], allowed, 0)];
    while let Some(([a, b], allowed, halvings)) = pending.pop() {
        let mut rule = |a: f64, b: f64| {
            let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
            let step = half * 0.6_f64.sqrt();
            half / 9.0 * (5.0 * (value(middle - step) + value(middle + step)) + 8.0 * value(middle))
        };
        let middle = 0.5 * (a + b);
        let (whole, halves) = (rule(a, b), rule(a, middle) + rule(middle, b));
        if halvings == most || (halvings >= 3 && (whole - halves).abs() <= allowed) {
            sum += halves;
        } else {
            pending.extend([([a, middle], 0.7 * allowed, halvings + 1), ([middle, b], 0.7 * allowed, halvings + 1)]);
        }
    }
    sum
}

#[test]
fn the_reference_and_the_factors_agree_texel_by_texel() {
    let atlas = atlas(&sphere(3, 0.2), 16);
    let dipole = figure_7();
    for mm_per_unit in [1.0, 4.0] {
        let surface = surface(&atlas, mm_per_unit);
        let factors = Factors::new(&surface, [dipole], 1e-3).expect("a tolerance");
        let reference = Reference::new(&atlas, mm_per_unit, &dipole).expect("a scale");
        let mut receiver = factors.receiver();
        for i in (0..256).step_by(17) {
            for j in 0..256_usize {
                let cluster = ClusterId { level: 0, y: (j / 16) as u32, x: (j % 16) as u32 };
                let [found] = receiver.factor([i as u32 % 16, i as u32 / 16], cluster);
                // The reference treats pairs beyond 5 radii as points, which causes an error of at most 0.75 (side /
                // distance)^2.
                assert_relative_eq!(found, reference.factor(i, j), max_relative = 0.02);
            }
        }
    }
}

/// B = G(2R) on a sphere of any radius; the polyhedron's error decreases with the size of its faces. By default only
/// the smallest and the largest radius.
#[test]
fn a_sphere_under_uniform_light_has_its_closed_form() {
    let dipole = figure_7();
    let step = by_form(2, 1);
    for radius in [1.0, 5.0, 20.0].into_iter().step_by(step) {
        let exact = dipole.disc(2.0 * radius);
        let mut errors = Vec::new();
        for (n, side) in [(2, 16), (4, 32), (8, 64)] {
            let surface = surface(&atlas(&sphere(n, 0.0), side), radius);
            let factors = Factors::new(&surface, [dipole], 1e-3).expect("a tolerance");
            let mut receiver = factors.receiver();
            let (mut sum, mut area) = (0.0, 0.0);
            for [x, y] in texels(side).step_by((side * side / 256) as usize) {
                let weight = surface.cluster_area(ClusterId { level: 0, y, x });
                sum += weight * receiver.factor([x, y], root(&surface))[0];
                area += weight;
            }
            errors.push((sum / area / exact - 1.0).abs());
        }
        assert!(errors[2] < 0.01, "radius {radius}: {errors:?}");
        assert!(errors[2] < 0.5 * errors[0] || errors[0] < 2e-3, "radius {radius}: {errors:?}");
    }
}

/// If texels are far larger than the mean free path, the sum of factors is the plane's total.
#[test]
fn dense_media_return_the_planes_total() {
    let surface = surface(&atlas(&sphere(2, 0.0), 8), 1000.0);
    for dipole in [medium(10.0, 0.01), medium(1e6, 1.0), medium(1e30, 1e30)] {
        let factors = Factors::new(&surface, [dipole], 0.01).expect("a tolerance");
        for texel in texels(8).step_by(5) {
            assert_relative_eq!(factors.factor(texel, root(&surface))[0], dipole.total(), max_relative = 0.02);
        }
    }
    // The other extreme: bodies far smaller than the mean free path return almost no light.
    let thin = medium(1e-30, 0.0);
    let factors = Factors::new(&surface, [thin], 0.01).expect("a tolerance");
    let [factor] = factors.factor([3, 3], root(&surface));
    assert!(factor > 0.0 && factor < 1e-50, "{factor}");
}

#[test]
fn bad_figures_are_refused() {
    let atlas = atlas(&sphere(1, 0.0), 8);
    for mm_per_unit in [0.0, -1.0, 9e-31, 1e154, f64::NAN, f64::INFINITY] {
        assert!(SurfaceMoments::new(&atlas, mm_per_unit).is_err(), "{mm_per_unit}");
        assert!(Reference::new(&atlas, mm_per_unit, &figure_7()).is_err(), "{mm_per_unit}");
    }
    for tolerance in [0.0, 1e-6, 0.2, f64::NAN] {
        assert!(Factors::new(&surface(&atlas, 1.0), [figure_7()], tolerance).is_err(), "{tolerance}");
    }
}
