//! Pass 3 on a card: pixels agree with the formulas in f64, and no face reads texels of another.

use crossbar::atlas::Atlas;
use crossbar::card::{MeshView, Texels};
use crossbar::elementary;
use crossbar::geom::Mesh;
use crossbar::geom::vector::wide;
use crossbar::scene::Camera;
use crossbar::subsurface::fresnel_transmittance;
use crossbar::subsurface::kernels::{DirectLight, EyeTransmittance, ViewKernel};
use crossbar::subsurface::on_card::{Light, LightStage, SubsurfaceCard, SubsurfaceCardOptions, View};
use glam::DVec3;
use std::f64::consts::PI;

use super::on_card::{ETA, arriving, atlas, card, cube, lights, to_itself};

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

/// Pass 3 for flat faces on the host, in f64.
struct Host<'a> {
    atlas: &'a Atlas,
    mesh: &'a Mesh,
    scattered: Texels,
    view: View,
    lights: &'a [Light],
}

impl Host<'_> {
    /// The color at a point of the picture; `None` if the ray does not meet this face.
    fn color(&self, x: f64, y: f64, face: u32) -> Option<[f64; 3]> {
        let (eye, direction) = (wide(self.view.mesh.camera.eye()), self.view.mesh.camera.direction_at(x, y));
        let [a, b, c] = self.mesh.corners(face)?.map(wide);
        let normal = (b - a).cross(c - a);
        let t = normal.dot(a - eye) / normal.dot(direction);
        let point = eye + t * direction;
        let weight = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) / normal.dot(normal);
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        if t <= 0.0 || normal.dot(direction) >= 0.0 || weights.iter().any(|weight| *weight < 0.0) {
            return None;
        }
        let (normal, to_eye) = (normal.normalize(), (eye - point).normalize());
        let transmittance = fresnel_transmittance(ETA, normal.dot(to_eye));
        let scattered = self.bilinear(face, weights).map(|b| b * transmittance / PI * self.view.mesh.exposure);
        let direct = self.direct(point, normal, to_eye).map(|value| value * self.view.mesh.exposure);
        Some([0, 1, 2].map(|c| match self.view.kernel.direct {
            DirectLight::None => scattered[c],
            DirectLight::ByVertex | DirectLight::ByFragment => scattered[c] + direct[c],
        }))
    }

    fn bilinear(&self, face: u32, weights: [f64; 3]) -> [f64; 3] {
        let place = self.atlas.places()[face as usize];
        let [x0, y0, x1, y1] = place.bounds();
        let [x, y] = place.coordinates(weights);
        let [x, y] = [x.clamp(x0, x1) - 0.5, y.clamp(y0, y1) - 0.5];
        let at = |column: f64, row: f64| {
            let [column, row] = [column.min(x1 - 0.5), row.min(y1 - 0.5)].map(|at| at as usize);
            self.scattered.row(row)[column]
        };
        let [fx, fy] = [x.fract(), y.fract()];
        [0, 1, 2].map(|c| {
            let texel = |column, row| f64::from(at(column, row)[c]);
            let row = |row| (1.0 - fx) * texel(x.floor(), row) + fx * texel(x.floor() + 1.0, row);
            (1.0 - fy) * row(y.floor()) + fy * row(y.floor() + 1.0)
        })
    }

    fn direct(&self, point: DVec3, normal: DVec3, to_eye: DVec3) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for light in self.lights {
            if let Light::Sky { radiance } = light {
                (0..3).for_each(|c| sum[c] += radiance[c] * self.view.diffuse[c]);
            }
            let Some((color, to, attenuation)) = arriving(light, point) else { continue };
            let cosine = normal.dot(to);
            if cosine > 0.0 {
                let highlight = elementary::pow(normal.dot((to + to_eye).normalize()).max(0.0), self.view.shininess);
                for c in 0..3 {
                    let factor = self.view.diffuse[c] / PI * cosine + self.view.specular[c] * highlight;
                    sum[c] += color[c] * attenuation * factor;
                }
            }
        }
        sum
    }
}

/// Snapping to a sixteenth of a pixel moves a corner by up to a thirty-second along each axis. So each channel must lie
/// between the smallest and the largest value of the formula at 5 x 5 points around the center, widened by a quarter of
/// that range, because a kink may fall between two points, and by `error` relative to the brightest value.
fn pixels_agree(card: &mut SubsurfaceCard, host: &Host<'_>, error: f64) -> usize {
    const STEPS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let picture = card.view_texels(&host.view).expect("a picture");
    let brightest = picture.texels.iter().flat_map(|texel| &texel[..3]).fold(0.0, |most: f32, value| most.max(*value));
    let mut compared = 0;
    for (pixel, found) in picture.texels.iter().enumerate() {
        let [x, y] = [pixel % picture.width, pixel / picture.width].map(|at| at as f64 + 0.5);
        let around = || STEPS.into_iter().flat_map(|dx| STEPS.map(|dy| (x + dx / 16.0, y + dy / 16.0)));
        // If all points around see the same face, it is in front: no front face of a cube is behind another.
        let face = (0..host.mesh.len() as u32).find(|&face| host.color(x, y, face).is_some());
        let seen = face.and_then(|face| around().map(|(x, y)| host.color(x, y, face)).collect::<Option<Vec<_>>>());
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

/// Error of the table lookup: linear interpolation between 256 16-bit entries with 8-bit weights, where T' < 10 and T''
/// < 40.
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
            // Highlights and point lights are not linear between vertices.
            let specular = if kernel.direct == DirectLight::ByFragment { [0.5, 0.4, 0.3] } else { [0.0; 3] };
            let lights = if kernel.direct == DirectLight::ByVertex { &all[..2] } else { &all[..] };
            card.light(lights).expect("light");
            let scattered = View::scattered(MeshView { exposure: 1.5, ..camera.into() });
            let view = View { kernel, diffuse: [0.8, 0.6, 0.4], specular, shininess: 20.0, ..scattered };
            let scattered = card.read_scattered().expect("a map");
            let host = Host { atlas: &atlas, mesh: &mesh, scattered, view, lights };
            let table = if kernel.transmittance == EyeTransmittance::Table { TABLE / PI * 1.5 } else { 0.0 };
            compared += pixels_agree(&mut card, &host, 2e-5 + table);
        }
    }
    assert!(compared > 6 * 5 * 200, "{compared} pixels");
}

/// By fragment, 60 constants hold 15 lights; by vertex, 256 instructions suffice for 11.
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
        assert!(refused.ends_with(&format!("supports at most {most}")), "{refused}");
    }
    let bad = View::scattered(MeshView { exposure: f64::NAN, ..cameras()[0].into() });
    assert!(card.view_texels(&bad).is_err(), "no exposure");
}
