//! `crossbar man`: a manual page per command.

use std::path::PathBuf;

use clap_mangen::Man;
use serde_json::json;

use super::{Out, Problem, Verdict, study};
use crate::io::write_files;
use crate::report::Findings;

const EXAMPLES: &str = "\
Examples:
  crossbar man --out out/man
      out/man/crossbar.1, crossbar-alu.1 and so on; `man out/man/crossbar-alu.1` shows a page
  crossbar man --out ~/.local/share/man/man1
      writes the pages to a folder in which `man` looks for them";

/// Write manual pages: one for the program, and one for each command and subcommand
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// Folder for the pages
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, program: clap::Command, out: &mut Out) -> miette::Result<Verdict> {
    let written = write_files(&args.out, &pages(program)).map_err(Problem::from)?;
    let mut found = Findings::new("Manual pages");
    found.field("files", json!(written));
    written.iter().for_each(|path| found.print(format!("wrote {}", path.display())));
    study::show(&found, out)
}

fn pages(program: clap::Command) -> Vec<(String, Vec<u8>)> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let of = |command: &clap::Command| command.get_subcommands().cloned().collect::<Vec<_>>();
    let commands: Vec<clap::Command> =
        of(&program).into_iter().flat_map(|command| [of(&command), vec![command]].concat()).collect();
    let page = |command| {
        let page = Man::new(command).source(concat!("crossbar ", env!("CARGO_PKG_VERSION"))).manual("Crossbar");
        let mut text = Vec::new();
        // Writing to a vector cannot fail.
        page.render(&mut text).ok();
        (page.get_filename(), text)
    };
    std::iter::once(program).chain(commands).map(page).collect()
}
