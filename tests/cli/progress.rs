//! Progress of long work on standard error.

use std::io::{BufRead as _, BufReader, Read as _};
use std::process::{Command, Stdio};

/// Work of minutes, which the test ends early.
const LONG: &[&str] = &["render", "white-box", "--renderer", "path", "--samples", "100000", "--size", "64x64"];

/// Long work announces once how long it will take and which options make it quicker, and if standard error is not a
/// terminal, its progress in plain lines; with `--quiet` it writes nothing.
#[test]
fn long_work_is_announced() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let [mut child, mut silent] = [None, Some("--quiet")].map(|more| {
        let mut command = Command::new(crate::program::path());
        command.args(LONG).args(more).current_dir(folder.path()).stdin(Stdio::null()).stdout(Stdio::null());
        command.stderr(Stdio::piped()).spawn().expect("the program that this test was built with")
    });
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines().map(|line| line.expect("text"));
    let is_announced = |line: &String| line.contains(" will take about ");
    let is_counted = |line: &String| line.contains(" of ") && line.contains(" done, about ") && line.ends_with(" left");
    let mut said = Vec::new();
    while !(said.iter().any(is_announced) && said.iter().any(is_counted)) {
        said.push(lines.next().expect("the work is long enough to be announced"));
    }
    for child in [&mut child, &mut silent] {
        child.kill().expect("a child");
        child.wait().expect("a child");
    }
    said.extend(lines);
    let announced: Vec<&String> = said.iter().filter(|line| is_announced(line)).collect();
    let quicker = " at this pace; quicker with fewer `--samples` or a smaller `--size`";
    assert!(announced.len() == 1 && announced[0].ends_with(quicker), "{said:?}");
    assert!(said.iter().all(|line| line.starts_with("progress: ") && !line.contains(['\x1b', '\r'])), "{said:?}");
    let mut text = String::new();
    silent.stderr.take().expect("a pipe").read_to_string(&mut text).expect("text");
    assert!(!text.contains("progress"), "{text}");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0, "a killed program leaves nothing");
}
