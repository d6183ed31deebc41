//! Output of the program, in the forms that tests use.

use std::fmt::Debug;
use std::path::Path;

use serde_json::Value;

use crate::{ProgramOutput, crossbar, crossbar_in};

/// Joins a text into one line of words, without line breaks and table frames.
pub(crate) fn words(text: &str) -> String {
    text.replace(['|', '│'], " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The path of a file in a folder, as an argument.
pub(crate) fn place(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().expect("a name in UTF-8").to_owned()
}

/// A temporary folder with these files.
pub(crate) fn folder_with(files: &[(&str, impl AsRef<[u8]>)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    folder
}

/// Runs the program in a folder; the arguments are separated by spaces.
pub(crate) fn line_in(folder: &Path, line: &str) -> ProgramOutput {
    crossbar_in(folder, &line.split_whitespace().collect::<Vec<_>>(), "")
}

/// JSON document of a run in the project's folder, which must succeed without a message.
pub(crate) fn document(arguments: &[&str]) -> Value {
    let ran = crossbar(&[arguments, &["--json"]].concat(), "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "{arguments:?}");
    ran.json()
}

/// JSON document of a run; the arguments are separated by spaces.
pub(crate) fn document_of(line: &str) -> Value {
    document(&line.split_whitespace().collect::<Vec<_>>())
}

/// Texts under their names, for one snapshot.
pub(crate) fn listed<'a>(texts: impl IntoIterator<Item = (&'a str, String)>) -> String {
    texts.into_iter().map(|(name, text)| format!("== {name}\n{text}")).collect()
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("expected a number, found {value}"))
}

impl ProgramOutput {
    /// The JSON document on standard output.
    pub(crate) fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|e| panic!("one JSON document, {e}: {}", self.transcript()))
    }

    /// Words of the message of a refused run with `arguments`: exit code 2, and nothing on standard output.
    pub(crate) fn refusal(&self, arguments: impl Debug) -> String {
        assert_eq!((self.code, self.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", self.stderr);
        words(&self.stderr)
    }
}

/// Words of the message of a refused run in the project's folder.
pub(crate) fn refused(arguments: &[&str]) -> String {
    crossbar(arguments, "").refusal(arguments)
}

/// Words of the message of a refused run; the arguments are separated by spaces.
pub(crate) fn refused_line(line: &str) -> String {
    refused(&line.split_whitespace().collect::<Vec<_>>())
}

/// The names of a folder's entries, sorted.
pub(crate) fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}
