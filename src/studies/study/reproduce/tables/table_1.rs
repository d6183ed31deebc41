//! Tables 1 and 2: rays per second, and the fraction of rays on the card, for five scenes and applications.

use std::rc::Rc;

use rayon::prelude::*;

use super::super::shared::Shared;
use super::super::{Bound, EntryChart, EntryFindings, Method, ModelSize, PaperFigure, PaperRow, ReproduceError};
use super::engine_run::{Run, rays_per_s};
use super::shares::{self, Share};
use super::teapot::Variant;
use super::workload::{CLASSICAL_TEAPOT, Job, JobRenderer, TIMES};
use super::{HOST_ALONE, QUESTION, RATE, commands, speed_up};
use crate::report::{Cell, Chart, NamedPicture, Series, Table};

/// Line of both tables.
struct PrintedScene {
    what: &'static str,
    tick: &'static str,
    job: Option<Job>,
    polygons: u64,
    rays_per_s: f64,
    share: f64,
    /// `R_min`.
    rays: usize,
}

const EYES: Job = Job { scene: "office-floor", view: Some("top"), renderer: JobRenderer::Eyes, side: 512 };

const SCENES: [PrintedScene; 5] = [
    // The room of Tables 3 to 5. Section 6.3: 256 rays and an octree tuned by hand; ours is not tuned.
    PrintedScene {
        what: "teapot room, classical",
        tick: "teapot, classical",
        job: None,
        polygons: 2650,
        rays_per_s: 206_905.0,
        share: 89.0,
        rays: 256,
    },
    PrintedScene {
        what: "teapot room, Monte Carlo",
        tick: "teapot, Monte Carlo",
        job: Some(Job { scene: "teapot-room", view: None, renderer: JobRenderer::MonteCarlo(4), side: 112 }),
        polygons: 2650,
        rays_per_s: 149_233.0,
        share: 71.0,
        rays: 64,
    },
    PrintedScene {
        what: "office",
        tick: "office",
        job: Some(Job { scene: "office", view: None, renderer: JobRenderer::Classical, side: 224 }),
        polygons: 34_000,
        rays_per_s: 114_499.0,
        share: 65.0,
        rays: 64,
    },
    PrintedScene {
        what: "office floor, top view",
        tick: "floor, top",
        job: Some(EYES),
        polygons: 11_052,
        rays_per_s: 129_485.0,
        share: 70.0,
        rays: 64,
    },
    PrintedScene {
        what: "office floor, side view",
        tick: "floor, side",
        job: Some(Job { view: Some("side"), ..EYES }),
        polygons: 11_052,
        rays_per_s: 131_302.0,
        share: 89.0,
        rays: 64,
    },
];

/// Samples per pixel of the pictures, relative to those of the renderings that are counted.
const SAMPLES: u32 = 4;

/// Section 6.3, of the first row: "a 52% speedup over the CPU".
const TUNED: f64 = 52.0;

const HOW: &str = "Five renderings as in Table 1, of scenes with as many polygons, on the host that Table 3 calibrates. Nothing of the scenes, pictures and \
    octrees is printed; the paper's first row has an octree tuned by hand, ours has the one of all runs.";

const READINGS: &str = "A printed share of rays on the card is read in two ways: rays that met the card at least once, among all rays; and visits of \
    the caches of GPU cells that ended on the card, among all visits, of which the rest was forced to the host. The text decides neither. Rows take the \
    first, which was chosen before any of them was worked out.";

/// Run of a scene.
struct SceneRun {
    run: Rc<Run>,
    triangles: usize,
    rays_per_s: f64,
    alone_rays_per_s: f64,
}

