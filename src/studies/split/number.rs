//! Number of a part, and total number of parts.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Maximum number of parts of a run.
const MAX_PARTS: u32 = 1_000_000;

/// Part K of N; K is from 1 to N.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PartNumber {
    number: u32,
    of: u32,
}

impl PartNumber {
    /// Part 1 of 1.
    pub(super) const ONLY: Self = Self { number: 1, of: 1 };

    /// Creates part `number` of `of`; `None` unless `number` is from 1 to `of`, and `of` at most a million.
    pub fn new(number: u32, of: u32) -> Option<Self> {
        (1 <= number && number <= of && of <= MAX_PARTS).then_some(Self { number, of })
    }

    /// The part's number, from 1.
    pub fn number(self) -> u32 {
        self.number
    }

    /// The number of parts.
    pub fn of(self) -> u32 {
        self.of
    }

    /// The part's items among `count`: the ranges of all parts follow each other, and their lengths differ by one at
    /// most. If there are more parts than items, some parts have no items.
    pub fn range(self, count: usize) -> Range<usize> {
        // At most `count`, so it fits.
        let end = |number: u32| (count as u128 * u128::from(number) / u128::from(self.of)) as usize;
        end(self.number - 1)..end(self.number)
    }
}

impl fmt::Display for PartNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.number, self.of)
    }
}

impl FromStr for PartNumber {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let both = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        both.and_then(|(number, of)| Self::new(number, of)).ok_or_else(|| {
            format!("expected K/N with K from 1 to N and N at most {MAX_PARTS}, as in 2/8, found `{text}`")
        })
    }
}
