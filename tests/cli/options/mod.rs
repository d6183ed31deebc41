//! Every option of every command changes the output or is refused: none is accepted and ignored.
//!
//! The table contains command lines and options with values; an option that is missing from it fails the test. Each
//! option is added to each command line. The compared output is the exit code, both streams and all files, except for
//! parts that differ between two equal runs (times) and the provenance, which names the options. By default the test
//! tries a fixed selection of one in 36 pairs of a line and an option; `CROSSBAR_FULL=1` tries all.

mod table;

use crate::environment::by_form;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use crossbar::picture::Picture;
use crossbar::transfer::file::{PrtFile, parse_prt, write_prt};
use rayon::prelude::*;
use serde_json::Value;

use crate::answers::line_in;
use crate::commands::copy_of_the_repository;
use crate::crossbar_in;
use crate::tree::{self, command_of};
use table::{TABLE, Tried};

/// Options whose value here may be refused everywhere: it names something that this test cannot provide, a model other
/// than the file's, a precision that the card lacks, or an entry of `reproduce` whose run takes minutes; or each line
/// has an option that excludes it.
const NEVER_ACCEPTED: [&str; 10] = [
    "--emulator",
    "--model",
    "--model-up",
    "--strict",
    "--crease",
    "--switch",
    "--full-size",
    "--list",
    "--record",
    "--fpcore",
];

/// Tried on every command line: the number of threads changes nothing.
const THREADS: TriedOption = TriedOption { name: "--threads", value: Some("1"), only: None, is_same: true };

/// An option of the table.
#[derive(Clone, Debug)]
struct TriedOption {
    name: &'static str,
    value: Option<&'static str>,
    /// Indices of the command lines on which the option is tried; `None` for all.
    only: Option<Vec<usize>>,
    is_same: bool,
}

impl Tried {
    fn options(&'static self) -> Vec<TriedOption> {
        let option = |word: &'static str| {
            let (is_same, word) = word.strip_prefix("same:").map_or((false, word), |word| (true, word));
            let (word, only) = word.split_once('@').map_or((word, None), |(word, only)| (word, Some(only)));
            let only = only.map(|only| only.split(',').map(|at| at.parse().expect("a base's number")).collect());
            let (name, value) = word.split_once('=').map_or((word, None), |(name, value)| (name, Some(value)));
            TriedOption { name, value, only, is_same }
        };
        self.options.split_whitespace().map(option).collect()
    }
}

#[test]
fn every_option_is_in_the_table() {
    let commands = tree::commands();
    let mut left: BTreeSet<&str> = commands.iter().map(|(name, _)| name.as_str()).collect();
    for tried in TABLE.iter() {
        let (name, command) = command_of(tried.bases[0], &commands);
        assert!(tried.bases.iter().all(|base| command_of(base, &commands).0 == *name), "{name}: one command a row");
        assert!(left.remove(name.as_str()), "{name}: one row a command");
        let own: BTreeSet<String> = tree::options(command).into_iter().map(|(option, _)| option).collect();
        let tabled: BTreeSet<String> = tried.options().iter().map(|option| option.name.to_owned()).collect();
        let required = |option: &&String| tried.bases.iter().all(|base| base.split(' ').any(|word| word == **option));
        let missing: Vec<&String> = own.difference(&tabled).filter(|option| !required(option)).collect();
        let unknown: Vec<&String> = tabled.difference(&own).collect();
        assert!(missing.is_empty() && unknown.is_empty(), "{name}: add {missing:?}, remove {unknown:?}");
    }
    assert!(left.is_empty(), "add {left:?}");
}

#[test]
fn every_option_changes_something_or_is_refused() {
    let step = by_form(36, 1);
    let lines = TABLE.iter().enumerate().flat_map(|(row, tried)| (0..tried.bases.len()).map(move |at| (row, at)));
    let lines = lines.filter(|&(row, at)| cfg!(feature = "wgsl") || !TABLE[row].bases[at].contains("wgsl"));
    let mut pairs = 0;
    let lines: Vec<(usize, usize, Vec<TriedOption>)> = lines
        .map(|(row, at)| {
            let mut options = TABLE[row].options();
            options.push(THREADS);
            options.retain(|option| {
                pairs += usize::from(option.only.as_ref().is_none_or(|only| only.contains(&at)));
                option.only.as_ref().is_none_or(|only| only.contains(&at)) && pairs % step == 0
            });
            (row, at, options)
        })
        .collect();
    let told: Vec<OptionFaults> = lines.par_iter().map(|(row, at, options)| tell(*row, *at, options)).collect();
    let faults: Vec<&String> = told.iter().flat_map(|told| &told.faults).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    if step == 1 && cfg!(feature = "wgsl") {
        let accepted: BTreeSet<(usize, &str)> = told.iter().flat_map(|told| told.accepted.clone()).collect();
        let mut refused = Vec::new();
        for (row, tried) in TABLE.iter().enumerate() {
            for TriedOption { name, .. } in tried.options() {
                let has = |base: &&str| base.split(' ').any(|word| word == name);
                let is_in_a_line = tried.bases.iter().any(has);
                if !is_in_a_line && !accepted.contains(&(row, name)) && !NEVER_ACCEPTED.contains(&name) {
                    refused.push((tried.bases[0], name));
                }
            }
        }
        assert!(refused.is_empty(), "refused everywhere, give them other values: {refused:#?}");
    }
}

