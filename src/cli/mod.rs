//! The command line: one file per subcommand, and the only place that prints.
//!
//! A command computes, writes its findings to an [`Out`], and returns whether its check passed ([`Verdict`]), or a
//! [`miette::Report`] for bad input. Studies share one runner, `study`. This file converts both to exit codes: 0 done,
//! 1 the check failed, 2 bad input or usage. If a reader closes the pipe (`| head`), the program ends quietly, or with
//! the code of its check.

mod all_frequency;
mod alu;
mod atlas;
mod bi_scale;
mod card;
mod check;
mod compare;
mod completions;
mod cpca;
mod devices;
mod diff;
mod error;
mod executor;
mod given;
mod groups;
mod intersect;
mod leaky_teapot;
mod man;
mod materials;
mod matmul;
mod measure;
mod model_file;
mod model_name;
mod out;
mod outputs;
mod page;
mod pixel;
mod precision;
mod progress;
mod radiosity;
mod render;
mod reproduce;
mod resolved;
mod run;
mod scene;
mod scene_name;
mod shown;
mod study;
mod subsurface;
mod switch;
mod timeline;
mod tour;
mod transfer;
mod uniform;
mod units;
mod version;
mod view;
mod words;

use std::io::{ErrorKind, Write as _};
use std::process::ExitCode;

use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

use crate::options::number;
use crate::report::Verdict;

use resolved::CommandLine;

pub use error::{OutputError, Problem};
pub use out::Out;
pub use progress::ProgressBar;

/// Message for a call without arguments.
const WELCOME: &str = "\
Crossbar: global illumination on the first programmable graphics cards, emulated to the bit.

Three things to try:
  crossbar leaky-teapot                  trace the teapot on a Radeon 8500 and in three float formats; find leaks
  crossbar render office --renderer path --samples 4
                                         a picture of an office; `--caster engine` has the Ray Engine cast its rays
  crossbar reproduce ray-engine-equation-11
                                         the numbers that a paper prints for an equation, beside ours

`crossbar --help` lists all commands. `crossbar leaky-teapot --help` describes a command, with examples.
";

const CHECK_FAILED: u8 = 1;
const BAD_INPUT: u8 = 2;

/// Global illumination on the first programmable graphics cards, emulated to the bit.
///
/// Exit codes: 0 done, 1 the check failed, 2 bad input or usage.
#[derive(Debug, Parser)]
#[command(name = "crossbar", version = version::VERSION.as_str(), max_term_width = 100, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,

    /// Write results and errors as JSON
    #[arg(long, global = true, display_order = 900)]
    json: bool,

    /// Number of threads; the results do not depend on it [default: one per core]
    #[arg(long, global = true, value_name = "N", display_order = 901,
          value_parser = number::whole::<u16>(1..=1024))]
    threads: Option<u16>,

    /// Show no progress
    #[arg(short, long, global = true, display_order = 902)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  crossbar leaky-teapot                                      # trace the teapot in several number formats
  crossbar devices                                           # the emulated cards
  crossbar check docs/examples/intersect.psa --device r200   # is it legal on a Radeon 8500?
  crossbar run docs/examples/product.toml                    # draw a case: write pictures, print counts
  echo 3C00 4000 | crossbar alu add --format fp16            # one plus two, in half precision
  crossbar alu --help                                        # what a command does, with examples

docs/examples and fixtures are folders of the repository; examples are run from its root.
An interrupted command leaves no incomplete files; run it again to start over.";

#[derive(Debug, Subcommand)]
enum Command {
    AllFrequency(all_frequency::Args),
    Alu(alu::Args),
    Atlas(atlas::Args),
    BiScale(bi_scale::Args),
    Check(check::Args),
    Compare(compare::Args),
    Completions(completions::Args),
    Cpca(cpca::Args),
    Devices(devices::Args),
    Diff(diff::Args),
    Intersect(intersect::Args),
    LeakyTeapot(leaky_teapot::Args),
    Man(man::Args),
    Materials(materials::Args),
    Matmul(matmul::Args),
    Measure(measure::Args),
    Page(page::Args),
    Precision(precision::Args),
    Radiosity(radiosity::Args),
    Render(render::Args),
    Reproduce(reproduce::Args),
    Run(run::Args),
    Scene(scene::Args),
    Subsurface(subsurface::Args),
    Timeline(timeline::Args),
    Tour(tour::Args),
    Units(units::Args),
}

