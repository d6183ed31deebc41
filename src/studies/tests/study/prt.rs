//! Radiance transfer: pictures of lights, interpolation over triangles, pictures of factors.

use std::f64::consts::PI;

use crossbar_base::geom::vector::wide;
use crossbar_base::geom::{Mesh, Ray};
use crossbar_ground::picture::Picture;
use crossbar_ground::scene::Camera;
use crossbar_ground::sphere::{EnvironmentPicture, HarmonicLight};
use crossbar_studies::study::prt::{BrdfFactors, FactorSubject, LitModel, LitPart, LitView, Rendering};
use crossbar_systems::all_frequency::Reflectance;
use crossbar_systems::all_frequency::factor::{FactorSampling, Supersamples};
use crossbar_systems::all_frequency::file::AllFrequencyFile;
use crossbar_systems::clustering::Signal;
use crossbar_systems::transfer::brdf::Brdf;
use crossbar_systems::transfer::file::{MeshDigest, PrtFile, PrtMeaning};
use crossbar_systems::transfer::grid::texel_center;
use crossbar_systems::transfer::light::{CubeLight, DiskSource, DistantLight};
use crossbar_systems::transfer::linear_basis::BasisWidth;
use crossbar_systems::transfer::{Tangents, Vertices};
use glam::DVec3;

use super::{StudyFiles, number};

/// A triangle in the plane z = 0, its vertices, and a camera above it.
fn triangle() -> (Mesh, Vertices, LitView) {
    let corners = vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2]]).expect("a mesh");
    let vertices = Vertices::new(&mesh, Tangents::Any).expect("vertices");
    let camera = Camera::new([0.7, 1.3, 5.0], [0.7, 1.3, 0.0], [0.0, 1.0, 0.0], 0.5, 48, 48).expect("a camera");
    let view = LitView { model: "a triangle".to_owned(), light: "a light".to_owned(), camera, exposure: None };
    (mesh, vertices, view)
}

/// Each corner has its own channel, so a pixel's channel is the barycentric weight of that corner, in [0, 1].
#[test]
fn weights_are_barycentric_and_stay_inside() {
    let (mesh, vertices, view) = triangle();
    let meaning = PrtMeaning::Transfer { channels: 3, exit_functions: vec![0], light_order: 1, includes_albedo: true };
    let unit = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let transfer = Some(Signal::new(3, unit).expect("a signal"));
    let file = PrtFile { meaning, mesh: None, transfer, clustering: None, provenance: None };
    let light = HarmonicLight::constant(1, [1.0; 3]).expect("a light");
    let scale = light.channels()[0][0];
    let (rays, width) = (view.camera.rays(), view.camera.width() as usize);
    let found = StudyFiles::of(&Rendering { view, mesh, vertices, file, original: None, light }).linear("picture.exr");
    let mut seen = 0;
    for (ray, found) in rays.iter().zip(&found).filter(|(_, found)| **found != [0.0; 3]) {
        let weights = found.map(|channel| f64::from(channel) / scale);
        let (origin, direction) = (wide(ray.origin()), wide(ray.direction()));
        let at = origin - origin.z / direction.z * direction;
        let expected = [1.0 - at.x / 2.0 - at.y / 4.0, at.x / 2.0, at.y / 4.0];
        assert!(weights.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5), "{at}");
        assert!(weights.iter().all(|weight| (0.0..=1.0 + 1e-6).contains(weight)), "{weights:?}");
        seen += 1;
    }
    let inside = |ray: &&Ray| {
        let at = wide(ray.origin()) - wide(ray.origin()).z / wide(ray.direction()).z * wide(ray.direction());
        at.x > 0.0 && at.y > 0.0 && at.x / 2.0 + at.y / 4.0 < 1.0
    };
    assert_eq!(seen, rays.iter().filter(inside).count());
    assert!(seen > width, "{seen}");
}

/// The picture of a light, from a study of a triangle without transfer.
fn picture_of(light: DistantLight) -> Picture {
    StudyFiles::of(&without_transfer(light)).picture("light.png")
}

