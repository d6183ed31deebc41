//! The command line that findings state: it includes defaults and omits options without effect.

use crate::commands::copy_of_the_repository;
use crate::crossbar_in;

/// The command that a run writes into its document.
fn resolved(arguments: &[&str]) -> String {
    let folder = copy_of_the_repository();
    let room = std::fs::read(folder.path().join("docs/examples/room.obj")).expect("a model");
    std::fs::write(folder.path().join("docs/examples/it's.obj"), room).expect("written");
    let ran = crossbar_in(folder.path(), &[arguments, &["--json"]].concat(), "");
    assert_eq!(ran.code, Some(0), "{arguments:?}: {}", ran.stderr);
    let document = ran.json();
    document["provenance"]["command"].as_str().expect("a command").to_owned()
}

fn resolved_line(line: &str) -> String {
    resolved(&line.split(' ').collect::<Vec<_>>())
}

#[test]
fn defaults_are_filled_in_and_what_changes_nothing_is_left_out() {
    assert_eq!(
        resolved_line(
            "leaky-teapot --format fp16 --size 8x8 --tessellation 1 --out x --executor scalar -q --threads 2"
        ),
        "crossbar leaky-teapot --size 8x8 --tessellation 1 --format fp16 --rays-per-edge 4 --sides front"
    );
    let line = "reproduce ray-engine-figure-7 ray-engine-equation-11";
    assert_eq!(resolved_line(line), format!("crossbar {line}"));
    // A default that does not apply to the subject is omitted.
    let line = "all-frequency factor --table docs/examples/reflectance.csv --terms 3";
    assert_eq!(resolved_line(line), format!("crossbar {line}"));
}

#[test]
fn what_is_resolved_resolves_to_itself() {
    let quoted = "leaky-teapot --size 8x8 --rays-per-edge 0 --device";
    let quoted = quoted.split(' ').chain(["Radeon 8500", "--mesh", "docs/examples/it's.obj"]).collect::<Vec<_>>();
    let again = |line: &str| {
        let words = shlex::split(line).expect("a line that a shell reads");
        resolved(&words[1..].iter().map(String::as_str).collect::<Vec<_>>())
    };
    let line = resolved(&quoted);
    assert!(line.contains("--device 'Radeon 8500'"), "{line}");
    assert!(quoted.iter().all(|word| shlex::split(&line).is_some_and(|words| words.iter().any(|found| found == word))));
    assert_eq!(again(&line), line);
    for line in [
        "leaky-teapot --size 8x8 --tessellation 1 --rays-per-edge 0 --device r200 --device nv35",
        "radiosity cornell-room --patches 30 --factors unoccluded --size 8x8 --picture-after 1,2 --solver card --solver \
         direct --switch rounding=rtz",
        "all-frequency factor --brdf phong --side 4 --terms 2",
        "leaky-teapot --size 8x8 --tessellation 1 --rays-per-edge 0 --eye -3,-9,3",
        "radiosity docs/examples/room.toml --patches 30 --size 8x8 --iterations 2",
    ] {
        let once = resolved_line(line);
        assert_eq!(again(&once), once);
    }
}
