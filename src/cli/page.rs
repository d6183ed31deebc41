//! `crossbar page`: a page that compares a visitor's GPU with the emulator.

use std::path::{Path, PathBuf};

use serde_json::json;

use super::{Out, Problem, ProgressBar, Verdict, study};
use crate::error::InputError;
use crate::io::read_file;
use crate::io::{require_writable, write_files};
use crate::report::Findings;
use crate::study::page::page;

const EXAMPLES: &str = "\
Examples:
  crossbar page --out out/page
      out/page/index.html: open it in a browser with WebGPU
  refsim/web/build && crossbar page --emulator target/web/refsim_web.wasm
      the same page with the emulator inside, so that visitors can run their own programs

The file is self-contained: it loads nothing and sends nothing. On the visitor's GPU it runs, in integer arithmetic, \
operations in eight number formats, the Ray Engine's intersection program on the teapot, and programs of the systems, \
instruction by instruction. It compares all bits with the emulator's results, which are stored in the file. It also \
shows the results of the GPU's own floats. docs/page.md describes the page.";

/// Write a web page that compares a visitor's GPU with the emulated cards, bit for bit
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The emulator, with which visitors run their own programs: the file that `refsim/web/build` compiles
    #[arg(long, value_name = "FILE.wasm")]
    emulator: Option<PathBuf>,
    /// Where to write index.html
    #[arg(long, value_name = "DIR", default_value = "out/page")]
    out: PathBuf,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    // Checked before the work, so that an unwritable folder is found at once.
    require_writable(&args.out).map_err(Problem::from)?;
    let emulator = args.emulator.as_deref().map(read_emulator).transpose()?;
    let bar = ProgressBar::new("", 1);
    let text = page(emulator.as_deref(), &mut |what, done, of| bar.show(what.to_owned(), done, of))?;
    drop(bar);
    let bytes = text.len();
    let written = write_files(&args.out, &[("index.html".to_owned(), text.into_bytes())]).map_err(Problem::from)?;
    let mut found = Findings::new("Page");
    found.fields(json!({ "files": written, "bytes": bytes }));
    written.iter().for_each(|path| found.print(format!("wrote {} ({bytes} bytes)", path.display())));
    study::show(&found, out)
}

fn read_emulator(path: &Path) -> Result<Vec<u8>, InputError> {
    /// Maximum size of a module, in bytes.
    const LIMIT: u64 = 32 << 20;
    read_file(path, "WebAssembly module", LIMIT)
}