pub(in super::super) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let room = shared.teapot()?;
    let first = room.runs(&[Variant { rays: SCENES[0].rays, ..Variant::PLUS_CARD }])?;
    let others = SCENES.par_iter().filter_map(|scene| Some((scene, scene.job?)));
    let others = others.map(|(scene, job)| {
        let work = job.workload()?;
        let run = Run::of(&work, Variant { rays: scene.rays, ..Variant::PLUS_CARD }.parameters())?;
        Ok((run, work.mesh.len(), work.alone))
    });
    let others: Vec<_> = others.collect::<Result<_, ReproduceError>>()?;
    let first = first.into_iter().map(|run| (run, room.work.mesh.len(), room.work.alone));
    let ran = first.chain(others.into_iter().map(|(run, triangles, alone)| (Rc::new(run), triangles, alone)));
    let ran = ran.map(|(run, triangles, alone)| {
        Ok(SceneRun {
            rays_per_s: rays_per_s(&run, &room.host, commands())?,
            alone_rays_per_s: alone.rays_per_s(&room.host),
            run,
            triangles,
        })
    });
    let ran: Vec<SceneRun> = ran.collect::<Result<_, ReproduceError>>()?;
    let mut rows = rates(&ran);
    let shares: Vec<Share<'_>> = SCENES
        .iter()
        .zip(&ran)
        .map(|(scene, ran)| Share { what: scene.what, printed: scene.share, counts: &ran.run.counts })
        .collect();
    let (share_rows, readings) = shares::rows(&shares, "Table 2");
    rows.extend(share_rows);
    let ticks = SCENES.each_ref().map(|scene| scene.tick);
    let pictures = (1..).zip(&SCENES).map(|(row, scene)| picture(row, scene, shared.models));
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    Ok(EntryFindings {
        pictures,
        text: vec![HOW.into(), READINGS.into()],
        rows,
        questions: vec![QUESTION],
        tables: vec![table(&ran), readings],
        charts: vec![
            EntryChart {
                name: "ray-engine-table-1",
                chart: rates_chart(&ran, &ticks),
                caption: "Rays a second of the five rows of Table 1.".into(),
            },
            EntryChart {
                name: "ray-engine-table-2",
                chart: shares::chart(&shares, &ticks, "Share of rays on the card"),
                caption: "Table 2, and both readings of our runs.".into(),
            },
        ],
        ..EntryFindings::default()
    })
}

/// Picture of a row's scene, by its renderer.
fn picture(row: usize, scene: &PrintedScene, models: ModelSize) -> Result<NamedPicture, ReproduceError> {
    let image = scene.job.unwrap_or(CLASSICAL_TEAPOT).picture(models.picture_side(), SAMPLES)?;
    Ok(NamedPicture::new(format!("ray-engine-table-1-scene-{row}"), image, scene.what))
}

fn rates(ran: &[SceneRun]) -> Vec<PaperRow> {
    let by = (TIMES, Method::Engine);
    let row = |(i, (scene, ran)): (usize, (&PrintedScene, &SceneRun))| {
        let target = PaperFigure::printed(scene.rays_per_s, 0, "rays/s", "Table 1");
        // The first row's room is the one on which the host was calibrated; for the others no rate of the host alone is printed.
        let gain = Bound::Gain { share: Bound::SHARE, over: HOST_ALONE };
        let bound = if i == 0 { gain } else { Bound::PREDICTION };
        PaperRow::new(scene.what, by, target, (ran.rays_per_s, RATE), bound)
    };
    let mut rows: Vec<PaperRow> = SCENES.iter().zip(ran).enumerate().map(row).collect();
    let tuned = PaperFigure::printed(TUNED, 0, "%", "section 6.3");
    let ours = ran.first().map_or(f64::NAN, |ran| speed_up(ran.rays_per_s));
    rows.insert(1, PaperRow::new("the same, over the host alone", by, tuned, (ours, RATE), Bound::PREDICTION));
    rows
}

fn rates_chart(ran: &[SceneRun], ticks: &[&str]) -> Chart {
    let points = |values: Vec<f64>| (1..).zip(values).map(|(x, value)| (f64::from(x), value / 1000.0)).collect();
    let dots = |label: &str, values: Vec<f64>| Series { label: label.to_owned(), points: points(values) };
    Chart {
        title: "Rays a second".to_owned(),
        y: "thousand rays/s".to_owned(),
        ticks: ticks.iter().map(ToString::to_string).collect(),
        dots: vec![
            dots("ours", ran.iter().map(|ran| ran.rays_per_s).collect()),
            dots("ours, host alone", ran.iter().map(|ran| ran.alone_rays_per_s).collect()),
        ],
        printed: points(SCENES.iter().map(|scene| scene.rays_per_s).collect()),
        ..Chart::default()
    }
}

fn table(ran: &[SceneRun]) -> Table {
    let columns =
        "scene polygons_printed triangles rays_traced printed_rays_per_s ours_rays_per_s host_alone_rays_per_s";
    let mut table = Table::of("Five scenes", columns);
    for (scene, ran) in SCENES.iter().zip(ran) {
        table.push([
            scene.what.into(),
            scene.polygons.into(),
            ran.triangles.into(),
            ran.run.counts.rays.into(),
            Cell::decimals(scene.rays_per_s, 0),
            Cell::measured(ran.rays_per_s),
            Cell::measured(ran.alone_rays_per_s),
        ]);
    }
    table
}
