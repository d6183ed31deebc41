//! Test of the tools: a planted difference is found, and shrunk to its cause.

use crate::executors::REFERENCE;
use crate::scene::{Case, Outcome};
use crate::shrink::shrink;
use crate::suite::{self, Kind};
use refsim::device::MadMode;
use refsim::isa::Version;

/// Instructions of ps_2_0 that are or contain a `mad`.
const WITH_MAD: [&str; 4] = ["mad", "lrp", "crs", "sincos"];

/// Draws the case with this rounding of `mad` on the reference executor.
fn drawn(case: &Case, mad: MadMode) -> Option<Outcome> {
    let case = with(case, mad);
    let programs = case.build().ok()?;
    case.scene.draw(&REFERENCE, &programs).ok()
}

fn with(case: &Case, mad: MadMode) -> Case {
    let mut case = case.clone();
    case.scene.profile.rules.mad = mad;
    case
}

/// Returns `true` if the outcome depends on the rounding of `mad`.
fn shows(case: &Case) -> bool {
    let (one, two) = (drawn(case, MadMode::Fused), drawn(case, MadMode::TwoRoundings));
    matches!((one, two), (Some(a), Some(b)) if a.difference(&b, "fused").is_some())
}

/// A larger case whose outcome depends on the rounding of `mad`.
fn planted() -> Case {
    let suites = suite::all();
    let mut programs = suites.iter().filter(|s| matches!(s.kind, Kind::Program(Version::Ps2_0, ..)));
    let found = programs.find_map(|s| (0..60).map(|seed| s.case(seed)).find(|c| c.pixel.len() > 30 && shows(c)));
    found.unwrap_or_else(|| panic!("rounding twice shows somewhere"))
}

pub(crate) fn a_planted_difference_is_cut_down() {
    let case = planted();
    let small = shrink(&case, shows);
    assert!(shows(&small));
    assert!(small.pixel.len() < 16, "cut down to\n{}", small.pixel.join("\n"));
    let has_mad = |line: &String| WITH_MAD.iter().any(|name| line.starts_with(name));
    assert!(small.pixel.iter().any(has_mad), "{}", small.pixel.join("\n"));
    assert!(small.scene.size[0] * small.scene.size[1] <= case.scene.size[0] * case.scene.size[1]);
    assert!(small.scene.alpha.is_none() && small.scene.blend.is_none() && !small.scene.second_pass);
}
