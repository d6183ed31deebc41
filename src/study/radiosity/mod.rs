//! Radiosity of a scene, solved in several ways side by side: on a card, on the host, directly.
//!
//! What each way needs (iterations, passes, time), how far it is from the direct solution, and how the room looks in it. With a change
//! of light or paint, how many iterations each way needs from where it stands, and from nothing.

mod change;
mod difference;
mod error;
mod page;
mod pictures;
mod room;
mod sweep;
mod tables;
mod time;
mod way;

use refsim::device::Profile;
use refsim::machine::Executor;

use crate::radiosity::form_factor::{RowSums, VisibilityParameters};
use crate::radiosity::on_card::Fit;
use crate::radiosity::solve::Options;
use crate::radiosity::{Patches, Subdivision, System};
use crate::scene::{Camera, Scene};

pub use change::{Change, Relit};
pub use difference::Difference;
pub use error::StudyError;
pub use page::files;
pub use pictures::{Frame, Pictures};
pub use room::{Factors, Wishes};
pub use sweep::SweepRow;
pub use tables::{Tables, tables};
pub use time::IterationTime;
pub use way::{CardFacts, CardWay, Stopped, Way};

use pictures::Studio;

/// What is to be found out.
#[derive(Debug)]
pub struct Parameters {
    /// The room.
    pub scene: Scene,
    /// How finely it is cut.
    pub subdivision: Subdivision,
    /// Where form factors come from, and what is asked of them.
    pub factors: Wishes,
    /// How it is solved: a row of the table each.
    pub ways: Vec<Way>,
    /// The card for ways on a card.
    pub profile: Profile,
    /// Who computes on it, and draws the pictures.
    pub executor: Executor,
    /// When iterations stop.
    pub options: Options,
    /// What changes after the first solution.
    pub changes: Vec<Change>,
    /// From where pictures are taken.
    pub camera: Camera,
    /// What radiance is multiplied by in pictures; `None` makes the mean of what is seen, lamps apart, a middle grey.
    pub exposure: Option<f64>,
    /// Iterations of the first way on a card of which there are pictures.
    pub frames: Vec<u32>,
    /// Other numbers of patches in which the room is solved on the card, under each of its open switches.
    pub sweep: Vec<u32>,
}

/// One way of solving, and what came of it.
#[derive(Debug)]
pub struct Row {
    /// What was done.
    pub way: Way,
    /// Its name, unique in a study and fit for a file name.
    pub label: String,
    /// The radiosity of each patch.
    pub radiosity: Vec<[f64; 3]>,
    /// Figure 3's error, at the start and after each iteration: the mean over the channels of the mean square of E - M B.
    pub history: Vec<f64>,
    /// The residual's length at the end, of the emittance's.
    pub residual: f64,
    /// Why it stopped.
    pub stopped: Stopped,
    /// Light that it leaves unaccounted for, of what is emitted; the largest of the channels.
    pub energy_balance_error: f64,
    /// How far it is from the direct solution, if that was asked for.
    pub off: Option<Difference>,
    /// On a card.
    pub card: Option<CardFacts>,
    /// After the changes.
    pub relit: Option<Relit>,
    /// How the room looks.
    pub pictures: Pictures,
}

/// What was found.
#[derive(Debug)]
pub struct Outcome {
    /// The patches.
    pub patches: Patches,
    /// Row sums as found, before anything was enforced.
    pub found_sums: RowSums,
    /// The largest difference between A_i F_ij and A_j F_ji as found, as a share.
    pub reciprocity_error: f64,
    /// Pictures' exposure.
    pub exposure: f64,
    /// A row a way.
    pub rows: Vec<Row>,
    /// The room after some iterations.
    pub frames: Vec<Frame>,
    /// Other numbers of patches, other settings of the switches.
    pub sweep: Vec<SweepRow>,
}

/// Hears what is being done, how much of it is done, and of how much.
pub type Watch<'a> = dyn FnMut(&str, u64, u64) + 'a;

