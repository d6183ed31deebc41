//! Tables 1 and 2: rays a second, and the share of rays on the card, for five scenes and applications.

use super::super::{Findings, Modelled, Printed, ReproduceError, Row};
use super::engine_run::{Run, TIMES, rays_per_s};
use super::workload::{Asks, CLASSICAL_TEAPOT, Job};
use super::{TeapotRoom, commands, figure, parameters};
use crate::ray_engine::engine::EngineParameters;
use crate::report::Table;

/// A line of both tables.
struct Scene {
    what: &'static str,
    job: Job,
    polygons: u64,
    rays_per_s: f64,
    share: f64,
    /// `R_min`.
    rays: usize,
}

const EYES: Job = Job { scene: "office-floor", view: Some("top"), asks: Asks::Eyes, side: 512 };

const SCENES: [Scene; 5] = [
    // Section 6.3: 256 rays and an octree tuned by hand; ours is not tuned.
    Scene {
        what: "teapot room, classical",
        job: CLASSICAL_TEAPOT,
        polygons: 2650,
        rays_per_s: 206_905.0,
        share: 89.0,
        rays: 256,
    },
    Scene {
        what: "teapot room, Monte Carlo",
        job: Job { scene: "teapot-room", view: None, asks: Asks::MonteCarlo(4), side: 112 },
        polygons: 2650,
        rays_per_s: 149_233.0,
        share: 71.0,
        rays: 64,
    },
    Scene {
        what: "office",
        job: Job { scene: "office", view: None, asks: Asks::Classical, side: 224 },
        polygons: 34_000,
        rays_per_s: 114_499.0,
        share: 65.0,
        rays: 64,
    },
    Scene { what: "office floor, top view", job: EYES, polygons: 11_052, rays_per_s: 129_485.0, share: 70.0, rays: 64 },
    Scene {
        what: "office floor, side view",
        job: Job { view: Some("side"), ..EYES },
        polygons: 11_052,
        rays_per_s: 131_302.0,
        share: 89.0,
        rays: 64,
    },
];

const HOW: &str = "Five renderings as in Table 1, of scenes with as many polygons, on the host that Table 3 calibrates. Nothing of the scenes, pictures and \
    octrees is printed; the paper's first row has an octree tuned by hand and 256 rays a pass, ours 256 rays a pass.";

const NOTE: &str = "Rays a second depend on how many cells and triangles lie on a ray's way, and the share on the card on how many rays meet the same cell: on \
    the scene's layout and the size of the picture, which are ours (512 x 512 for eye rays alone). In our office floor, mostly walls of few \
    triangles, few cells hold five triangles. To know more one would need the scenes.";

pub(in super::super) fn findings() -> Result<Findings, ReproduceError> {
    let room = TeapotRoom::new()?;
    let mut rows = Vec::new();
    let mut table = Table::new("Five scenes", &HEADINGS);
    for scene in SCENES {
        let work = scene.job.workload()?;
        let run = Run::of(&work, EngineParameters { rays: scene.rays, ..parameters() })?;
        let (ours, alone) = (rays_per_s(&run, &room.host, commands())?, work.alone.rays_per_s(&room.host));
        let share = 100.0 * run.counts.share_on_card();
        let row = |what: String, value, unit, place, ours| Row {
            what,
            device: TIMES,
            printed: Printed { value, decimals: 0, unit, place },
            rates: None,
            pipeline: Modelled::predicted(ours),
            note: NOTE.to_owned(),
        };
        rows.push(row(scene.what.to_owned(), scene.rays_per_s, "rays/s", "Table 1", ours));
        rows.push(row(format!("{}: rays on the card", scene.what), scene.share, "%", "Table 2", share));
        table.push([
            scene.what.into(),
            scene.polygons.into(),
            work.mesh.len().into(),
            work.alone.rays.into(),
            figure(scene.rays_per_s, 1.0),
            figure(ours, 1.0),
            figure(alone, 1.0),
            figure(scene.share, 1.0),
            figure(share, 10.0),
        ]);
    }
    Ok(Findings { text: vec![HOW.to_owned()], rows, tables: vec![table], charts: Vec::new() })
}

const HEADINGS: [&str; 9] = [
    "scene",
    "polygons_printed",
    "triangles",
    "rays_traced",
    "printed_rays_per_s",
    "ours_rays_per_s",
    "host_alone_rays_per_s",
    "printed_on_card_%",
    "ours_on_card_%",
];
