//! Hostile and careless values for every option of every subcommand: exit code 2, one message, no files left behind.
//! `files` does the same for input files and output paths.

mod files;

use crate::environment::by_form;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use rayon::prelude::*;

use crate::answers::{folder_with, names_in, words};
use crate::commands::copy_of_the_repository;
use crate::{ProgramOutput, crossbar_in, tree};

/// Hostile values for any option.
const HOSTILE: &[&str] = &[
    "", " ", "nan", "inf", "-inf", "1e39", "-1e39", "1e400", "1e300", "-1", "0", "-0", "1,nan,2", "-1,-1", "0x0",
    "1e9x1e9", ",", "=", "a=", "=1,1,1", "--", "-", ".", "..", "/", "a\nb", "🫖",
];
const LONG: &str =
    "4294967296 18446744073709551616 99999999999999999999x1 a=1e39,0,0 nowhere/at.all \u{202e}x \u{1b}[2J";

/// Each command, with arguments that fail before any computation, whatever the options; the tests check messages and
/// leftover files.
const COMMANDS: &str = include_str!("commands.txt");

/// Commands without options that take values.
const WITHOUT_VALUES: [&str; 1] = ["completions"];

/// Names and contents.
type Files<'a> = Vec<(&'a str, &'a [u8])>;

fn said(folder: &Path, arguments: &[OsString]) -> ProgramOutput {
    let mut command = Command::new(crate::program::path());
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    let output = command.output().expect("the program that this test was built with");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes text");
    ProgramOutput { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Asserts that the program prints one complete message, without repetitions and control characters, and nothing else.
fn assert_refused(arguments: &[OsString], files: &[(&str, &[u8])]) -> String {
    let folder = folder_with(files);
    let ProgramOutput { code, stdout, stderr } = said(folder.path(), arguments);
    assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}: {stderr}");
    let errors = stderr.lines().filter(|line| line.to_lowercase().starts_with("error:")).count();
    // A shader's errors are listed under an error that counts them.
    let one = errors == 1 || (errors > 1 && stderr.starts_with("Error: asm::syntax"));
    assert!(one, "{arguments:?}: one error, not {errors}:\n{stderr}");
    assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
    assert!(!stderr.contains(|c| c != '\n' && crossbar::report::visible::is_hidden(c)), "{arguments:?}: {stderr:?}");
    assert_eq!(twice(&stderr), None, "{arguments:?}: {stderr}");
    let digits = stderr.split(|c: char| !c.is_ascii_digit()).map(str::len).max();
    assert!(digits < Some(30), "{arguments:?}: a number that nobody reads: {stderr}");
    let left = names_in(folder.path());
    assert_eq!(left.len(), files.len(), "{arguments:?} left {left:?}");
    stderr
}

/// A cause, printed after an arrow, that repeats the words of the message before it.
fn twice(stderr: &str) -> Option<String> {
    let (_, rest) = stderr.split_once("  x ")?;
    let (message, causes) = rest.split_once("-> ")?;
    let lines = causes.split("\n\n").next()?.lines().take_while(|line| !line.contains("help:"));
    let cause = words(&lines.collect::<Vec<_>>().join(" "));
    words(message).contains(&cause).then_some(cause)
}

/// Every command line with each of its options that takes a value.
fn all_options() -> Vec<(Vec<&'static str>, String)> {
    let commands = tree::commands();
    let own = COMMANDS.lines().flat_map(|base| {
        let options = tree::options(&tree::command_of(base, &commands).1);
        options.into_iter().filter(|(_, takes_value)| *takes_value).map(move |(option, _)| (base, option))
    });
    let global = ("alu add --format fp99", "--threads".to_owned());
    own.chain([global]).map(|(base, option)| (base.split(' ').collect(), option)).collect()
}

#[test]
fn every_command_is_here() {
    let commands = tree::commands();
    let of_table: Vec<&str> = COMMANDS.lines().map(|base| tree::command_of(base, &commands).0.as_str()).collect();
    for (name, _) in &commands {
        assert!(of_table.contains(&name.as_str()) || WITHOUT_VALUES.contains(&name.as_str()), "{name}: add it");
    }
}

#[test]
fn hostile_values() {
    let mut runs: Vec<Vec<OsString>> = Vec::new();
    // By default each option gets one twelfth of the values, others than its neighbors.
    let step = by_form(12, 1);
    for (number, (base, option)) in all_options().into_iter().enumerate() {
        let base = || base.iter().map(OsString::from).chain([OsString::from(&option)]);
        let values = HOSTILE.iter().copied().chain(LONG.split(' ')).skip(number % step).step_by(step);
        runs.extend(values.map(|value| base().chain([OsString::from(value)]).collect()));
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStringExt as _;
            runs.push(base().chain([OsString::from_vec(b"\xff\xfe\x1b[31m".to_vec())]).collect());
        }
    }
    runs.par_iter().for_each(|arguments| {
        assert_refused(arguments, &[]);
    });
}

/// The program refuses each command line of refused.txt, with the words below it.
#[test]
fn what_is_wrong_is_said() {
    let folder = copy_of_the_repository();
    let mut cases = Vec::<(&str, Vec<&str>)>::new();
    for line in include_str!("../refused.txt").lines().filter(|line| !line.starts_with('#')) {
        if let Some((name, text)) = line.strip_prefix("file ").and_then(|file| file.split_once(" < ")) {
            fs::write(folder.path().join(name), text.replace(';', "\n")).expect("a file");
        } else if let Some(words) = line.strip_prefix("    ") {
            cases.last_mut().expect("a command line").1.push(words);
        } else {
            cases.push((line, Vec::new()));
        }
    }
    let left = || fs::read_dir(folder.path()).expect("a folder").count();
    let before = left();
    cases.par_iter().for_each(|(line, expected)| {
        let (arguments, input) = line.split_once(" < ").unwrap_or((line, ""));
        let ran = crossbar_in(folder.path(), &arguments.split(' ').collect::<Vec<_>>(), &input.replace(';', "\n"));
        let said = ran.refusal(line);
        assert!(expected.iter().all(|words| said.contains(words)), "{line}: {said}");
    });
    assert_eq!(left(), before, "a refused command left something behind");
}
