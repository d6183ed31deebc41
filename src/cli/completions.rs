//! `crossbar completions`: a script for a shell, generated from the commands and options of the program.

use std::io::Write as _;

use clap_complete::Shell;
use serde_json::json;

use super::{Out, OutputError, Verdict};

const EXAMPLES: &str = "\
Examples:
  source <(crossbar completions bash)
      a line for ~/.bashrc
  crossbar completions zsh > _crossbar
      to be run in a folder of $fpath
  crossbar completions fish | source
      a line for ~/.config/fish/config.fish";

/// Print a shell script that completes commands, options and their values
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

pub(super) fn run(args: &Args, mut program: clap::Command, out: &mut Out) -> miette::Result<Verdict> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "crossbar", &mut script);
    if out.json() {
        let script = String::from_utf8_lossy(&script);
        out.document(&json!({ "shell": args.shell.to_string(), "script": script }))?;
    } else {
        out.write_all(&script).map_err(OutputError::from)?;
    }
    Ok(Verdict::Done)
}
