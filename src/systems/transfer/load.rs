//! Signals read from files.

use std::path::Path;

use super::file::{self, MeshDigest, PrtFile, PrtMeaning, parse_prt};
use crate::clustering::Signal;
use crate::error::{InputError, input_error};
use crate::io::{npz, number_table, parse_numbers, read_file};

/// Reads a signal from a file: the transfer of a `.npz` file, a NumPy array, or comma-separated values, recognised by
/// the first bytes. Its numbers are f32, like stored transfer. Also returns the meaning of the numbers, and the digest
/// of the mesh whose vertices are the points.
pub fn load_signal(path: &Path) -> Result<(PrtMeaning, Option<MeshDigest>, Signal), InputError> {
    let limit = file::MAX_BYTES.max(number_table::MAX_BYTES);
    let bytes = read_file(path, "signal", limit)?;
    if bytes.starts_with(npz::MAGIC) {
        let PrtFile { meaning, mesh, transfer, .. } = parse_prt(&bytes, path)?;
        let signal = transfer.ok_or_else(|| {
            input_error!("crossbar::signal::compressed" =>
                "expected transfer, found clusters only"; help "give the file from which it was compressed")
            .at(path)
        })?;
        return Ok((meaning, mesh, signal));
    }
    let table = parse_numbers(&bytes, path)?;
    let meaning = PrtMeaning::Numbers { dimension: u32::try_from(table.columns).unwrap_or(u32::MAX) };
    let signal = Signal::new(table.columns, table.values);
    let signal = signal.map_err(|reason| input_error!("crossbar::signal::numbers" => "{reason}").at(path))?;
    Ok((meaning, None, signal))
}
