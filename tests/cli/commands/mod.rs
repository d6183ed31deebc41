//! Every command in README.md, docs and the help texts, run as a reader would type it at the root of the repository.
//!
//! Commands of the program run on copies of `fixtures` and `docs/examples`, and must exit with 0, or with N if `# exit
//! code N` follows the command. [`CUT`] shortens long work: it changes sizes and counts, never the set of options.
//! [`NOT_RUN`] lists commands that cannot run here, with the reason; their options are still parsed. Commands of cargo
//! must name packages, targets, features and tests that exist.

mod cargo;
mod prose;
mod texts;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use rayon::prelude::*;

use crate::generated::hold;
use crate::{ProgramOutput, crossbar_in};
use texts::Command;

/// Reduced sizes and counts of long work: command, option and the value that replaces the value in the text. Where
/// `always` is true, the option is added if the text does not have it.
const CUT: &[(&str, &str, &str, bool)] = &[
    ("leaky-teapot", "--size", "16x16", true),
    ("leaky-teapot", "--tessellation", "1", true),
    ("leaky-teapot", "--rays-per-edge", "0", true),
    ("render", "--size", "8x8", true),
    ("render", "--samples", "1", false),
    ("radiosity", "--size", "8x8", true),
    ("radiosity", "--patches", "60", true),
    ("radiosity", "--iterations", "4", false),
    ("radiosity", "--picture-after", "1,2", false),
    ("radiosity", "--sweep-patches", "60", false),
    ("subsurface", "--all-pairs", "no", true),
    ("subsurface", "--size", "8x8", true),
    ("subsurface", "--links", "4", false),
    ("subsurface", "--tolerance", "0.1", true),
    ("timeline", "--eye-rays", "8x8", false),
    ("tour", "--size", "8x8", true),
    ("tour", "--coarser", "8", true),
];

/// Commands that do not run here: how they begin, and the reason.
const NOT_RUN: &[(&str, &str)] = &[
    ("alu mulAdd", "reads what TestFloat writes, which is not part of the repository"),
    ("leaky-teapot --executor wgpu", "needs an adapter; tests/gpu runs the study on the one that there is"),
    ("cpca precompute transfer-bird", "takes minutes; the other examples compute the same of a small model"),
    ("measure measured.csv --device r200", "reads what a card drew; .ci/measuring has a software driver in its place"),
    (
        "page --emulator",
        "reads what refsim/web/build compiles, for which not every machine has the library; tests/page opens it where it is",
    ),
    ("reproduce", "takes minutes; tests/papers runs every entry"),
    ("reproduce cpca-table-1 --full-size", "takes minutes; tests/papers runs the entry on reduced models"),
    ("reproduce --record", "takes hours; tests/cli holds that what is recorded stays"),
];

/// A temporary copy of the folders that commands read.
pub(crate) fn copy_of_the_repository() -> tempfile::TempDir {
    fn copy(from: &Path, to: &Path) {
        fs::create_dir_all(to).expect("a folder");
        for entry in fs::read_dir(from).expect("a folder").flatten() {
            let place = to.join(entry.file_name());
            if entry.path().is_dir() {
                copy(&entry.path(), &place);
            } else {
                fs::copy(entry.path(), &place).expect("a copy");
            }
        }
    }
    let folder = tempfile::tempdir().expect("a folder for the test");
    for part in ["fixtures/cases", "fixtures/fpbench", "fixtures/models", "fixtures/rays", "docs/examples"] {
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join(part), &folder.path().join(part));
    }
    folder
}

/// The arguments with long work reduced as in [`CUT`].
fn cut(arguments: &[String]) -> Vec<String> {
    let mut cut = arguments.to_vec();
    for (command, option, value, always) in CUT {
        if cut.first().is_none_or(|name| name != command) || cut.iter().any(|word| word == "--help") {
            continue;
        }
        match cut.iter().position(|word| word == option) {
            Some(place) if place + 1 < cut.len() => cut[place + 1] = (*value).to_owned(),
            Some(_) => {}
            // The program refuses quads of patches for a model.
            None if *option == "--tessellation" && cut.iter().any(|word| word == "--mesh") => {}
            None if *always => cut.extend([(*option).to_owned(), (*value).to_owned()]),
            None => {}
        }
    }
    cut
}

