//! Figure 7: frame rates, modelled with the ground included.

use glam::DVec3;
use refsim::device::Profile;
use refsim::timing::host::HostOperation;

use super::scene::FigureScene;
use super::{
    Dependence, EntryFindings, ModelSize, PaperRow, RunResult, StudyError, TimedWork, models, paper_row, paragraph,
};
use crate::all_frequency::on_card::time::{FactoredFrame, PrintedModel, TABLE_1, host_of_table_1};
use crate::all_frequency::on_card::{ProductPlace, VertexColors};
use crate::all_frequency::shade::Multiplies;
use crate::card::frame_time::{FrameTime, frame_time};
use crate::geom::teapot::teapot;
use crate::report::{Cell, Table};
use crate::scene::built::ground::GROUND_SIDE;
use crate::study::reproduce::all_frequency::counts::COLUMNS;
use crate::transfer::visibility::SegmentCensus;

const CARD: &str = "r350";
/// Printed frame rates, each with the index of its column of Table 1: Buddha, glossy Buddha, teapot.
const PRINTED: [(&str, usize); 4] = [("diffuse", BUDDHA), ("glossy", 5), ("low", 1), ("all", 1)];
const BUDDHA: usize = 4;
/// Representatives per cluster, coefficients and number of segments, vertices per cluster, channels.
const VECTORS: u64 = 16;
const COEFFICIENTS: u64 = 256;
const SEGMENTS: u64 = 24;
const PER_CLUSTER: u64 = 200;
const CHANNELS: u64 = 3;
const CALIBRATED: &str = "Table 1: frames without drawing, vertices, clusters and omega";

const HOW: &str = "Figure 7's rates are Table 1's columns with a ground of {} vertices; {} % of the ground's segments hold transfer here. Host and \
    card work in parallel, vertex colors are sent as bytes, pixels take no time, and {} vertices are run per triangle. Table 1's rates with drawing \
    use the same model without a ground. Low-frequency light has as many Haar coefficients as any other, so the model has one rate for both lights.";

/// Number of vertices processed per triangle, for meshes that are not ordered for the card's vertex cache.
const RUN_PER_TRIANGLE: f64 = 1.1;

/// Cost of steps 2 and 3 for a ground whose fraction of non-empty segments is `omega`.
fn of_ground(omega: f64) -> (u64, Multiplies) {
    let vertices = u64::from(GROUND_SIDE * GROUND_SIDE);
    let entries = ((vertices * SEGMENTS) as f64 * omega) as u64;
    let per_vector = CHANNELS * VECTORS;
    let clusters = entries / PER_CLUSTER;
    (vertices, Multiplies { per_cluster: clusters * per_vector * COEFFICIENTS, per_vertex: entries * per_vector })
}

/// Fraction of the segments that are above the horizon of an open ground.
const OPEN_GROUND: f64 = 0.5;

/// Cost of the diffuse Buddha with its ground under a light whose fraction of nonzero coefficients is `share`; columns
/// without light are skipped.
pub(super) fn buddha_without_drawing(share: f64) -> Multiplies {
    let (own, ground) = (TABLE_1[BUDDHA].multiplies(), of_ground(OPEN_GROUND).1);
    Multiplies {
        per_cluster: ((own.per_cluster + ground.per_cluster) as f64 * share) as u64,
        per_vertex: own.per_vertex + ground.per_vertex,
    }
}

/// Seconds on the host of Table 1.
pub(super) fn seconds_of(steps: Multiplies) -> Result<f64, StudyError> {
    let host = host_of_table_1().on(super::HOST)?;
    Ok(host.time_of(HostOperation::MultiplyAdd, steps.per_cluster + steps.per_vertex).seconds())
}

/// Time of a frame including drawing, on a ground whose fraction of non-empty segments is `ground`; or without a
/// ground, as in section 7 for Table 1.
fn time_of(model: &PrintedModel, ground: Option<f64>) -> Result<FrameTime, StudyError> {
    let place = ProductPlace::Vertices(VertexColors::Bytes);
    let vertices = 100 * model.vertex_hundreds;
    let frame = |vertices: u64, terms: u64, host| FactoredFrame {
        vertices,
        triangles: 2 * vertices,
        terms: terms as usize,
        host,
        run_per_triangle: RUN_PER_TRIANGLE,
    };
    let mut log = frame(vertices, model.terms, model.multiplies()).log(&place);
    if let Some(omega) = ground {
        let (of_vertices, steps) = of_ground(omega);
        log.extend(frame(of_vertices, 1, steps).log(&place));
    }
    let (profile, host) = (Profile::named(CARD)?, host_of_table_1().on(super::HOST)?);
    frame_time(&profile, &log, &host).on(CARD)
}

pub(in crate::study::reproduce) fn timed() -> Result<TimedWork, StudyError> {
    TimedWork::new("all-frequency/fps-bunny", CARD, time_of(&TABLE_1[0], None)?.frame)
}

fn rate_row(id: &str, time: &FrameTime) -> Result<PaperRow, StudyError> {
    paper_row(id, (CARD, time.into()), (time.per_second(), Dependence::Predicted { from: CALIBRATED }))
}

pub(super) fn figure(size: ModelSize) -> Result<EntryFindings, StudyError> {
    let teapot = teapot(size.pick(40, 4)).on(super::HOST)?;
    let scene = FigureScene::new(&teapot, models::ground(size), DVec3::new(1.0, -2.4, 1.2))?;
    let census = SegmentCensus::new(&scene.vertices, &scene.of_ground, &scene.hats);
    let omega = census.omega();
    let mut table = Table::of("Figure 7: frames per second", "model printed modelled on_an_open_ground without_ground");
    let mut rows = Vec::new();
    for (id, at) in PRINTED {
        let time = time_of(&TABLE_1[at], Some(omega))?;
        let row = rate_row(&format!("all-frequency/fps-figure-7-{id}"), &time)?;
        let [open, none] = [Some(OPEN_GROUND), None].map(|omega| time_of(&TABLE_1[at], omega));
        table.push([
            row.target.what.as_str().into(),
            row.target.cell(),
            Cell::measured(time.per_second()),
            Cell::measured(open?.per_second()),
            Cell::measured(none?.per_second()),
        ]);
        rows.push(row);
    }
    for ((_, id, _), model) in COLUMNS.iter().zip(&TABLE_1) {
        rows.push(rate_row(&format!("all-frequency/fps-{id}"), &time_of(model, None)?)?);
    }
    let how = paragraph(HOW, &[&(GROUND_SIDE * GROUND_SIDE), &(100.0 * omega), &(RUN_PER_TRIANGLE, 1)]);
    Ok(EntryFindings::new([how], rows, [], [table]))
}
