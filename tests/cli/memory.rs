//! Work that does not fit into memory is refused before it begins: the estimate in the message is at least the memory
//! actually used.

use std::fs;
use std::path::Path;

use crossbar::picture::{RgbImage, png};

use crate::{crossbar_in, start};

/// Commands with large work, each with an input from [`inputs`].
const LARGE: &[&[&str]] = &[
    &["render", "square.obj", "--size", "16384x16384"],
    &["render", "square.obj", "--size", "16384x16384", "--device", "r200"],
    &["render", "white-box", "--size", "16384x16384", "--renderer", "path"],
    &["render", "white-box", "--size", "8x8", "--renderer", "photon", "--photons", "4294967295"],
    &["atlas", "square.obj", "--side", "8192"],
    &["leaky-teapot", "--size", "16384x16384"],
    &["leaky-teapot", "--size", "8x8", "--tessellation", "64", "--rays-per-edge", "64"],
    &["timeline", "--eye-rays", "16384x16384"],
    &["timeline", "--eye-rays", "16384x16384", "--mesh", "square.obj"],
    &["radiosity", "white-box", "--patches", "16384"],
    &["radiosity", "white-box", "--size", "16384x16384"],
    &["run", "large.toml"],
    &["compare", "large.toml"],
    &["timeline", "large.toml", "--device", "r300"],
    &["diff", "large.png", "large.png"],
    &["cpca", "compress", "large.csv", "--out", "y.npz"],
    &[
        "cpca",
        "precompute",
        "transfer-polygons",
        "--kind",
        "glossy",
        "--rows",
        "100",
        "--order",
        "10",
        "--out",
        "x.npz",
    ],
    &["cpca", "render", "step_small.npz", "--model", "step.obj", "--size", "16384x16384"],
    &["all-frequency", "factor", "--brdf", "phong", "--side", "48"],
    &["intersect", "--mesh", "square.obj", "--rays", "many.csv", "--out", "h.csv"],
    &["intersect", "--mesh", "large.obj", "--rays", "few.csv", "--out", "h.csv"],
];

fn inputs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let put = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).expect("a file");
    put("square.obj", &fs::read(root.join("fixtures/models/square.obj")).expect("a fixture"));
    let case = fs::read_to_string(root.join("fixtures/cases/modulate.toml")).expect("a fixture");
    let (front, target) = case.split_once("[target]").expect("its target");
    put("large.toml", format!("{front}[target]{}", target.replacen("[2, 2]", "[2048, 2048]", 1)).as_bytes());
    let header = b"ox,oy,oz,dx,dy,dz\n";
    put("few.csv", &[header, &b"0,0,1,0,0,-1\n"[..]].concat());
    put("many.csv", &[&header[..], &b"0,0,1,0,0,-1\n".repeat(1_000_000)].concat());
    let [small, medium] = [[16, 16], [1024, 1024]].map(|size| {
        let (target, _) = target.split_once("# Half").expect("its probes");
        format!("{front}[target]{}", target.replacen("[2, 2]", &format!("{size:?}"), 1))
    });
    put("small.toml", small.as_bytes());
    put("medium.toml", medium.as_bytes());
    let faces: String = (1..99_999).map(|i| format!("f {i} {} {}\n", i + 1, i + 2)).collect();
    put("medium.obj", format!("{}{faces}", "v 0.125 0.25 0.5\n".repeat(100_001)).as_bytes());
    let picture = |side: u32| png(&RgbImage::new(side, side)).expect("a file");
    put("small.png", &picture(64));
    put("medium.png", &picture(512));
    put("large.png", &picture(2048));
    put("large.csv", &b"0.25,0.5,-1\n".repeat(2_000_000));
    for name in ["step.obj", "step_small.npz"] {
        put(name, &fs::read(root.join("docs/examples").join(name)).expect("an example"));
    }
    put("large.obj", &b"v 0.0000000 0.0000000 0.0000000\n".repeat(500_000));
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn too_much_is_refused_with_the_limit_named() {
    let folder = inputs();
    let before = names(folder.path());
    for arguments in LARGE {
        let ran = crossbar_in(folder.path(), &[arguments, &["--memory-limit", "64MiB"][..]].concat(), "");
        assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.stderr);
        assert!(ran.stderr.contains("crossbar::memory"), "{arguments:?}: {}", ran.stderr);
        // Lines are wrapped at spaces and hyphens.
        let stderr = ran.stderr.replace(|c: char| c == '|' || c.is_whitespace(), "");
        assert!(stderr.contains("64.0MiBareallowedby`--memory-limit`"), "{arguments:?}: {}", ran.stderr);
        assert_eq!(names(folder.path()), before, "{arguments:?} writes nothing");
    }
    let ran = crossbar_in(folder.path(), &["leaky-teapot", "--size", "2048x2048", "--memory-limit", "1GiB"], "");
    insta::assert_snapshot!(ran.stderr);
    let ran = crossbar_in(folder.path(), &["render", "square.obj", "--size", "8x8", "--memory-limit", "much"], "");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
}

/// The process's own memory limit counts, without any option.
#[test]
#[cfg(target_os = "linux")]
fn a_limited_process_refuses_and_does_not_abort() {
    let folder = inputs();
    let before = names(folder.path());
    // With less than the first limit, the system may not even load the program.
    for kibibytes in ["500000", "1500000"] {
        let small = |arguments: &&[&str]| {
            arguments[0] == "intersect"
                || ["compress", "factor"].contains(&arguments[1])
                || arguments.contains(&"large.toml")
        };
        for arguments in LARGE.iter().filter(|arguments| !small(arguments)) {
            let mut command = std::process::Command::new("sh");
            command.args(["-c", "ulimit -v \"$0\"; exec \"$@\"", kibibytes, crate::program::path()]);
            let output = command.args(*arguments).current_dir(folder.path()).output().expect("a shell");
            let stderr = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?} in {kibibytes} KiB: {stderr}");
            assert!(stderr.contains("crossbar::memory"), "{arguments:?} in {kibibytes} KiB: {stderr}");
            assert_eq!(names(folder.path()), before, "{arguments:?} writes nothing");
        }
    }
}

