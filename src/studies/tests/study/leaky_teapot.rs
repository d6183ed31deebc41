//! The leaky teapot: colors of its map, and warnings about formats with too few bits.

use crossbar_base::geom::exact::Sides;
use crossbar_base::geom::teapot::teapot;
use crossbar_ground::scene::Camera;
use crossbar_studies::report::digits::count;
use crossbar_studies::report::palette::Color;
use crossbar_studies::study::configuration::Configuration;
use crossbar_studies::study::leaky_teapot::{FormatLimits, LeakyTeapotOptions, Parameters, PixelVerdict, run};
use crossbar_systems::ray_engine::RayBatch;
use refsim::machine::ExecutorKind;
use strum::VariantArray as _;

use super::findings;
use crate::report::colors::{contrast, least_distance};

#[test]
fn colours_differ_for_every_reader() {
    let colors: Vec<Color> = PixelVerdict::VARIANTS.iter().map(|verdict| verdict.color()).collect();
    assert!(least_distance(&colors) > 20.0, "{}", least_distance(&colors));
    // Errors are brighter than correct pixels, so readers without color vision can see them.
    for verdict in PixelVerdict::VARIANTS.iter().filter(|verdict| verdict.is_error()) {
        assert!(contrast(verdict.color(), PixelVerdict::Right.color()) > 2.0, "{verdict:?}");
    }
}

/// Limits of each format, in rows named by letters, and the sentences about them.
fn limited(formats: &[&str]) -> (Vec<FormatLimits>, Vec<String>) {
    let side = 48;
    let rays = Camera::teapot(side, side).expect("a camera").rays();
    let label = |(format, letter): (&&str, char)| Configuration {
        label: letter.to_string(),
        ..Configuration::format(format).expect("a format")
    };
    let parameters = Parameters {
        model: None,
        mesh: teapot(2).expect("a teapot"),
        view: RayBatch::new(side, side, rays).expect("a ray per pixel"),
        listed: None,
        configurations: formats.iter().zip('a'..).map(label).collect(),
        shared: Vec::new(),
        executor: ExecutorKind::Batch.into(),
        options: LeakyTeapotOptions { rays_per_edge: 0, sides: Sides::Front, all_pairs: false },
    };
    let outcome = run(&parameters, &mut |_, _, _| {}).expect("it is traced");
    let said = findings(&parameters).conclusions().to_vec();
    let said = said.into_iter().filter(|sentence| sentence.contains("no bits left"));
    (outcome.rows.iter().map(|row| row.limits).collect(), said.collect())
}

#[test]
fn few_warnings_are_said_each_and_many_by_their_range() {
    let (limits, said) = limited(&["s3.7", "s3.7", "e8m23"]);
    assert_eq!(limits[2].warning(), None);
    assert_eq!(said, [format!("a and b: {}.", limits[0].warning().expect("few bits"))]);
    let (limits, said) = limited(&["s3.7", "e8m23", "s3.6", "s3.4"]);
    let range = |has: fn(&FormatLimits) -> bool, of: fn(&FormatLimits) -> u64| {
        let all: Vec<u64> = limits.iter().filter(|limits| has(limits)).map(of).collect();
        let [least, most] = [all.iter().min(), all.iter().max()].map(|end| count(*end.expect("a row")));
        if least == most { most } else { format!("{least} to {most}") }
    };
    let names = |has: fn(&FormatLimits) -> bool| {
        let all: Vec<&str> =
            ["a", "b", "c", "d"].into_iter().zip(&limits).filter(|row| has(row.1)).map(|row| row.0).collect();
        all.join(", ").replacen(", d", " and d", 1)
    };
    let (vanish, coarse) = (FormatLimits::triangles_vanish as fn(&_) -> _, FormatLimits::t_is_coarse as fn(&_) -> _);
    let below = range(vanish, |limits| limits.bits.below_step);
    let [hits, values] = [range(coarse, |limits| limits.hits), range(coarse, |limits| limits.t_values)];
    let vanished =
        format!("{}: no bits left: n of {below} triangles is below one step of the card's format.", names(vanish));
    let shared = format!("{}: no bits left: t of {hits} hits has {values} different values.", names(coarse));
    assert_eq!(said, [vanished, shared]);
}
