//! `crossbar devices`: the profiles, and the source of every figure.

use refsim::device::{FigureRow, MeasuredCounts, Profile, Switch};
use serde_json::{Value, json};

#[cfg(feature = "wgpu")]
mod adapters;
#[cfg(not(feature = "wgpu"))]
#[path = "no_adapters.rs"]
mod adapters;

#[cfg(not(feature = "wgpu"))]
pub(super) use adapters::missing as no_adapters;

use super::{Out, Verdict, study};
use crate::case::device_named;
use crate::report::{Cell, Findings, FoundTable, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar devices
      every card with what its pixel programs can do
  crossbar devices r200
      all figures of the Radeon 8500 with sources, and the open questions as switches
  crossbar devices ideal-fp24 --json
      an unlimited card with 24-bit floats, as JSON
  crossbar devices --adapters
      the GPUs of this computer that the wgpu executor can use";

/// Show the device profiles: limits, and every figure with its source and confidence
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// A device, or ideal-FORMAT; all devices if left out
    name: Option<String>,
    /// List the GPU adapters of this computer instead
    #[arg(long, conflicts_with = "name")]
    adapters: bool,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    if args.adapters {
        adapters::list(out)?;
        return Ok(Verdict::Done);
    }
    match &args.name {
        Some(name) => study::show(&one(&device_named(name)?), out),
        None => all(out).map(|()| Verdict::Done),
    }
}

/// The cards and their variants side by side.
fn all(out: &mut Out) -> miette::Result<()> {
    let names = Profile::card_names().into_iter().chain(Profile::variant_names());
    let profiles = names.map(Profile::named).collect::<Result<Vec<_>, _>>()?;
    if out.json() {
        let rows: Vec<Value> = profiles.iter().map(summary).collect();
        return Ok(out.document(&rows)?);
    }
    let mut table = Table::new(
        "Devices",
        &["device", "card", "programs", "pixel format", "temporaries", "constants", "samplers", "targets", "switches"],
    );
    for profile in &profiles {
        let limits = &profile.limits;
        table.push([
            profile.name.as_str().into(),
            profile.title.as_str().into(),
            versions(profile).into(),
            profile.rules.format.to_string().into(),
            limits.temporaries.into(),
            limits.constants.into(),
            limits.samplers.into(),
            limits.render_targets.into(),
            profile.switches().len().into(),
        ]);
    }
    out.table(&table)?;
    out.line("")?;
    out.line("There is also ideal-FORMAT for any number format, for example ideal-fp32 or ideal-s3.12:rtz:")?;
    out.line("no limits and no timing. `crossbar devices NAME` shows every figure of a device with its source.")?;
    Ok(())
}

fn versions(profile: &Profile) -> String {
    let tokens: Vec<&str> = profile.limits.versions.iter().map(|version| version.token()).collect();
    tokens.join(" ")
}

fn summary(profile: &Profile) -> Value {
    let limits = &profile.limits;
    json!({
        "name": profile.name,
        "title": profile.title,
        "versions": limits.versions.iter().map(|version| version.token()).collect::<Vec<_>>(),
        "format": profile.rules.format.to_string(),
        "temporaries": limits.temporaries,
        "constants": limits.constants,
        "samplers": limits.samplers,
        "render_targets": limits.render_targets,
        "switches": profile.switches().len(),
    })
}

/// Table of the formats of single instructions in a device file.
fn instructions(profile: &Profile) -> FoundTable {
    let mut table = Table::new("Formats of single instructions", &["program", "instruction", "format"]);
    for (digest, formats) in profile.instruction_formats().iter() {
        for (index, format) in formats {
            table.push([format!("{digest:016x}").into(), (*index).into(), format.to_string().into()]);
        }
    }
    table.into()
}

/// Table of the formats of storages and sums in a device file.
fn storages(profile: &Profile) -> FoundTable {
    let mut table = Table::new("Formats of storages and sums", &["storage", "format"]);
    let storages = profile.rules.storage.iter().map(|(storage, format)| (storage.name(), format));
    for (name, format) in storages.chain(profile.rules.accumulator.map(|format| ("accumulator", format))) {
        table.push([name.into(), format.to_string().into()]);
    }
    table.into()
}

/// All findings about one device.
fn one(profile: &Profile) -> Findings {
    let mut found = Findings::new(profile.title.as_str());
    found.fields(json!({
        "name": profile.name,
        "title": profile.title,
        "figures": profile.figures().iter().map(figure_json).collect::<Vec<_>>(),
        "switches": profile.switches().iter().map(switch_json).collect::<Vec<_>>(),
    }));
    found.introduce(format!("{}: {}", profile.name, profile.title));
    let mut figures = Table::new("Figures", &["figure", "value", "unit", "confidence", "source"]);
    for row in profile.figures() {
        let confidence = confidence(&row);
        let value = row.value.parse::<u64>().map_or_else(|_| row.value.into(), Cell::Count);
        figures.push([row.key.into(), value, row.unit.into(), confidence.into(), row.source.into()]);
    }
    found.table(figures);
    found.table(storages(profile).field("storages"));
    found.table(instructions(profile).field("instructions"));
    let title = "Switches: open questions of the hardware. Set one in a case file under [switches].";
    let mut switches = Table::new(title, &["switch", "now", "values", "confidence", "decides", "source"]);
    for switch in profile.switches() {
        let figure = profile.figures().into_iter().find(|row| row.key == format!("rules.{}", switch.name));
        switches.push([
            switch.name.as_str().into(),
            switch.current.as_str().into(),
            switch.values.join(" ").into(),
            figure.as_ref().map_or_else(|| switch.confidence.to_string(), confidence).into(),
            switch.meaning.as_str().into(),
            switch.source.as_str().into(),
        ]);
    }
    found.table(switches);
    found
}

/// Confidence in a figure, with the counts of its measurement.
fn confidence(row: &FigureRow) -> String {
    let counts = row.counts.as_ref().map(|counts| format!(" ({counts})")).unwrap_or_default();
    format!("{}{counts}", row.confidence)
}

fn figure_json(row: &FigureRow) -> Value {
    json!({
        "key": row.key,
        "value": row.value,
        "unit": row.unit,
        "source": row.source,
        "confidence": row.confidence.to_string(),
        "counts": row.counts.as_ref().map(counts_json),
    })
}

fn counts_json(counts: &MeasuredCounts) -> Value {
    let right: serde_json::Map<String, Value> =
        counts.right.iter().map(|(name, right)| (name.clone(), json!(right))).collect();
    json!({ "of": counts.of, "all": counts.all, "right": right })
}

fn switch_json(switch: &Switch) -> Value {
    json!({
        "name": switch.name,
        "values": switch.values,
        "current": switch.current,
        "default": switch.default,
        "meaning": switch.meaning,
        "source": switch.source,
        "confidence": switch.confidence.to_string(),
    })
}
