//! Subsurface scattering: environment light, errors by the angle from the light, values at vertices.

use std::f64::consts::PI;

use clap::Parser;
use crossbar_base::geom::Mesh;
use crossbar_ground::atlas::Atlas;
use crossbar_ground::scene::Camera;
use crossbar_studies::study::caster::CasterChoice;
use crossbar_studies::study::subsurface::{Lighting, Parameters, SubsurfaceOptions};
use crossbar_systems::subsurface::on_card::Light;
use crossbar_systems::subsurface::{irradiance, materials};
use crossbar_systems::transfer::grid::{LIGHT_MAP, LIGHT_SIDE};
use crossbar_systems::transfer::light::CubeLight;
use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::{StudyFiles, number, rgb};

#[derive(Parser)]
struct Options {
    #[command(flatten)]
    study: SubsurfaceOptions,
}

fn study(mesh: &Mesh, lighting: Lighting, options: &str) -> Parameters {
    let arguments = format!("subsurface --mm-per-unit 10 {options}");
    let options = Options::try_parse_from(arguments.split(' ')).expect("options").study;
    let material = materials::named("marble").expect("a published medium").material();
    Parameters {
        model: "a model".to_owned(),
        mesh: mesh.clone(),
        ways: options.ways(&material).expect("ways"),
        material,
        lighting,
        profile: Profile::named("nv35").expect("a card"),
        switches: Vec::new(),
        executor: ExecutorKind::Batch.into(),
        caster: CasterChoice::Host,
        camera: Camera::new([0.5, -4.0, 0.5], [0.5; 3], [0.0, 0.0, 1.0], 0.3, 16, 16).expect("a camera"),
        options,
    }
}

/// A mesh of flat faces: each face has its own corners, with its normal.
fn flat(faces: &[[[f32; 3]; 3]]) -> Mesh {
    let normal = |[a, b, c]: [[f32; 3]; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| DVec3::from(corner.map(f64::from)));
        (b - a).cross(c - a).normalize().as_vec3().to_array()
    };
    let normals = faces.iter().flat_map(|&face| [normal(face); 3]).collect();
    let triangles = (0..faces.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
    let mesh = Mesh::new(faces.as_flattened().to_vec(), triangles);
    mesh.and_then(|mesh| mesh.with_normals(normals)).expect("a mesh")
}

fn cube() -> Mesh {
    let corner = |i: u8| [0, 1, 2].map(|axis| f32::from(i >> axis & 1));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = quads.map(|[a, b, c, d]: [u8; 4]| [[a, b, c], [a, c, d]].map(|face| face.map(corner)));
    flat(halves.as_flattened())
}

/// Per face: the light that enters under an environment, and the mean over the face's texels under the host's lights.
fn entering(light: CubeLight, lights: &[Light]) -> Vec<[f64; 2]> {
    let study = study(&cube(), Lighting::Environment(light), "--atlas 8 --links 4 --all-pairs no");
    let atlas = Atlas::new(&study.mesh, 8).expect("an atlas");
    let expected = irradiance(&atlas, lights, study.material.eta);
    let faces = StudyFiles::of(&study).rows("faces.csv");
    let mean = |face: usize| {
        let own = || atlas.texels().iter().zip(&expected).filter(|(texel, _)| texel.face as usize == face);
        own().map(|(_, e)| e[1]).sum::<f64>() / own().count() as f64
    };
    faces.iter().enumerate().map(|(face, row)| [rgb(row, "E")[1], mean(face)]).collect()
}

/// The beams of an environment preserve its flux: on a body without self-shadowing, constant light equals a sky, and
/// light of one texel equals parallel light from its direction.
#[test]
fn environments_keep_their_flux() {
    let constant = CubeLight::constant([1.0, 2.0, 0.5]).expect("a light");
    for [found, sky] in entering(constant, &[Light::Sky { radiance: [1.0, 2.0, 0.5] }]) {
        assert!(sky > PI && (found - sky).abs() < 1e-2 * sky, "{found} {sky}");
    }
    let mut texels = vec![[0.0; 3]; LIGHT_MAP.len()];
    texels[5] = [0.0, 1000.0, 0.0];
    const { assert!(5 < LIGHT_SIDE, "row 0, column 5 of face 0") };
    let (towards, irradiance) = (LIGHT_MAP.direction(0, 5, 0).to_array(), 1000.0 * LIGHT_MAP.solid_angle(5, 0));
    let sun = Light::Directional { towards, irradiance: [0.0, irradiance, 0.0] };
    let found = entering(CubeLight::new(texels).expect("a light"), &[sun]);
    assert!(found.iter().any(|[_, sun]| *sun > 0.1 * irradiance) && found.iter().any(|[_, sun]| *sun == 0.0));
    for [found, sun] in found {
        assert!((found - sun).abs() < 1e-9 * irradiance, "{found} {sun}");
    }
}

