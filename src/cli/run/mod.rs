//! `crossbar run`: any shader on any textures, constants and geometry.

mod trace;

use std::path::{Path, PathBuf};

use refsim::machine::Executor;
use serde_json::json;

use super::executor::DeviceExecutor;
use super::uniform::{self, Uniform};
use super::{Out, Problem, error, pixel, study};
use crate::{
    case::{self, CaseOutcome, Overrides, PixelTrace, ProbeResult, Setup, Traced},
    io::{require_writable, write_files},
    report::{Cell, Findings, Table, Verdict},
};

const EXAMPLES: &str = "\
Examples:
  crossbar run fixtures/cases/modulate.toml --out out/modulate
      draws the case, writes its targets to out/modulate and checks its probes
  crossbar run fixtures/cases/transform.toml --trace 2,2
      also shows what every instruction wrote at column 2, row 2
  crossbar run docs/examples/wgsl/ggx.wgsl --uniform roughness=0.3
      a fragment shader in WGSL, on a single-precision device (needs the feature wgsl)

docs/cases.md describes the case format. Unsigned targets are written as PNG, all others and the depth buffer as EXR. \
The counts measure the work, in instruction slots and bytes; `crossbar timeline` models how long a card takes.

Exit codes: 0 done, 1 a probe did not find the expected value, 2 the case cannot be run.";

/// Draw a case: any shader on any textures, constants and geometry; pictures, probes, counts
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The case, a TOML file; or a WGSL shader, which is drawn over 64 x 64 pixels
    #[arg(value_name = "CASE.toml|SHADER.wgsl")]
    case: PathBuf,

    /// The value of a uniform of a WGSL shader: up to four numbers; may be given several times
    #[arg(long, value_name = "NAME=X,Y,..", value_parser = uniform::parse)]
    uniform: Vec<Uniform>,

    /// Folder for the pictures [default: out/ followed by the case's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Executor; all executors give the same bits
    #[arg(long, value_enum, default_value = "scalar")]
    executor: DeviceExecutor,

    /// Show what every instruction writes at the pixel in this column and row, counted from 0 at the top left
    #[arg(long, value_name = "X,Y", value_parser = pixel::parse, allow_hyphen_values = true)]
    trace: Option<[u32; 2]>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let executor = args.executor.open()?;
    let overrides = Overrides { uniforms: args.uniform.clone(), ..Overrides::default() };
    let setup = Setup::read_with(&args.case, &overrides)?;
    setup.warnings.iter().cloned().for_each(error::warn);
    let folder = args.out.clone().unwrap_or_else(|| default_folder(&args.case));
    let traced = args.trace.map(|place| follow(&setup, &executor, place)).transpose()?;
    let traced = traced.as_ref().map(|trace| Traced { setup: &setup, trace });
    // Checked before the work, so that an unwritable folder is found at once.
    require_writable(&folder).map_err(Problem::from)?;
    let outcome = case::run(&setup, &executor)?;
    let written = write_files(&folder, &outcome.pictures).map_err(Problem::from)?;
    let mut found = findings(&setup, args, &outcome, &written);
    if let Some(traced) = &traced {
        found.field("trace", traced.document());
    }
    let verdict = study::show(&found, out)?;
    if let (Some(traced), false) = (traced, out.json()) {
        out.line("")?;
        trace::ShownTrace(traced).print(out)?;
    }
    Ok(verdict)
}

fn follow(setup: &Setup, executor: &Executor, place: [u32; 2]) -> miette::Result<PixelTrace> {
    let place = pixel::within(place, setup.size)?;
    Ok(case::trace(setup, executor, place)?)
}

fn default_folder(case: &Path) -> PathBuf {
    Path::new("out").join(case.file_stem().unwrap_or_else(|| "case".as_ref()))
}

fn counts(outcome: &CaseOutcome) -> Table {
    let mut table = Table::new("Counts", &["count", "number"]);
    for &(name, number) in &outcome.counts {
        table.push([Cell::from(name), number.into()]);
    }
    table
}

fn probes(results: &[ProbeResult]) -> Table {
    let mut table = Table::new("Probes", &["probe", "pixel", "target", "expected", "found", "verdict"]);
    for (number, result) in (1_usize..).zip(results) {
        let probe = &result.probe;
        table.push([
            number.into(),
            format!("{}, {}", probe.pixel[0], probe.pixel[1]).into(),
            probe.target.into(),
            probe.expected.to_string().into(),
            result.found.to_string().into(),
            if result.passed { "passed" } else { "failed" }.into(),
        ]);
    }
    table
}

fn findings(setup: &Setup, args: &Args, outcome: &CaseOutcome, written: &[PathBuf]) -> Findings {
    let format = setup.profile.rules.format;
    let mut found = Findings::new(setup.title.clone().unwrap_or_default());
    found.fields(outcome.document(setup));
    found.field("case", json!(args.case.display().to_string()));
    found.field("files", json!(written.iter().map(|path| path.display().to_string()).collect::<Vec<_>>()));
    found.conclude(Verdict::held(outcome.passed()));
    setup.title.iter().for_each(|title| found.introduce(title.clone()));
    found.introduce(format!("device {}, pixel registers {format}", setup.profile.name));
    written.iter().for_each(|path| found.introduce(format!("wrote {}", path.display())));
    found.table(counts(outcome));
    found.table(probes(&outcome.probes));
    if !outcome.probes.is_empty() {
        let passed = outcome.probes.iter().filter(|result| result.passed).count();
        found.print(format!("{passed} passed, {} failed", outcome.probes.len() - passed));
    }
    found
}