/// Does all of it.
///
/// # Errors
/// [`StudyError`].
pub fn run(parameters: &Parameters, watch: &mut Watch<'_>) -> Result<Outcome, StudyError> {
    let patches = Patches::new(&parameters.scene, parameters.subdivision)?;
    // Before the form factors, which take long.
    let on_card = |way: &Way| if let Way::Card(how) = way { Some(how.packing) } else { None };
    for packing in parameters.ways.iter().filter_map(on_card) {
        Fit::of(&parameters.profile, packing)?.require(&parameters.profile, packing, patches.list().len())?;
    }
    let room = room::find(&patches, parameters, watch)?;
    let system = System::new(room.factors, patches.reflectances(), patches.emittances())?;
    if system.emittance().iter().flatten().all(|&e| e == 0.0) {
        return Err(StudyError::Dark);
    }
    let changed = change::apply(&parameters.changes, &parameters.scene, &patches, &system)?;
    let mut solved = Vec::new();
    for (at, way) in parameters.ways.iter().enumerate() {
        watch(&format!("solving: {}", way.label(&parameters.profile)), at as u64, parameters.ways.len() as u64);
        solved.push(way::solve(*way, &system, changed.as_ref(), parameters)?);
    }
    let direct = solved.iter().find(|s| s.way == Way::DIRECT);
    let truth = direct.map(|s| s.radiosity.clone());
    let exposure = parameters.exposure.unwrap_or_else(|| {
        let brightness = |s: &way::Solved| pictures::exposure(&patches, system.emittance(), &s.radiosity);
        direct.or(solved.first()).map_or(1.0, brightness)
    });
    let mut studio = Studio::new(&patches, parameters, exposure)?;
    let frames = studio.frames(&solved)?;
    let (mut rows, ways) = (Vec::new(), solved.len() as u64);
    for one in solved {
        watch(&format!("drawing: {}", one.way.label(&parameters.profile)), rows.len() as u64, ways);
        rows.push(row(one, &system, truth.as_deref(), &mut studio, parameters)?);
    }
    drop(studio);
    let sweep = sweep::run(parameters, watch)?;
    Ok(Outcome {
        found_sums: room.found_sums,
        reciprocity_error: room.reciprocity_error,
        exposure,
        rows,
        frames,
        sweep,
        patches,
    })
}

/// A way's row: how far it is off, and its pictures.
fn row(
    mut one: way::Solved,
    system: &System,
    truth: Option<&[[f64; 3]]>,
    studio: &mut Studio<'_>,
    parameters: &Parameters,
) -> Result<Row, StudyError> {
    let (pictures, card) = studio.show(&mut one, system)?;
    let last = one.history.last().copied().unwrap_or(f64::NAN);
    Ok(Row {
        label: one.way.label(&parameters.profile),
        residual: (last / one.emitted).sqrt(),
        energy_balance_error: energy_balance_error(system, &one.radiosity),
        off: truth.map(|truth| Difference::between(&one.radiosity, truth, system.emittance())),
        pictures,
        card,
        way: one.way,
        radiosity: one.radiosity,
        history: one.history,
        stopped: one.stopped,
        relit: one.relit,
    })
}

/// Light unaccounted for, of what is emitted; the largest of the channels that emit.
fn energy_balance_error(system: &System, radiosity: &[[f64; 3]]) -> f64 {
    let left = system.energy_balance_error(radiosity);
    let emitted = |c: usize| -> f64 {
        system.factors().areas().iter().zip(system.emittance()).map(|(area, e)| area * e[c]).sum()
    };
    (0..3).filter(|&c| emitted(c) > 0.0).map(|c| (left[c] / emitted(c)).abs()).fold(0.0, f64::max)
}

/// Unoccluded, sampled or rendered, for people.
impl std::fmt::Display for Factors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unoccluded => f.write_str("unoccluded"),
            Self::Rays(VisibilityParameters { side, .. }) => write!(f, "{} rays a pair", side * side),
            Self::Hemicube { resolution } => write!(f, "hemicubes of {resolution}"),
        }
    }
}