/// Errors of a tetrahedron with one texel per face, summed by hand: the face towards the light is at 0 degrees, and
/// faces at equal angles share a bin.
#[test]
fn errors_are_told_by_angle() {
    let corners = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]];
    let faces = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]].map(|face| face.map(|corner: usize| corners[corner]));
    let mesh = flat(&faces);
    // The sun lies above the middle of the face without the first corner.
    let sun = Light::Directional { towards: [-1.0; 3], irradiance: [1.0, 2.0, 3.0] };
    let options = "--atlas 2 --links 4 --map fp16 --link-format fp16 --all-pairs yes";
    let files = StudyFiles::of(&study(&mesh, Lighting::Lights(vec![sun]), options));
    let (faces, bins) = (files.rows("faces.csv"), files.rows("angles.csv"));
    let way = bins[0]["way"].replace('-', "_");
    // The other faces form the dihedral angle, whose cosine is -1/3, with this face.
    let ends: Vec<[f64; 2]> =
        bins.iter().map(|bin| ["from_degrees", "to_degrees"].map(|end| number(bin, end))).collect();
    assert_eq!(ends, [[0.0, 15.0], [105.0, 120.0]]);
    for (bin, own) in bins.iter().zip([&faces[..1], &faces[1..]]) {
        let area: f64 = own.iter().map(|face| number(face, "area_mm2")).sum();
        let all: f64 = faces.iter().map(|face| number(face, "area_mm2")).sum();
        let [mut truth, mut squares, mut off, mut off_squares] = [0.0; 4];
        for face in own {
            for (found, right) in rgb(face, &way).into_iter().zip(rgb(face, "all_pairs")) {
                let area = number(face, "area_mm2");
                truth += area * right;
                squares += area * right * right;
                off += area * (found - right);
                off_squares += area * (found - right) * (found - right);
            }
        }
        for (heading, expected) in [
            ("area_percent", 100.0 * area / all),
            ("B_all_pairs", truth / (3.0 * area)),
            ("all_percent", 100.0 * off / truth),
            ("all_rms_percent", 100.0 * (off_squares / squares).sqrt()),
        ] {
            let found = number(bin, heading);
            assert!((found - expected).abs() <= 1e-6 * expected.abs().max(1e-3), "{heading}: {found} {expected}");
        }
        // Errors of links equal the card's errors, except for the rounding of its formats.
        for (links, all) in [("links_percent", "all_percent"), ("links_rms_percent", "all_rms_percent")] {
            assert!((number(bin, links) - number(bin, all)).abs() < 0.5, "{bin:?}");
        }
    }
    let sky = Light::Sky { radiance: [1.0; 3] };
    let with_sky = study(&mesh, Lighting::Lights(vec![sun, sky]), options);
    assert!(!StudyFiles::of(&with_sky).0.contains_key("angles.csv"), "a sky shines from everywhere");
}

/// At each corner of a square, the irradiance matches the nearest texel's within 5 % of the maximum; a vertex without a
/// face has no value.
#[test]
fn corners_have_the_values_of_their_texels() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3]];
    let square = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let lamp = Light::Point { position: [0.2, 0.3, 0.6], intensity: [1.0, 2.0, 3.0], attenuation: [0.0, 0.0, 1.0] };
    let study = study(&square, Lighting::Lights(vec![lamp]), "--atlas 32 --links 4 --all-pairs no");
    let atlas = Atlas::new(&square, 32).expect("an atlas");
    let entering = irradiance(&atlas, &[lamp], study.material.eta);
    let rows = StudyFiles::of(&study).rows("vertices.csv");
    for row in &rows[..4] {
        let place = DVec3::from(["x", "y", "z"].map(|axis| number(row, axis)));
        let apart = |(texel, _): &(&crossbar_ground::atlas::Texel, &[f64; 3])| (texel.point - place).length();
        let nearest = atlas.texels().iter().zip(&entering).min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let (_, expected) = nearest.expect("a texel");
        let found = rgb(row, "E");
        let most = entering.iter().map(|e| e[0]).fold(0.0, f64::max);
        assert!((found[0] - expected[0]).abs() < 0.05 * most, "{place}: {found:?} {expected:?}");
    }
    assert_eq!(rows[4]["E_r"], "", "a vertex of no face");
}
