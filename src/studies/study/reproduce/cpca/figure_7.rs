//! Figure 7: projections of exit radiance, under colored lights.

use glam::DVec3;
use rayon::prelude::*;

use super::signals::{BIRD, ComputedSignal, SIGNALS};
use super::views::{ModelView, RIM};
use super::{EntryFindings, HOST, RunResult, Shared, StudyError, number, paragraph, solved};
use crate::cpca::transfer::{Incident, TracedRays};
use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::report::{Cell, Table};
use crate::sphere::{DirectionRule, HarmonicLight};
use crate::study::prt::ExitRadiance;
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
    let figures = [points, 16, 16, 25, directions].map(|count| number(count as f64, 0));
    Ok(EntryFindings::new(
        [paragraph(HOW, figures.into_iter().chain([number(RIM, 2)]))],
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
