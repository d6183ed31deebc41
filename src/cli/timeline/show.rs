//! The tables of a timeline, and its JSON document.

use std::collections::BTreeMap;

use refsim::event::ReadBackMode;
use refsim::event::{DrawRecord, Event, MipmapRecord, SamplerTraffic};
use refsim::timing::timeline::Usage;
use refsim::timing::{DrawCost, Picoseconds};
use serde_json::{Value, json};

use super::args::Args;
use super::run::{Input, TimedLog};
use crate::cli::Out;
use crate::report::visible::visible_line;
use crate::report::{Cell, Table};

/// Maximum number of draws in the table; the document has all draws.
const MAX_DRAWS: usize = 16;

pub(super) fn print(
    args: &Args,
    input: &Input,
    log: &[Event],
    timed: &[TimedLog],
    out: &mut Out,
) -> miette::Result<()> {
    let profile = input.profile();
    out.line(visible_line(&input.title()))?;
    out.line(format_args!("{} ({}), times in microseconds", profile.title, profile.name))?;
    if args.cache {
        out.line("")?;
        out.titled_table(&cache(log))?;
    }
    for one in timed {
        out.line("")?;
        out.line(format_args!("Model: {}", one.name()))?;
        let tables = [Some(draws(log, one)), mipmaps(log, one), Some(units(one)), Some(shares(one))];
        for table in tables.into_iter().flatten() {
            out.line("")?;
            out.titled_table(&table)?;
        }
        if args.sensitivity {
            out.line("")?;
            let table = guesses(one);
            if table.rows().is_empty() {
                out.line(format_args!("{}: none", table.title()))?;
            } else {
                out.titled_table(&table)?;
            }
        }
        if one.replay.uncosted > 0 {
            let operations = one.replay.uncosted;
            out.line(format_args!(
                "{operations} operations of the host cost nothing here: no run has calibrated them"
            ))?;
        }
    }
    out.line("")?;
    out.titled_table(&totals(input, log, timed))?;
    if let Some(path) = &args.perfetto {
        out.line(format_args!("wrote {}", path.display()))?;
    }
    Ok(())
}

/// Microseconds.
fn us(time: Picoseconds) -> Cell {
    Cell::measured(time.0 as f64 / 1e6)
}

/// Cell with a part in percent.
fn percent(part: i128, whole: Picoseconds) -> Cell {
    Cell::percent(100.0 * part as f64 / whole.0.max(1) as f64)
}

/// Cell with a part's share of a total, in percent.
fn share(part: Picoseconds, whole: Picoseconds) -> Cell {
    percent(part.0.into(), whole)
}

