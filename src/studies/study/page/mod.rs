//! The page that compares a visitor's GPU with the emulator: one HTML file that runs the number library's shaders in
//! WebGPU, and compares their results with stored ones of [`refsim::num`] and the batch executor.
//!
//! docs/page.md describes what it shows. The script of the page is in `assets`.

mod arithmetic;
mod encode;
mod markup;
mod operands;
mod own;
mod program_cases;
mod programs;
mod teapot;

use serde_json::json;

use self::teapot::Teapot;
use crate::report::not_encoded;
use crate::study::{ProgressFn, StudyError};

const WASM: &[u8] = b"\0asm";

/// Renders the page as one self-contained HTML file, with the emulator (`refsim/web`, compiled to WebAssembly) in it if
/// given. `progress` is called with the name of each part before it starts. Fails if the card refuses the pictures, a
/// picture cannot be encoded, or the emulator is not a WebAssembly module.
pub fn page(emulator: Option<&[u8]>, progress: &mut ProgressFn<'_>) -> Result<String, StudyError> {
    if emulator.is_some_and(|bytes| !bytes.starts_with(WASM)) {
        let error = StudyError::new("page::emulator", "expected a WebAssembly module as the emulator");
        return Err(error.with_help("give the file that `refsim/web/build` writes"));
    }
    let emulator = emulator.map(own::Emulator::new).transpose();
    let emulator = emulator.map_err(|error| not_encoded("gzip", error))?;
    progress("arithmetic", 0, 3);
    let arithmetic = arithmetic::arithmetic();
    progress("the teapot", 1, 3);
    let teapot = Teapot::compute()?;
    progress("programs", 2, 3);
    let programs = programs::programs()?;
    let version = env!("CARGO_PKG_VERSION");
    let data = json!({ "version": version, "arithmetic": arithmetic, "teapot": teapot, "programs": programs });
    Ok(markup::html(version, &teapot.views, &data.to_string(), emulator.as_ref()))
}
