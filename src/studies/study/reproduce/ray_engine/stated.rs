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
pub(super) const QUESTION: &str = "which scene, picture and octree the authors had, what their driver's commands cost, and how often their rays met the card: \
    none of it is printed.";

const HOW: &str = "The teapot room is rendered after Whitted at {} x {} pixels, and what the renderer asks is played to the engine: every ray \
    goes through ray tree, octree and caches, every pass is drawn by the emulated card in fp32. The work of the host is counted, operation by \
    operation, and costs the guessed weights of the host model, scaled so that the host alone casts the {} rays/s of Table 3's first row: \
    the one figure that is calibrated. Draws take the GeForce4's fill rate, read-backs its bus, commands the guesses of every timeline.";

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
