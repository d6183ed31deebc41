//! The leaky teapot: colors of its map, and warnings about formats with too few bits.

use crossbar_base::geom::exact::Sides;
use crossbar_base::geom::teapot::teapot;
use crossbar_ground::scene::Camera;
use crossbar_studies::report::palette::Color;
use crossbar_studies::report::words::listed;
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
    let said = said.into_iter().filter(|sentence| sentence.starts_with("In "));
    (outcome.rows.iter().map(|row| row.limits).collect(), said.collect())
}

#[test]
fn rows_with_the_same_limit_share_a_sentence() {
    let (limits, said) = limited(&["s3.7", "s3.7", "e8m23", "s3.4"]);
    assert_eq!(limits[2].warning(), None);
    assert!(!said.is_empty());
    for clause in ["the format has too few bits for the normals of ", "the hit distance t has only "] {
        let is_limited = |limits: &FormatLimits| limits.warning().is_some_and(|warning| warning.contains(clause));
        let rows: Vec<&str> = limits
            .iter()
            .zip(["a", "b", "c", "d"])
            .filter(|(limits, _)| is_limited(limits))
            .map(|(_, row)| row)
            .collect();
        let sentences: Vec<&String> = said.iter().filter(|sentence| sentence.contains(clause)).collect();
        assert_eq!(sentences.len(), usize::from(!rows.is_empty()), "{said:?}");
        let start = format!("In {}, {clause}", listed(&rows));
        assert!(sentences.iter().all(|sentence| sentence.starts_with(&start)), "{start}: {said:?}");
    }
}
