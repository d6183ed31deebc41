//! Provenance of results.

use std::io::{self, Read};

use serde::Serialize;
use sha2::{Digest as _, Sha256};

use crate::picture::PictureNotes;

/// Everything required to reproduce a result. No time and no machine name: the same run writes the same bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Command line, with defaults filled in.
    pub command: String,
    /// Device profiles, in the order of use.
    pub profiles: Vec<String>,
    /// Switches that were set explicitly or differ from their defaults, as name and value.
    pub switches: Vec<(String, String)>,
    /// Seed of random choices, if there were any.
    pub seed: Option<u64>,
    /// Input files on the command line, each with the SHA-256 of its contents.
    pub inputs: Vec<(String, String)>,
}

impl Provenance {
    /// Creates the provenance of a result of this version of the program.
    pub fn new(command: impl Into<String>) -> Self {
        Self { version: env!("CARGO_PKG_VERSION").to_owned(), command: command.into(), ..Self::default() }
    }

    /// Converts to the notes of a picture file.
    pub fn notes(&self) -> PictureNotes {
        let rows = self.rows().into_iter().filter(|(name, _)| *name != "version");
        let lines: Vec<String> = rows.map(|(name, value)| format!("{name}: {value}")).collect();
        let software = format!("crossbar {}", self.version);
        PictureNotes { software, comments: lines.join("\n"), ..PictureNotes::default() }
    }

    /// Returns rows of name and value.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let switches: Vec<String> = self.switches.iter().map(|(name, value)| format!("{name}={value}")).collect();
        let or = |text: String, none: &str| if text.is_empty() { none.to_owned() } else { text };
        let mut rows = vec![
            ("version", self.version.clone()),
            ("command", self.command.clone()),
            ("profile", or(self.profiles.join(", "), "none")),
            ("switches", or(switches.join(", "), "all at their defaults")),
            ("seed", self.seed.map_or_else(|| "none: nothing is random".to_owned(), |s| s.to_string())),
        ];
        rows.extend(self.inputs.iter().map(|(path, digest)| ("input", format!("{path}, SHA-256 {digest}"))));
        rows
    }
}

/// Computes the SHA-256 of a reader's contents, in hexadecimal. Fails if the reader does.
pub fn sha256(mut contents: impl Read) -> io::Result<String> {
    let (mut digest, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        match contents.read(&mut buffer)? {
            0 => break,
            read => digest.update(&buffer[..read]),
        }
    }
    Ok(digest.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
