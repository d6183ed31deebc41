//! Tables 1 and 2: rays per second, and the fraction of rays on the card, for five scenes and applications.

use std::sync::Arc;

use rayon::prelude::*;
use refsim::timing::queue::QueueFigures;

use super::shares::{self, Share};
use super::workload::{Job, JobRenderer, QUESTION, RATE, Run, TIMES, TeapotRoom, Workload, plus_card, rays_per_s};
use super::{EntryFindings, Method, PaperRow, Shared, StudyError, paper_row, printed};
use crate::ray_engine::engine::EngineParameters;
use crate::report::{Cell, NamedChart, Table};

/// Line of both tables: its name in figure names, the figure of its polygons, its name in the chart, its picture, and
/// the number of rays at which a cell's cache is sent to the card (`R_min`).
type PrintedScene = (&'static str, &'static str, &'static str, Option<Job>, usize);

const EYES: Job = Job { scene: "office-floor", view: Some("top"), renderer: JobRenderer::Eyes, side: 512 };
const MONTE_CARLO: Job = Job { scene: "teapot-room", view: None, renderer: JobRenderer::MonteCarlo(4), side: 56 };
const OFFICE: Job = Job { scene: "office", view: None, renderer: JobRenderer::Classical, side: 224 };

const SCENES: [PrintedScene; 5] = [
    // The room of Tables 3 to 5. Section 6.3: 256 rays and an octree tuned by hand; ours is not tuned.
    ("teapot-classical", "polygons-teapot", "teapot, classical", None, 256),
    ("teapot-monte-carlo", "polygons-teapot", "teapot, Monte Carlo", Some(MONTE_CARLO), 64),
    ("office", "polygons-office", "office", Some(OFFICE), 64),
    ("floor-top", "polygons-floor", "floor, top", Some(EYES), 64),
    ("floor-side", "polygons-floor", "floor, side", Some(Job { view: Some("side"), ..EYES }), 64),
];
const HOW: &str = "Five renderings like those of Table 1 use scenes with the printed numbers of polygons, on the host that Table 3 calibrates. The \
    paper does not describe its scenes, pictures and octrees. The octree of its first row was tuned by hand; we use one octree for all runs.";
const READINGS: &str = "The printed share of rays on the card has two readings: the rays that met the card at least once, among all rays; or the \
    visits to the caches of GPU cells that ended on the card, among all visits (the other visits were forced to the host). The text does not \
    decide between them. Rows use the first reading, which we chose before we computed any share.";

struct SceneRun {
    run: Arc<Run>,
    triangles: usize,
    rays_per_s: f64,
    alone_rays_per_s: f64,
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let host = &room.host;
    let timed = |run: Arc<Run>, work: &Workload| {
        let rays_per_s = rays_per_s(&run, host, QueueFigures::default())?;
        let (triangles, alone_rays_per_s) = (work.mesh.len(), work.alone.rays_per_s(host));
        Ok::<_, StudyError>(SceneRun { run, triangles, rays_per_s, alone_rays_per_s })
    };
    let engine = |rays: usize| EngineParameters { rays, ..plus_card() };
    let first = room.runs(&[engine(SCENES[0].4)])?.into_iter().map(|run| timed(run, &room.work));
    let others = SCENES.par_iter().filter_map(|&(.., job, rays)| Some((job?, rays))).map(|(job, rays)| {
        let work = job.workload()?;
        timed(Arc::new(Run::new(&work, engine(rays))?), &work)
    });
    let others: Vec<_> = others.collect();
    let ran: Vec<SceneRun> = first.chain(others).collect::<Result<_, _>>()?;
    let rate = |(scene, ran): (&PrintedScene, &SceneRun)| {
        paper_row(&format!("ray-engine/{}", scene.0), (TIMES, Method::Engine), (ran.rays_per_s, RATE))
    };
    let mut rows: Vec<PaperRow> = SCENES.iter().zip(&ran).map(rate).collect::<Result<_, _>>()?;
    let table = table(&rows, &ran)?;
    let shares: Vec<Share<'_>> = SCENES.iter().zip(&ran).map(|(scene, ran)| (scene.0, &ran.run.counts)).collect();
    let (share_rows, readings) = shares::rows(&shares, "Table 2")?;
    rows.extend(share_rows);
    Ok(EntryFindings {
        text: vec![HOW.into(), READINGS.into()],
        rows,
        questions: vec![QUESTION],
        tables: vec![table, readings],
        charts: vec![NamedChart {
            name: "ray-engine-table-2".into(),
            chart: shares::chart(&shares, &SCENES.map(|(_, _, tick, ..)| tick), "Share of rays on the card")?,
            caption: "Printed shares of Table 2, and our shares by both readings.".into(),
        }],
        ..EntryFindings::default()
    })
}

fn table(rates: &[PaperRow], ran: &[SceneRun]) -> Result<Table, StudyError> {
    let columns =
        "scene polygons_printed triangles rays_traced printed_rays_per_s ours_rays_per_s host_alone_rays_per_s";
    let mut table = Table::of("Five scenes", columns);
    for ((scene, rate), ran) in SCENES.iter().zip(rates).zip(ran) {
        table.push([
            rate.target.what.as_str().into(),
            printed(&format!("ray-engine/{}", scene.1))?.cell(),
            ran.triangles.into(),
            ran.run.counts.rays.into(),
            rate.target.cell(),
            Cell::measured(ran.rays_per_s),
            Cell::measured(ran.alone_rays_per_s),
        ]);
    }
    Ok(table)
}