fn without_transfer(light: DistantLight) -> LitModel {
    let (mesh, vertices, view) = triangle();
    let file = AllFrequencyFile {
        mesh: MeshDigest::new(&vertices),
        hats: BasisWidth::default(),
        reflectance: Reflectance::Diffuse,
        visibility: None,
        coded: None,
        model: None,
    };
    let model = LitPart { mesh, vertices, colors: vec![[1.0; 3]], file };
    LitModel { view, model, original: None, ground: None, light, keep: None }
}

/// Without light, there is nothing to which a difference is relative.
#[test]
fn black_pictures_are_compared_without_a_ratio() {
    let (mesh, vertices, view) = triangle();
    let meaning = PrtMeaning::Transfer { channels: 1, exit_functions: vec![0], light_order: 1, includes_albedo: true };
    let original = Some(Signal::new(1, vec![1.0; 3]).expect("a signal"));
    let file = PrtFile { meaning, mesh: None, transfer: original.clone(), clustering: None, provenance: None };
    let light = HarmonicLight::constant(1, [0.0; 3]).expect("a light");
    let low = StudyFiles::of(&Rendering { view, mesh, vertices, file, original, light });
    let mut all = without_transfer(DistantLight::Constant([1.0; 3]));
    all.original = Some(all.model.file.clone());
    for files in [low, StudyFiles::of(&all)] {
        let rows = files.rows("comparison.csv");
        assert_eq!((rows[0]["value"].as_str(), number(rows.last().expect("rows"), "value")), ("", 0.0));
    }
}

/// If a disk's picture is read as a light again, the disk is in its original direction.
#[test]
fn the_picture_read_as_a_light_comes_from_the_same_direction() {
    let towards = DVec3::new(0.6, -0.5, 0.4).normalize();
    let picture = picture_of(DistantLight::Disks(vec![DiskSource { towards, radius: 0.3, radiance: [5.0, 4.0, 3.0] }]));
    let read = EnvironmentPicture::new(&picture).expect("a lat-long picture");
    let read = CubeLight::from_picture(&read).expect("a light");
    let middle: DVec3 = read.texels().iter().enumerate().map(|(n, texel)| texel[0] * texel_center(n)).sum();
    assert!(middle.normalize().dot(towards) > 0.999, "{towards} {}", middle.normalize());
}

#[test]
fn a_black_light_is_black() {
    let pixels = picture_of(DistantLight::Constant([0.0; 3])).linear().expect("a picture in color");
    assert!(pixels.iter().all(|pixel| *pixel == [0.0; 3]));
}

/// Two lights on a diffuse sphere, one from the front and one grazing: the ratio of two pixels is the ratio of their
/// sums of cosines.
#[test]
fn a_diffuse_sphere_is_lit_by_the_cosine() {
    let lights = [(DVec3::new(-0.5, -0.6, 0.62), PI), (DVec3::new(0.9, 0.35, 0.1), 0.5 * PI)];
    let study = BrdfFactors {
        name: "white".to_owned(),
        subject: FactorSubject::Brdf(Brdf::Lambert { albedo: 1.0 }),
        sampling: FactorSampling { side: 8, supersamples: Supersamples::NONE, ..FactorSampling::default() },
        terms: None,
    };
    let picture = StudyFiles::of(&study).picture("f.png");
    let size = f64::from(picture.width());
    let pixels = picture.linear().expect("a picture in color");
    let place = |along: f64| (((along / 1.05 + 1.0) * size - 1.0) / 2.0).round() as u32;
    let shown = |x: f64, z: f64| f64::from(pixels[(place(-z) * picture.width() + place(x)) as usize][0]);
    let lit = |x: f64, z: f64| {
        let normal = DVec3::new(x, -(1.0 - x * x - z * z).sqrt(), z);
        let of = |(light, irradiance): &(DVec3, f64)| irradiance / PI * light.normalize().dot(normal).max(0.0);
        lights.iter().map(of).sum::<f64>()
    };
    let whole = shown(-0.3, 0.4) / lit(-0.3, 0.4);
    for (x, z) in [(0.0, 0.0), (0.3, 0.2), (0.8, 0.1), (-0.5, 0.5)] {
        assert!((shown(x, z) / whole - lit(x, z)).abs() < 0.02, "{x}, {z}: {} {}", shown(x, z) / whole, lit(x, z));
    }
    assert_eq!(shown(-1.0, 1.0), 0.0, "there is nothing beside the sphere");
}