/// The program with all its options: a tree of commands, verbs and arguments.
pub fn program() -> clap::Command {
    groups::grouped(outputs::with_common_settings(model_file::with_options(Cli::command())))
}

/// A parsed command line, the same line with its defaults, and the result of the check that its options go together.
type Parsed = (Cli, CommandLine, Result<(), Problem>);

fn parse(arguments: &[std::ffi::OsString]) -> Result<Parsed, clap::Error> {
    let mut program = program();
    let matches = program.try_get_matches_from_mut(arguments).map_err(error::without_tip)?;
    let cli = Cli::from_arg_matches(&matches).map_err(|error| error.format(&mut program))?;
    let fits = given::refuse_repeated(&program, &matches)
        .and_then(|()| given::refuse_places(&program, &matches))
        .and_then(|()| model_file::choose(&program, &matches));
    Ok((cli, resolved::command_line(&program, &matches), fits))
}

/// Runs the program on the arguments of the process.
pub fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().collect();
    if arguments.len() < 2 {
        // A failed write is ignored.
        std::io::stderr().write_all(WELCOME.as_bytes()).ok();
        return ExitCode::from(BAD_INPUT);
    }
    let (cli, command_line, fits) = match parse(&arguments) {
        Ok(parsed) => parsed,
        Err(error) => {
            return match error::print_usage(&error, &arguments) {
                Err(failed) if failed.kind() != ErrorKind::BrokenPipe => {
                    error::print(OutputError::from(failed).into());
                    ExitCode::from(BAD_INPUT)
                }
                // Help and `--version` come this way too, with code 0.
                _ => ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(BAD_INPUT)),
            };
        }
    };
    if cli.json {
        error::as_json();
    }
    if cli.json || cli.quiet {
        progress::silence();
    }
    // 0 threads means one per core. Building fails only if a pool exists already, which is impossible this early.
    let threads = cli.threads.map_or(0, usize::from);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().ok();
    if let Err(problem) = fits {
        error::print(problem.into());
        return ExitCode::from(BAD_INPUT);
    }
    crate::io::protect_inputs();
    let mut out = Out::new(cli.json);
    let result = obey(cli.command, &command_line, &mut out).and_then(|verdict| {
        out.flush().map_err(OutputError::from)?;
        Ok(verdict)
    });
    match result {
        Ok(Verdict::Done) => ExitCode::SUCCESS,
        Ok(Verdict::Failed) => ExitCode::from(CHECK_FAILED),
        Err(report) if error::reader_left(&report) => ExitCode::SUCCESS,
        Err(report) => {
            // Findings made before the error are written first.
            out.flush().ok();
            error::print(report);
            ExitCode::from(BAD_INPUT)
        }
    }
}

fn obey(command: Command, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    match command {
        Command::AllFrequency(args) => all_frequency::run(&args, command_line, out),
        Command::Alu(args) => alu::run(&args, out),
        Command::Atlas(args) => study::run(&args, command_line, out),
        Command::BiScale(args) => bi_scale::run(&args, command_line, out),
        Command::Check(args) => check::run(&args, out),
        Command::Compare(args) => compare::run(&args, out),
        Command::Completions(args) => completions::run(&args, program(), out),
        Command::Cpca(args) => cpca::run(&args, command_line, out),
        Command::Devices(args) => devices::run(&args, out),
        Command::Diff(args) => study::run(&args, command_line, out),
        Command::Intersect(args) => intersect::run(&args, out),
        Command::LeakyTeapot(args) => study::run(&args, command_line, out),
        Command::Man(args) => man::run(&args, program(), out),
        Command::Materials(args) => materials::run(&args, out),
        Command::Matmul(args) => study::run(&args, command_line, out),
        Command::Measure(args) => study::run(&args, command_line, out),
        Command::Page(args) => page::run(&args, out),
        Command::Precision(args) => study::run(&args, command_line, out),
        Command::Radiosity(args) => study::run(&args, command_line, out),
        Command::Subsurface(args) => study::run(&args, command_line, out),
        Command::Render(args) => render::run(&args, command_line, out),
        Command::Reproduce(args) => reproduce::run(&args, command_line, out),
        Command::Run(args) => run::run(&args, out),
        Command::Scene(args) => scene::run(&args, out),
        Command::Timeline(args) => timeline::run(&args, out),
        Command::Tour(args) => study::run(&args, command_line, out),
        Command::Units(args) => units::run(&args, out),
    }
}
