//! Contour integrals over polygons and spheres, compared with brute force, with the plane and with solid angles.

use approx::assert_relative_eq;
use crossbar::elementary::atan2;
use crossbar::subsurface::Dipole;
use glam::DVec3;
use std::f64::consts::PI;

use super::links_models::medium;
use super::polygon::point_to_polygon;

/// The factor to a triangle by the midpoint rule over `cells` squared small triangles.
fn brute_force(dipole: &Dipole, point: DVec3, [a, b, c]: [DVec3; 3], cells: u32) -> f64 {
    let step = 1.0 / f64::from(cells);
    let (u, v) = (step * (b - a), step * (c - a));
    let area = 0.5 * u.cross(v).length();
    let mut sum = 0.0;
    for i in 0..cells {
        for j in 0..cells - i {
            let corner = a + f64::from(i) * u + f64::from(j) * v;
            sum += area * dipole.r_d(point.distance(corner + (u + v) / 3.0));
            if i + j + 1 < cells {
                sum += area * dipole.r_d(point.distance(corner + (u + v) / 1.5));
            }
        }
    }
    sum
}

#[test]
fn contours_are_sums_of_small_triangles() {
    let triangle = [DVec3::new(0.3, -1.0, 0.5), DVec3::new(4.0, 0.5, 1.5), DVec3::new(-1.0, 2.5, 0.0)];
    let inside = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
    let normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalize();
    for dipole in [medium(1.0, 0.0), medium(1.0, 0.05), medium(0.4, 1.0)] {
        for point in [inside, inside + 0.7 * normal, triangle[0], triangle[1] - 3.0 * normal, DVec3::new(5.0, 5.0, 5.0)]
        {
            let [coarse, fine] = [200, 400].map(|cells| brute_force(&dipole, point, triangle, cells));
            // The error of the midpoint rule falls with the square of the step.
            let extrapolated = fine + (fine - coarse) / 3.0;
            let exact = point_to_polygon(&dipole, point, &triangle);
            assert_relative_eq!(exact, extrapolated, max_relative = 2e-7);
            let turned = [triangle[2], triangle[1], triangle[0]];
            assert_relative_eq!(exact, point_to_polygon(&dipole, point, &turned), max_relative = 1e-13);
        }
    }
}

#[test]
fn a_large_square_is_the_plane() {
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| 1e9 * DVec3::new(x, y, 0.0));
    for dipole in [medium(2.21, 0.0012), medium(0.01, 3.0), medium(1e3, 1.0)] {
        let factor = point_to_polygon(&dipole, DVec3::new(3.0, -7.0, 0.0), &square);
        assert_relative_eq!(factor, dipole.total(), max_relative = 1e-12);
        let above = point_to_polygon(&dipole, DVec3::new(3.0, -7.0, 0.8), &square);
        assert_relative_eq!(above, dipole.beyond(0.8), max_relative = 1e-12);
    }
}

/// The solid angle of a triangle (Van Oosterom and Strackee 1983).
fn solid_angle(from: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - from);
    let [x, y, z] = [a, b, c].map(DVec3::length);
    let below = x * y * z + a.dot(b) * z + a.dot(c) * y + b.dot(c) * x;
    2.0 * atan2(a.dot(b.cross(c)).abs(), below)
}

#[test]
fn without_absorption_factors_in_the_plane_are_solid_angles() {
    let dipole = medium(0.7, 0.0);
    let triangle = [DVec3::new(0.0, 0.0, 0.0), DVec3::new(9.0, 1.0, 0.0), DVec3::new(2.0, 6.0, 0.0)];
    for point in [DVec3::new(3.0, 2.0, 0.0), DVec3::new(-2.0, 1.0, 0.0), DVec3::new(1e-9, 1e-8, 0.0)] {
        let angles = [dipole.z_r(), dipole.z_v()].map(|z| solid_angle(point + z * DVec3::Z, triangle));
        let exact = (angles[0] + angles[1]) / (4.0 * PI);
        assert_relative_eq!(point_to_polygon(&dipole, point, &triangle), exact, max_relative = 1e-12);
    }
}

/// Chords of a sphere are shorter than twice the radius, and every ring of chords has the area of a flat ring.
#[test]
fn without_absorption_a_sphere_loses_energy() {
    let sums = [1.0, 10.0, 100.0].map(|radius: f64| format!("{:.4}", medium(1.0, 0.0).disc(2.0 * radius)));
    assert_eq!(sums, ["0.3200", "0.8660", "0.9863"], "docs/papers/subsurface.md");
}
