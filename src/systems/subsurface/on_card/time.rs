//! The log of a frame by pass, and its time by the pipeline model.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::timing::{Bottleneck, Level, Model, Picoseconds, TimingError};
use strum::Display;

/// A pass of the paper, or the levels between the first two passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Display)]
#[strum(serialize_all = "lowercase")]
pub enum PassKind {
    /// Pass 1.
    #[strum(to_string = "radiosity map")]
    RadiosityMap,
    /// The mip levels of the radiosity map.
    Levels,
    /// Pass 2.
    Gather,
    /// Pass 3.
    View,
}

impl PassKind {
    /// All passes, in the order of a frame.
    pub const ALL: [Self; 4] = [Self::RadiosityMap, Self::Levels, Self::Gather, Self::View];
}

/// An event of a pass.
#[derive(Clone, Debug)]
pub struct PassEvent {
    /// The pass.
    pub pass: PassKind,
    /// Counts of the pass.
    pub event: Event,
}

/// The modelled time of a pass, in sequence, without uploads and read-backs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTime {
    /// The pass's time.
    pub time: Picoseconds,
    /// The bottleneck of the longest draw; `None` if there are no draws.
    pub bottleneck: Option<Bottleneck>,
}

/// The times of a log's passes, in the order of [`PassKind::ALL`].
pub fn pass_times(profile: &Profile, log: &[PassEvent]) -> Result<[PassTime; 4], TimingError> {
    let model = Model::new(Level::Pipeline, profile)?;
    Ok(PassKind::ALL.map(|kind| {
        let mut time = PassTime::default();
        let mut longest = Picoseconds::ZERO;
        for PassEvent { event, .. } in log.iter().filter(|event| event.pass == kind) {
            match event {
                Event::Draw(draw) => {
                    let cost = model.draw(draw);
                    time.time += cost.total;
                    if cost.total >= longest {
                        (longest, time.bottleneck) = (cost.total, Some(cost.bottleneck));
                    }
                }
                Event::GenerateMipmaps(record) => time.time += model.mipmaps(record).total,
                Event::StateChange { changes, constants } => time.time += model.state_change(*changes, *constants),
                Event::Clear { bytes, .. } => time.time += model.clear(*bytes),
                _ => {}
            }
        }
        time
    }))
}