/// The entry of [`NOT_RUN`] that the command begins with, if any.
fn exemption(arguments: &[String]) -> Option<&'static str> {
    let text = arguments.join(" ");
    // The list and single entries of `reproduce` are quick, so only the bare command is exempt.
    let named = |start: &str| if start == "reproduce" { text == start } else { text.starts_with(start) };
    NOT_RUN.iter().map(|(start, _)| *start).find(|start| named(start))
}

fn run(folder: &Path, arguments: &[String], input: &str) -> ProgramOutput {
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    crossbar_in(folder, &words, input)
}

/// A message if the command does not end as its text states; otherwise `None`. A program without the feature `wgpu` or
/// `wgsl` may refuse commands that need it, but must say how to build with the feature.
fn fault(command: &Command) -> Option<String> {
    let root = copy_of_the_repository();
    let (arguments, expected) = match exemption(&command.arguments) {
        None => (cut(&command.arguments), command.code),
        // With `--help` at the end, the program parses all options before it and does nothing.
        Some(_) => ([&command.arguments[..], &["--help".to_owned()]].concat(), 0),
    };
    let ran = run(root.path(), &arguments, &command.input);
    let of_wgsl = arguments.iter().any(|argument| argument.contains("wgsl"));
    let lacks = |feature: &str| ran.stderr.contains(&format!("cargo build --release --features {feature}"));
    if (command.with_wgpu && lacks("wgpu")) || (of_wgsl && lacks("wgsl")) {
        return (ran.code != Some(2)).then(|| format!("{}: expected exit code 2\n{}", command.place, ran.transcript()));
    }
    (ran.code != Some(expected)).then(|| format!("{}: `{}`\n{}", command.place, arguments.join(" "), ran.transcript()))
}

#[test]
fn every_command_of_the_program_runs() {
    let commands = texts::of_the_program();
    assert!(commands.len() > 50, "the texts are full of commands: {}", commands.len());
    let mut seen = BTreeSet::new();
    let once: Vec<&Command> = commands.iter().filter(|c| seen.insert((&c.arguments, &c.input, c.code))).collect();
    let faults: Vec<String> = once.par_iter().filter_map(|command| fault(command)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_exemption_and_cut_is_used() {
    let commands = texts::of_the_program();
    let exempt: BTreeSet<_> = commands.iter().filter_map(|command| exemption(&command.arguments)).collect();
    assert_eq!(exempt.len(), NOT_RUN.len(), "{exempt:?}");
    for (name, option, ..) in CUT {
        let used = commands.iter().any(|command| command.arguments.first().is_some_and(|first| first == name));
        assert!(used, "{name} {option}");
    }
}

#[test]
fn every_command_of_cargo_names_what_exists() {
    let faults: Vec<String> = texts::of_cargo().iter().filter_map(cargo::fault).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Each output quoted on a page after `<!-- output of: COMMAND -->` equals what the command prints.
/// `INSTA_UPDATE=always` updates the pages.
#[test]
fn outputs_on_pages_are_those_of_the_program() {
    let root = copy_of_the_repository();
    let shown = texts::outputs();
    assert!(!shown.is_empty(), "a page shows an output");
    for output in shown {
        let ran = run(root.path(), &output.arguments, "");
        assert_eq!(ran.stderr, "", "{}", output.place);
        let page = fs::read_to_string(&output.page).expect("the page");
        let block = |text: &str| format!("{}\n```text\n{text}\n```\n", output.heading);
        hold(&output.page, &page.replace(&block(&output.text), &block(ran.stdout.trim_end())));
    }
}
