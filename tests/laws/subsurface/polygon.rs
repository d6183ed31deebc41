//! Factors from a point to flat polygons by contour integrals: a second way to compute equation 10.
//!
//! In the plane of a polygon, with `h` the point's height above it and (rho, phi) polar coordinates around its foot,
//! R_d has the radial primitive `D(rho) = G(sqrt(rho^2 + h^2)) - G(h)`, so that the integral over the polygon is
//! `1 / (2 pi)` times the integral of `D(rho) dphi` around its boundary.

use std::f64::consts::PI;

use crossbar::elementary::{asinh, cosh};
use crossbar::geom::vector::unit;
use crossbar::quadrature::integral;
use crossbar::subsurface::Dipole;
use glam::DVec3;

/// The widest interval that gets sixteen points.
const WIDEST: f64 = 1.0;

/// The integral of R_d over a flat polygon, from a point: the factor of equation 10 for a vanishing patch at the
/// point. Corners in mm, in either order; a polygon without area has the factor 0. The polygon may be concave but must
/// not cross itself. The error is about 1e-13 of the plane's total.
pub(crate) fn point_to_polygon(dipole: &Dipole, point: DVec3, corners: &[DVec3]) -> f64 {
    let Some(normal) = normal(corners) else { return 0.0 };
    let height = normal.dot(corners[0] - point);
    let foot = point + height * normal;
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum: f64 = pairs.map(|(&a, &b)| side(dipole, normal, height.abs(), a - foot, b - foot)).sum();
    sum / (2.0 * PI)
}

/// The unit normal on the side from which the corners run counter-clockwise.
fn normal(corners: &[DVec3]) -> Option<DVec3> {
    let &first = corners.first()?;
    let pairs = corners.iter().zip(corners.iter().skip(1));
    unit(pairs.map(|(&a, &b)| (a - first).cross(b - first)).sum())
}

/// The integral of `D(rho) dphi` along a side from a to b, seen from the origin.
///
/// With p the distance of the side's line and t the position on it, t = p sinh(u) makes `rho = p cosh(u)` and
/// `dphi = du / cosh(u)`: smooth at the scale 1 of u, however close the line passes.
fn side(dipole: &Dipole, normal: DVec3, height: f64, a: DVec3, b: DVec3) -> f64 {
    let Some(along) = unit(b - a) else { return 0.0 };
    let away = normal.dot(a.cross(along));
    let distance = away.abs();
    let [from, to] = [a, b].map(|end| asinh(end.dot(along) / distance));
    if !(distance > 0.0 && from.is_finite() && to.is_finite()) {
        return 0.0;
    }
    let panels = ((to - from) / WIDEST).ceil().max(1.0);
    let value = |u: f64| {
        let stretch = cosh(u);
        dipole.disc_at(height, distance * stretch) / stretch
    };
    let step = (to - from) / panels;
    let sum: f64 =
        (0..panels as u32).map(|i| integral(from + step * f64::from(i), from + step * f64::from(i + 1), value)).sum();
    away.signum() * sum
}
