//! Tables 1 and 2: rays per second, and the fraction of rays on the card, for five scenes and applications.

use std::rc::Rc;

use rayon::prelude::*;

use super::engine_run::{Run, rays_per_s};
use super::shares::{self, Share};
use super::teapot::{TeapotRoom, Variant};
use super::workload::{Job, JobRenderer, TIMES};
use super::{EntryFindings, Method, PaperRow, QUESTION, RATE, Shared, StudyError, commands, paper_row, printed};
use crate::report::{Cell, NamedChart, Table};

/// Line in both tables, with the names of its printed figures.
struct PrintedScene {
    rate: &'static str,
    share: &'static str,
    polygons: &'static str,
    tick: &'static str,
    job: Option<Job>,
    /// Number of rays at which a cell's cache is sent to the card (`R_min`).
    rays: usize,
}

const EYES: Job = Job { scene: "office-floor", view: Some("top"), renderer: JobRenderer::Eyes, side: 512 };

const SCENES: [PrintedScene; 5] = [
    // The room of Tables 3 to 5. Section 6.3: 256 rays and an octree tuned by hand; ours is not tuned.
    PrintedScene {
        rate: "ray-engine/teapot-classical",
        share: "ray-engine/share-teapot-classical",
        polygons: "ray-engine/polygons-teapot",
        tick: "teapot, classical",
        job: None,
        rays: 256,
    },
    PrintedScene {
        rate: "ray-engine/teapot-monte-carlo",
        share: "ray-engine/share-teapot-monte-carlo",
        polygons: "ray-engine/polygons-teapot",
        tick: "teapot, Monte Carlo",
        job: Some(Job { scene: "teapot-room", view: None, renderer: JobRenderer::MonteCarlo(4), side: 56 }),
        rays: 64,
    },
    PrintedScene {
        rate: "ray-engine/office",
        share: "ray-engine/share-office",
        polygons: "ray-engine/polygons-office",
        tick: "office",
        job: Some(Job { scene: "office", view: None, renderer: JobRenderer::Classical, side: 224 }),
        rays: 64,
    },
    PrintedScene {
        rate: "ray-engine/floor-top",
        share: "ray-engine/share-floor-top",
        polygons: "ray-engine/polygons-floor",
        tick: "floor, top",
        job: Some(EYES),
        rays: 64,
    },
    PrintedScene {
        rate: "ray-engine/floor-side",
        share: "ray-engine/share-floor-side",
        polygons: "ray-engine/polygons-floor",
        tick: "floor, side",
        job: Some(Job { view: Some("side"), ..EYES }),
        rays: 64,
    },
];

const HOW: &str = "Five renderings as in Table 1 use scenes with as many polygons, on the host that Table 3 calibrates. The paper does not describe \
    the scenes, pictures and octrees. Its first row has a hand-tuned octree; ours uses the octree of all runs.";

const READINGS: &str = "A printed share of rays on the card has two readings: rays that met the card at least once, among all rays; and visits to \
    the caches of GPU cells that ended on the card, among all visits, of which the rest was forced to the host. The text does not decide between \
    them. Rows use the first, which was chosen before any of them was computed.";

struct SceneRun {
    run: Rc<Run>,
    triangles: usize,
    rays_per_s: f64,
    alone_rays_per_s: f64,
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let first = room.runs(&[Variant { rays: SCENES[0].rays, ..Variant::PLUS_CARD }])?;
    let others = SCENES.par_iter().filter_map(|scene| Some((scene, scene.job?)));
    let others = others.map(|(scene, job)| {
        let work = job.workload()?;
        let run = Run::new(&work, Variant { rays: scene.rays, ..Variant::PLUS_CARD }.parameters())?;
        Ok((run, work.mesh.len(), work.alone))
    });
    let others: Vec<_> = others.collect::<Result<_, StudyError>>()?;
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
    let ran: Vec<SceneRun> = ran.collect::<Result<_, StudyError>>()?;
    let mut rows = rates(&ran)?;
    let shares: Vec<Share<'_>> = SCENES.iter().zip(&ran).map(|(scene, ran)| (scene.share, &ran.run.counts)).collect();
    let (share_rows, readings) = shares::rows(&shares, "Table 2")?;
    rows.extend(share_rows);
    let ticks = SCENES.each_ref().map(|scene| scene.tick);
    Ok(EntryFindings {
        text: vec![HOW.into(), READINGS.into()],
        rows,
        questions: vec![QUESTION],
        tables: vec![table(&ran)?, readings],
        charts: vec![NamedChart {
            name: "ray-engine-table-2".into(),
            chart: shares::chart(&shares, &ticks, "Share of rays on the card")?,
            caption: "Table 2, and both readings of our runs.".into(),
        }],
        ..EntryFindings::default()
    })
}

fn rates(ran: &[SceneRun]) -> Result<Vec<PaperRow>, StudyError> {
    let row = |(scene, ran): (&PrintedScene, &SceneRun)| {
        paper_row(scene.rate, (TIMES, Method::Engine), (ran.rays_per_s, RATE))
    };
    SCENES.iter().zip(ran).map(row).collect()
}

fn table(ran: &[SceneRun]) -> Result<Table, StudyError> {
    let columns =
        "scene polygons_printed triangles rays_traced printed_rays_per_s ours_rays_per_s host_alone_rays_per_s";
    let mut table = Table::of("Five scenes", columns);
    for (scene, ran) in SCENES.iter().zip(ran) {
        let rate = printed(scene.rate)?;
        table.push([
            rate.what.as_str().into(),
            printed(scene.polygons)?.cell(),
            ran.triangles.into(),
            ran.run.counts.rays.into(),
            rate.cell(),
            Cell::measured(ran.rays_per_s),
            Cell::measured(ran.alone_rays_per_s),
        ]);
    }
    Ok(table)
}
