//! Draws probes with each value of a switch.

use std::path::Path;

use crossbar::case::{Loaded, Setup};
use refsim::device::{Profile, Switch};
use refsim::machine::ExecutorKind;

/// Codes of a case's first target, and of its depth buffer, drawn with a value of a switch; `None` if the case cannot
/// be drawn.
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

/// Values of the switch in groups that draw the same codes, with these; `None` if a value cannot draw the case.
pub(super) fn groups(text: &str, switch: &Switch) -> Option<Vec<(Vec<u64>, Vec<String>)>> {
    let mut groups: Vec<(Vec<u64>, Vec<String>)> = Vec::new();
    for value in &switch.values {
        let codes = codes(text, (&switch.name, value), ExecutorKind::Scalar)?;
        match groups.iter_mut().find(|(others, _)| *others == codes) {
            Some((_, values)) => values.push(value.clone()),
            None => groups.push((codes, vec![value.clone()])),
        }
    }
    Some(groups)
}

/// The open switches of a device: no document states the default, and no measurement of the chip or a sibling shows it.
pub(super) fn open(profile: &Profile) -> impl Iterator<Item = &Switch> {
    profile.switches().iter().filter(|switch| switch.confidence.is_open())
}
