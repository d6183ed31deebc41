//! Parts of a run, in any order: merged, they equal the files of one run.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::commands::copy_of_the_repository;
use crate::crossbar_in;
use crate::random::Random;

/// Commands that split, on small input. The result goes to `out`, with an extension if it is a file.
const COMMANDS: &[&str] = &[
    "cpca precompute docs/examples/court.obj --order 3 --out out.npz",
    "cpca precompute docs/examples/step.obj --kind glossy --rows 9 --order 2 --degree 18 --brdf phong:0.2,0.6,9 \
     --bounces 2 --channels rgb --out out.npz",
    "cpca precompute docs/examples/step.obj --order 2 --brdf lambert:0 --material marble --mm-per-unit 10 --out out.npz",
    "all-frequency precompute docs/examples/step.obj --out out.npz",
    "all-frequency precompute docs/examples/step.obj --ground 5 --out out.npz",
    "all-frequency compress docs/examples/step_all.npz --model docs/examples/step.obj --points-per-cluster 15 --vectors 2 \
     --out out.npz",
    "bi-scale precompute docs/examples/court.obj --directions 3 --out out.npz",
    "leaky-teapot --size 24x16 --tessellation 1 --rays-per-edge 1 --format fp16 --format s3.12 --format fp32 --out out",
    "leaky-teapot --mesh docs/examples/step.obj --rays docs/examples/rays.csv --rays-per-edge 0 --device r200 \
     --device nv35 --out out",
    "radiosity cornell-room --patches 13 --size 8x8 --solver direct --solver card --iterations 2 --sweep-patches 8,20 --out out",
    "radiosity docs/examples/room.toml --patches 30 --size 8x8 --solver direct --out out",
    "subsurface docs/examples/sphere.obj --mm-per-unit 5 --material marble --atlas 64 --choice fixed --choice adaptive \
     --links 4 --size 8x8 --out out",
    "precision docs/examples/lerp.toml --goal largest_codes<=0 --out out",
    "precision docs/examples/lerp.toml --family fixed --budget 90 --out out",
];

fn shuffle<T>(random: &mut Random, items: &mut [T]) {
    for end in (1..items.len()).rev() {
        items.swap(end, random.below(end + 1));
    }
}

/// Runs a command that must succeed.
fn run(folder: &Path, words: &[&str]) -> String {
    let ran = crossbar_in(folder, words, "");
    assert_eq!(ran.code, Some(0), "{words:?}: {}", ran.transcript());
    ran.stdout
}

/// The command with another `--out`, and `--part`.
fn part(command: &str, part: &str, out: &str) -> String {
    let (command, _) = command.split_once(" --out ").expect("an output");
    format!("{command} --part {part} --out {out}")
}

fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Collects and removes the files that a command wrote, by path: those that begin with `out`.
fn written(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn take(path: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
        if path.is_file() {
            found.insert(path.to_owned(), fs::read(path).expect("a file"));
            return;
        }
        fs::read_dir(path).expect("a folder").flatten().for_each(|entry| take(&entry.path(), found));
    }
    let mut found = BTreeMap::new();
    let entries: Vec<PathBuf> = fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    let own = |path: &&PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("out"));
    for path in entries.iter().filter(own) {
        take(path, &mut found);
        let removed = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
        removed.expect("removed");
    }
    found
}

/// Standard output without times.
fn without_times(said: &str) -> String {
    said.split_inclusive('\n').filter(|line| !line.starts_with("time ")).collect()
}

/// Any number of parts, more than items among them, in any order, on any number of threads.
#[test]
fn merged_parts_are_the_files_of_one_run() {
    let mut random = Random::new(47);
    for &command in COMMANDS {
        let folder = copy_of_the_repository();
        let folder = folder.path();
        let said = run(folder, &words(command));
        let whole = written(folder);
        assert!(!whole.is_empty(), "{command}");
        // One command with more parts than vertices.
        let many = if command.contains("--order 3") { Some(47) } else { None };
        for of in [1 + random.below(6)].into_iter().chain(many) {
            let mut files: Vec<String> = (1..=of).map(|number| format!("{number}.part")).collect();
            let mut order: Vec<usize> = (1..=of).collect();
            shuffle(&mut random, &mut order);
            for number in order {
                let line = part(command, &format!("{number}/{of}"), &files[number - 1]);
                let threads = random.of(&["1", "3"]);
                run(folder, &[&words(&line)[..], &["--threads", threads]].concat());
            }
            assert!(written(folder).is_empty(), "{command}: a part writes its own file alone");
            shuffle(&mut random, &mut files);
            let out = command.rsplit(' ').next().expect("a name");
            let names: Vec<&str> = files.iter().map(String::as_str).collect();
            let merged = run(folder, &[&["merge"], &names[..], &["--out", out]].concat());
            assert_eq!(without_times(&merged), without_times(&said), "{command}");
            let found = written(folder);
            assert!(found == whole, "{command}, {of} parts: {:?}", found.keys());
        }
    }
}

