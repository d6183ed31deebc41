//! Iterations per second of a card (section 3.1): an iteration is drawn, and the pipeline model times its log.
//!
//! Time depends only on sizes and programs, so the drawn system is all zeros.

use refsim::device::Profile;
use refsim::event::{DrawRecord, Event};
use refsim::machine::ExecutorKind;
use refsim::timing::cache::TextureCaches;
use refsim::timing::{Bottleneck, Level, Model, Picoseconds, TimingError};
use thiserror::Error;

use super::card_system::CardSystem;
use super::model;
use super::on_card::{CardSolver, Fit, Storage};
use super::packing::Packing;
use crate::card::CardError;

/// Error of timing an iteration.
#[non_exhaustive]
#[derive(Debug, Error)]
pub enum RateError {
    /// The card cannot run the iteration.
    #[error(transparent)]
    Card(#[from] CardError),
    /// The card's rates are not known.
    #[error(transparent)]
    Timing(#[from] TimingError),
}

/// Parameters of the timed iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Number of patches.
    pub patches: usize,
    /// Layout of elements in texels. With luminance packing one channel is timed, as in the paper.
    pub packing: Packing,
    /// Number format: single or half floats.
    pub storage: Storage,
    /// `true` to simulate the texture cache, a thousand times slower; otherwise the minimum traffic is assumed.
    pub cache: bool,
}

/// Time of an iteration.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedIteration {
    /// Number of passes.
    pub passes: usize,
    /// Number of draws: a pass with luminance packing needs four draws, one per channel of its target.
    pub draws: usize,
    /// Time of the whole iteration: draws and changes of state in sequence, because draws depend on each other.
    pub time: Picoseconds,
    /// Clocks of the texture units, which work concurrently with the other units.
    pub textures: u64,
    /// Clocks of the arithmetic units.
    pub arithmetic: u64,
    /// Clocks of memory accesses.
    pub memory: u64,
    /// Bottleneck of the longest draw.
    pub bottleneck: Bottleneck,
    /// Bytes transferred between the card and its memory.
    pub bytes: u64,
    /// Fraction of the memory's bandwidth used, in [0, 1].
    pub bandwidth: f64,
    /// Fraction of shaded fragments inside the target, in [0, 1]; the others complete quads of 2 x 2.
    pub filled: f64,
    /// Iterations per second.
    pub per_s: f64,
    /// Millions of floating-point operations per second, at 2 N^2 per iteration and system.
    pub mflops: f64,
}

/// Times an iteration of a system of `timing.patches` patches.
pub fn timed_iteration(profile: &Profile, timing: &Timing) -> Result<TimedIteration, RateError> {
    let model = Model::new(Level::Pipeline, profile)?;
    let log = iteration_log(profile, timing)?;
    let state = log.iter().fold(Picoseconds::ZERO, |sum, event| match event {
        Event::StateChange { changes, constants } => sum + model.state_change(*changes, *constants),
        _ => sum,
    });
    let draws: Vec<&DrawRecord> =
        log.iter().filter_map(|event| if let Event::Draw(d) = event { Some(&**d) } else { None }).collect();
    let costs: Vec<_> = draws.iter().map(|draw| model.draw(draw)).collect();
    let clocks: Vec<_> = draws.iter().map(|draw| model.clocks(draw)).collect();
    let time = costs.iter().fold(state, |sum, cost| sum + cost.total);
    let bytes = clocks.iter().map(|c| c.traffic.total()).sum();
    let (drawn, shaded) =
        draws.iter().fold((0, 0), |(drawn, shaded), d| (drawn + d.counts.fragments.generated, shaded + 4 * d.quads));
    let moved = profile.rates.memory_bytes_per_s.unwrap_or(1) as f64 * time.seconds();
    let per_s = 1.0 / time.seconds();
    let longest = costs.iter().max_by_key(|cost| cost.total);
    Ok(TimedIteration {
        passes: model::passes(
            timing.patches as u32,
            timing.packing.elements(),
            Fit::of(profile, timing.packing)?.block as u32,
        ) as usize,
        draws: draws.len(),
        time,
        textures: clocks.iter().map(|c| c.textures.0).sum(),
        arithmetic: clocks.iter().map(|c| c.arithmetic.0).sum(),
        memory: clocks.iter().map(|c| c.memory.0).sum(),
        bottleneck: longest.map_or(Bottleneck::Overhead, |cost| cost.bottleneck),
        bytes,
        bandwidth: bytes as f64 / moved,
        filled: drawn as f64 / (shaded.max(1)) as f64,
        per_s,
        mflops: model::mflops(timing.patches as u32, per_s),
    })
}

fn iteration_log(profile: &Profile, timing: &Timing) -> Result<Vec<Event>, RateError> {
    let fit = Fit::of(profile, timing.packing)?;
    let zeros = CardSystem::zeros(timing.packing, timing.patches, fit.block, fit.limit)
        .map_err(|problem| CardError::input(format!("device `{}`: {problem}", profile.name)))?;
    let mut card = CardSolver::of(profile.clone(), ExecutorKind::Batch, &[zeros], timing.storage)?;
    card.bind_as_after_iteration()?;
    if timing.cache {
        card.machine_mut().observe_textures(Some(Box::new(TextureCaches::new(profile)?)));
    }
    card.record(true);
    card.iterate()?;
    Ok(card.take_log())
}
