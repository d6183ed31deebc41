//! `crossbar materials`: published media with sources, custom media, errors that suggest a name.

use std::collections::BTreeSet;

use crate::answers::{document, number, refused};
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

#[test]
fn all_published_media_have_sources_and_the_totals_of_their_integrals() {
    let all = document(&["materials"]);
    let names: BTreeSet<&str> =
        all.as_array().expect("a list").iter().filter_map(|row| row["medium"].as_str()).collect();
    assert_eq!(names.len(), 14);
    for name in names {
        let medium = document(&["materials", name]);
        let row = |quantity: &str| {
            let rows = medium["lengths"].as_array().expect("rows");
            rows.iter().find(|row| row["quantity"] == quantity).unwrap_or_else(|| panic!("no {quantity}")).clone()
        };
        for channel in ["red", "green", "blue"] {
            let [total, sum] = ["R_d, total in closed form", "R_d, integrated"].map(|of| number(&row(of)[channel]));
            assert!((total - sum).abs() < 1e-12, "{name}: {total}, {sum}");
            let radii = ["50", "90", "99"].map(|share| number(&row(&format!("radius that holds {share} %"))[channel]));
            assert!(radii[0] < radii[1] && radii[1] < radii[2], "{radii:?}");
        }
        let sources = medium["sources"].as_array().expect("rows");
        assert!(sources.len() >= 3 && sources.iter().all(|row| row["source"] != ""), "{medium}");
        assert_eq!(row("diffusion length, 1 / sigma_tr")["red"].is_number(), name != "Spectralon");
    }
}

#[test]
fn what_is_no_medium_is_refused_with_what_was_meant() {
    for (arguments, said) in
        [(&["materials", "chiken1"][..], "did you mean `Chicken1`?"), (&["materials", "butter"], "the media are Apple")]
    {
        let text = refused(arguments);
        assert!(text.contains(said), "{arguments:?}: {text}");
    }
}
