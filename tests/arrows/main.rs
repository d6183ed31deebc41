//! Laws of the source: a room uses only the rooms that its line allows, as docs/architecture.md prints them; the files
//! of a room need each other in one direction; names and lines of documentation keep their bounds.

mod circles;
mod names;
mod source;

use std::collections::BTreeSet;
use std::fs;

use circles::room;
use source::{Crate, root};

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
        ("geom", &["linalg"]),
        ("scene", &["geom", "linalg"]),
        ("io", &["geom", "scene", "linalg"]),
        ("card", &["geom", "linalg"]),
        ("report", &[]),
        ("shader", &["io", "report"]),
        ("compare", &[]),
        ("oracle", &["geom", "compare", "linalg"]),
        ("case", &["io", "geom", "scene", "report", "shader", "compare"]),
        ("radiosity", &["card", "geom", "scene", "linalg", "io"]),
        ("ray_engine", &["card", "geom", "scene", "linalg", "io"]),
        ("renderer", &["geom", "scene", "linalg"]),
        ("study", &["ray_engine", "radiosity", "renderer", "report", "card", "geom", "scene", "linalg", "io"]),
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
const SPEAKS_REFSIM: &[&str] = &["card", "case", "compare", "shader", "radiosity", "ray_engine", "study", "cli"];

fn violations((folder, law): Law) -> Vec<String> {
    let source = Crate::read(folder);
    let rooms: BTreeSet<&str> = law.iter().map(|(room, _)| *room).collect();
    let mut found = Vec::new();
    for (module, it) in &source.modules {
        let room = room(&it.file);
        let Some((_, allowed)) = law.iter().find(|(r, _)| *r == room) else {
            found.push(format!("{}: room `{room}` is not in the law's table", it.file.display()));
            continue;
        };
        for name in source.after(module, "crate") {
            if rooms.contains(name) && name != room && !allowed.contains(&name) {
                found.push(format!("{}: `{room}` uses `{name}`", it.file.display()));
            }
        }
    }
    found
}

#[test]
fn rooms_use_only_what_stands_to_their_left() {
    let found = [violations(REFSIM), violations(CROSSBAR)].concat();
    assert!(found.is_empty(), "the import law is broken:\n{}", found.join("\n"));
}

#[test]
fn the_shared_ground_knows_nothing_of_cards() {
    let source = Crate::read("src");
    for (module, it) in &source.modules {
        let speaks = source.after(module, "refsim").next().is_some();
        let room = room(&it.file);
        assert!(!speaks || SPEAKS_REFSIM.contains(&room.as_str()), "{}: `{room}` speaks refsim", it.file.display());
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

/// nalgebra's default features choose its product's kernels at run time, which makes bits depend on the processor. The
/// benches compare with a crate that turns them on; that is harmless as long as no code of ours uses nalgebra, since
/// features of bench dependencies reach the library in test builds.
#[test]
fn no_result_depends_on_dispatched_products() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("the manifest");
    let (_, package) = manifest.split_once("\n[dependencies]").expect("the table");
    let (dependencies, _) = package.split_once("[dev-dependencies]").expect("both tables");
    let lock = fs::read_to_string(root().join("Cargo.lock")).expect("the lock file");
    if lock.contains("name = \"matrixmultiply\"") {
        assert!(!dependencies.contains("nalgebra"), "drop the bench's `bvh`, or nalgebra: together they change bits");
    }
}

#[test]
fn the_scanner_sees_groups_and_macros_and_passes_over_comments() {
    let text =
        "use crate::{num::Format, isa::{Mask, Swizzle}};\n// crate::exec\nfn f() { let x = vec![crate::asm::f()]; }";
    let source = Crate::of_texts([("lib.rs".into(), text.to_owned())]);
    let names: BTreeSet<&str> = source.after(&[], "crate").collect();
    assert_eq!(names.into_iter().collect::<Vec<_>>(), ["asm", "isa", "num"], "two from the group, one from the macro");
}
