//! Tables 1 to 5 of the Ray Engine: rays per second of whole renderings.
//!
//! The paper's host is known by one figure, the 135,812 rays per second of Table 3's first row; from it the scale of
//! the host model is calibrated, on our counts for our teapot room. Everything else is predicted: what the engine does
//! is run and counted, the card takes what equation 11 and its commands take. Scenes, pictures and octree are ours,
//! since none of the paper's is printed. What such a choice decides is swept: the octree of the host alone
//! ([`sweeps::host_leaf`]), the costs of commands ([`sweeps::commands`]), and what is called a ray on the card
//! ([`shares`]).

mod engine_run;
mod host_work;
mod sensitivity;
mod shares;
mod speed_ups;
mod sweeps;
mod table_1;
mod table_3;
mod table_4;
mod table_5;
mod teapot;
mod workload;

use refsim::timing::host::CPU_ONLY_RAYS_PER_SECOND;
use refsim::timing::queue::QueueFigures;

use super::prose::{Prose, number};
use super::report::rounded;
use super::{ReproduceError, Standing};
use crate::report::Cell;
use engine_run::Commands;

pub(super) use table_1::findings as table_1;
pub(super) use table_3::findings as table_3;
pub(super) use table_4::findings as table_4;
pub(super) use table_5::findings as table_5;
pub(super) use teapot::TeapotRoom;

/// The printed figures that go into every predicted rate.
const RATE: Standing = Standing::Predicted {
    from: "135,812 rays/s of the host alone (the host's scale), 286 M/s at ten triangles (the card's fill rate), 250 MB/s (read-back)",
};

const HOW: &str = "The teapot room is rendered after Whitted at {} x {} pixels, and what the renderer asks is played to the engine: every ray \
    goes through ray tree, octree and caches, every pass is drawn by the emulated card in fp32. The work of the host is counted, operation by \
    operation, and costs the guessed weights of the host model, scaled so that the host alone casts the {} rays/s of Table 3's first row: \
    the one figure that is calibrated. Draws take the GeForce4's fill rate, read-backs its bus, commands the guesses of every timeline.";

/// How the figures of Tables 3 to 5 come about.
fn how(room: &TeapotRoom) -> Prose {
    let side = || number(f64::from(room.side), 0);
    Prose::new(HOW, [side(), side(), number(HOST_ALONE, 0)])
}

/// Why rows of all tables may be off.
const QUESTION: &str = "which scene, picture and octree the authors had, what their driver's commands cost, and how often their rays met the card: \
    none of it is printed.";

/// Rays per second of the host alone, as printed.
const HOST_ALONE: f64 = CPU_ONLY_RAYS_PER_SECOND as f64;

/// A speed-up over the host alone, in per cent.
fn speed_up(rays_per_s: f64) -> f64 {
    100.0 * (rays_per_s / HOST_ALONE - 1.0)
}

/// How the tables' runs are timed: what commands cost is guessed, and the guesses are those of every timeline.
fn commands() -> Commands {
    Commands::Cost(QueueFigures::default())
}

fn figure(value: f64, steps: f64) -> Cell {
    rounded(value, steps).into()
}
