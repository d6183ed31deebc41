//! How fast a card would iterate: an iteration is drawn, and its log timed by the pipeline model. Figures of section 3.1.
//!
//! Time depends on sizes and programs alone, so the system that is drawn is black.

use refsim::device::Profile;
use refsim::event::{DrawRecord, Event};
use refsim::machine::ExecutorKind;
use refsim::timing::cache::TextureCaches;
use refsim::timing::{Bottleneck, Level, Model, Picoseconds, TimingError};
use thiserror::Error;

use super::card_order::CardSystem;
use super::model;
use super::on_card::{CardError, CardSolver, Fit, Storage};
use super::packing::Packing;

/// Why an iteration could not be timed.
#[derive(Debug, Error)]
pub enum RateError {
    /// The card does not make it.
    #[error(transparent)]
    Card(#[from] CardError),
    /// The card's rates are not known.
    #[error(transparent)]
    Timing(#[from] TimingError),
}

/// What is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Patches.
    pub patches: usize,
    /// Four elements a texel is one channel only, as in the paper.
    pub packing: Packing,
    /// Single or half floats.
    pub storage: Storage,
    /// Whether the texture cache is simulated texel by texel, which takes some thousand times as long; else the least traffic is taken.
    pub cache: bool,
}

/// An iteration, timed.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// Passes.
    pub passes: usize,
    /// Draws: a pass with four elements a texel takes four, one a channel of its target.
    pub draws: usize,
    /// The whole iteration: draws and changes of state, one after the other, since each reads what the last wrote.
    pub time: Picoseconds,
    /// Clocks of the texture units, of arithmetic, and of memory, all of which work at once.
    pub textures: u64,
    /// Arithmetic.
    pub arithmetic: u64,
    /// Memory.
    pub memory: u64,
    /// What most of the time waits for.
    pub bottleneck: Bottleneck,
    /// Bytes between the card and its memory.
    pub bytes: u64,
    /// Their share of what memory could move in the time.
    pub bandwidth: f64,
    /// The share of shaded fragments that are in the target: others fill up quads of 2 x 2.
    pub filled: f64,
    /// Iterations a second.
    pub per_s: f64,
    /// Million operations a second, 2 N^2 an iteration and system.
    pub mflops: f64,
}

/// Times an iteration of a system of so many patches.
///
/// # Errors
/// [`RateError`]: the card has no such programs or textures, or its rates are not known.
pub fn timed_iteration(profile: &Profile, timing: &Timing) -> Result<Timed, RateError> {
    let model = Model::new(Level::Pipeline, profile)?;
    let log = iteration_log(profile, timing)?;
    let state = log.iter().fold(Picoseconds::ZERO, |sum, event| match event {
        Event::StateChange { changes } => sum + model.state_change(*changes),
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
    Ok(Timed {
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

/// What is asked of the card in the second of two iterations, as in any but the first.
fn iteration_log(profile: &Profile, timing: &Timing) -> Result<Vec<Event>, RateError> {
    let fit = Fit::of(profile, timing.packing)?;
    let black = CardSystem::zeros(timing.packing, timing.patches, fit.block, fit.limit)
        .map_err(|problem| CardError::TooLarge { device: profile.name.clone(), problem })?;
    let mut card = CardSolver::of(profile.clone(), ExecutorKind::Batch, &[black], timing.storage)?;
    card.iterate()?;
    if timing.cache {
        card.machine_mut().observe_textures(Some(Box::new(TextureCaches::new(profile)?)));
    }
    card.record(true);
    card.iterate()?;
    Ok(card.take_log())
}
