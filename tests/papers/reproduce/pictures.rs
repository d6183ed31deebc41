//! The pictures of entries.

use std::collections::BTreeMap;

use crossbar::report::{NamedPicture, PictureGrid};
use crossbar::study::reproduce::{EntryFindings, RecordStatus};

use super::found;

/// The pictures of findings, without those of its light.
pub(super) fn pictures(found: &EntryFindings) -> Vec<&NamedPicture> {
    let all = found.pictures.iter().flat_map(PictureGrid::pictures);
    all.filter(|picture| !picture.name.ends_with("light")).collect()
}

/// Number of pixels, black apart, whose hue differs from that of the most frequent color.
fn other_hues(colors: &BTreeMap<[u8; 3], usize>) -> usize {
    let hue = |color: &[u8; 3]| color.map(|value| f64::from(value) / f64::from(color[0].max(color[1]).max(color[2])));
    let lit = || colors.iter().filter(|(color, _)| color.iter().any(|&value| value > 64));
    let (main, _) = lit().max_by_key(|(_, count)| **count).expect("a color");
    let is_other = |color: &[u8; 3]| hue(color).iter().zip(hue(main)).any(|(value, main)| (value - main).abs() > 0.2);
    lit().filter(|(color, _)| is_other(color)).map(|(_, count)| count).sum()
}

/// Figures 4, 5 and 7 to 9 have their pictures, none of them empty or like another one of its entry.
#[test]
fn figures_have_their_pictures() {
    let counts = [
        ("cpca-figures-3-4", 7),
        ("cpca-coherence", 8),
        ("cpca-figure-7", 5),
        ("cpca-figure-8", 4),
        ("cpca-figure-9", 6),
        ("all-frequency-figures", 49),
    ];
    for (id, count) in counts {
        let Some(found) = found(id) else { continue };
        let pictures = pictures(found);
        assert_eq!(pictures.len(), count, "{id}");
        for (at, picture) in pictures.iter().enumerate() {
            let pixels = |picture: &NamedPicture| picture.image.pixels().map(|pixel| pixel.0).collect::<Vec<_>>();
            let full = matches!(found.record, Some(RecordStatus::Computed { .. }));
            assert_eq!(picture.image.width(), if full { 640 } else { 320 }, "{}", picture.name);
            let mut seen: BTreeMap<[u8; 3], usize> = BTreeMap::new();
            pixels(picture).into_iter().for_each(|pixel| *seen.entry(pixel).or_default() += 1);
            assert!(seen.len() > 2, "{id}, {}: {} colors", picture.name, seen.len());
            // Mixed with the ground, a group keeps its hue: another hue is another group.
            let others = other_hues(&seen);
            assert!(id != "cpca-coherence" || others > 32, "{id}, {}: {others} pixels", picture.name);
            for other in &pictures[..at] {
                assert!(pixels(other) != pixels(picture), "{id}: {} and {}", other.name, picture.name);
            }
        }
    }
}
