//! Runs of an earlier study of one subject: a longer search continues where the last ended.

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use super::bits::Assignment;
use super::subject::{PrecisionSubject, WorstPlace};
use crate::io::read_limited;
use crate::report::sha256;

/// Name of the file in the study's folder.
pub(super) const FILE: &str = "runs.json";
/// Maximum length of the file, in bytes.
const MAX_BYTES: u64 = 1 << 28;
/// Number of known runs that are repeated as a check. If one differs, all known runs are discarded.
const CHECKED: u32 = 3;

/// Values of earlier runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KnownRuns {
    /// Digest of the program's version, the subject, its device and the measure.
    subject: String,
    /// Runs by the digest of their formats.
    runs: BTreeMap<String, KnownRun>,
    /// Number of known runs that were repeated.
    #[serde(skip)]
    checked: u32,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct KnownRun {
    /// Bits of the goal's measure, an IEEE double: JSON has neither infinity nor NaN.
    bits: u64,
    worst: Option<WorstPlace>,
}

impl KnownRuns {
    /// Reads the runs of the study that was written to a folder; empty if there is no file, or a damaged one.
    pub fn of_folder(folder: &Path) -> Self {
        let bytes = read_limited(&folder.join(FILE), MAX_BYTES).ok().flatten().unwrap_or_default();
        serde_json::from_slice(&bytes).unwrap_or_default()
    }

    /// Returns these runs if they are of this subject and measure, otherwise no runs.
    pub(super) fn of(&self, subject: &dyn PrecisionSubject, measure: &str) -> Self {
        let digest = digest_of(subject, measure);
        if self.subject == digest { self.clone() } else { Self { subject: digest, ..Self::default() } }
    }

    /// Value and place of the largest error of a run; `None` if it is not known or must be repeated.
    pub(super) fn get(&mut self, assignment: &Assignment) -> Option<(f64, Option<WorstPlace>)> {
        let run = self.runs.get(&digest(assignment))?.clone();
        if self.checked < CHECKED {
            self.checked += 1;
            return None;
        }
        Some((f64::from_bits(run.bits), run.worst))
    }

    /// Adds a run that was made. If the known value differs, discards all known runs.
    pub(super) fn insert(&mut self, assignment: &Assignment, value: f64, worst: Option<WorstPlace>) {
        let run = KnownRun { bits: value.to_bits(), worst };
        let key = digest(assignment);
        if self.runs.get(&key).is_some_and(|known| *known != run) {
            self.runs.clear();
        }
        self.runs.insert(key, run);
    }

    /// The file's contents.
    pub(super) fn to_json(&self) -> Vec<u8> {
        serde_json::to_vec(self).unwrap_or_default()
    }
}

/// Digest of formats.
fn digest(assignment: &Assignment) -> String {
    let mut text = String::new();
    for bits in assignment {
        let _ = match bits {
            Some(bits) => write!(text, "{bits} "),
            None => write!(text, "- "),
        };
    }
    short(sha256(text.as_bytes()).unwrap_or_default())
}

fn digest_of(subject: &dyn PrecisionSubject, measure: &str) -> String {
    struct Hashed(Sha256);
    impl fmt::Write for Hashed {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.update(text);
            Ok(())
        }
    }
    let mut hashed = Hashed(Sha256::new());
    let version = env!("CARGO_PKG_VERSION");
    let _ = write!(hashed, "{version} {measure} {:?} {:?}", subject.profile(), subject.content());
    short(hashed.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Truncates a digest to 128 bits.
fn short(mut digest: String) -> String {
    digest.truncate(32);
    digest
}
