//! Figure 7: projections of exit radiance, under colored lights.

use glam::DVec3;
use rayon::prelude::*;

use super::signals::{BIRD, ComputedSignal, SIGNALS};
use super::{EntryFindings, HOST, RunResult, Shared, StudyError, paragraph, solved};
use crate::clustering::Clustering;
use crate::cpca::transfer::{Incident, TracedRays};
use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::report::{Cell, Table};
use crate::scene::Camera;
use crate::sphere::{DirectionRule, HarmonicLight};
use crate::study::prt::{ExitRadiance, Lit, SeenSurface};
use crate::tracer::HostTracer;
use crate::transfer::brdf::ExitBasis;

/// Degree of the rule that integrates exit radiance without a projection.
const DEGREE: usize = 62;

/// Projection: its letter in the figure, its name here, the order of exit radiance, and `true` for equation 1 (least
/// squares, with both inverses) or `false` for the method of Sloan et al. 2002 (zero hemisphere, with neither).
const PROJECTIONS: [(&str, &str, usize, bool); 4] = [
    ("a", "zero hemisphere", 4, false),
    ("b", "least squares", 4, true),
    ("c", "zero hemisphere", 5, false),
    ("", "least squares", 5, true),
];

const HOW: &str = "The scene is our bird with {} vertices, anisotropic with a Fresnel factor, under a red and a blue light. The figure shows {} rows \
    by zero hemisphere (a), {} rows by least squares (b) and {} by zero hemisphere (c). Errors are RMS errors of pictures, relative to the RMS of \
    exit radiance without projection: the shadowed integral of BRDF and light over {} directions per vertex. A pixel counts as silhouette if the \
    cosine between view and normal is below {}.";
const QUESTION: &str = "the model, its BRDF and the lights of Figure 7.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let light = HarmonicLight::red_and_blue(5);
    let mut table = Table::of("Errors of pictures", "figure projection rows error_% silhouettes_%");
    let (mut errors, mut exact, mut points) = (Vec::new(), None, 0);
    for (mark, name, order, least_squares) in PROJECTIONS {
        let incident = Incident::Harmonics { order: 5, inverse: least_squares };
        let exit = ExitRadiance::Glossy { basis: ExitBasis::of_order(order), least_squares, incident };
        let computed = ComputedSignal::projected(&SIGNALS[BIRD], exit, shared.models)?;
        let view = ModelView::new(&computed, &light)?;
        let exact = match &mut exact {
            Some(exact) => exact,
            none => none.insert(view.of_vertices(&exit_radiance(&computed, (&light, view.eye()))?)),
        };
        let found = [view.difference(None, exact, |_| true)?, view.difference(None, exact, |cosine| cosine < RIM)?];
        let rows = order * order;
        let shares = found.map(|share| Cell::percent(100.0 * share));
        table.push([Cell::from(mark), name.into(), rows.into()].into_iter().chain(shares));
        errors.push(found);
        points = computed.signal.points();
    }
    let [zero, least, zero_25] = [errors[0], errors[1], errors[2]];
    let directions = DirectionRule::hemisphere(DEGREE).len();
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&points, &16.0, &16.0, &25.0, &directions, &(RIM, 2)])],
        [
            solved("figure-7-16", zero[0] / least[0])?,
            solved("figure-7-silhouettes", zero[1] / least[1])?,
            solved("figure-7-especially", zero[1] / least[1] * least[0] / zero[0])?,
            solved("figure-7-25", zero_25[0] / least[0])?,
        ],
        [QUESTION],
        [table],
    ))
}

/// Radiance of every vertex towards an eye, from BRDF and light alone: section 3.1 without harmonics, and only direct
/// light with shadows.
fn exit_radiance(
    computed: &ComputedSignal,
    (light, eye): (&HarmonicLight, DVec3),
) -> Result<Vec<[f64; 3]>, StudyError> {
    let (vertices, brdf) = (&computed.vertices, computed.paper.material.brdf());
    let mut tracer = HostTracer::new(&computed.mesh, Sides::Both);
    let rays = TracedRays::trace(vertices, DirectionRule::hemisphere(DEGREE), &mut tracer, false);
    let rays = rays.on(HOST)?;
    let of_vertex = |vertex: usize| {
        let frame = &vertices.frames()[vertex];
        let view = frame.to_local((eye - wide(vertices.positions()[vertex])).normalize_or_zero());
        let mut sum = [0.0; 3];
        for (at, (&s, weight)) in rays.rule().directions().iter().zip(rays.rule().weights()).enumerate() {
            if view.z > 0.0 && !rays.is_blocked(vertex, at) {
                let radiance = light.radiance(frame.to_global(s));
                let factor = weight * brdf.value(view, s) * s.z;
                (0..3).for_each(|channel| sum[channel] += factor * radiance[channel]);
            }
        }
        sum
    };
    Ok((0..vertices.len()).into_par_iter().map(of_vertex).collect())
}

