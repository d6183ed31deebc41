//! Pass 3 on a card: pixels against the formulas in f64, and no face that reads another's texels.

use crossbar::atlas::Atlas;
use crossbar::card::Texels;
use crossbar::geom::Mesh;
use crossbar::geom::vector::wide;
use crossbar::scene::Camera;
use crossbar::subsurface::fresnel::mean_transmittance;
use crossbar::subsurface::fresnel_transmittance;
use crossbar::subsurface::kernels::{Combine, DirectLight, EyeTransmittance, ViewKernel};
use crossbar::subsurface::on_card::{Light, LightStage, SubsurfaceCard, SubsurfaceCardOptions, View};
use glam::DVec3;
use refsim::texture::TexelFormat;
use std::collections::BTreeSet;
use std::f64::consts::PI;

use super::on_card::{ETA, SIDE, atlas, card, cube, lights, to_itself};

fn cameras() -> Vec<Camera> {
    let eyes = [[3.0, -4.0, 2.5], [-2.0, -3.0, -4.0], [1.2, 5.0, 0.3], [0.0, 0.0, 1.05], [-40.0, 30.0, 20.0]];
    let camera = |eye: [f32; 3]| {
        let distance = eye.map(|x| x * x).iter().sum::<f32>().sqrt();
        let up = if eye[..2] == [0.0; 2] { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
        Camera::new(eye, [0.0; 3], up, 1.6 / distance.max(2.0), 40, 36).expect("a camera")
    };
    eyes.map(camera).to_vec()
}

fn options() -> SubsurfaceCardOptions {
    SubsurfaceCardOptions { light: LightStage::Texels, ..SubsurfaceCardOptions::default() }
}

/// Each face in a color of its own: every pixel has exactly one of them, whatever the view.
#[test]
fn no_face_reads_another() {
    let colors: Vec<[f64; 3]> = (0..12).map(|face| [1.0 + f64::from(face), 0.7 * f64::from(face), 0.3]).collect();
    for shape in [cube(2.0), slivers()] {
        let faces = shape.len();
        let atlas = Atlas::new(&shape, SIDE).expect("an atlas");
        let mut card = card(&atlas, &to_itself(), options());
        card.irradiate(&colors[..faces]).expect("irradiances");
        let scattered = card.read_scattered().expect("a map");
        let factor = (mean_transmittance(ETA) / PI) as f32;
        let allowed: BTreeSet<[u32; 3]> =
            scattered.texels.iter().map(|texel| [0, 1, 2].map(|channel| (texel[channel] * factor).to_bits())).collect();
        assert!(allowed.len() <= faces);
        let mut seen = BTreeSet::new();
        for camera in cameras() {
            let kernel = ViewKernel {
                transmittance: EyeTransmittance::Mean,
                direct: DirectLight::None,
                ..ViewKernel::default()
            };
            let picture = card.view_texels(&View { kernel, ..View::scattered(camera) }).expect("a picture");
            for &[r, g, b, alpha] in picture.texels.iter().filter(|texel| texel[3] != 0.0) {
                let color = [r, g, b].map(f32::to_bits);
                assert!(alpha == 1.0 && allowed.contains(&color), "{:?}", [r, g, b]);
                seen.insert(color);
            }
        }
        assert!(seen.len() >= allowed.len() - 1, "{} of {} colors", seen.len(), allowed.len());
    }
}

/// Thin triangles around an axis, of very different sizes.
fn slivers() -> Mesh {
    let mut positions = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    const STEPS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];
        let around = || STEPS.into_iter().flat_map(|dx| STEPS.map(|dy| (x + dx / 16.0, y + dy / 16.0)));
        // Where all points around see one face, and that face is in front: a cube shows no face behind another.
        let seen = (0..host.mesh.len() as u32)
            .find_map(|face| around().map(|(x, y)| host.color(x, y, face)).collect::<Option<Vec<_>>>());
        let Some(colors) = seen else { continue };
        assert_eq!(found[3], 1.0, "pixel ({x}, {y}) shows the model");
        compared += 1;
        for channel in 0..3 {
            let of = colors.iter().map(|color| color[channel]);
            let (least, most) =
                of.fold((f64::MAX, 0.0_f64), |(least, most), value| (least.min(value), most.max(value)));
            let margin = (most - least) / 4.0 + error * f64::from(brightest);
            let value = f64::from(found[channel]);
            assert!(
                value >= least - margin && value <= most + margin,
                "pixel ({x}, {y}), channel {channel} of {:?}: {value}, expected {least} to {most}",
                host.view.kernel
            );
        }
    }
    compared
}