/// Cell with the change of a total, in percent.
fn change(from: Picoseconds, to: Picoseconds) -> Cell {
    percent(i128::from(to.0) - i128::from(from.0), from)
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

fn draws(log: &[Event], timed: &TimedLog) -> Table {
    let headings = ["draw", "triangles", "fragments", "front end", "shader", "memory", "total", "clocks", "bound by"];
    let count = timed.replay.draws.len();
    let title = if count > MAX_DRAWS { format!("Draws, {MAX_DRAWS} of {count}") } else { "Draws".to_owned() };
    let mut table = Table::new(title, &headings);
    for (number, (record, cost)) in costs(log, timed).take(MAX_DRAWS).enumerate() {
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

/// Generations of mip levels in a log, each with its cost.
fn generations<'a>(log: &'a [Event], timed: &'a TimedLog) -> impl Iterator<Item = (&'a MipmapRecord, &'a DrawCost)> {
    let records = log.iter().filter_map(|event| match event {
        Event::GenerateMipmaps(record) => Some(record),
        _ => None,
    });
    records.zip(&timed.replay.mipmaps)
}

/// Table of the mip levels that the card generated; `None` if there are none.
fn mipmaps(log: &[Event], timed: &TimedLog) -> Option<Table> {
    let headings = ["levels", "texels read", "texels written", "total", "clocks", "bound by"];
    let mut table = Table::new("Generated mip levels", &headings);
    for (record, cost) in generations(log, timed).take(MAX_DRAWS) {
        table.push([
            record.levels.len().into(),
            record.texels_read().into(),
            record.texels_written().into(),
            us(cost.total),
            cost.core_clocks.0.into(),
            cost.bottleneck.to_string().into(),
        ]);
    }
    (!table.rows().is_empty()).then_some(table)
}

/// Texture cache hits and misses per sampler, over all draws.
fn cache(log: &[Event]) -> Table {
    let headings = ["sampler", "texels", "misses, half", "misses", "misses, double", "distinct lines"];
    let mut table = Table::new("Texture cache, also of half and of double the size", &headings);
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

fn units(timed: &TimedLog) -> Table {
    let whole = timed.replay.timeline.makespan();
    let mut table = Table::new("Units", &["unit", "busy", "waiting", "idle", "busy %", "waits for"]);
    for Usage { unit, busy, waiting, idle, reasons } in timed.replay.timeline.usage() {
        let reasons: Vec<String> =
            reasons.iter().map(|(reason, time)| format!("{reason} {}", us(*time).text())).collect();
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
    let mut table = Table::new("Critical path: where the time went", &["unit", "with", "pieces", "time", "%"]);
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
    let headings = ["guess", "value", "halved", "change %", "doubled", "change %"];
    let mut table = Table::new("Guesses: the total with half and with twice the figure", &headings);
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

/// Rate per second, rounded down.
fn a_second(count: u64, time: Picoseconds) -> u64 {
    let rate = u128::from(count) * 1_000_000_000_000 / u128::from(time.0.max(1));
    u64::try_from(rate).unwrap_or(u64::MAX)
}

fn fragments(log: &[Event], timed: &TimedLog) -> u64 {
    costs(log, timed).map(|(record, _)| record.counts.fragments.generated).sum()
}

fn totals(input: &Input, log: &[Event], timed: &[TimedLog]) -> Table {
    let mut table = Table::new("Totals", &["model", "total", "fragments/s", "rays/s"]);
    for one in timed {
        let whole = one.replay.timeline.makespan();
        let rays = input.rays().map(|rays| a_second(rays, whole));
        table.push([one.name().into(), us(whole), a_second(fragments(log, one), whole).into(), rays.into()]);
    }
    table
}

pub(super) fn document(args: &Args, input: &Input, log: &[Event], timed: &[TimedLog]) -> Value {
    json!({
        "case": args.case.as_ref().map(|path| path.display().to_string()),
        "title": input.title(),
        "rays": input.rays(),
        "version": env!("CARGO_PKG_VERSION"),
        "device": input.profile().name,
        "readback": args.readback.map(|mode| if mode == ReadBackMode::Synchronous { "sync" } else { "async" }),
        "double_buffered": args.double_buffer,
        "texture_cache": args.cache.then(|| cache(log).json()),
        "events": log.len(),
        "models": timed.iter().map(|one| model(input, log, one)).collect::<Vec<_>>(),
        "trace": args.perfetto.as_ref().map(|path| path.display().to_string()),
    })
}

fn model(input: &Input, log: &[Event], timed: &TimedLog) -> Value {
    let timeline = &timed.replay.timeline;
    let whole = timeline.makespan();
    let draws = costs(log, timed).map(|(record, cost)| {
        json!({
            "triangles": record.counts.primitives.rasterised,
            "fragments": record.counts.fragments.generated,
            "front_end_ps": cost.front_end.0,
            "shader_ps": cost.shader.0,
            "memory_ps": cost.memory.0,
            "total_ps": cost.total.0,
            "core_clocks": cost.core_clocks.0,
            "bound_by": cost.bottleneck.to_string(),
        })
    });
    let mipmaps = generations(log, timed).map(|(record, cost)| {
        json!({
            "levels": record.levels.len(),
            "texels_read": record.texels_read(),
            "texels_written": record.texels_written(),
            "total_ps": cost.total.0,
            "core_clocks": cost.core_clocks.0,
            "bound_by": cost.bottleneck.to_string(),
        })
    });
    let units = timeline.usage().into_iter().map(|usage| {
        let reasons: serde_json::Map<String, Value> =
            usage.reasons.iter().map(|(reason, time)| (reason.to_string(), time.0.into())).collect();
        json!({
            "unit": usage.unit.to_string(),
            "busy_ps": usage.busy.0,
            "waiting_ps": usage.waiting.0,
            "idle_ps": usage.idle.0,
            "waits_for_ps": reasons,
        })
    });
    let path = timeline.where_the_time_went().into_iter().map(|share| {
        json!({
            "unit": share.unit.to_string(),
            "kind": share.kind.to_string(),
            "pieces": share.segments,
            "time_ps": share.time.0,
        })
    });
    let sensitivity = timed.sensitivity.iter().map(
        |row| json!({ "guess": row.key, "value": row.value, "halved_ps": row.halved.0, "doubled_ps": row.doubled.0 }),
    );
    json!({
        "model": timed.name(),
        "total_ps": whole.0,
        "fragments_per_s": a_second(fragments(log, timed), whole),
        "rays_per_s": input.rays().map(|rays| a_second(rays, whole)),
        "draws": draws.collect::<Vec<_>>(),
        "mipmaps": mipmaps.collect::<Vec<_>>(),
        "units": units.collect::<Vec<_>>(),
        "critical_path": path.collect::<Vec<_>>(),
        "sensitivity": sensitivity.collect::<Vec<_>>(),
        "uncosted_host_operations": timed.replay.uncosted,
    })
}
