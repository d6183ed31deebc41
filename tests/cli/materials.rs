//! `crossbar materials`: published media with sources, custom media, errors that suggest a name.

use crate::crossbar;

#[test]
fn the_text_shows_lengths_reflectances_and_sources() {
    let ran = crossbar(&["materials", "chicken1"], "");
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    for expected in [
        "Chicken1: index of refraction 1.3",
        "mean free path, z_r",
        "radius that holds 90 %",
        "0.126",
        "0.31, 0.15, 0.1",
        "disputed",
        "unconfirmed",
        "Mitsuba",
    ] {
        assert!(ran.stdout.contains(expected), "`{expected}` stands in\n{}", ran.stdout);
    }
    let all = crossbar(&["materials"], "").stdout;
    assert!(["Apple", "Wholemilk", "Figure7-marble", "0.8464"].iter().all(|text| all.contains(text)), "{all}");
}
