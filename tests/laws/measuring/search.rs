//! Search for small cases that tell the values of a switch apart.

use std::path::Path;

use crossbar::case::{Loaded, Setup};
use refsim::device::{Confidence, Profile, Switch};
use refsim::isa::Version;
use refsim::machine::ExecutorKind;

use super::draft::{Dice, Draft};

/// Random cases that are tried.
const TRIES: u64 = 800;

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

/// Values of the switch in groups that draw the same codes; `None` if a value cannot draw the case.
pub(super) fn groups(text: &str, switch: &Switch) -> Option<Vec<Vec<String>>> {
    let mut groups: Vec<(Vec<u64>, Vec<String>)> = Vec::new();
    for value in &switch.values {
        let codes = codes(text, (&switch.name, value), ExecutorKind::Scalar)?;
        match groups.iter_mut().find(|(others, _)| *others == codes) {
            Some((_, values)) => values.push(value.clone()),
            None => groups.push((codes, vec![value.clone()])),
        }
    }
    Some(groups.into_iter().map(|(_, values)| values).collect())
}

/// The open switches of a device: those whose default is a guess.
pub(super) fn open(profile: &Profile) -> impl Iterator<Item = &Switch> {
    profile.switches().iter().filter(|switch| switch.confidence == Confidence::Guess)
}

/// A case that tells as many values apart as any that was tried, made as small as this search can.
pub(super) fn smallest(profile: &Profile, switch: &Switch) -> Option<Draft> {
    let mut dice = Dice::new(&format!("{} {}", profile.name, switch.name), 1);
    let mut versions = vec!["ps_1_1"];
    versions.extend(profile.supports(Version::Ps1_4).then_some("ps_1_4"));
    versions.extend(profile.supports(Version::Ps2_0).then_some("ps_2_0"));
    let count = |draft: &Draft| groups(&draft.text(&profile.name), switch).map_or(1, |groups| groups.len());
    let mut best: Option<(usize, Draft)> = None;
    for _ in 0..TRIES {
        let version = versions[dice.below(versions.len())];
        let draft = match dice.below(5) {
            0 => Draft::arithmetic(version, &mut dice),
            1 => Draft::textured(version, &mut dice),
            2 => Draft::triangle(version, &mut dice),
            3 => Draft::transformed(version, &mut dice),
            _ if version != "ps_1_1" => Draft::coordinates(version, &mut dice),
            _ => continue,
        };
        let told = count(&draft);
        if told > best.as_ref().map_or(1, |(told, _)| *told) {
            best = Some((told, draft));
        }
        if told == switch.values.len() {
            break;
        }
    }
    let (told, mut draft) = best?;
    while let Some(simpler) = draft.simpler().into_iter().find(|draft| count(draft) == told) {
        draft = simpler;
    }
    Some(draft)
}
