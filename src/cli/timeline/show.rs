//! The findings of a timeline.

use std::collections::BTreeMap;

use refsim::event::{DrawRecord, Event, ReadBackMode, SamplerTraffic};
use refsim::timing::timeline::Usage;
use refsim::timing::{DrawCost, Picoseconds};
use serde_json::{Value, json};

use super::run::{Args, CardRun, TimedLog};
use crate::report::{Cell, Findings, FoundTable, Table};

/// Maximum number of draws in the table; the document has all draws.
const MAX_DRAWS: usize = 16;

/// The tables of both models, as text and as a document.
pub(super) fn findings(args: &Args, run: &CardRun, timed: &[TimedLog]) -> Findings {
    let CardRun { profile, title, rays, log } = run;
    let mut found = Findings::new(title);
    found.fields(json!({
        "case": args.case.as_ref().map(|path| path.display().to_string()),
        "title": title,
        "rays": rays,
        "version": env!("CARGO_PKG_VERSION"),
        "device": profile.name,
        "readback": args.readback.map(|mode| if mode == ReadBackMode::Synchronous { "sync" } else { "async" }),
        "double_buffered": args.double_buffer,
        "events": log.len(),
        "time_unit": "us",
        "models": timed.iter().map(|one| model(log, one)).collect::<Vec<_>>(),
        "trace": args.perfetto.as_ref().map(|path| path.display().to_string()),
    }));
    found.introduce(title.clone());
    found.introduce(format!("{} ({}), times in microseconds", profile.title, profile.name));
    if args.cache {
        found.table(FoundTable::from(cache(log)).field("texture_cache"));
    }
    for one in timed {
        for (field, table) in tables(log, one, false) {
            if field != "sensitivity" || args.sensitivity {
                found.table(table);
            }
        }
        if one.replay.uncosted > 0 {
            let (name, operations) = (one.name(), one.replay.uncosted);
            found.print(format!(
                "{name}: {operations} operations of the host take no time, because they are not calibrated"
            ));
        }
    }
    found.table(FoundTable::from(totals(run, timed)).field("totals"));
    if let Some(path) = &args.perfetto {
        found.print(format!("wrote {}", path.display()));
    }
    found
}

fn us(time: Picoseconds) -> Cell {
    Cell::measured(time.0 as f64 / 1e6)
}

fn percent(part: i128, whole: Picoseconds) -> Cell {
    Cell::percent(100.0 * part as f64 / whole.0.max(1) as f64)
}

fn share(part: Picoseconds, whole: Picoseconds) -> Cell {
    percent(part.0.into(), whole)
}

fn change(from: Picoseconds, to: Picoseconds) -> Cell {
    percent(i128::from(to.0) - i128::from(from.0), from)
}

impl TimedLog {
    fn table(&self, title: &str, headings: &[&str]) -> Table {
        Table::new(format!("Model {}: {title}", self.name()), headings)
    }
}

fn costs<'a>(log: &'a [Event], timed: &'a TimedLog) -> impl Iterator<Item = (&'a DrawRecord, &'a DrawCost)> {
    log.iter().filter_map(record).zip(&timed.replay.draws)
}

fn record(event: &Event) -> Option<&DrawRecord> {
    match event {
        Event::Draw(record) => Some(record),
        _ => None,
    }
}