/// Side of the pictures, in pixels.
const SIDE: u32 = 160;

/// Position of the eye, and the tangent of half the field of view.
const EYE: ([f32; 3], f32) = ([4.0, -3.0, 1.5], 0.3);

/// Cosine between view and normal below which a pixel counts as part of the silhouette.
pub(super) const RIM: f64 = 0.35;

/// Model under a light, seen by a camera.
pub(super) struct ModelView<'a> {
    computed: &'a ComputedSignal,
    light: &'a HarmonicLight,
    camera: Camera,
    seen: SeenSurface,
}

impl<'a> ModelView<'a> {
    pub(super) fn new(computed: &'a ComputedSignal, light: &'a HarmonicLight) -> Result<Self, StudyError> {
        let (eye, tan_half_height) = EYE;
        let camera = Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], tan_half_height, SIDE, SIDE);
        let camera = camera.on(HOST)?;
        let seen = SeenSurface::new(&computed.mesh, &computed.vertices, &camera);
        Ok(Self { computed, light, camera, seen })
    }

    pub(super) fn eye(&self) -> DVec3 {
        wide(self.camera.eye())
    }

    /// Interpolates radiance of vertices towards the eye to colors of pixels.
    pub(super) fn of_vertices(&self, radiance: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.seen.colors(radiance, [0.0; 3])
    }

    /// Difference of a picture from another picture with the same model and camera: RMS of the difference, relative to
    /// the RMS of the other picture. `wanted` selects pixels by the cosine between view and normal at the vertex with
    /// the largest weight.
    pub(super) fn difference(
        &self,
        clustering: Option<&Clustering>,
        other: &[[f64; 3]],
        wanted: impl Fn(f64) -> bool,
    ) -> Result<f64, StudyError> {
        let (mut apart, mut whole) = (0.0, 0.0);
        for ((vertex, ours), theirs) in self.seen.nearest().zip(self.colors(clustering)?).zip(other) {
            if vertex.is_some_and(|vertex| wanted(self.cosine(vertex as usize))) {
                let apart_by = |channel: usize| ours[channel] - theirs[channel];
                apart += (0..3).map(|channel| apart_by(channel) * apart_by(channel)).sum::<f64>();
                whole += theirs.iter().map(|value| value * value).sum::<f64>();
            }
        }
        Ok(if whole > 0.0 { (apart / whole).sqrt() } else { 0.0 })
    }

    /// Fraction of another picture's light that this picture lacks, over all pixels and channels.
    pub(super) fn missing(&self, other: &Self) -> Result<f64, StudyError> {
        let sum = |colors: Vec<[f64; 3]>| colors.iter().flatten().sum::<f64>();
        let (ours, theirs) = (sum(self.colors(None)?), sum(other.colors(None)?));
        Ok(if theirs > 0.0 { 1.0 - ours / theirs } else { 0.0 })
    }

    /// Colors of pixels from a clustering, or from the transfer itself.
    pub(super) fn colors(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, StudyError> {
        let lit = Lit::new(&self.computed.meaning, self.light).ok_or("the signal is not transfer").on(HOST)?;
        let exit = clustering.map_or_else(|| lit.of_signal(&self.computed.signal), |c| lit.of_clusters(c));
        Ok(self.of_vertices(&lit.radiance(&exit, &self.computed.vertices, self.eye())))
    }

    fn cosine(&self, vertex: usize) -> f64 {
        let vertices = &self.computed.vertices;
        let view = self.eye() - wide(vertices.positions()[vertex]);
        view.normalize_or_zero().dot(vertices.frames()[vertex].normal())
    }
}
