//! Hostile and careless values for every option of every subcommand: exit code 2, one message, no files left behind.
//! `files` does the same for input files and output paths.

mod files;

use crate::environment::is_full;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use rayon::prelude::*;

use crate::answers::words;
use crate::tree;

/// Hostile values for any option.
const HOSTILE: &[&str] = &[
    "", " ", "nan", "inf", "-inf", "1e39", "-1e39", "1e400", "1e300", "-1", "0", "-0", "1,nan,2", "-1,-1", "0x0",
    "1e9x1e9", ",", "=", "a=", "=1,1,1", "--", "-", ".", "..", "/", "a\nb", "🫖",
];
const LONG: &[&str] = &[
    "4294967296",
    "18446744073709551616",
    "99999999999999999999x1",
    "a=1e39,0,0",
    "nowhere/at.all",
    "\u{202e}x",
    "\u{1b}[2J",
];

/// Each command, with arguments that fail before any computation, whatever the options; the tests check messages and
/// leftover files.
const COMMANDS: &[&str] = &[
    "all-frequency card nowhere.npz --model nowhere.obj",
    "all-frequency compress nowhere.npz --model nowhere.obj --out y.npz",
    "all-frequency factor --table nowhere.csv",
    "all-frequency lighting --light nowhere.hdr",
    "all-frequency precompute nowhere.obj --out x.npz",
    "all-frequency render nowhere.npz --model nowhere.obj",
    "all-frequency show nowhere.npz",
    "alu add --format fp99",
    "atlas nowhere.obj",
    "bi-scale bicluster nowhere.mtx",
    "bi-scale card nowhere.npz --model nowhere.obj --texture mail",
    "bi-scale precompute nowhere.obj --out x.npz",
    "bi-scale render nowhere.npz --model nowhere.obj --texture mail",
    "bi-scale show nowhere.mtx",
    "bi-scale texture nowhere.png --out b.npy",
    "check nowhere.psa",
    "compare nowhere.toml",
    "cpca card nowhere.npz --model nowhere.obj",
    "cpca compress nowhere.npz --out y.npz",
    "cpca precompute nowhere.obj --out x.npz",
    "cpca render nowhere.npz --model nowhere.obj",
    "cpca show nowhere.npz",
    "devices nowhere",
    "diff nowhere.png nowhere.exr",
    "intersect --mesh nowhere.obj",
    "leaky-teapot --device nowhere",
    "man nowhere",
    "materials nowhere",
    "matmul nowhere.npy nowhere.npy --unit hopper-fp8",
    "measure nowhere.csv --device r200",
    "precision nowhere.toml",
    "precision --fpcore nowhere.fpcore",
    "radiosity nowhere.obj",
    "render nowhere.obj",
    "reproduce nowhere",
    "run nowhere.toml",
    "scene nowhere",
    "subsurface nowhere.obj --mm-per-unit 1 --material marble",
    "timeline nowhere.toml",
    "page nowhere",
    "tour nowhere",
    "units nowhere",
];

/// Commands without options that take values.
const WITHOUT_VALUES: [&str; 1] = ["completions"];

/// Names and contents.
type Files<'a> = Vec<(&'a str, &'a [u8])>;