/// Both parts of a small command.
fn two_parts() -> tempfile::TempDir {
    let folder = copy_of_the_repository();
    for number in ["1", "2"] {
        run(folder.path(), &words(&part(COMMANDS[0], &format!("{number}/2"), &format!("{number}.part"))));
    }
    folder
}

/// The message about parts that are refused: the error's code, its sentence and its help, without digests and commits.
fn refusal(folder: &Path, line: &str) -> String {
    let before = fs::read_dir(folder).expect("a folder").count();
    let ran = crossbar_in(folder, &[&words(line)[..], &["--json"]].concat(), "");
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{line}: {}", ran.stderr);
    assert_eq!(fs::read_dir(folder).expect("a folder").count(), before, "{line} leaves nothing");
    let error: Value = serde_json::from_str(&ran.stderr).expect("one JSON document");
    let text = |field: &str| error[field].as_str().unwrap_or_default().to_owned();
    let said = format!("$ crossbar {line}\n{}\n{}\n{}\n", text("code"), text("message"), text("help"));
    let mut shown = String::new();
    for word in said.split_inclusive(|c: char| !c.is_ascii_alphanumeric()) {
        let (letters, end) =
            word.split_at(word.len() - usize::from(!word.ends_with(|c: char| c.is_ascii_alphanumeric())));
        let is_digest = letters.len() == 64 && letters.bytes().all(|byte| byte.is_ascii_hexdigit());
        shown.push_str(if is_digest { "DIGEST" } else { letters });
        shown.push_str(end);
    }
    shown
}

/// Each refusal has a reason, and nothing is written.
#[test]
fn parts_that_do_not_fit_are_refused() {
    let folder = two_parts();
    let folder = folder.path();
    let mut said = String::new();
    let mut refuse = |line: &str| said.push_str(&format!("{}\n", refusal(folder, line)));
    let bytes = fs::read(folder.join("2.part")).expect("a part");
    let put = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).expect("written");

    refuse("merge 2.part --out out.npz");
    refuse("merge 2.part 1.part 2.part --out out.npz");
    fs::copy(folder.join("1.part"), folder.join("copy.part")).expect("a copy");
    refuse("merge 2.part 1.part copy.part --out out.npz");
    run(folder, &words(&part(COMMANDS[0], "1/3", "third.part")));
    refuse("merge 1.part third.part --out out.npz");
    run(folder, &words(&part(COMMANDS[3], "2/2", "other.part")));
    refuse("merge 1.part other.part --out out.npz");
    put("short.part", &bytes[..bytes.len() - 1]);
    refuse("merge 1.part short.part --out out.npz");
    let mut edited = bytes.clone();
    let middle = bytes.len() - 100;
    edited[middle] ^= 1;
    put("edited.part", &edited);
    refuse("merge 1.part edited.part --out out.npz");
    put("text.part", b"a text\nof lines\n");
    refuse("merge 1.part text.part --out out.npz");
    put("later.part", &[b"crossbar part, version 9\n{}\n", &bytes[..]].concat());
    refuse("merge 1.part later.part --out out.npz");
    refuse("merge 1.part nowhere.part --out out.npz");
    refuse("merge 1.part docs --out out.npz");
    let mtl = fs::read(folder.join("docs/examples/court.mtl")).expect("materials");
    put("docs/examples/court.mtl", &[&mtl[..], b"# another line\n"].concat());
    refuse("merge 1.part 2.part --out out.npz");
    put("docs/examples/court.mtl", &mtl);
    refuse("merge 1.part 2.part --out docs");
    refuse("cpca precompute docs/examples/step.obj --part 3/2 --out x.part");
    insta::assert_snapshot!(said);
    run(folder, &["merge", "1.part", "2.part", "--out", "out.npz"]);
}

