//! Radiosity: errors compared with the direct solution.

use clap::Parser;
use crossbar_ground::scene::{Camera, Scene};
use crossbar_studies::study::Study as _;
use crossbar_studies::study::caster::CasterChoice;
use crossbar_studies::study::radiosity::{Parameters, RadiosityOptions};
use crossbar_systems::radiosity::{Patches, rooms};
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::{StudyFiles, number, rgb};

#[derive(Parser)]
struct Options {
    #[command(flatten)]
    study: RadiosityOptions,
}

/// A box whose lamp is brighter by a factor.
fn study(brightness: f32, options: &str) -> Parameters {
    let scene = rooms::cornell(rooms::CornellBox::default());
    let mut materials = scene.materials().to_vec();
    materials.iter_mut().for_each(|material| material.emission = material.emission.map(|c| brightness * c));
    let scene = Scene::new(scene.mesh().clone(), materials, scene.material_of().to_vec(), Vec::new()).expect("a scene");
    let options = Options::try_parse_from(format!("radiosity {options}").split(' ')).expect("options").study;
    Parameters {
        methods: options.methods().expect("ways"),
        camera: Camera::new([0.5, -1.2, 0.5], [0.5, 0.5, 0.5], [0.0, 0.0, 1.0], 0.5, 16, 16).expect("a camera"),
        profile: Profile::named("nv35").expect("a card"),
        switches: Vec::new(),
        executor: ExecutorKind::Batch.into(),
        casters: vec![CasterChoice::Host],
        scene,
        options,
    }
}

/// The errors of an iteration that stops early follow from the patches' radiosities: the largest relative to the
/// brightest patch's radiosity, and relative to each patch's own; the mean is signed, and lamps do not count.
#[test]
fn lamps_and_dark_patches_do_not_count_for_the_bias() {
    let study = study(1.0, "--patches 40 --factors unoccluded --solver jacobi --solver direct --iterations 2");
    let emittances = Patches::new(&study.scene, study.options.subdivision()).expect("patches").emittances();
    assert!(emittances.iter().any(|e| *e != [0.0; 3]) && emittances.contains(&[0.0; 3]));
    let files = StudyFiles::of(&study);
    let (mut absolute, mut brightest, mut relative, mut unlit) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
    for (patch, emittance) in files.rows("patches.csv").iter().zip(&emittances) {
        for ((found, right), emittance) in rgb(patch, "jacobi").into_iter().zip(rgb(patch, "direct")).zip(emittance) {
            absolute = absolute.max((found - right).abs());
            brightest = brightest.max(right);
            if right > 0.0 {
                relative = relative.max((found - right).abs() / right);
                unlit.extend((*emittance == 0.0).then_some((found - right) / right));
            }
        }
    }
    let rows = files.rows("rows.csv");
    let jacobi = rows.iter().find(|row| row["way"] == "jacobi").expect("a row");
    let bias = unlit.iter().sum::<f64>() / unlit.len() as f64;
    assert!(bias < -0.01, "two iterations are too dark: {bias}");
    for (heading, expected) in
        [("largest_error", absolute / brightest), ("largest_relative", relative), ("mean_relative", bias)]
    {
        let found = number(jacobi, heading);
        assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{heading}: {found} {expected}");
    }
}

/// A room too bright for half floats does not have a small error: the study is rejected.
#[test]
fn radiosities_that_are_not_finite_are_no_small_error() {
    let options = "--patches 40 --factors unoccluded --solver card --storage fp16 --solver direct --iterations 2";
    let refused = study(1e5, options).findings(&mut |_, _, _| {}).map(|_| ()).expect_err("infinite radiosities");
    let said = format!("{refused:?}");
    assert!(said.contains("found no finite residual after 1 iterations"), "{said}");
}
