//! `crossbar materials`: published media with sources, custom media, errors that suggest a name.

use serde_json::Value;

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
    let all = all.as_array().expect("a list");
    assert_eq!(all.len(), 14);
    for medium in all {
        for channel in 0..3 {
            let [total, sum] = ["total", "total_integrated"].map(|key| number(&medium[key][channel]));
            assert!((total - sum).abs() < 1e-12, "{}: {total}, {sum}", medium["name"]);
            let radii: Vec<f64> = (0..3).map(|i| number(&medium["radii"][i]["mm"][channel])).collect();
            assert!(radii[0] < radii[1] && radii[1] < radii[2], "{radii:?}");
        }
        for figure in ["sigma_s_prime", "sigma_a", "eta"] {
            assert!(medium["sources"][figure]["source"].as_str().is_some_and(|source| !source.is_empty()));
        }
    }
    let spectralon = all.iter().find(|medium| medium["name"] == "Spectralon").expect("listed");
    assert_eq!(spectralon["diffusion_length_mm"][0], Value::Null);
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
