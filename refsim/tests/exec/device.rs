//! Tests the profiles: loading, contents, and errors for unknown names.

use std::collections::BTreeSet;

use refsim::device::{
    ColorIterator, Confidence, ConstantStorage, DeviceError, MadMode, Profile, SignedTexelMinimum, Storage,
    SubpixelGrid, TexkillComponents,
};
use refsim::isa::Version;
use refsim::num::{Denormals, DotOrder, Format, Overflow, Rounding, Specials};
use refsim::texture::TexelFormat;

#[test]
fn every_profile_loads_and_every_value_of_every_switch_can_be_set() {
    let mut names = Profile::card_names();
    assert_eq!(names, ["nv20", "r200", "nv25", "r300", "nv30", "r350", "nv35", "gt200"]);
    names.extend(Profile::variant_names());
    names.extend(["ideal-fp32", "ideal-s3.12:rtz:wrap", "ideal-e4m3:sat:ftz"]);
    for name in names {
        let profile = Profile::named(name).unwrap();
        assert_eq!(profile.name, name);
        for switch in profile.switches().to_vec() {
            assert!(switch.values.contains(&switch.default), "{name} {}", switch.name);
            assert!(!switch.meaning.is_empty(), "{name} {} says nothing", switch.name);
            for value in &switch.values {
                let mut changed = profile.clone();
                changed.set_switch(&switch.name, value).unwrap();
                let current = changed.switches().iter().find(|s| s.name == switch.name).unwrap();
                assert_eq!(&current.current, value);
                // Every value of a switch must change the profile.
                let differs = changed.rules != profile.rules || changed.limits != profile.limits;
                assert_eq!(differs, *value != switch.current, "{name} {} {value}", switch.name);
            }
        }
    }
}

/// A word of a card's title finds the card; a word that several titles share finds none.
#[test]
fn cards_are_found_by_the_names_that_people_know() {
    for (name, card) in [
        ("Radeon 8500", "r200"),
        ("R200", "r200"),
        ("ati radeon 9800 pro", "r350"),
        ("geforce3", "nv20"),
        ("GeForce 4", "nv25"),
        ("Ti4600", "nv25"),
        ("GeForce FX 5800", "fx5800"),
        ("GeForce FX 5800 Ultra", "nv30"),
        ("gtx-280", "gt200"),
    ] {
        assert_eq!(Profile::named(name).expect(name).name, card);
    }
    for name in ["", "Radeon", "GeForce FX", "8500 Pro", "Voodoo"] {
        assert!(matches!(Profile::named(name), Err(DeviceError::UnknownDevice { .. })), "{name}");
    }
}

#[test]
fn every_figure_has_a_source() {
    for name in Profile::card_names().into_iter().chain(Profile::variant_names()) {
        let profile = Profile::named(name).unwrap();
        let rows = profile.figures();
        assert!(rows.len() > 50, "{name} has {} figures", rows.len());
        for row in rows {
            assert!(row.source.len() > 3, "{name} {}", row.key);
            assert!(!row.source.contains(".md"), "{name} {}: {}", row.key, row.source);
            assert!(!row.value.is_empty() && !row.value.contains('?'), "{name} {}", row.key);
        }
    }
}

/// Every confidence word is used by some figure. NV2A is a sibling of two cards only: for all other cards, its
/// measurements count at most as measurements on kin.
#[test]
fn words_of_confidence_say_on_which_chip() {
    let mut words = BTreeSet::new();
    for name in Profile::card_names() {
        for row in Profile::named(name).unwrap().figures() {
            words.insert(row.confidence);
            if row.source.contains("NV2A") && !row.source.contains("NV34") {
                let unfit: &[Confidence] = match name {
                    "nv20" | "nv25" => &[Confidence::Kin],
                    _ => &[Confidence::Measured, Confidence::Sibling],
                };
                assert!(!unfit.contains(&row.confidence), "{name} {}: {}", row.key, row.confidence);
            }
        }
    }
    assert_eq!(Vec::from_iter(words), Confidence::ALL);
    let open = Confidence::ALL.into_iter().filter(|word| word.is_open()).map(Confidence::word);
    assert_eq!(open.collect::<Vec<_>>(), ["kin", "state", "report", "guess"]);
}

/// ROUND_PREC of R200 offers subpixel grids of 1/16 and coarser; R300 also offers 1/12.
#[test]
fn the_radeons_have_the_grids_of_their_registers() {
    let mut r200 = Profile::named("r200").unwrap();
    assert_eq!(r200.rules.subpixel_grid, SubpixelGrid::Bits(4));
    assert!(matches!(r200.set_switch("subpixel-bits", "8"), Err(DeviceError::SwitchValue { .. })));
    r200.set_switch("subpixel-bits", "3").unwrap();
    assert_eq!(r200.rules.subpixel_grid.lines(), 8);
    let mut r300 = Profile::named("r300").unwrap();
    r300.set_switch("subpixel-bits", "twelfths").unwrap();
    assert_eq!(r300.rules.subpixel_grid.lines(), 12);
}

