//! Comma-separated tables that begin with a header.

use std::path::Path;

use super::quoted;
use crate::error::{FilePlace, InputError, input_error};

/// Comma-separated values of any number per line, without white space around them.
pub(super) fn rows(bytes: &[u8]) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(bytes)
}

pub(super) fn syntax(reason: csv::Error, name: &Path) -> InputError {
    input_error!("crossbar::table::syntax" => "the table cannot be read: {reason}").at(name)
}

/// Calls `each` with the line and the fields of every row; `per` names the subject of a row in messages.
pub(super) fn for_each_row(
    bytes: &[u8],
    name: &Path,
    header: &[&str],
    per: &str,
    each: &mut dyn FnMut(usize, &csv::ByteRecord) -> Result<(), InputError>,
) -> Result<(), InputError> {
    let (mut reader, syntax) = (rows(bytes), |reason| syntax(reason, name));
    let mut record = csv::ByteRecord::new();
    let has_header = reader.read_byte_record(&mut record).map_err(syntax)?;
    if !(has_header && record.iter().eq(header.iter().map(|column| column.as_bytes()))) {
        let header = header.join(",");
        return Err(input_error!("crossbar::table::header" =>
            "expected the header `{header}`, found {}", whole(&record);
            help "write a line `{header}`, then a line per {per}")
        .at(FilePlace::line(name, 1)));
    }
    while reader.read_byte_record(&mut record).map_err(syntax)? {
        let line = record.position().map_or(0, csv::Position::line) as usize;
        each(line, &record).map_err(|error| error.at(FilePlace::line(name, line)))?;
    }
    Ok(())
}

/// Text of a row for messages.
pub(super) fn whole(record: &csv::ByteRecord) -> String {
    quoted(&record.iter().collect::<Vec<_>>().join(&b','))
}

/// The numbers of a row, if there are N, all finite.
pub(super) fn finite<const N: usize>(record: &csv::ByteRecord) -> Option<[f64; N]> {
    let number = |field: &[u8]| std::str::from_utf8(field).ok()?.parse().ok().filter(|value: &f64| value.is_finite());
    let numbers: Vec<f64> = record.iter().map(number).collect::<Option<_>>()?;
    numbers.try_into().ok()
}
