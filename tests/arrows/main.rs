//! Rules for the source: a room (a top-level module) uses only the rooms that the table of this test allows; the files
//! of a room have no circular dependencies; no type name is defined in more than two rooms.

mod circles;
mod names;
mod source;

use std::collections::BTreeSet;
use std::fs;

use circles::room;
use source::{Crate, root};

/// A source folder, the module that contains the rooms, and for each room the rooms that it may name.
type Law = (&'static str, &'static [&'static str], &'static [(&'static str, &'static str)]);

/// The names of a list.
fn listed(list: &str) -> impl Iterator<Item = &str> {
    list.split_whitespace()
}

const REFSIM: Law = (
    "refsim/src",
    &[],
    &[
        ("num", ""),
        ("isa", "num"),
        ("asm", "num isa"),
        ("front", "num isa"),
        ("texel", "num"),
        ("device", "num isa texel"),
        ("check", "num isa device"),
        ("event", "isa"),
        ("texture", "num texel device"),
        ("raster", "num device texture"),
        ("output", "num texel device texture raster"),
        ("exec", "num isa device check texture raster output event"),
        ("machine", "num isa device check texture raster output exec event"),
        ("timing", "isa device event"),
        ("lib", ""),
    ],
);

/// The package below the emulator, which re-exports its `num`.
const LANES: Law =
    ("refsim/lanes/src", &[], &[("num", ""), ("lanes", "num"), ("rows", "num lanes"), ("lib", "lanes rows")]);

const CROSSBAR: Law = (
    "src",
    &[],
    // The rooms of all members of the workspace below `src`, which name each other as rooms of one crate.
    &[
        ("error", ""),
        ("linalg", "error"),
        ("elementary", ""),
        ("fresnel", ""),
        ("names", ""),
        ("quadrature", "elementary"),
        ("picture", "error elementary"),
        ("sphere", "error elementary quadrature picture linalg"),
        ("geom", "error"),
        ("tracer", "error geom"),
        ("scene", "error elementary geom linalg"),
        ("io", "error names picture geom scene linalg"),
        ("card", "tracer picture geom scene"),
        ("atlas", "error elementary geom"),
        ("report", "error elementary picture"),
        ("options", "geom io"),
        ("kept", "error io report"),
        ("shader", "error io report"),
        ("compare", ""),
        ("oracle", "error geom compare"),
        ("case", "error names picture io geom scene report shader compare"),
        ("radiosity", "error card tracer elementary quadrature picture geom atlas scene linalg io"),
        ("subsurface", "error card tracer elementary fresnel quadrature picture geom atlas scene linalg io"),
        ("clustering", "error geom linalg"),
        ("transfer", "error clustering card tracer elementary fresnel quadrature picture sphere geom scene linalg io"),
        ("cpca", "error clustering transfer card tracer elementary quadrature picture sphere geom scene linalg io"),
        ("all_frequency", "error clustering transfer card elementary fresnel picture sphere geom scene linalg io"),
        ("bi_scale", "error clustering transfer card tracer elementary picture sphere geom scene linalg io"),
        ("ray_engine", "error card tracer geom scene linalg io"),
        ("renderer", "error card tracer elementary fresnel picture sphere geom scene linalg"),
        (
            "study",
            "error names ray_engine radiosity subsurface clustering transfer cpca all_frequency bi_scale sphere atlas renderer \
             case shader kept report options picture card tracer elementary geom scene linalg io",
        ),
        (
            "cli",
            "error names study ray_engine radiosity subsurface clustering transfer cpca all_frequency bi_scale sphere atlas \
             renderer case compare shader kept report options picture card tracer geom scene linalg io",
        ),
        ("lib", ""),
        ("main", "cli"),
    ],
);

/// The executors: `scalar` uses none of the others; `batch` and `wgsl` share `lower`. Files of `exec` itself precede
/// all of them.
const EXEC: Law =
    ("refsim/src", &["exec"], &[("scalar", ""), ("lower", ""), ("batch", "lower"), ("wgsl", "lower"), ("gpu", "wgsl")]);

const BATCH: Law = (
    "refsim/src",
    &["exec", "batch"],
    &[
        ("cache", ""),
        ("formats", ""),
        ("schedule", ""),
        ("run", "cache formats schedule"),
        ("vertex", "cache formats schedule run"),
        ("tile", "cache formats schedule run vertex"),
        ("executor", "cache formats schedule run vertex tile"),
    ],
);

/// Rooms of the root package that may use the emulator; the other shared rooms do not depend on cards.
const SPEAKS_REFSIM: &str = "card tracer case compare shader radiosity subsurface clustering transfer cpca all_frequency bi_scale \
     ray_engine study cli renderer";

/// The uses that a law forbids, one line each. A file outside the table's rooms is a violation; if the rooms share
/// files (`below` is not empty), it may name no room.
fn violations((crate_folder, below, law): Law) -> Vec<String> {
    let source = Crate::read(crate_folder);
    let rooms: BTreeSet<&str> = law.iter().map(|(room, _)| *room).collect();
    let in_room = |path: &[String]| {
        (path.len() > below.len() && path.iter().zip(below).all(|(a, b)| a == b)).then(|| path[below.len()].clone())
    };
    let mut found = Vec::new();
    for (module, it) in &source.modules {
        let path: Vec<String> =
            it.file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let Some(room) = in_room(&path) else { continue };
        let allowed = match law.iter().find(|(r, _)| *r == room) {
            Some((_, allowed)) => *allowed,
            None if !below.is_empty() => "",
            None => {
                found.push(format!("{}: room `{room}` is not in the law's table", it.file.display()));
                continue;
            }
        };
        for name in source.paths(module).filter_map(|path| in_room(&path)) {
            if rooms.contains(name.as_str())
                && name != room
                && !listed(allowed).any(|word| word == name)
                && room != "mod"
            {
                found.push(format!("{}: `{room}` uses `{name}`", it.file.display()));
            }
        }
    }
    found
}

#[test]
fn rooms_use_only_what_stands_to_their_left() {
    let found = [REFSIM, LANES, CROSSBAR, EXEC, BATCH].map(violations).concat();
    assert!(found.is_empty(), "the import law is broken:\n{}", found.join("\n"));
}

#[test]
fn the_shared_ground_knows_nothing_of_cards() {
    let source = Crate::read("src");
    for (module, it) in &source.modules {
        let speaks = source.after(module, "refsim").next().is_some();
        let room = room(&it.file);
        assert!(
            !speaks || listed(SPEAKS_REFSIM).any(|word| word == room),
            "{}: `{room}` speaks refsim",
            it.file.display()
        );
    }
}

#[test]
fn only_executors_name_the_lanes() {
    let source = Crate::read("refsim/src");
    for (module, it) in source.modules.iter().filter(|(_, it)| !["exec", "lib"].contains(&room(&it.file).as_str())) {
        let names = source.after(module, "refsim_lanes").next();
        assert!(names.is_none(), "{}: `num` is `crate::num`, and only `exec` needs the rest", it.file.display());
    }
}

#[test]
fn the_emulator_depends_on_nothing_heavy() {
    let manifest = fs::read_to_string(root().join("refsim/Cargo.toml")).expect("refsim's manifest");
    let (dependencies, _) = manifest.split_once("[dev-dependencies]").expect("both tables");
    for banned in ["crossbar", "nalgebra", "image", "clap"] {
        assert!(!dependencies.contains(banned), "refsim depends on `{banned}`");
    }
    // Only the feature `wgpu` adds the dependency on GPU drivers.
    let gpu = dependencies.lines().find(|line| line.starts_with("wgpu = {")).expect("wgpu, by feature");
    assert!(gpu.contains("optional = true"), "refsim depends on `wgpu` without being asked");
    assert!(!dependencies.contains("default = ["), "refsim has default features");
}

/// nalgebra's product chooses its kernel by the CPU if another crate enables its `std`.
#[test]
fn only_linalg_names_nalgebra() {
    let source = Crate::read("src");
    for (module, it) in source.modules.iter().filter(|(_, it)| room(&it.file) != "linalg") {
        assert!(source.after(module, "nalgebra").next().is_none(), "{}: take it from `linalg`", it.file.display());
    }
    let manifests = ["", "src/base/", "src/ground/", "src/systems/", "src/studies/"];
    for manifest in manifests.map(|folder| root().join(folder).join("Cargo.toml")) {
        let text = fs::read_to_string(manifest).expect("a manifest");
        // Only the program's dependencies; the root's profiles also name crates of the benches.
        let dependencies = text.split("[profile.").next().unwrap_or_default();
        for comparison in ["bvh", "parry3d", "obvhs"] {
            assert!(!dependencies.contains(comparison), "`{comparison}` belongs into benches/Cargo.toml");
        }
    }
}
