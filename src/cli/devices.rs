//! `crossbar devices`: the profiles, and the source of every figure.

use refsim::device::{FigureRow, Profile};
use serde_json::json;

use super::{Out, Verdict, study};
use crate::case::device_named;
use crate::report::{Cell, Findings, FoundTable, Table};

const EXAMPLES: &str = "\
Examples:
  crossbar devices
      all cards, and what their pixel programs can do
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
    /// A device, or ideal-FORMAT [default: all devices]
    name: Option<String>,
    /// List the GPU adapters of this computer instead
    #[arg(long, conflicts_with = "name")]
    adapters: bool,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    if args.adapters {
        #[cfg(feature = "wgpu")]
        return list_adapters(out);
        #[cfg(not(feature = "wgpu"))]
        return Err(no_adapters().into());
    }
    match &args.name {
        Some(name) => study::show(&one(&device_named(name)?), out),
        None => all(out),
    }
}

/// The GPUs of this computer.
#[cfg(feature = "wgpu")]
fn list_adapters(out: &mut Out) -> miette::Result<Verdict> {
    let adapters = refsim::exec::gpu::adapters();
    if out.json() {
        out.document(&adapters)?;
        return Ok(Verdict::Done);
    }
    if adapters.is_empty() {
        out.line(refsim::exec::gpu::GpuError::NoAdapter)?;
        return Ok(Verdict::Done);
    }
    let mut table = Table::new("GPU adapters", &["adapter", "kind", "through", "driver", "largest buffer (bytes)"]);
    for adapter in adapters {
        table.push([
            adapter.name.into(),
            adapter.kind.to_string().into(),
            adapter.backend.into(),
            adapter.driver.into(),
            adapter.largest_buffer.into(),
        ]);
    }
    out.table(&table)?;
    Ok(Verdict::Done)
}

#[cfg(not(feature = "wgpu"))]
pub(super) fn no_adapters() -> super::Problem {
    super::Problem::usage(
        "this build has no GPU support: the feature `wgpu` is off",
        "build with `cargo build --release --features wgpu`",
    )
}

fn all(out: &mut Out) -> miette::Result<Verdict> {
    let names = Profile::card_names().into_iter().chain(Profile::variant_names());
    let mut table = Table::new(
        "Devices",
        &["device", "card", "programs", "pixel format", "temporaries", "constants", "samplers", "targets", "switches"],
    );
    for name in names {
        let profile = Profile::named(name)?;
        let limits = &profile.limits;
        let versions: Vec<&str> = limits.versions.iter().map(|version| version.token()).collect();
        table.push([
            profile.name.as_str().into(),
            profile.title.as_str().into(),
            versions.join(" ").into(),
            profile.rules.format.to_string().into(),
            limits.temporaries.into(),
            limits.constants.into(),
            limits.samplers.into(),
            limits.render_targets.into(),
            profile.switches().len().into(),
        ]);
    }
    let below = [
        "There is also ideal-FORMAT for any number format, such as ideal-fp32 or ideal-s3.12:rtz: a device",
        "without limits and timing. `crossbar devices NAME` shows every figure of a device with its source.",
    ];
    out.listing(&table, &below)?;
    Ok(Verdict::Done)
}

fn instructions(profile: &Profile) -> FoundTable {
    let mut table = Table::new("Formats of single instructions", &["program", "instruction", "format"]);
    for (digest, formats) in profile.instruction_formats().iter() {
        for (index, format) in formats {
            table.push([format!("{digest:016x}").into(), (*index).into(), format.to_string().into()]);
        }
    }
    table.into()
}

fn storages(profile: &Profile) -> FoundTable {
    let mut table = Table::new("Formats of stored values and of sums", &["storage", "format"]);
    let storages = profile.rules.storage.iter().map(|(storage, format)| (storage.name(), format));
    for (name, format) in storages.chain(profile.rules.accumulator.map(|format| ("accumulator", format))) {
        table.push([name.into(), format.to_string().into()]);
    }
    table.into()
}

fn one(profile: &Profile) -> Findings {
    let mut found = Findings::new(profile.title.as_str());
    found.fields(json!({ "name": profile.name, "title": profile.title }));
    found.introduce(format!("{}: {}", profile.name, profile.title));
    let mut figures = Table::new("Figures", &["figure", "value", "unit", "confidence", "source"]);
    for row in profile.figures() {
        let confidence = confidence(&row);
        let value = row.value.parse::<u64>().map_or_else(|_| row.value.into(), Cell::Count);
        figures.push([row.key.into(), value, row.unit.into(), confidence.into(), row.source.into()]);
    }
    found.table(FoundTable::from(figures).field("figures"));
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
    found.table(FoundTable::from(switches).field("switches"));
    found
}

/// Confidence in a figure, with the counts of its measurement.
fn confidence(row: &FigureRow) -> String {
    let counts = row.counts.as_ref().map(|counts| format!(" ({counts})")).unwrap_or_default();
    format!("{}{counts}", row.confidence)
}
