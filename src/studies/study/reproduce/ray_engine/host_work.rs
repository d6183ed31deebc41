//! Breakdown of the host's time.

use refsim::event::Event;
use refsim::timing::host::{HostCounts, HostModel, HostOperation};

use super::speed_ups::SpeedUpRun;
use super::teapot::TeapotRoom;
use crate::report::{Cell, Table};

/// Table of the microseconds per ray that the host spends on each kind of operation: alone, and in the lines of a
/// table.
pub(super) fn table(room: &TeapotRoom, lines: &[&SpeedUpRun]) -> Table {
    let kinds = HostOperation::ALL.iter().map(|operation| format!("{operation}_us"));
    let headings: Vec<String> = std::iter::once("run".to_owned()).chain(kinds).chain(["sum_us".to_owned()]).collect();
    let mut table = Table::new("The host's time a ray", &headings);
    table.push(row("host alone", &room.host, &room.work.alone.counts, room.work.alone.rays));
    for line in lines {
        table.push(row(line.name, &room.host, &counted(line.run.log()), line.run.counts.rays));
    }
    table
}

fn row(what: &str, host: &HostModel, counts: &HostCounts, rays: u64) -> Vec<Cell> {
    let each = |seconds: f64| Cell::measured(1e6 * seconds / rays.max(1) as f64);
    let kinds = HostOperation::ALL.iter().map(|kind| each(host.time_of(*kind, counts.of(*kind)).seconds()));
    std::iter::once(what.into()).chain(kinds).chain([each(host.time_of_all(counts).seconds())]).collect()
}

/// Counts the host's operations in a log.
fn counted(log: &[Event]) -> HostCounts {
    let mut counts = HostCounts::default();
    for event in log {
        if let Event::Host(work) = event
            && let Ok(operation) = HostOperation::named(&work.kind)
        {
            counts.add(operation, work.operations);
        }
    }
    counts
}