struct Said {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

fn said(folder: &Path, arguments: &[OsString]) -> Said {
    let mut command = Command::new(crate::program::path());
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    let output = command.output().expect("the program that this test was built with");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes text");
    Said { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Asserts that the program prints one complete message, without repetitions and control characters, and nothing else.
fn assert_refused(arguments: &[OsString], files: &[(&str, &[u8])]) -> String {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    let Said { code, stdout, stderr } = said(folder.path(), arguments);
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
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("a folder").flatten().map(|entry| entry.file_name()).collect();
    assert_eq!(left.len(), files.len(), "{arguments:?} left {left:?}");
    stderr
}

/// A cause, printed after an arrow, that repeats the words of the message before it.
fn twice(stderr: &str) -> Option<String> {
    let (_, rest) = stderr.split_once("  x ")?;
    let (message, causes) = rest.split_once("-> ")?;
    let cause = words(
        causes
            .split("\n\n")
            .next()?
            .lines()
            .take_while(|line| !line.contains("help:"))
            .collect::<Vec<_>>()
            .join(" ")
            .as_str(),
    );
    words(message).contains(&cause).then_some(cause)
}

/// Every command line with each of its options that takes a value.
fn all_options() -> Vec<(Vec<&'static str>, String)> {
    let commands = tree::commands();
    let own = COMMANDS.iter().flat_map(|base| {
        let options = tree::options(&tree::command_of(base, &commands).1);
        options.into_iter().filter(|(_, takes_value)| *takes_value).map(move |(option, _)| (*base, option))
    });
    let global = ("alu add --format fp99", "--threads".to_owned());
    own.chain([global]).map(|(base, option)| (base.split(' ').collect(), option)).collect()
}

#[test]
fn every_command_is_here() {
    let commands = tree::commands();
    let of_table: Vec<&str> = COMMANDS.iter().map(|base| tree::command_of(base, &commands).0.as_str()).collect();
    for (name, _) in &commands {
        assert!(of_table.contains(&name.as_str()) || WITHOUT_VALUES.contains(&name.as_str()), "{name}: add it");
    }
}

#[test]
fn hostile_values() {
    let mut runs: Vec<Vec<OsString>> = Vec::new();
    // By default each option gets one sixth of the values, a different sixth than its neighbors.
    let full = is_full();
    for (number, (base, option)) in all_options().into_iter().enumerate() {
        let base = || base.iter().map(OsString::from).chain([OsString::from(&option)]);
        let (first, step) = if full { (0, 1) } else { (number % 6, 6) };
        runs.extend(
            HOSTILE
                .iter()
                .chain(LONG)
                .skip(first)
                .step_by(step)
                .map(|value| base().chain([OsString::from(value)]).collect()),
        );
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

/// Values that the option itself must refuse, with messages that name the fault.
#[test]
fn what_is_wrong_is_said() {
    const LARGE: &str = "too large for a 32-bit float: at most 3.4028235e38";
    let camera = "--renderer path --eye 0,0,0.5 --target 0,1,0.5 --tan-half-height -1";
    let cases = [
        ("nothing-of-the-kind", "nothing-of-the-kind"),
        ("leaky-teapot --size 4x4 -d r200 -d R200", ""),
        ("alu convert --format fp16", "--to"),
        ("render white-box --eye -1e39,0,0", LARGE),
        ("render white-box --eye 1,2", "expected three numbers X,Y,Z, found `1,2`"),
        ("render white-box --tan-half-height 1e39", LARGE),
        (&format!("render white-box {camera}"), "above 0 and up to 1000000, found -1"),
        ("render white-box --exposure -1", "expected a number above 0, found `-1`"),
        ("render white-box --exposure 1e400", "too large for a 64-bit float"),
        ("render white-box --size -1x4", "expected a size as `512x512`, each side 1 to 16384, found `-1x4`"),
        ("radiosity white-box --tolerance -1", "expected a number not below 0, found `-1`"),
        ("cpca precompute transfer-brd --out x.npz", "did you mean `transfer-bird`?"),
        ("cpca precompute white-box --rows 24 --out x.npz", "`--rows` is for glossy transfer"),
        ("cpca precompute white-box --kind glossy --rows 10 --out x.npz", "expected a square from 1 to 100"),
        ("cpca precompute white-box --brdf mirror:1 --out x.npz", "phong:ALBEDO,SPECULAR,EXPONENT"),
        ("cpca precompute white-box --brdf lambert:2 --out x.npz", "expected a number from 0 to 1 for the albedo"),
        ("cpca precompute white-box --brdf phong:0.1,0.5,9 --out x.npz", "diffuse materials for diffuse transfer"),
        ("cpca precompute white-box --tangents texture --out x.npz", "no texture coordinates to take tangents from"),
        ("all-frequency factor --brdf cook-torrance --fresnel 1", "expected a number from 0 to below 1"),
        (
            "all-frequency factor --brdf lambert --side 8 --terms 2",
            "expected 1 to 1 terms, the rank of the table, found 2",
        ),
        ("all-frequency precompute white-box --reflectance nowhere --out x.npz", "nowhere/view_factors.npy"),
        ("cpca render x.npz --model white-box --light disk:0,0,1", "disk:X,Y,Z:DEGREES"),
        ("bi-scale render x.npz --model white-box --texture =mail", "as in floor=tiles"),
        ("bi-scale render x.npz --model white-box --texture mail --repeat 0", "above 0"),
        ("subsurface stand-in-head --mm-per-unit 1", "add `--material NAME` (see `crossbar materials`)"),
        ("subsurface stand-in-head --mm-per-unit 0 --material marble", "expected a number above 0, found `0`"),
        ("subsurface stand-in-heat --mm-per-unit 1 --material marble", "did you mean `stand-in-head`?"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marbel", "did you mean `Marble`?"),
        ("subsurface stand-in-head --mm-per-unit 1 --sigma-s -1 --sigma-a 1", "a number of at least 0, or three"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --links 15", "has 15 clusters"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --atlas 100 --choice adaptive", "power of two"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --atlas 64 --links 4 --all-pairs no", "128"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --atlas 4097", "power of two"),
        ("atlas stand-in-head --side 4097", "power of two"),
        ("atlas stand-in-head --side 100", "power of two"),
        ("materials chiken1", "did you mean `Chicken1`?"),
        (
            "subsurface stand-in-head --mm-per-unit 1 --material marble --eta 4",
            "an index of refraction from 1 to 3, found 4",
        ),
        ("cpca render x.npz --model white-box --light disk:0,0,1:1e300", "at most 180 degrees, found `1e300`"),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --light sun:1,1,1", "directional:X,Y,Z:R,G,B"),
        (
            "subsurface stand-in-head --mm-per-unit 1 --material marble --light ambient:0,0,0",
            "expected light on the model",
        ),
        ("subsurface stand-in-head --mm-per-unit 1 --material marble --device r200", "expected one of nv30, nv35"),
        ("timeline --eye-rays -1,2", "found `-1,2`"),
        ("timeline nowhere.toml --out x", "unexpected argument '--out' found Usage: crossbar timeline"),
        ("precision raydiosity", "did you mean `radiosity`? there are ray-engine, radiosity"),
        ("intersect --mesh a.obj --rays r.csv --out h.csv --executor exact --device r200", "`--device` is for"),
        (
            "radiosity white-box --solver direct --tolerance 1e-3",
            "`--tolerance` and `--iterations` are for solvers that",
        ),
        ("reproduce --list nowhere", "`nowhere`"),
        ("diff a.png b.png --scale 0.1", "--out <DIR>"),
        ("atlas stand-in-head --size 4x4", "--out <DIR>"),
        ("leaky-teapot --kernel paper --kernel paper", "expected different values of `--kernel`, found `paper` twice"),
        ("radiosity white-box --solver direct --solver direct", "of `--solver`, found `direct` twice"),
        ("tour --coarser nan", "expected a whole number from 1 to 8, found `nan`"),
        ("render white-box --seed abc", "expected a whole number from 0 to 18446744073709551615, found `abc`"),
        ("matmul a.npy b.npy --unit hopper-fp8 --type f99", "expected one of "),
        ("run nowhere.toml --trace -1,2", "expected a pixel as `3,4`, column and row from 0; found `-1,2`"),
        ("compare nowhere.toml --pixel -1,2", "found `-1,2`"),
        ("cpca precompute white-box --kind glossy --brdf phong:0.5,0.6,9 --out x.npz", "sum of albedo and specular"),
        ("alu add --format fp16 --verify", "expected at least one line to verify, found none"),
        ("alu add --format fp16 --verify --json", "expected at least one line to verify, found none"),
    ];
    for (arguments, words) in cases {
        let arguments: Vec<OsString> = arguments.split(' ').map(OsString::from).collect();
        let folder = tempfile::tempdir().expect("a folder for the test");
        let Said { code, stdout, stderr } = said(folder.path(), &arguments);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{arguments:?}: {stderr}");
        assert!(crate::answers::words(&stderr).contains(words), "{arguments:?}: {stderr}");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0, "{arguments:?}");
    }
}