/// Address space that threads and allocators reserve counts too: the result is a message or success, never an abort.
#[test]
#[cfg(target_os = "linux")]
fn little_address_space_is_no_abort() {
    for kibibytes in ["150000", "200000", "250000", "300000", "350000", "400000"] {
        for arguments in [
            &["render", "office", "--size", "16x16", "--out", "o"][..],
            &["radiosity", "white-box", "--size", "8x8", "--patches", "60", "--out", "o"],
        ] {
            for _ in 0..2 {
                let folder = tempfile::tempdir().expect("a folder for the test");
                let mut command = std::process::Command::new("sh");
                command.args(["-c", "ulimit -v \"$0\"; exec \"$@\"", kibibytes, crate::program::path()]);
                let output = command.args(arguments).current_dir(folder.path()).output().expect("a shell");
                let stderr = String::from_utf8_lossy(&output.stderr);
                let refused = output.status.code() == Some(2) && stderr.contains("crossbar::memory");
                assert!(refused || output.status.success(), "{arguments:?} in {kibibytes} KiB: {stderr}");
            }
        }
    }
}

/// The memory in bytes that a command says it needs when the limit is too small; 0 if 1 MiB suffices.
fn said(folder: &Path, arguments: &[&str]) -> f64 {
    let ran = crossbar_in(folder, &[arguments, &["--memory-limit", "1MiB", "--json"]].concat(), "");
    if ran.code == Some(0) {
        // It runs within 1 MiB.
        return 0.0;
    }
    let error: serde_json::Value = serde_json::from_str(&ran.stderr).expect("one JSON document");
    let message = error["message"].as_str().expect("a message");
    let (_, rest) = message.split_once("takes up to ").unwrap_or_else(|| panic!("{arguments:?}: {message}"));
    let (size, _) = rest.split_once(" of memory").expect("a size");
    size.parse::<bytesize::ByteSize>().expect("a size").as_u64() as f64
}

/// The peak resident memory of a run in bytes, polled from the kernel's `VmHWM`. `wait4`'s figure would begin at the
/// size of the parent process, and these tests are large.
#[cfg(target_os = "linux")]
fn peak(folder: &Path, arguments: &[&str]) -> f64 {
    let mut child = start(folder, arguments);
    let status = format!("/proc/{}/status", child.id());
    let mut kibibytes = 0_u64;
    loop {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let now = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse().ok());
        kibibytes = kibibytes.max(now.unwrap_or(0));
        if let Some(status) = child.try_wait().expect("a child") {
            assert_eq!(status.code(), Some(0), "{arguments:?}");
            return (kibibytes * 1024) as f64;
        }
        std::thread::sleep(std::time::Duration::from_micros(500));
    }
}

/// The estimate against the measurement: both as the increase over the same command with little work.
#[test]
#[cfg(target_os = "linux")]
fn what_is_said_is_what_is_taken() {
    let folder = inputs();
    let peak = |arguments: &[&str]| peak(folder.path(), arguments);
    let sized = |command: &'static str, small: &'static str, large: &'static str| {
        [small, large].map(|size| command.replace("SIZE", size).leak().split(' ').collect::<Vec<&str>>())
    };
    let measured = [
        sized("render square.obj --size SIZE", "64x64", "1024x1024"),
        sized("render square.obj --device r200 --size SIZE", "64x64", "1024x1024"),
        sized("render white-box --renderer distributed --samples 1 --size SIZE", "64x64", "512x512"),
        sized("render white-box --renderer photon --samples 1 --gather 0 --size 8x8 --photons SIZE", "1000", "100000"),
        sized("atlas square.obj --side SIZE", "64", "1024"),
        sized("atlas square.obj --size 8x8 --out atlas --side SIZE", "64", "1024"),
        sized("leaky-teapot --format fp32 --tessellation 2 --rays-per-edge 0 --size SIZE", "32x32", "512x512"),
        sized("leaky-teapot --format fp32 --tessellation 4 --size 8x8 --rays-per-edge SIZE", "1", "64"),
        sized("timeline --mesh square.obj --eye-rays SIZE", "32x32", "640x640"),
        sized(
            "radiosity white-box --factors unoccluded --solver card --iterations 2 --size 8x8 --patches SIZE",
            "100",
            "800",
        ),
        sized("run SIZE.toml --executor batch", "small", "medium"),
        sized("diff SIZE.png SIZE.png --out maps", "small", "medium"),
        sized("intersect --mesh square.obj --rays SIZE.csv --out h.csv", "few", "many"),
        sized("cpca render step_small.npz --model step.obj --out prt --size SIZE", "64x64", "512x512"),
        sized("all-frequency factor --brdf phong --supersamples 1x1 --out f --side SIZE", "8", "32"),
        sized("intersect --mesh SIZE.obj --rays few.csv --out h.csv", "square", "medium"),
    ];
    for [small, large] in &measured {
        let [grown, told] = [peak(large) - peak(small), said(folder.path(), large) - said(folder.path(), small)];
        assert!(grown < told, "{large:?} takes {grown:.3e} bytes more than {small:?}, and says {told:.3e}");
    }
}
