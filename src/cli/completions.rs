//! `crossbar completions`: what a shell completes after `crossbar`.

use std::io::Write as _;

use clap_complete::Shell;
use serde_json::json;

use super::{Out, OutputError, Verdict};

const EXAMPLES: &str = "\
Examples:
  crossbar completions bash > crossbar.bash
      for ~/.local/share/bash-completion/completions/crossbar, which bash reads at its next start
  crossbar completions zsh > _crossbar
      for a folder of zsh's $fpath
  crossbar completions fish > crossbar.fish
      for ~/.config/fish/completions/crossbar.fish";

/// Print the completions of commands and options for a shell
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
