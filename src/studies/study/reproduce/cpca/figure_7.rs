//! Figure 7: projections of exit radiance, under colored lights.

use glam::DVec3;
use rayon::prelude::*;

use super::figure_3::EYE;
use super::signals::{BIRD, ComputedSignal, SIGNALS, anisotropic};
use super::views::{ModelView, RED_AND_BLUE, RIM};
use super::{
    EntryFindings, HOST, ModelSize, PaperRow, Prose, Setting, Shared, StudyError, Sweep, failed, number, solved,
};
use crate::cpca::transfer::{Incident, TracedRays};
use crate::geom::exact::Sides;
use crate::geom::vector::wide;
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::sphere::{DirectionRule, HarmonicLight};
use crate::study::prt::ExitRadiance;
use crate::tracer::HostTracer;
use crate::transfer::brdf::{Brdf, ExitBasis};

/// Degree of the rule that integrates exit radiance without a projection.
const DEGREE: usize = 62;

/// Projection: its mark in the figure, its name here, the order of exit radiance, and `true` for equation 1 (least
/// squares, with both inverses) or `false` for the method of Sloan et al. 2002 (zero hemisphere, with neither).
const PROJECTIONS: [(&str, &str, usize, bool); 4] = [
    ("a", "zero hemisphere", 4, false),
    ("b", "least squares", 4, true),
    ("c", "zero hemisphere", 5, false),
    ("", "least squares", 5, true),
];

/// Fresnel reflectances at normal incidence of the sweep, from that of glass to that of metals.
const NORMAL_INCIDENCES: [f64; 5] = [0.04, 0.1, 0.2, 0.4, 0.8];

const HOW: &str = "{} vertices of our bird, anisotropic with a Fresnel factor, under a red and a blue light. The figure shows {} rows by zero \
    hemisphere (a), {} rows by least squares (b) and {} by zero hemisphere (c). Errors are those of pictures, root mean square over that of exit radiance \
    without any projection: the integral of BRDF and light over {} directions per vertex, shadows and all. Pixels count as silhouette below a cosine of {} \
    between view and normal.";
const FRESNEL: &str = "The BRDF is lost, and with it the reflectance at normal incidence, which decides how much of the energy of the Fresnel factor lies at silhouettes: \
    it is swept from {} to {}. Rows have the value of all other figures, which was chosen before.";
const QUESTION: &str = "the model, its BRDF and the lights of Figure 7.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let paper = &SIGNALS[BIRD];
    let brdfs = NORMAL_INCIDENCES.map(anisotropic);
    let is_stated = |brdf: &Brdf| *brdf == paper.material.brdf();
    let mut exact = None;
    let found = brdfs.iter().enumerate().map(|(at, brdf)| {
        let exact = (&mut exact, &brdfs[..], at);
        ProjectedPictures::new(exact, shared.models, is_stated(brdf))
    });
    let mut found = found.collect::<Result<Vec<_>, StudyError>>()?;
    let settings = NORMAL_INCIDENCES.iter().zip(&found);
    let settings =
        settings.map(|(&at, found)| Setting { at: number(at, 2), values: found.ratios().to_vec() }).collect();
    let stated = brdfs.iter().position(is_stated).ok_or_else(|| failed(HOST)(&"the figure's BRDF is not swept"))?;
    let stated = found.swap_remove(stated);
    let mut rows = stated.rows()?;
    let sweep = Sweep { name: "Fresnel factors of the BRDF", parameter: "reflectance at normal incidence", settings };
    sweep.explain(&mut rows);
    let swept = sweep.table("Rows by the reflectance at normal incidence", &rows, (None, |value| value));
    let directions = DirectionRule::hemisphere(DEGREE).len();
    let figures = [stated.points, 16, 16, 25, directions].map(|count| number(count as f64, 0));
    let ends = [NORMAL_INCIDENCES[0], NORMAL_INCIDENCES[NORMAL_INCIDENCES.len() - 1]].map(|end| number(end, 2));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures.into_iter().chain([number(RIM, 2)])), Prose::new(FRESNEL, ends)],
        rows,
        questions: vec![QUESTION],
        pictures: vec![stated.grid()],
        tables: vec![stated.table, swept],
        ..EntryFindings::default()
    })
}

/// Exit radiance of all vertices, with each BRDF.
type ExactRadiance = Vec<Vec<[f64; 3]>>;

/// All projections with one BRDF.
struct ProjectedPictures {
    /// Errors of the picture and of its silhouettes, per projection.
    errors: Vec<[f64; 2]>,
    table: Table,
    pictures: Vec<NamedPicture>,
    /// Number of vertices.
    points: usize,
}