#[test]
fn r200_is_what_the_paper_says() {
    let r200 = Profile::named("r200").unwrap();
    assert_eq!(r200.rules.format, Format::S3_12.with_rounding(Rounding::Down));
    assert_eq!(r200.rules.partial, None);
    assert_eq!(r200.rules.vertex_format, Format::FP32);
    assert_eq!(r200.rules.constant_storage, ConstantStorage::Register);
    assert_eq!(r200.rules.color_iterator, ColorIterator::Unorm(8));
    assert_eq!((r200.rules.mad, r200.rules.dot), (MadMode::TwoRoundings, DotOrder::Sequential));
    assert_eq!(r200.rules.signed_texel_minimum, SignedTexelMinimum::BelowMinusOne);
    assert_eq!(r200.limits.texture_instructions_per_phase, Some(6));
    assert_eq!(r200.limits.arithmetic_instructions_per_phase, Some(8));
    assert_eq!(r200.limits.temporaries, Some(6));
    assert!(r200.supports(Version::Ps1_4) && !r200.supports(Version::Ps2_0));
    assert_eq!(r200.rates.fill_pixels_per_s, Some(1_100_000_000));
    let format = r200.figures().into_iter().find(|r| r.key == "rules.format").unwrap();
    assert_eq!((format.value.as_str(), format.confidence), ("s3.12:rdn", Confidence::Documented));
    let rounding = r200.figures().into_iter().find(|r| r.key == "rules.rounding").unwrap();
    assert_eq!((rounding.value.as_str(), rounding.confidence), ("rdn", Confidence::Guess));
}

#[test]
fn ray_textures_decide_the_sixteen_bit_formats() {
    let formats = |value: &str| {
        let mut r200 = Profile::named("r200").unwrap();
        r200.set_switch("ray-textures", value).unwrap();
        let wide = [TexelFormat::Rg16, TexelFormat::Rg16Snorm, TexelFormat::Rgba16, TexelFormat::Rgba16Snorm];
        wide.map(|format| r200.limits.texture_formats.contains(&format))
    };
    assert_eq!(formats("unsigned"), [true, false, false, false]);
    assert_eq!(formats("signed"), [false, true, false, false]);
    assert_eq!(formats("wide"), [true; 4]);
}

#[test]
fn switches_reach_the_formats() {
    let mut nv30 = Profile::named("nv30").unwrap();
    let (full, half) = (nv30.rules.format, nv30.rules.partial.unwrap());
    assert_eq!((full.overflow, full.denormals, full.specials), (Overflow::Nv30, Denormals::Flush, Specials::Nv));
    assert_eq!((half.overflow, half.denormals, half.specials), (Overflow::Nv30, Denormals::Keep, Specials::Nv));
    nv30.set_switch("rounding", "rtz").unwrap();
    assert_eq!(nv30.rules.format.rounding, Rounding::TowardZero);
    assert_eq!(nv30.rules.partial.unwrap().rounding, Rounding::TowardZero);
    assert_eq!(nv30.limits.instructions, Some(512));
    nv30.set_switch("instruction-slots", "1024").unwrap();
    assert_eq!(nv30.limits.instructions, Some(1024));

    let mut r300 = Profile::named("r300").unwrap();
    assert_eq!(r300.rules.format, "e7m16:rtz:ftz".parse().unwrap());
    assert_eq!(r300.rules.texkill_components, TexkillComponents::Four);
    r300.set_format(Format::FP16).unwrap();
    let denormals = r300.switches().iter().find(|s| s.name == "denormals").unwrap();
    assert_eq!(denormals.current, "keep");
    // Floats cannot wrap; the switch of the fixed-point card has no effect.
    let mut r200 = Profile::named("r200").unwrap();
    r200.set_format(Format::FP24).unwrap();
    assert!(matches!(r200.set_switch("overflow", "wrap"), Err(DeviceError::FormatRule { .. })));
    assert_eq!(r200.rules.format, Format::FP24);
}

