//! Files of other kinds, files that claim huge sizes, and output paths that cannot be written.

use std::ffi::OsString;

use rayon::prelude::*;

use super::{Files, assert_refused};

/// Gives every option for an input file every kind of unsuitable file.
#[test]
fn hostile_files() {
    let commands: [&[&str]; 18] = [
        &["check", "IN", "--device", "r200"],
        &["run", "IN"],
        &["compare", "IN"],
        &["timeline", "IN"],
        &["render", "IN"],
        &["render", "IN", "--renderer", "eye"],
        &["radiosity", "IN"],
        &["bi-scale", "bicluster", "IN"],
        &["bi-scale", "compare", "IN"],
        &["cpca", "compress", "IN", "--out", "y.npz"],
        &["cpca", "error", "IN", "IN"],
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
        for bytes in contents {
            for name in ["in.obj", "in.toml", "in.csv"] {
                runs.push((with(name), [&good[..], &[(name, bytes)]].concat()));
            }
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

/// A PNG file whose header claims `side` x `side` RGBA pixels, followed by `length` arbitrary bytes.
fn png_of_noise(side: u32, sample_bits: u8, length: usize) -> Vec<u8> {
    let header = [&b"IHDR"[..], &side.to_be_bytes(), &side.to_be_bytes(), &[sample_bits, 6, 0, 0, 0]].concat();
    let chunk = |body: &[u8]| {
        let length = (body.len() as u32 - 4).to_be_bytes();
        [&length[..], body, &crc32fast::hash(body).to_be_bytes()].concat()
    };
    let noise = [&b"IDAT"[..], &b"nothing ".repeat(length / 8)].concat();
    [b"\x89PNG\r\n\x1a\n".to_vec(), chunk(&header), chunk(&noise), chunk(b"IEND")].concat()
}

/// A picture with too many pixels for the program, the command or its file's size is refused because of its header,
/// whatever its contents.
#[test]
fn large_pictures_are_refused_by_their_headers() {
    let (huge, large, cut) = (png_of_noise(9000, 16, 8), png_of_noise(7000, 8, 200_000), png_of_noise(7000, 8, 8));
    for (arguments, words) in [
        (&["diff", "huge.png", "huge.png"][..], "found 9000x9000 with 4 channels"),
        (&["diff", "huge.png", "huge.png"], "16384 pixels per side"),
        (&["bi-scale", "texture", "large.png", "--out", "b.npy"], "expected 1 to 1024 texels"),
        (&["diff", "cut.png", "cut.png"], "for the 7000x7000 pixels that its header says"),
    ] {
        let files: [(&str, &[u8]); 3] = [("huge.png", &huge), ("large.png", &large), ("cut.png", &cut)];
        let arguments: Vec<OsString> = arguments.iter().map(OsString::from).collect();
        let stderr = assert_refused(&arguments, &files);
        assert!(crate::answers::words(&stderr).contains(words), "{arguments:?}: {stderr}");
    }
}

/// A scene without light sources is refused before the computation, which would take minutes here.
#[test]
fn a_dark_scene_is_refused_before_the_work() {
    let side = 40;
    let (mut model, vertex) = (String::new(), |x: u32, y: u32| y * (side + 1) + x + 1);
    for (x, y) in (0..=side).flat_map(|y| (0..=side).map(move |x| (x, y))) {
        model.push_str(&format!("v {x} {y} {}\n", (x * 7 + y * 13) % 5));
    }
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let [a, b, c, d] = [vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)];
        model.push_str(&format!("f {a} {b} {c}\nf {a} {c} {d}\n"));
    }
    let start = std::time::Instant::now();
    let stderr = assert_refused(&["radiosity", "m.obj"].map(OsString::from), &[("m.obj", model.as_bytes())]);
    assert!(stderr.contains("radiosity::dark"), "{stderr}");
    assert!(start.elapsed() < std::time::Duration::from_secs(20), "{:?}", start.elapsed());
}

/// Gives every option for an output path every kind of path that cannot be written.
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