/// A part with a valid digest, but from another program, or of a command that does not split.
#[test]
fn parts_of_other_programs_are_refused() {
    let folder = two_parts();
    let folder = folder.path();
    let bytes = fs::read(folder.join("1.part")).expect("a part");
    let mut lines = bytes.splitn(3, |&byte| byte == b'\n');
    let (first, header) = (lines.next().expect("a line"), lines.next().expect("a line"));
    let results = lines.next().and_then(|rest| rest.len().checked_sub(32).map(|end| &rest[..end])).expect("results");
    let header: Value = serde_json::from_slice(header).expect("the header");
    let forged = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut header = header.clone();
        change(&mut header);
        let mut bytes = [first, b"\n", header.to_string().as_bytes(), b"\n", results].concat();
        let digest = crossbar::report::sha256(&bytes[..]).expect("bytes");
        let digest: Vec<u8> =
            (0..32).map(|at| u8::from_str_radix(&digest[2 * at..2 * at + 2], 16).expect("hexadecimal")).collect();
        bytes.extend(digest);
        fs::write(folder.join(name), bytes).expect("written");
    };
    let mut said = String::new();
    forged("same.part", &|_| ());
    run(folder, &["merge", "same.part", "2.part", "--out", "out.npz"]);
    forged("program.part", &|header| header["command"]["program"] = "0.0.9 (abcdef123)".into());
    let ran = crossbar_in(folder, &["merge", "program.part", "2.part", "--out", "x.npz"], "");
    assert!(ran.code == Some(2) && ran.stderr.contains("crossbar::part::program"), "{}", ran.stderr);
    let mut refuse = |line: &str| said.push_str(&format!("{}\n", refusal(folder, line)));
    forged("man.part", &|header| {
        header["command"]["arguments"] = serde_json::json!(["man"]);
        header["part"] = serde_json::json!({ "number": 1, "of": 1 });
    });
    refuse("merge man.part --out x");
    forged("options.part", &|header| {
        header["command"]["arguments"] = serde_json::json!(["cpca", "precompute", "a.obj", "--colour=red"]);
        header["part"] = serde_json::json!({ "number": 1, "of": 1 });
    });
    refuse("merge options.part --out x");
    forged("count.part", &|header| header["count"] = 3.into());
    refuse("merge count.part 2.part --out x.npz");
    forged("number.part", &|header| header["part"] = serde_json::json!({ "number": 0, "of": 2 }));
    refuse("merge number.part 2.part --out x.npz");
    forged("results.part", &|header| header["part"] = serde_json::json!({ "number": 1, "of": 1 }));
    refuse("merge results.part --out x.npz");
    insta::assert_snapshot!(said);
}

/// Every changed byte of a part is detected.
#[test]
fn damage_is_noticed_wherever_it_is() {
    let folder = two_parts();
    let folder = folder.path();
    let bytes = fs::read(folder.join("1.part")).expect("a part");
    let mut random = Random::new(5);
    for _ in 0..24 {
        let mut damaged = bytes.clone();
        match random.below(3) {
            0 => damaged.truncate(random.below(bytes.len())),
            1 => damaged.push(0),
            _ => damaged[random.below(bytes.len())] ^= 1 << random.below(8),
        }
        fs::write(folder.join("damaged.part"), &damaged).expect("written");
        let ran = crossbar_in(folder, &["merge", "damaged.part", "2.part", "--out", "out.npz"], "");
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{}", ran.stderr);
        assert!(ran.stderr.contains("crossbar::part::file"), "{}", ran.stderr);
        assert!(!folder.join("out.npz").exists());
    }
}

/// Findings of a command that computes a part.
#[test]
fn a_part_says_what_it_is() {
    let folder = copy_of_the_repository();
    insta::assert_snapshot!(run(folder.path(), &words(&part(COMMANDS[0], "2/3", "2.part"))));
    let line = part(COMMANDS[0], "2/40", "2.part");
    let said: Value =
        serde_json::from_str(&run(folder.path(), &[&words(&line)[..], &["--json"]].concat())).expect("JSON");
    let number = |field: &str| said[field].as_u64().expect("a number");
    assert_eq!((number("part"), number("of")), (2, 40));
    assert_eq!(number("first"), number("count") / 40);
    assert_eq!(number("bytes"), fs::metadata(folder.path().join("2.part")).expect("a part").len());
}