/// The tables about one model, each with its field in the document; `json` selects all draws and all digits.
fn tables(log: &[Event], timed: &TimedLog, json: bool) -> [(&'static str, Table); 5] {
    [
        ("draws", draws(log, timed, if json { usize::MAX } else { MAX_DRAWS })),
        ("mipmaps", mipmaps(log, timed, if json { usize::MAX } else { MAX_DRAWS })),
        ("units", units(timed, if json { Cell::machine_text } else { Cell::text })),
        ("critical_path", shares(timed)),
        ("sensitivity", guesses(timed)),
    ]
}

fn draws(log: &[Event], timed: &TimedLog, most: usize) -> Table {
    let headings = ["draw", "triangles", "fragments", "front end", "shader", "memory", "total", "clocks", "bound by"];
    let count = timed.replay.draws.len();
    let title = if count > most { format!("draws, {most} of {count}") } else { "draws".to_owned() };
    let mut table = timed.table(&title, &headings);
    for (number, (record, cost)) in costs(log, timed).take(most).enumerate() {
        table.push([
            number.into(),
            record.counts.primitives.rasterised.into(),
            record.counts.fragments.generated.into(),
            us(cost.front_end),
            us(cost.shader),
            us(cost.memory),
            us(cost.total),
            cost.core_clocks.0.into(),
            cost.bottleneck.to_string().into(),
        ]);
    }
    table
}

fn mipmaps(log: &[Event], timed: &TimedLog, most: usize) -> Table {
    let headings = ["levels", "texels read", "texels written", "total", "clocks", "bound by"];
    let mut table = timed.table("generated mip levels", &headings);
    let records = log.iter().filter_map(|event| match event {
        Event::GenerateMipmaps(record) => Some(record),
        _ => None,
    });
    for (record, cost) in records.zip(&timed.replay.mipmaps).take(most) {
        table.push([
            record.levels.len().into(),
            record.texels_read().into(),
            record.texels_written().into(),
            us(cost.total),
            cost.core_clocks.0.into(),
            cost.bottleneck.to_string().into(),
        ]);
    }
    table
}

fn cache(log: &[Event]) -> Table {
    let headings = ["sampler", "texels", "misses, half", "misses", "misses, double", "distinct lines"];
    let mut table =
        Table::new("Texture cache: misses at half the size, at the given size, and at double the size", &headings);
    let mut samplers = BTreeMap::<u8, SamplerTraffic>::new();
    let records = log.iter().filter_map(record).flat_map(|record| &record.samplers);
    for (sampler, traffic) in records.filter_map(|sampler| Some((sampler.sampler, sampler.traffic?))) {
        let sum = samplers.entry(sampler).or_default();
        sum.accesses += traffic.accesses;
        sum.distinct += traffic.distinct;
        for (sum, misses) in sum.misses.iter_mut().zip(traffic.misses) {
            *sum += misses;
        }
    }
    for (sampler, SamplerTraffic { accesses, misses: [half, same, double], distinct }) in samplers {
        let numbers = [sampler.into(), accesses, half, same, double, distinct];
        table.push(numbers.map(Cell::Count));
    }
    table
}

/// Times of the units. `written` formats the waiting times, listed by their reasons.
fn units(timed: &TimedLog, written: fn(&Cell) -> String) -> Table {
    let whole = timed.replay.timeline.makespan();
    let mut table = timed.table("units", &["unit", "busy", "waiting", "idle", "busy %", "waits for"]);
    for Usage { unit, busy, waiting, idle, reasons } in timed.replay.timeline.usage() {
        let reasons: Vec<String> =
            reasons.iter().map(|(reason, time)| format!("{reason} {}", written(&us(*time)))).collect();
        table.push([
            unit.to_string().into(),
            us(busy),
            us(waiting),
            us(idle),
            share(busy, whole),
            reasons.join(", ").into(),
        ]);
    }
    table
}

fn shares(timed: &TimedLog) -> Table {
    let whole = timed.replay.timeline.makespan();
    let mut table = timed.table("critical path: where the time went", &["unit", "with", "pieces", "time", "%"]);
    for part in timed.replay.timeline.where_the_time_went() {
        table.push([
            part.unit.to_string().into(),
            part.kind.to_string().into(),
            part.segments.into(),
            us(part.time),
            share(part.time, whole),
        ]);
    }
    table
}

fn guesses(timed: &TimedLog) -> Table {
    let whole = timed.replay.timeline.makespan();
    let headings = ["guess", "value", "halved", "halved %", "doubled", "doubled %"];
    let mut table = timed.table("guessed figures: the total time with half and with twice the value", &headings);
    for row in &timed.sensitivity {
        let (halved, doubled) = (row.halved, row.doubled);
        table.push([
            row.key.as_str().into(),
            row.value.as_str().into(),
            us(halved),
            change(whole, halved),
            us(doubled),
            change(whole, doubled),
        ]);
    }
    table
}

fn a_second(count: u64, time: Picoseconds) -> u64 {
    let rate = u128::from(count) * 1_000_000_000_000 / u128::from(time.0.max(1));
    u64::try_from(rate).unwrap_or(u64::MAX)
}

fn fragments(log: &[Event], timed: &TimedLog) -> u64 {
    costs(log, timed).map(|(record, _)| record.counts.fragments.generated).sum()
}

fn totals(run: &CardRun, timed: &[TimedLog]) -> Table {
    let mut table = Table::new("Totals", &["model", "total", "fragments/s", "rays/s"]);
    for one in timed {
        let whole = one.replay.timeline.makespan();
        let rays = run.rays.map(|rays| a_second(rays, whole));
        table.push([one.name().into(), us(whole), a_second(fragments(&run.log, one), whole).into(), rays.into()]);
    }
    table
}

fn model(log: &[Event], timed: &TimedLog) -> Value {
    let mut document = json!({ "model": timed.name(), "uncosted_host_operations": timed.replay.uncosted });
    for (field, table) in tables(log, timed, true) {
        document[field] = table.json();
    }
    document
}
