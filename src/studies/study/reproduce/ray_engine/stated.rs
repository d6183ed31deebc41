//! Values common to all tables: the printed rate, the open question, the timing of runs.

use refsim::timing::host::CPU_ONLY_RAYS_PER_SECOND;
use refsim::timing::queue::QueueFigures;

use super::engine_run::Commands;
use super::teapot::TeapotRoom;
use super::{Dependence, number, paragraph};

pub(super) const RATE: Dependence = Dependence::Predicted {
    from: "135,812 rays/s of the host alone (the host's scale), 286 M/s at ten triangles (the card's fill rate), 250 MB/s (read-back)",
};

/// Rays per second of the host alone, as printed.
pub(super) const HOST_ALONE: f64 = CPU_ONLY_RAYS_PER_SECOND as f64;

/// Open question about rows of all tables.
pub(super) const QUESTION: &str = "the authors' scene, picture and octree, the cost of their driver's commands, and \
    how often their rays met the card.";

const HOW: &str = "The teapot room is rendered by Whitted ray tracing at {} x {} pixels, and the renderer's requests are replayed to the engine: \
    every ray goes through ray tree, octree and caches, and the emulated card draws every pass in fp32. The host's work is counted operation by \
    operation with the guessed weights of the host model, scaled so that the host alone casts the {} rays/s of Table 3's first row: the only \
    calibrated figure. Draws run at the GeForce4's fill rate, read-backs at its bus rate, commands at the guessed costs of every timeline.";

/// Description of the computation of Tables 3 to 5.
pub(super) fn how(room: &TeapotRoom) -> String {
    let side = || number(f64::from(room.side), 0);
    paragraph(HOW, [side(), side(), number(HOST_ALONE, 0)])
}

/// Speed-up over the host alone, in percent.
pub(super) fn speed_up(rays_per_s: f64) -> f64 {
    100.0 * (rays_per_s / HOST_ALONE - 1.0)
}

/// Cost model of the tables' runs, with the same guesses as every timeline.
pub(super) fn commands() -> Commands {
    Commands::Cost(QueueFigures::default())
}
