//! The published media: compares totals computed from their coefficients with the printed diffuse reflectances.

use crossbar::subsurface::materials::{FigureConfidence, MATERIALS, PublishedMaterial};
use crossbar::subsurface::{Coefficients, Dipole};

/// Half a unit of the last digit of a printed reflectance.
const HALF_A_UNIT: f64 = 0.005;

/// Channels whose printed reflectance differs from the rounded total: name, printed reflectance, total.
const DIFFERENT: &[&str] = &[
    "Chicken1 green 0.15 0.1558",
    "Chicken1 blue 0.10 0.1264",
    "Chicken2 blue 0.10 0.1076",
    "Cream blue 0.73 0.7247",
    "Potato red 0.77 0.7644",
    "Potato green 0.62 0.6125",
    "Skimmilk blue 0.69 0.6823",
    "Skin1 green 0.22 0.2273",
    "Skin2 red 0.63 0.6226",
    "Skin2 green 0.44 0.4333",
    "Wholemilk blue 0.77 0.7594",
];

fn total(sigma_s_prime: f64, sigma_a: f64, eta: f64) -> f64 {
    Dipole::new(Coefficients { sigma_s_prime, sigma_a: sigma_a.max(0.0) }, eta).unwrap().total()
}

fn channels(material: &PublishedMaterial) -> impl Iterator<Item = (usize, f64, f64, f64, f64)> {
    let printed = material.reflectance.map_or([f64::NAN; 3], |figure| figure.value);
    let (s, a, eta) = (material.sigma_s_prime.value, material.sigma_a.value, material.eta.value);
    (0..3).map(move |c| (c, s[c], a[c], printed[c], total(s[c], a[c], eta)))
}

#[test]
fn printed_reflectances_are_totals_but_for_those_named() {
    let mut found = Vec::new();
    for material in MATERIALS.iter().filter(|material| material.reflectance.is_some()) {
        for (c, _, _, printed, total) in channels(material) {
            if (total - printed).abs() > HALF_A_UNIT {
                let channel = ["red", "green", "blue"][c];
                found.push(format!("{} {channel} {printed:.2} {total:.4}", material.name));
            }
        }
    }
    assert_eq!(found, DIFFERENT);
}

/// Half a unit of the last of `digits` significant digits.
fn half_a_unit(value: f64, digits: i32) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let mut unit = 1.0;
    while unit > value {
        unit /= 10.0;
    }
    (1..digits).for_each(|_| unit /= 10.0);
    0.5 * unit
}

#[test]
fn rounded_coefficients_explain_no_more_than_these_differences() {
    // Only two digits of each coefficient are reliable; the others may change the total by this much.
    let mut unexplained = Vec::new();
    for material in MATERIALS.iter().filter(|material| material.reflectance.is_some()) {
        for (c, s, a, printed, _) in channels(material) {
            let (ds, da) = (half_a_unit(s, 2), half_a_unit(a, 2));
            let low = total(s - ds, a + da, material.eta.value);
            let high = total(s + ds, a - da, material.eta.value);
            if printed + HALF_A_UNIT < low || printed - HALF_A_UNIT > high {
                unexplained.push(format!("{} {c}", material.name));
            }
        }
    }
    assert_eq!(unexplained, ["Chicken1 2", "Potato 1", "Wholemilk 2"]);
}

#[test]
fn a_tenth_of_the_red_absorption_would_contradict_what_is_printed() {
    for name in ["Chicken1", "Chicken2"] {
        let material = MATERIALS.iter().find(|material| material.name == name).unwrap();
        assert_eq!(material.sigma_a.confidence, FigureConfidence::Disputed);
        let (_, s, a, printed, ours) = channels(material).next().unwrap();
        assert!((ours - printed).abs() < HALF_A_UNIT);
        assert!(total(s, a / 10.0, material.eta.value) > 1.9 * printed);
    }
}

#[test]
fn figure_7_is_no_row_of_the_table() {
    let rows = MATERIALS.iter().filter(|material| material.reflectance.is_some());
    assert_eq!(rows.clone().count(), 12);
    for material in rows {
        assert!(channels(material).all(|(_, s, a, _, _)| s != 2.21 && a != 0.0012), "{}", material.name);
    }
    let totals: Vec<String> = MATERIALS[12..].iter().map(|m| format!("{:.6}", channels(m).next().unwrap().4)).collect();
    assert_eq!(totals, ["0.897233", "0.867847"]);
}
