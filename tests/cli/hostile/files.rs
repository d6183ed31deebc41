//! Files of other kinds, files that claim huge sizes, and output paths that cannot be written.

use std::ffi::OsString;

use rayon::prelude::*;

use super::{Files, assert_refused, said};
use crate::answers::folder_with;
use crate::environment::is_full;

/// Tries every kind of unsuitable file for every option that takes an input file.
#[test]
fn hostile_files() {
    let commands: [&[&str]; 16] = [
        &["check", "IN", "--device", "r200"],
        &["run", "IN"],
        &["compare", "IN"],
        &["timeline", "IN"],
        &["render", "IN"],
        &["render", "IN", "--renderer", "eye"],
        &["radiosity", "IN"],
        &["bi-scale", "bicluster", "IN"],
        &["cpca", "compress", "IN", "--out", "y.npz"],
        &["all-frequency", "factor", "--table", "IN"],
        &["cpca", "precompute", "IN", "--out", "x.npz"],
        &["cpca", "show", "IN"],
        &["bi-scale", "texture", "IN", "--out", "b.npy"],
        &["subsurface", "IN", "--mm-per-unit", "1", "--material", "marble", "--atlas", "4", "--all-pairs", "no"],
        &["intersect", "--mesh", "IN", "--rays", "r.csv", "--out", "h.csv"],
        &["intersect", "--mesh", "m.obj", "--rays", "IN", "--out", "h.csv"],
    ];
    let wide = format!("x{}", "y".repeat(200_000));
    let contents: [&[u8]; 9] = [
        b"",
        b"\n",
        b"\0",
        b"\xff\xfe",
        b"\xef\xbb\xbf",
        b"v 0 0 0\n\0\n",
        wide.as_bytes(),
        b"v 0 0 1e39\nv 0 0 0\nv 0 1 0\nf 1 2 3\n",
        b"\x1b[2J\xc2\x9b",
    ];
    let good: [(&str, &[u8]); 2] =
        [("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), ("r.csv", b"ox,oy,oz,dx,dy,dz\n0,0,1,0,0,-1\n")];
    let mut runs: Vec<(Vec<OsString>, Files<'_>)> = Vec::new();
    for command in commands {
        let with = |input: &str| command.iter().map(|a| OsString::from(a.replace("IN", input))).collect::<Vec<_>>();
        // By default each content has one of the names.
        let names = ["in.obj", "in.toml", "in.csv"];
        for (at, bytes) in contents.into_iter().enumerate() {
            let some = if is_full() { &names[..] } else { &names[(at + runs.len()) % 3..][..1] };
            runs.extend(some.iter().map(|name| (with(name), [&good[..], &[(*name, bytes)]].concat())));
        }
        runs.push((with("."), good.to_vec()));
        runs.push((with("m.obj/x"), good.to_vec()));
        #[cfg(target_os = "linux")]
        for device in ["/dev/null", "/proc/self/mem", "/dev/zero"] {
            runs.push((with(device), good.to_vec()));
        }
    }
    runs.par_iter().for_each(|(arguments, files)| {
        let stderr = assert_refused(arguments, files);
        assert!(stderr.len() < 4000, "{arguments:?}: a message of {} bytes", stderr.len());
    });
}

/// Tries every kind of unwritable path for every option that takes an output path.
#[test]
fn hostile_places_for_results() {
    let files: [(&str, &[u8]); 3] = [
        ("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("r.csv", b"ox,oy,oz,dx,dy,dz\n0,0,1,0,0,-1\n"),
        ("file", b"mine"),
    ];
    let case = crate::case::example("modulate");
    let folders: [&[&str]; 7] = [
        &["man"],
        &["run", &case],
        &["render", "m.obj", "--size", "4x4"],
        &["render", "white-box", "--size", "2x2"],
        &["scene", "white-box"],
        &["leaky-teapot", "--size", "2x2", "--tessellation", "1", "--format", "fp32"],
        &["reproduce", "ray-engine-equation-11"],
    ];
    let not_folders = ["", "file", "file/x", "/dev/null", "/dev/null/x", "/proc/nowhere", "/dev/stdout"];
    let single: [&[&str]; 2] =
        [&["intersect", "--mesh", "m.obj", "--rays", "r.csv", "--out"], &["timeline", &case, "--perfetto"]];
    let not_files = ["", ".", "/", "..", "file/x", "/proc/nowhere", "/dev/full"];
    let mut runs: Vec<Vec<OsString>> = Vec::new();
    for (commands, places, option) in
        [(&folders[..], &not_folders[..], Some("--out")), (&single[..], &not_files[..], None)]
    {
        for (command, place) in commands.iter().flat_map(|command| places.iter().map(move |place| (command, place))) {
            let words = command.iter().copied().chain(option).chain([*place]);
            runs.push(words.map(OsString::from).collect());
        }
    }
    runs.par_iter().for_each(|arguments| {
        assert_refused(arguments, &files);
    });
}

/// No command replaces a file that it reads, whether it writes a file or a folder. The first two are refused before the
/// work, the last when it writes.
#[test]
fn inputs_are_not_overwritten() {
    let (mesh, rays) = (&b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"[..], &b"ox,oy,oz,dx,dy,dz\n0,0,1,0,0,-1\n"[..]);
    let picture = include_bytes!("../../../docs/examples/exact.png");
    let files = [("m.obj", mesh), ("r.csv", rays), ("first.png", picture), ("b.png", picture)];
    for command in [
        "intersect --mesh m.obj --rays r.csv --out m.obj",
        "intersect --mesh m.obj --rays r.csv --out ./r.csv",
        "diff b.png first.png --out .",
    ] {
        let (folder, arguments) = (folder_with(&files), command.split(' ').map(OsString::from).collect::<Vec<_>>());
        let found = said(folder.path(), &arguments);
        assert_eq!((found.code, found.stderr.contains("reads")), (Some(2), true), "{command}");
        for (name, bytes) in files {
            assert_eq!(std::fs::read(folder.path().join(name)).expect("a file"), bytes, "{command}: {name}");
        }
    }
}
