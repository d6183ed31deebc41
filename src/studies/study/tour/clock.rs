//! One clock for all cards: the modelled times of all steps, one after the other.

use refsim::device::Profile;
use refsim::timing::Picoseconds;
use serde_json::Map;

use crate::report::digits::{Quantity, count, shown};
use crate::report::trace::{Slice, Trace};
use crate::report::words::percent;
use crate::report::{Cell, Findings, FoundTable, Table, not_encoded};
use crate::study::StudyError;
use crate::study::caster::CastRecord;

/// A step of the clock.
struct Step {
    what: &'static str,
    card: String,
    work: String,
    time: Picoseconds,
    casts_rays: bool,
}

/// The steps so far.
#[derive(Default)]
pub(super) struct Clock(Vec<Step>);

impl Clock {
    /// Adds a step.
    pub(super) fn step(&mut self, what: &'static str, card: &Profile, work: String, time: Option<Picoseconds>) {
        let (card, time) = (card.title.to_string(), time.unwrap_or_default());
        self.0.push(Step { what, card, work, time, casts_rays: false });
    }

    /// Adds a step of the Ray Engine.
    pub(super) fn rays(&mut self, what: &'static str, card: &Profile, cast: Option<CastRecord>) {
        let Some(CastRecord { counts, card: time, .. }) = cast else { return };
        self.step(what, card, format!("{} rays, {} passes", count(counts.rays), count(counts.passes)), time);
        self.0.iter_mut().next_back().into_iter().for_each(|step| step.casts_rays = true);
    }

    fn total(&self) -> f64 {
        self.0.iter().map(|step| step.time).sum::<Picoseconds>().seconds()
    }

    pub(super) fn conclude(&self, found: &mut Findings) {
        let rays: Picoseconds = self.0.iter().filter(|step| step.casts_rays).map(|step| step.time).sum();
        found.conclusion(format!(
            "The cards take {} s (modelled) for the room and everything in it; {} of this time is for the Ray Engine's \
             passes.",
            shown(self.total(), Quantity::Measured),
            percent(rays.seconds() / self.total()),
        ));
    }

    /// Adds the table and the trace.
    pub(super) fn report(&self, found: &mut Findings) -> Result<(), StudyError> {
        let mut table = Table::of("Steps", "step card work starts_ms takes_ms");
        let (mut start, mut slices) = (Picoseconds::ZERO, Vec::new());
        for Step { what, card, work, time, .. } in &self.0 {
            let [starts, takes] = [start, *time].map(|time| Cell::measured(1e3 * time.seconds()));
            table.push([(*what).into(), card.as_str().into(), work.as_str().into(), starts, takes]);
            slices.push(Slice {
                lane: 0,
                name: (*what).to_owned(),
                category: card.clone(),
                start: start.0,
                duration: time.0,
                details: Map::new(),
            });
            start += *time;
        }
        found.heading("One clock");
        found.explained_table(FoundTable::from(table).csv("clock").field("clock"), EXPLAINED);
        let (title, lanes) = ("One room through four systems".to_owned(), vec!["cards".to_owned()]);
        let mut bytes = Vec::new();
        let trace = Trace { title, lanes, slices, ..Trace::default() };
        trace.write(&mut bytes).map_err(|error| not_encoded("JSON", error))?;
        found.keep_file("timeline.json", bytes);
        Ok(())
    }
}

const EXPLAINED: &str = "The times come from the pipeline model of each card; the steps run one after the other. Host \
    work is counted only for the bunny's frames: tests of rays on the host, clusters and links take no time here. \
    timeline.json is the same for https://ui.perfetto.dev or chrome://tracing.";
