//! Time of an iteration on the card, and the log of relighting a scene.

use refsim::event::Event;
use refsim::texture::TexelFormat;
use refsim::timing::{Bottleneck, TimingError};

use super::method::CardMethod;
use super::{Parameters, no_card};
use crate::radiosity::display::Display;
use crate::radiosity::on_card::{CardSolver, PassProgram};
use crate::radiosity::rate::{RateError, Timing, timed_iteration};
use crate::radiosity::{Patches, System, model};
use crate::study::StudyError;

pub(super) const LOGGED: u32 = 4;
const CHANNELS: f64 = 3.0;

/// Time of an iteration over all three channels in the pipeline model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IterationTime {
    pub(super) seconds: f64,
    /// Millions of operations per second: two per element and channel, indexing not counted.
    pub(super) mflops: f64,
    pub(super) bound_by: Bottleneck,
    /// Memory bandwidth in use, in [0, 1].
    pub(super) bandwidth: f64,
}

#[derive(Clone, Debug)]
pub(super) struct CardFacts {
    /// Number of passes per iteration, over all its systems.
    pub(super) passes: usize,
    pub(super) block: usize,
    pub(super) instructions: usize,
    pub(super) matrix_bytes: f64,
    /// Time of an iteration in the pipeline model; `None` for devices without timing.
    pub(super) time: Option<IterationTime>,
    /// Log of changing the light, iterating and displaying the room.
    pub(super) log: Vec<Event>,
}

/// Changes the light, iterates and displays the room on the card, and measures the cost.
pub(super) fn facts(
    card: &mut CardSolver,
    how: CardMethod,
    system: &System,
    patches: &Patches,
    parameters: &Parameters,
) -> Result<CardFacts, StudyError> {
    let systems = card.radiosity_textures().len();
    let display = match systems {
        1 => Some(Display::new(card.machine_mut(), patches, &parameters.camera, TexelFormat::Bgra8)?),
        _ => None,
    };
    card.record(true);
    card.set_emittance(system).map_err(no_card)?;
    (0..LOGGED).try_for_each(|_| card.iterate()).map_err(no_card)?;
    if let (Some(display), [all]) = (display, &card.radiosity_textures()[..]) {
        display.flat(card.machine_mut(), *all, 1.0)?;
    }
    let log = card.take_log();
    card.record(false);
    let texel = how.storage.format().bytes() as u32;
    let programs = card.programs();
    Ok(CardFacts {
        passes: card.passes() * systems,
        block: programs.iter().map(|p| p.texels).max().unwrap_or(0),
        instructions: programs.iter().map(PassProgram::instructions).max().unwrap_or(0),
        matrix_bytes: model::matrix_bytes(card.patches() as u32, how.packing.elements(), texel) * systems as f64,
        time: time(how, systems, card.patches(), parameters)?,
        log,
    })
}

fn time(
    how: CardMethod,
    systems: usize,
    patches: usize,
    parameters: &Parameters,
) -> Result<Option<IterationTime>, StudyError> {
    let timing = Timing { patches, packing: how.packing, storage: how.storage, cache: false };
    let timed = match timed_iteration(&parameters.profile, &timing) {
        Ok(timed) => timed,
        Err(RateError::Timing(TimingError::Missing { .. })) => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    let seconds = timed.time.seconds() * systems as f64;
    Ok(Some(IterationTime {
        seconds,
        mflops: CHANNELS * model::mflops(patches as u32, 1.0 / seconds),
        bound_by: timed.bottleneck,
        bandwidth: timed.bandwidth,
    }))
}