/// Results for one command line.
#[derive(Debug, Default)]
struct OptionFaults {
    faults: Vec<String>,
    /// Row of the table and name of the option.
    accepted: Vec<(usize, &'static str)>,
}

fn tell(row: usize, at: usize, options: &[TriedOption]) -> OptionFaults {
    let base = TABLE[row].bases[at];
    let mut told = OptionFaults::default();
    if options.is_empty() {
        return told;
    }
    let (first, second) = (outcome(base, None), outcome(base, None));
    let is_stable = |(key, value): &(&String, &String)| second.get(*key) == Some(*value);
    let stable: BTreeMap<&String, &String> = first.iter().filter(is_stable).collect();
    let unstable: BTreeSet<&String> =
        first.keys().chain(second.keys()).filter(|key| !stable.contains_key(key)).collect();
    let fails = first[CODE] == "Some(2)";
    if fails && !base.contains("odd.obj") {
        told.faults.push(format!("`{base}` fails: {first:?}"));
    }
    // A line that ends in an error must only depend on the options that the error names.
    let is_there = |option: &TriedOption| option.value.is_none() && base.split(' ').any(|word| word == option.name);
    for option in options.iter().filter(|option| (!fails || option.only.is_some()) && !is_there(option)) {
        let found = outcome(base, Some(option));
        let same = found
            .iter()
            .filter(|(key, _)| !unstable.contains(key))
            .eq(first.iter().filter(|(key, _)| !unstable.contains(key)));
        let what = if option.is_same { "changes what comes out" } else { "is accepted and changes nothing" };
        if same != option.is_same {
            told.faults.push(format!("`{base}` {} {}: {what}", option.name, option.value.unwrap_or_default()));
        }
        if found[CODE] != "Some(2)" || fails {
            told.accepted.push((row, option.name));
        }
    }
    told
}

/// Key of the exit code in an outcome.
const CODE: &str = "exit code";

/// The outcome of a command line with the option added or replaced: leaves of the document, or lines of the streams,
/// and a digest of each file.
fn outcome(base: &str, option: Option<&TriedOption>) -> BTreeMap<String, String> {
    static NUMBER: AtomicUsize = AtomicUsize::new(0);
    let run = format!("run-{}", NUMBER.fetch_add(1, Ordering::Relaxed));
    let folder = inputs();
    fs::create_dir(folder.join(&run)).expect("a folder");
    let (line, input) = base.split_once(" < ").unwrap_or((base, ""));
    let mut words: Vec<&str> = line.split_whitespace().collect();
    if let Some(TriedOption { name, value, .. }) = option {
        let several =
            ["--texture", "--format", "--switch"].contains(name) && value.is_some_and(|value| value.contains('='));
        if let Some(place) = words.iter().position(|word| word == name).filter(|_| !several) {
            words.drain(place..=place + usize::from(value.is_some()));
        }
        words.push(name);
        words.extend(value);
    }
    words.push("--json");
    // Every command creates the folders of its outputs.
    let placed = |word: &&str| {
        let own = ["OUT", "other", "kept", "trace.json"].iter().any(|name| word.starts_with(name));
        if own { format!("{run}/missing/{word}") } else { (*word).to_owned() }
    };
    let words: Vec<String> = words.iter().map(placed).collect();
    let ran = crossbar_in(folder, &words.iter().map(String::as_str).collect::<Vec<_>>(), &input.replace(';', "\n"));
    let mut outcome = BTreeMap::from([(CODE.to_owned(), format!("{:?}", ran.code))]);
    let mut put = |key: String, value: &str| drop(outcome.insert(key, value.replace(&run, "RUN")));
    for (name, stream) in [("stdout", &ran.stdout), ("stderr", &ran.stderr)] {
        match serde_json::from_str::<Value>(stream) {
            Ok(document) => leaves(name.to_owned(), &document, &mut put),
            Err(_) => stream.lines().enumerate().for_each(|(at, line)| put(format!("{name}:{at}"), line)),
        }
    }
    files(&folder.join(&run), "", &mut put);
    fs::remove_dir_all(folder.join(&run)).expect("removed");
    outcome
}

fn leaves(key: String, value: &Value, put: &mut impl FnMut(String, &str)) {
    match value {
        Value::Object(fields) => {
            let fields = fields.iter().filter(|(name, _)| *name != "provenance");
            fields.for_each(|(name, value)| leaves(format!("{key}/{name}"), value, put));
        }
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(at, value)| leaves(format!("{key}/{at}"), value, put));
        }
        leaf => put(key, &leaf.to_string()),
    }
}

