//! Options of all commands that trace rays: cameras, hits, pictures.

use std::path::Path;

use glam::DVec3;
use miette::IntoDiagnostic as _;
use refsim::num::FormatError;

use super::Problem;
use crate::geom::exact::{ExactT, Sides, Tracer};
use crate::geom::{Mesh, Ray};
use crate::io::load_picture;
use crate::options::Size;
use crate::picture::Picture;
use crate::scene::Camera;

pub(super) const DEFAULT_DEVICE: &str = "ideal-fp32";

pub(super) fn bad_format(error: FormatError) -> miette::Report {
    Problem::usage(format!("{error}"), "formats look like s3.12, e5m10:rtz or fp24: see `crossbar alu --help`").into()
}

/// Position of a camera, its target, and its up vector.
pub(super) type Placement = (Option<[f32; 3]>, Option<[f32; 3]>, [f32; 3]);

/// A camera. Without an eye, it looks down a little from the front and sees the whole mesh; if there is no target
/// either, the mesh fills the picture.
pub(super) fn framing(
    mesh: &Mesh,
    size: Size,
    tan_half_height: f32,
    (eye, target, up): Placement,
) -> miette::Result<Camera> {
    let Some([low, high]) = mesh.bounds() else {
        return Err(Problem::usage(
            "the mesh has no triangles",
            "give an OBJ, PLY, STL or glTF file with at least one face",
        )
        .into());
    };
    let middle = [0, 1, 2].map(|i| low[i] / 2.0 + high[i] / 2.0);
    let half = [0, 1, 2].map(|i| f64::from(high[i]) / 2.0 - f64::from(low[i]) / 2.0);
    let radius = (half[0] * half[0] + half[1] * half[1] + half[2] * half[2]).sqrt();
    if radius == 0.0 && eye.is_none() {
        let help = "give another mesh, or place the camera with `--eye` if the command has this option";
        return Err(Problem::usage("expected a mesh with an extent, found a single point", help).into());
    }
    let tangent = f64::from(tan_half_height);
    let camera = |eye, target| Camera::new(eye, target, up, tan_half_height, size.width, size.height).into_diagnostic();
    if eye.is_none() && target.is_none() {
        let aspect = f64::from(size.width) / f64::from(size.height);
        if let Some((eye, target)) = filling(mesh, up, [tangent * aspect, tangent], (middle, radius)) {
            return camera(eye, target);
        }
    }
    let target = target.unwrap_or(middle);
    let eye = eye.unwrap_or_else(|| {
        // The sphere around the mesh touches the edges of the picture if the sine of half the view is radius /
        // distance.
        let distance = 1.05 * radius * (1.0 + 1.0 / (tangent * tangent)).sqrt();
        [0, 1, 2].map(|i| (f64::from(target[i]) + distance * FRONT[i]) as f32)
    });
    camera(eye, target)
}

/// Default direction from the target to the eye: from the front, and a little from above.
const FRONT: [f64; 3] = [0.3, -0.8, 0.52];

const FILLED: f64 = 0.92;

/// The nearest eye that looks along [`FRONT`] and sees every vertex, and a target near `middle`; `None` if no such
/// picture exists, because up is parallel to the line of sight.
///
/// A vertex (x, w) lies within a picture of half width `t` at distance 1 if |x - e| <= t (d - w), for an eye at (e, d).
/// So e lies between max(x + t w) - t d and min(x - t w) + t d, and the two are equal for the smallest d.
fn filling(
    mesh: &Mesh,
    up: [f32; 3],
    tangents: [f64; 2],
    (middle, radius): ([f32; 3], f64),
) -> Option<([f32; 3], [f32; 3])> {
    let exact = |point: [f32; 3]| DVec3::from(point.map(f64::from));
    let toward = DVec3::from(FRONT).normalize();
    let right = exact(up).cross(toward).try_normalize()?;
    // Unit vectors to the right and up in the picture, and towards the eye.
    let axes = [right, toward.cross(right), toward];
    let points = || mesh.iter_corners().flatten().map(|v| axes.map(|axis| axis.dot(exact(v))));
    let extreme = |of: &dyn Fn([f64; 3]) -> f64| points().map(of).fold(f64::NEG_INFINITY, f64::max);
    let mut eye = [0.0, 0.0, extreme(&|at| at[2]) + 0.1 * radius];
    for (side, tangent) in tangents.into_iter().enumerate() {
        let t = FILLED * tangent;
        let [most, least] = [extreme(&|at| at[side] + t * at[2]), -extreme(&|at| t * at[2] - at[side])];
        eye[side] = f64::midpoint(most, least);
        eye[2] = eye[2].max((most - least) / (2.0 * t));
    }
    let [x, y, w] = eye;
    let point = |w: f64| (axes[0] * x + axes[1] * y + axes[2] * w).to_array().map(|c| c as f32);
    Some((point(w), point(toward.dot(exact(middle)).min(w - w.abs() * 1e-3))))
}

/// First hits in exact arithmetic, converted by `rounded`; only some rays' exact numbers are in memory at a time.
pub(super) fn exact_hits<T>(
    tracer: &Tracer<'_>,
    rays: &[Ray],
    sides: Sides,
    rounded: fn(&ExactT) -> T,
) -> Vec<Option<(u32, T)>> {
    const AT_ONCE: usize = 1 << 16;
    let hits = rays.chunks(AT_ONCE).flat_map(|some| tracer.nearest_all(some, sides));
    hits.map(|hit| Some((hit.as_ref()?.triangle, rounded(&hit?.t)))).collect()
}

pub(super) fn picture(path: &Path) -> miette::Result<Picture> {
    Ok(load_picture(path)?)
}
