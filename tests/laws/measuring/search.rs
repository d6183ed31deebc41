//! Search for the smallest case that tells the values of a switch apart.

use std::path::Path;

use crossbar::case::{Loaded, Setup};
use refsim::device::{Confidence, Profile, Switch};
use refsim::isa::Version;
use refsim::machine::ExecutorKind;

use super::draft::{Dice, Draft};

/// Random cases that are tried.
const TRIES: u64 = 20_000;

/// Codes of a case's first target, and of its depth buffer, under a value of a switch; `None` if it cannot be drawn.
pub(super) fn codes(text: &str, switch: (&str, &str), kind: ExecutorKind) -> Option<Vec<u64>> {
    let (head, rest) = text.split_once("\n\n")?;
    let set = format!("{head}\n\n[switches]\n{} = \"{}\"\n\n{rest}", switch.0, switch.1);
    let setup = Setup::from_bytes("probe", set.as_bytes(), Path::new(".")).ok()?;
    let mut loaded = Loaded::new(&setup, kind).ok()?;
    loaded.draw().ok()?;
    let [width, height] = setup.size;
    let target = loaded.targets().ok()?[0];
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let mut codes: Vec<u64> = places.map(|(x, y)| target.raw(0, 0, y, x) as u64).collect();
    codes.extend(loaded.depth().ok()?.iter().flat_map(|depth| depth.data()).map(|&code| u64::from(code)));
    Some(codes)
}

/// Returns `true` if each value of the switch draws other codes.
pub(super) fn tells_apart(text: &str, switch: &Switch) -> bool {
    let mut seen: Vec<Vec<u64>> = Vec::new();
    switch.values.iter().all(|value| {
        let Some(codes) = codes(text, (&switch.name, value), ExecutorKind::Scalar) else { return false };
        let is_new = !seen.contains(&codes);
        seen.push(codes);
        is_new
    })
}

/// The open switches of a device: those whose default is a guess.
pub(super) fn open(profile: &Profile) -> impl Iterator<Item = &Switch> {
    profile.switches().iter().filter(|switch| switch.confidence == Confidence::Guess)
}

/// A case that tells the values apart, made as small as this search can.
pub(super) fn smallest(profile: &Profile, switch: &Switch) -> Option<Draft> {
    let mut dice = Dice::new(&format!("{} {}", profile.name, switch.name), 1);
    let runs = |version: Version| profile.supports(version);
    let mut versions = vec!["ps_1_1"];
    versions.extend(runs(Version::Ps1_4).then_some("ps_1_4"));
    versions.extend(runs(Version::Ps2_0).then_some("ps_2_0"));
    for _ in 0..TRIES {
        let version = versions[dice.below(versions.len())];
        let draft = match dice.below(4) {
            0 => Draft::arithmetic(version, &mut dice),
            1 => Draft::textured(version, &mut dice),
            2 => Draft::triangle(version, &mut dice),
            _ if version != "ps_1_1" => Draft::coordinates(version, &mut dice),
            _ => continue,
        };
        if tells_apart(&draft.text(&profile.name), switch) {
            return Some(shrunk(draft, profile, switch));
        }
    }
    None
}

fn shrunk(mut draft: Draft, profile: &Profile, switch: &Switch) -> Draft {
    loop {
        let simpler = draft.simpler().into_iter();
        match simpler.into_iter().find(|draft| tells_apart(&draft.text(&profile.name), switch)) {
            Some(simpler) => draft = simpler,
            None => return draft,
        }
    }
}