/// Files by name and digest; pages only by name, because they name the options.
fn files(folder: &Path, under: &str, put: &mut impl FnMut(String, &str)) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let name = format!("{under}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            files(&entry.path(), &name, put);
            continue;
        }
        let is_page = ["index.html", "study.json"].iter().any(|page| name.ends_with(page));
        let bytes = if is_page { Vec::new() } else { fs::read(entry.path()).expect("a file") };
        let bytes = without_provenance(bytes);
        // A CRC would be equal for all files that end with their own CRC. Only the channels of pictures count, because
        // picture files name the options, too.
        let mut digest = DefaultHasher::new();
        match Picture::decode(&bytes) {
            Ok(picture) => format!("{:?}", picture.channels()).hash(&mut digest),
            Err(_) => bytes.hash(&mut digest),
        }
        put(format!("file {name}"), &format!("{:016x}", digest.finish()));
    }
}

/// Removes the provenance from a transfer file; returns other files unchanged.
fn without_provenance(bytes: Vec<u8>) -> Vec<u8> {
    match parse_prt(&bytes, Path::new("a.npz")) {
        Ok(file) => {
            let mut bare = Vec::new();
            write_prt(&PrtFile { provenance: None, ..file }, &mut bare).expect("written");
            bare
        }
        Err(_) => bytes,
    }
}

/// A folder with the inputs of the command lines: the repository's examples, and small files made here.
fn inputs() -> &'static Path {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let folder = copy_of_the_repository();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
        // A material that reflects more than all light, and a triangle with the opposite winding.
        put(
            "odd.obj",
            "mtllib odd.mtl\nv 0 0 0\nv 1 0 0\nv 1 0.2 1\nv 0 0.1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\n\
             f 1/1 2/2 3/3\nf 1/1 4/4 3/3\n",
        );
        put("odd.mtl", "newmtl m\nNs 5\nKd 0.8 0.7 0.8\nKs 0.5 0.5 0.4\nd 1\nillum 2\n");
        let square = fs::read_to_string(folder.path().join("fixtures/models/square.obj")).expect("a model");
        put("square.obj", &square);
        put("rays.csv", "ox,oy,oz,dx,dy,dz\n0.75,-1,0.25,0,1,0.1\n0.25,-1,0.75,0,1,0\n0.25,2,0.5,0,-0.9,0\n");
        put("rays_2.csv", "ox,oy,oz,dx,dy,dz\n0.7,-1,0.3,0,1,0\n0.3,-1,0.7,0.1,1,0\n0.25,2,0.5,0,-0.9,0\n");
        let cell = |n: u32| (f64::from(n % 16) - 7.5, f64::from(n / 16) - 9.5);
        let ray = |(x, y): (f64, f64)| format!("0,-10,1.5,{},1,{}\n", x / 40.0, y / 60.0);
        put("many.csv", &(0..256).map(cell).map(ray).fold("ox,oy,oz,dx,dy,dz\n".to_owned(), |all, ray| all + &ray));
        put("roof.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0.5\nv 1 -1 0.5\nv 0 -1 0.5\nf 1 2 3 4\nf 2 1 6 5\n");
        put("heights.csv", "0,0.1\n0.2,0\n");
        for line in [
            "all-frequency factor --brdf phong --side 4 --terms 2 --out factors",
            "all-frequency precompute docs/examples/step.obj --ground 3 --out on.npz",
            "all-frequency precompute square.obj --reflectance factors --out glossy_sight.npz",
            "all-frequency compress glossy_sight.npz --model square.obj --vectors 3 --out glossy.npz",
            "bi-scale precompute docs/examples/court.obj --directions 2 --out court.npz",
            "matmul docs/examples/matmul_a.npy docs/examples/matmul_b.npy --unit hopper-fp8 --out product",
            "bi-scale texture plain --texels 2 --directions 4 --views 2 --out plain.npy",
        ] {
            let ran = line_in(folder.path(), line);
            assert_eq!(ran.code, Some(0), "{}", ran.transcript());
        }
        folder
    });
    folder.path()
}