impl ProjectedPictures {
    /// Computes those of `brdfs[at]`. Exact radiance is computed with all of the BRDFs at once, on first use.
    fn new(
        (exact_radiance, brdfs, at): (&mut Option<ExactRadiance>, &[Brdf], usize),
        models: ModelSize,
        draws: bool,
    ) -> Result<Self, StudyError> {
        let light = HarmonicLight::red_and_blue(5);
        let glossy = |order: usize, least_squares: bool, incident: Incident| ExitRadiance::Glossy {
            basis: ExitBasis::of_order(order),
            least_squares,
            incident,
        };
        let table = Table::of("Errors of pictures", "figure projection rows error_% silhouettes_%");
        let mut found = Self { errors: Vec::new(), table, pictures: Vec::new(), points: 0 };
        for (mark, name, order, least_squares) in PROJECTIONS {
            let incident = Incident::Harmonics { order: 5, inverse: least_squares };
            let exit = glossy(order, least_squares, incident);
            let computed = ComputedSignal::with_brdf(&SIGNALS[BIRD], brdfs[at], exit, models)?;
            let mut view = ModelView::new(&computed, &light, EYE)?;
            let all = match &mut *exact_radiance {
                Some(all) => all,
                none => none.insert(exit_radiance(&computed, brdfs, (&light, view.eye()))?),
            };
            let exact_radiance = &all[at];
            let exact = view.of_vertices(exact_radiance);
            view.expose(&exact);
            let error = view.difference(None, &exact, |_| true)?;
            let rim = view.difference(None, &exact, |cosine| cosine < RIM)?;
            let rows = order * order;
            let shares = [error, rim].map(|share| Cell::percent(100.0 * share));
            found.table.push([Cell::from(mark), name.into(), rows.into()].into_iter().chain(shares));
            found.errors.push([error, rim]);
            if draws {
                if found.points == 0 {
                    let file = "cpca-figure-7-exact".to_owned();
                    let caption = "what they are held against".to_owned();
                    found.pictures.push(view.shown(exact_radiance, file, caption)?);
                }
                let file = format!("cpca-figure-7-{}-{rows}", name.replace(' ', "-"));
                found.pictures.push(view.picture(None, file, format!("{name}, {rows} rows"))?);
                if found.points == 0 {
                    found.pictures.push(view.light("cpca-figure-7", RED_AND_BLUE)?);
                }
            }
            found.points = computed.signal.points();
        }
        Ok(found)
    }

    /// Pictures as in the figure, then what they are held against.
    fn grid(&self) -> PictureGrid {
        let found = |name: &str| self.pictures.iter().find(|picture| picture.name.ends_with(name)).cloned();
        let columns = ["(a) zero hemisphere, 16 rows", "(b) least squares, 16 rows", "(c) zero hemisphere, 25 rows"];
        let printed = ["zero-hemisphere-16", "least-squares-16", "zero-hemisphere-25"].map(found);
        let others = ["exact", "least-squares-25", "light"].map(found);
        PictureGrid::new("Figure 7", columns)
            .sparse_row("", printed)
            .sparse_row("no projection; least squares, 25 rows; the light", others)
    }

    /// Values of the rows.
    fn ratios(&self) -> [f64; 4] {
        let [zero, least, zero_25] = [self.errors[0], self.errors[1], self.errors[2]];
        [zero[0] / least[0], zero[1] / least[1], zero[1] / least[1] * least[0] / zero[0], zero_25[0] / least[0]]
    }

    fn rows(&self) -> Result<Vec<PaperRow>, StudyError> {
        let ids = ["figure-7-16", "figure-7-silhouettes", "figure-7-especially", "figure-7-25"];
        ids.into_iter().zip(self.ratios()).map(|(id, ours)| solved(id, ours)).collect()
    }
}

/// Radiance of every vertex towards an eye from each BRDF and light alone: section 3.1 without harmonics, direct light
/// with shadows only.
fn exit_radiance(
    computed: &ComputedSignal,
    brdfs: &[Brdf],
    (light, eye): (&HarmonicLight, DVec3),
) -> Result<ExactRadiance, StudyError> {
    let vertices = &computed.vertices;
    let mut tracer = HostTracer::new(&computed.mesh, Sides::Both);
    let rays = TracedRays::trace(vertices, DirectionRule::hemisphere(DEGREE), &mut tracer, false);
    let rays = rays.map_err(|e| failed(HOST)(&e))?;
    let of_vertex = |vertex: usize| {
        let frame = &vertices.frames()[vertex];
        let view = frame.to_local((eye - wide(vertices.positions()[vertex])).normalize_or_zero());
        let mut sums = vec![[0.0; 3]; brdfs.len()];
        for (at, (&s, weight)) in rays.rule().directions().iter().zip(rays.rule().weights()).enumerate() {
            if view.z > 0.0 && !rays.is_blocked(vertex, at) {
                let radiance = light.radiance(frame.to_global(s));
                for (sum, brdf) in sums.iter_mut().zip(brdfs) {
                    let factor = weight * brdf.value(view, s) * s.z;
                    (0..3).for_each(|channel| sum[channel] += factor * radiance[channel]);
                }
            }
        }
        sums
    };
    let by_vertex: Vec<_> = (0..vertices.len()).into_par_iter().map(of_vertex).collect();
    Ok((0..brdfs.len()).map(|brdf| by_vertex.iter().map(|sums| sums[brdf]).collect()).collect())
}
