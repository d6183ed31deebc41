//! The import law: a room uses only the rooms that its line allows. docs/architecture.md prints the same table.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A crate's source folder, and for each room of it the rooms that it may name.
type Law = (&'static str, &'static [(&'static str, &'static [&'static str])]);

const REFSIM: Law = (
    "refsim/src",
    &[
        ("num", &[]),
        ("isa", &["num"]),
        ("asm", &["num", "isa"]),
        ("device", &["num", "isa"]),
        ("check", &["num", "isa", "device"]),
        ("event", &["isa"]),
        ("texture", &["num", "device"]),
        ("raster", &["num", "device", "texture"]),
        ("output", &["num", "device", "texture", "raster"]),
        ("exec", &["num", "isa", "device", "check", "texture", "raster", "output", "event"]),
        ("machine", &["num", "isa", "device", "check", "texture", "raster", "output", "exec", "event"]),
        ("timing", &["isa", "device", "event"]),
        ("lib", &[]),
    ],
);

const CROSSBAR: Law = (
    "src",
    &[
        ("linalg", &[]),
        ("elementary", &[]),
        ("geom", &["linalg"]),
        ("tracer", &["geom"]),
        ("scene", &["elementary", "geom", "linalg"]),
        ("io", &["geom", "scene", "linalg"]),
        ("card", &[]),
        ("report", &["elementary"]),
        ("shader", &["io", "report"]),
        ("compare", &[]),
        ("oracle", &["geom", "compare", "linalg"]),
        ("case", &["io", "geom", "scene", "report", "shader", "compare"]),
        ("radiosity", &["card", "tracer", "elementary", "geom", "scene", "linalg", "io"]),
        ("ray_engine", &["card", "tracer", "geom", "scene", "linalg", "io"]),
        ("renderer", &["tracer", "elementary", "geom", "scene", "linalg"]),
        (
            "study",
            &[
                "ray_engine",
                "radiosity",
                "renderer",
                "report",
                "card",
                "tracer",
                "elementary",
                "geom",
                "scene",
                "linalg",
                "io",
            ],
        ),
        (
            "cli",
            &[
                "study",
                "ray_engine",
                "radiosity",
                "renderer",
                "case",
                "compare",
                "shader",
                "report",
                "card",
                "tracer",
                "geom",
                "scene",
                "linalg",
                "io",
            ],
        ),
        ("lib", &[]),
        ("main", &["cli"]),
    ],
);

/// Rooms of the root package that may speak to the emulator at all; the shared ground knows nothing of cards.
const SPEAKS_REFSIM: &[&str] =
    &["card", "tracer", "case", "compare", "shader", "radiosity", "ray_engine", "study", "cli"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the source folders can be read") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            rust_files(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push(path);
        }
    }
}

/// The first component below `source`, without `.rs`.
fn room_of(path: &Path, source: &Path) -> String {
    let relative = path.strip_prefix(source).expect("below the source folder");
    let first = relative.components().next().expect("a component").as_os_str().to_string_lossy().into_owned();
    first.trim_end_matches(".rs").to_owned()
}

/// The names that follow `prefix` in code (comments and doc links left out), `{a, b}` groups included.
fn named_after(text: &str, prefix: &str) -> BTreeSet<String> {
    let code: String = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let mut names = BTreeSet::new();
    for (at, _) in code.match_indices(prefix) {
        let preceded = code[..at].chars().next_back().is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$');
        if preceded && !code[..at].ends_with('$') {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        if let Some(group) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut start = true;
            for (i, c) in group.char_indices() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => start = true,
                    c if start && c.is_alphanumeric() => {
                        names.insert(identifier(&group[i..]));
                        start = false;
                    }
                    _ => {}
                }
            }
        } else {
            names.insert(identifier(rest));
        }
    }
    names
}

fn identifier(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

fn violations((source, law): Law, crate_name: &str) -> Vec<String> {
    let source = root().join(source);
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let rooms: BTreeSet<&str> = law.iter().map(|(room, _)| *room).collect();
    let mut found = Vec::new();
    for file in files {
        let room = room_of(&file, &source);
        let Some((_, allowed)) = law.iter().find(|(r, _)| *r == room) else {
            found.push(format!("{}: room `{room}` is not in the law's table", file.display()));
            continue;
        };
        let text = fs::read_to_string(&file).expect("a source file");
        let mut used = named_after(&text, "crate::");
        used.extend(named_after(&text, &format!("{crate_name}::")));
        for name in used {
            if rooms.contains(name.as_str()) && name != room && !allowed.contains(&name.as_str()) {
                found.push(format!("{}: `{room}` uses `{name}`", file.display()));
            }
        }
    }
    found
}

#[test]
fn rooms_use_only_what_stands_to_their_left() {
    let mut found = violations(REFSIM, "refsim");
    found.extend(violations(CROSSBAR, "crossbar"));
    assert!(found.is_empty(), "the import law is broken:\n{}", found.join("\n"));
}

#[test]
fn the_shared_ground_knows_nothing_of_cards() {
    let source = root().join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    for file in files {
        let room = room_of(&file, &source);
        let text = fs::read_to_string(&file).expect("a source file");
        let speaks = !named_after(&text, "refsim::").is_empty();
        assert!(!speaks || SPEAKS_REFSIM.contains(&room.as_str()), "{}: `{room}` speaks refsim", file.display());
    }
}

#[test]
fn the_emulator_depends_on_nothing_heavy() {
    let manifest = fs::read_to_string(root().join("refsim/Cargo.toml")).expect("refsim's manifest");
    let (dependencies, _) = manifest.split_once("[dev-dependencies]").expect("both tables");
    for banned in ["crossbar", "nalgebra", "image", "clap"] {
        assert!(!dependencies.contains(banned), "refsim depends on `{banned}`");
    }
    // The GPU's driver side comes only to who asks for it.
    let gpu = dependencies.lines().find(|line| line.starts_with("wgpu = {")).expect("wgpu, by feature");
    assert!(gpu.contains("optional = true"), "refsim depends on `wgpu` without being asked");
    assert!(!dependencies.contains("default = ["), "refsim has default features");
}

/// nalgebra's product chooses its kernel by the processor if other crates turn its `std` on: docs/decisions/0016.
#[test]
fn only_linalg_names_nalgebra() {
    let source = root().join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    for file in files.iter().filter(|file| room_of(file, &source) != "linalg") {
        let text = fs::read_to_string(file).expect("a source file");
        assert!(named_after(&text, "nalgebra::").is_empty(), "{}: take it from `linalg`", file.display());
    }
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("the manifest");
    for comparison in ["bvh", "parry3d", "obvhs"] {
        assert!(!manifest.contains(comparison), "`{comparison}` belongs into benches/Cargo.toml");
    }
}

#[test]
fn the_scanner_sees_groups_and_passes_over_comments() {
    let names = named_after(
        "use crate::{num::Format, isa::{Mask, Swizzle}};\n// crate::exec\nlet x = crate::asm::f();",
        "crate::",
    );
    assert_eq!(names.into_iter().collect::<Vec<_>>(), ["asm", "isa", "num"], "two from the group, one in line");
}
