//! The time of a frame as a table and as a sentence.

use refsim::device::Profile;
use refsim::event::Event;
use refsim::timing::host::{HostError, HostModel};

use crate::card::frame_time::{FrameTime, FrameTimeError, frame_time};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Table};

/// The time of a frame; `None` on a device with unknown rates.
pub(super) fn modelled(
    profile: &Profile,
    log: &[Event],
    host: Result<HostModel, HostError>,
) -> Result<Option<FrameTime>, FrameTimeError> {
    match frame_time(profile, log, &host?) {
        Ok(time) => Ok(Some(time)),
        Err(FrameTimeError::Timing(_)) => Ok(None),
        Err(error) => Err(error),
    }
}

/// Table of the parts of a frame.
pub(super) fn times(time: &FrameTime) -> Table {
    let mut table = Table::new("A frame", &["part", "ms"]);
    let parts = [
        ("frame to frame", time.frame),
        ("host at work", time.host),
        ("products on the host", time.products),
        ("upload of vertices", time.uploads),
        ("state and constants", time.state),
        ("draws", time.draws),
    ];
    parts.into_iter().for_each(|(part, time)| table.push([part.into(), Cell::measured(1e3 * time.seconds())]));
    table
}

/// Frame rate and its bottleneck, without a full stop.
pub(super) fn rate(time: &FrameTime, card: &str) -> String {
    let rate = shown(time.per_second(), Quantity::Measured);
    let waits = time.bottleneck.map_or_else(String::new, |bottleneck| format!(", whose draws wait for {bottleneck}"));
    format!("{card}: modelled {rate} frames per second{waits}")
}
