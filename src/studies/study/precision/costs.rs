//! Costs of formats by their width.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::bits::FormatBits;
use crate::io::read_limited;
use crate::study::StudyError;

/// Longest file that is read, in bytes (1 MiB).
const MAX_BYTES: u64 = 1 << 20;
/// Width of the widest format, in bits.
const WIDEST: u32 = 32;
const HELP: &str =
    "the header is `bits,cost`; the costs do not fall with the bits, and the last row has 32 bits or more";

/// Costs by width: the width itself, or the costs of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FormatCosts {
    /// Costs by width in bits, ascending; empty if the cost is the width.
    by_width: BTreeMap<u32, f64>,
}

/// Line of the table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CostRow {
    bits: u32,
    cost: f64,
}

impl FormatCosts {
    /// Reads a table with the header `bits,cost`: a format costs as much as the narrowest width listed that holds it.
    /// Fails if the file cannot be read or is not such a table: the message has the path and the line.
    pub fn load(path: &Path) -> Result<Self, StudyError> {
        let name = path.display();
        let unreadable = |source| {
            StudyError::new("crossbar::precision::costs", format!("cannot read the costs {name}"))
                .with_help("check the path, and that you may read the file")
                .with_source(source)
        };
        let bytes = read_limited(path, MAX_BYTES).map_err(unreadable)?.ok_or_else(|| {
            let found = format!("{name}: expected a table of at most {MAX_BYTES} bytes, found more");
            StudyError::new("crossbar::precision::costs", found).with_help(HELP)
        })?;
        Self::parse(&bytes).map_err(|(line, found)| {
            StudyError::new("crossbar::precision::costs", format!("{name}:{line}: {found}")).with_help(HELP)
        })
    }

    /// Parses the table; an error has the line and the reason.
    fn parse(bytes: &[u8]) -> Result<Self, (u64, String)> {
        let broken = |error: csv::Error| {
            let line = error.position().map_or(1, csv::Position::line);
            (line, format!("expected a width in bits and its cost: {error}"))
        };
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
        let headers = reader.headers().map_err(broken)?.clone();
        let mut by_width: BTreeMap<u32, f64> = BTreeMap::new();
        let mut line = 1;
        for record in reader.records() {
            let record = record.map_err(broken)?;
            line = record.position().map_or(line, csv::Position::line);
            let CostRow { bits, cost } = record.deserialize(Some(&headers)).map_err(broken)?;
            if !cost.is_finite() || cost < 0.0 {
                return Err((line, format!("expected a finite cost of at least 0, found {cost}")));
            }
            if by_width.insert(bits, cost).is_some() {
                return Err((line, format!("expected each width once, found {bits} again")));
            }
        }
        if let Some(((narrow, more), (wide, less))) =
            by_width.iter().zip(by_width.iter().skip(1)).find(|((_, a), (_, b))| a > b)
        {
            let found =
                format!("expected costs that do not fall, found {more} for {narrow} bits and {less} for {wide}");
            return Err((line, found));
        }
        match by_width.last_key_value() {
            Some((&bits, _)) if bits >= WIDEST => Ok(Self { by_width }),
            Some((bits, _)) => Err((line, format!("expected a row of {WIDEST} bits or more, found {bits} at most"))),
            None => Err((line, "expected rows, found a table without".to_owned())),
        }
    }

    /// Cost of one instruction in a format.
    pub(super) fn of(&self, bits: FormatBits) -> f64 {
        let listed = self.by_width.range(bits.width()..).next().map(|(_, cost)| *cost);
        listed.unwrap_or_else(|| f64::from(bits.width()))
    }

    /// Sum of costs over all instructions.
    pub(super) fn sum(&self, formats: &[FormatBits]) -> f64 {
        formats.iter().fold(0.0, |sum, bits| sum + self.of(*bits))
    }

    /// Returns `true` if costs come from a table.
    pub(super) fn is_table(&self) -> bool {
        !self.by_width.is_empty()
    }
}