/// Replacing the device's format replaces the format's default rules, and keeps other settings of the device.
#[test]
fn what_is_set_stays_when_the_format_is_replaced() {
    let with = |file: &str, format: &str| {
        let mut profile = Profile::from_device_file(file).unwrap();
        profile.replace_format(format).map(|()| (profile.rules.format.to_string(), profile))
    };
    let format = |switches: &str, format: &str| {
        with(&format!("device = \"r200\"\n[switches]\n{switches}"), format).map(|(format, _)| format)
    };
    let down = "rounding = \"rdn\"";
    assert_eq!(format("", "s3.8"), Ok("s3.8".to_owned()), "the card's own rounding belongs to its own format");
    for (switches, asked, found) in [
        (down, "s3.8", "s3.8:rdn"),
        (down, "fp16", "e5m10:rdn"),
        (down, "s3.8:rne", "s3.8"),
        (down, "s3.8:rtz", "s3.8:rtz"),
        (down, "s3.8:wrap", "s3.8:rdn:wrap"),
        ("overflow = \"wrap\"", "s3.8:rtz", "s3.8:rtz:wrap"),
        ("overflow = \"wrap\"", "fp16:inf", "e5m10"),
    ] {
        assert_eq!(format(switches, asked).as_deref(), Ok(found), "{switches}, {asked}");
    }
    let error = format("overflow = \"wrap\"", "fp16").unwrap_err().to_string();
    assert_eq!(error, "switch `overflow` of device `r200` is `wrap`, which its format `e5m10` cannot have");
    let stored = "device = \"ideal-fp32\"\naccumulator = \"e8m13\"\n[storage]\ntemporaries = \"fp16\"";
    let (_, kept) = with(stored, "fp24").unwrap();
    assert_eq!(kept.rules.storage.of(Storage::Temporaries), Some(Format::FP16));
    assert_eq!(kept.rules.accumulator, Some("e8m13".parse().unwrap()));
    assert!(matches!(with(stored, "e5m8"), Err(DeviceError::StorageFormat { what: "temporaries", .. })));
}

#[test]
fn ideal_devices_take_any_format() {
    let ideal = Profile::named("ideal-s1.6:rtz:wrap").unwrap();
    assert_eq!(ideal.rules.format, "s1.6:rtz:wrap".parse().unwrap());
    assert!(!ideal.limits.version_limits);
    assert_eq!(ideal.limits.instructions, None);
    assert!(Version::ALL.iter().all(|v| ideal.supports(*v)));
}

/// Tests of a card's arithmetic therefore need not be repeated for its variants.
#[test]
fn variants_differ_from_their_card_in_rates_alone() {
    let variants = Profile::variant_names();
    assert_eq!(variants, ["fx5800", "fx5900"]);
    for (name, card, core, memory) in [("fx5800", "nv30", 400, 12_800), ("fx5900", "nv35", 400, 27_200)] {
        let (variant, card) = (Profile::named(name).unwrap(), Profile::named(card).unwrap());
        assert_eq!((&variant.rules, &variant.limits, &variant.bus), (&card.rules, &card.limits, &card.bus), "{name}");
        assert_eq!(variant.switches(), card.switches(), "{name}");
        assert!(!variant.title.contains("Ultra") && card.title.contains("Ultra"), "{name}");
        let mega = |figure: Option<u64>| figure.unwrap() / 1_000_000;
        assert_eq!((mega(variant.rates.core_clock_hz), mega(variant.rates.memory_bytes_per_s)), (core, memory));
        let (mine, theirs) = (variant.figures(), card.figures());
        let differ = mine.iter().zip(&theirs).filter(|(a, b)| a != b).map(|(a, _)| a.key.as_str());
        let differ: Vec<&str> = differ.collect();
        assert_eq!(differ.len(), 5, "{name}: {differ:?}");
        assert!(differ.iter().all(|key| key.starts_with("rates.")), "{name}: {differ:?}");
    }
}

const NV20: &str = include_str!("../../src/device/profiles/nv20.toml");
const NV30: &str = include_str!("../../src/device/profiles/nv30.toml");

#[test]
fn clocks_are_of_instructions() {
    let slip = NV30.replace("\nrsq = {", "\nrqs = {");
    let error = Profile::from_toml("nv30", &slip).expect_err("no instruction").to_string();
    assert!(error.contains("clocks.rqs: no such instruction; expected one of ") && error.contains(" rsq "), "{error}");
}

#[test]
fn counts_of_a_measured_figure_support_its_value() {
    let whole = r#""sibling", of = "NV2A", all = 52, right = { 4 = 52, 8 = 16 }"#;
    assert!(NV20.contains(whole));
    let figures = Profile::from_toml("nv20", NV20).expect("a card").figures();
    let counted = figures.iter().find(|row| row.key.ends_with("subpixel-bits")).and_then(|row| row.counts.as_ref());
    assert_eq!(counted.map(ToString::to_string).as_deref(), Some("NV2A: 4 52, 8 16 of 52"));
    assert!(Profile::from_toml("nv20", &NV20.replace(whole, r#""sibling""#)).is_ok());
    for (from, to) in [
        // Counts have three parts, and a figure that was measured, here or on a sibling.
        (r#" of = "NV2A","#, ""),
        (" all = 52,", ""),
        ("sibling", "guess"),
        ("sibling", "kin"),
        ("sibling", "documented"),
        // The value predicts more than another hypothesis, and every hypothesis is a value of the switch.
        ("4 = 52, ", ""),
        ("8 = 16", "8 = 52"),
        ("all = 52", "all = 51"),
        ("8 = 16", "7 = 16"),
    ] {
        let figure = whole.replace(from, to);
        let error = Profile::from_toml("nv20", &NV20.replace(whole, &figure)).expect_err(&figure).to_string();
        assert!(error.contains("subpixel-bits"), "{figure}: {error}");
    }
}