/// The table's errors: linear between 256 entries of 16 bits with weights of 8 bits, T' < 10, T'' < 40.
const TABLE: f64 = 40.0 / 8.0 / (255.0 * 255.0) + 10.0 / 255.0 / 512.0 + 1.0 / 65536.0;

#[test]
fn pixels_are_those_of_the_formulas() {
    let (mesh, atlas) = (cube(2.0), atlas(2.0));
    let all = lights();
    let mut card = card(&atlas, &to_itself(), options());
    card.light(&all).expect("light");
    let mut compared = 0;
    for kernel in ViewKernel::all() {
        for camera in cameras() {
            // A highlight is not linear between vertices, nor is a point light.
            let specular = if kernel.direct == DirectLight::ByFragment { [0.5, 0.4, 0.3] } else { [0.0; 3] };
            let lights = if kernel.direct == DirectLight::ByVertex { &all[..2] } else { &all[..] };
            card.light(lights).expect("light");
            let view = View {
                kernel,
                exposure: 1.5,
                diffuse: [0.8, 0.6, 0.4],
                specular,
                shininess: 20.0,
                ..View::scattered(camera)
            };
            let scattered = card.read_scattered().expect("a map");
            let host = Host { atlas: &atlas, mesh: &mesh, scattered, view, lights };
            let table = if kernel.transmittance == EyeTransmittance::Table { TABLE / PI * 1.5 } else { 0.0 };
            compared += pixels_agree(&mut card, &host, 2e-5 + table);
        }
    }
    assert!(compared > 15 * 5 * 200, "{compared} pixels");
}

#[test]
fn a_picture_of_8_bits_is_the_float_one_rounded() {
    let atlas = atlas(2.0);
    let mut card = card(&atlas, &to_itself(), options());
    card.light(&lights()).expect("light");
    let picture = |card: &mut SubsurfaceCard, format| {
        let view = View { format, exposure: 2.0, ..View::scattered(cameras()[0]) };
        card.view(&view).expect("a picture");
        card.view_texels(&view).expect("a picture")
    };
    let [floats, bytes] = [TexelFormat::Rgba32f, TexelFormat::Bgra8].map(|format| picture(&mut card, format));
    for (float, byte) in floats.texels.iter().zip(&bytes.texels) {
        for (float, byte) in float.iter().zip(byte) {
            assert!((float.clamp(0.0, 1.0) - byte).abs() <= 0.5 / 255.0 + 1e-7);
        }
    }
}

/// By fragment 60 constants hold 15 lights, by vertex 256 instructions 11.
#[test]
fn more_direct_lights_than_a_program_takes_are_refused() {
    let atlas = atlas(2.0);
    let mut card = card(&atlas, &to_itself(), options());
    let light = Light::Directional { towards: [0.0, 0.0, 1.0], irradiance: [0.01; 3] };
    for (direct, most) in [(DirectLight::ByVertex, 11), (DirectLight::ByFragment, 15)] {
        let kernel = ViewKernel { direct, ..ViewKernel::default() };
        let view = View { kernel, diffuse: [1.0; 3], ..View::scattered(cameras()[0]) };
        card.light(&vec![light; most]).expect("light");
        card.view_texels(&view).expect("a picture");
        card.light(&vec![light; most + 1]).expect("light");
        let refused = card.view_texels(&view).expect_err("too many").to_string();
        let found = most + 1;
        assert_eq!(
            refused,
            format!(
                "found {found} lights beside skies, a program of direct light on device `nv35` takes at most {most}"
            )
        );
    }
    let bad = View { exposure: f64::NAN, ..View::scattered(cameras()[0]) };
    let words = card.view_texels(&bad).expect_err("no exposure").to_string();
    assert_eq!(words, "expected an exposure of 0 to 1e30, found NaN");
}
