//! Solution in a meshed atlas: its texture, and the room rendered through it.

use crate::geom::vector::wide;
use crate::geom::{Hit, Ray, Sides};
use crate::picture::{Picture, RgbImage};
use crate::radiosity::Patches;
use crate::radiosity::display::{AtlasPower, RadiosityAtlas};
use crate::report::{Cell, Table};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::tracer::HostTracer;

/// Solution in an atlas.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasPictures {
    /// Name of the solution's method.
    pub label: String,
    /// Side of the atlas, in texels.
    pub side: u32,
    /// Number of triangles.
    pub triangles: usize,
    /// Power in the texels.
    pub power: AtlasPower,
    /// Picture of the atlas.
    pub texture: RgbImage,
    /// Picture of the room, each pixel a bilinear read.
    pub view: RgbImage,
}

/// Resamples a named solution into an atlas of its patches, and renders it from a camera, with the exposure of all
/// pictures.
pub(super) fn show(
    (patches, atlas): (&Patches, &RadiosityAtlas),
    (label, radiosity): (&str, &[[f64; 3]]),
    camera: &Camera,
    exposure: f64,
) -> Result<AtlasPictures, StudyError> {
    let texels = atlas.texels(patches, radiosity);
    let exposed = |value: [f64; 3]| value.map(|value| (exposure / std::f64::consts::PI * value) as f32);
    let picture = |width, height, pixels: &[[f32; 3]]| Picture::rgb(width, height, pixels).display(1.0);
    let side = atlas.atlas().side();
    let rays = camera.rays();
    let (hits, _) = HostTracer::new(atlas.mesh(), Sides::Both).nearest_all(&rays);
    let pixel = |(ray, hit): (&Ray, Option<Hit>)| {
        let Some(hit) = hit else { return [0.0; 3] };
        let [a, b, c] = atlas.atlas().corners(hit.triangle);
        // Patches are black behind.
        if (b - a).cross(c - a).dot(wide(ray.direction())) >= 0.0 {
            return [0.0; 3];
        }
        let at = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
        exposed(atlas.read_at(&texels, hit.triangle, at))
    };
    let seen: Vec<[f32; 3]> = rays.iter().zip(hits).map(pixel).collect();
    let texture: Vec<[f32; 3]> = texels.iter().map(|&value| exposed(value)).collect();
    Ok(AtlasPictures {
        label: label.to_owned(),
        side,
        triangles: atlas.mesh().len(),
        power: atlas.power(patches, radiosity, &texels),
        texture: picture(side, side, &texture)?,
        view: picture(camera.width(), camera.height(), &seen)?,
    })
}

/// Table with a line per channel: the power in the atlas and that of the patches.
pub(super) fn table(atlas: Option<&AtlasPictures>) -> Table {
    let mut table = Table::of(
        "The meshed atlas; power is radiosity times area",
        "of side triangles channel power_in_texels power_of_patches difference_% at_most_%",
    );
    if let Some(AtlasPictures { label, side, triangles, power, .. }) = atlas {
        for (at, channel) in ["red", "green", "blue"].into_iter().enumerate() {
            let [held, exact, bound] = [power.held[at], power.exact[at], power.bound[at]];
            let share = |part: f64| if exact > 0.0 { Cell::measured(100.0 * part / exact) } else { Cell::Empty };
            table.push([
                label.as_str().into(),
                (*side).into(),
                (*triangles).into(),
                channel.into(),
                Cell::measured(held),
                Cell::measured(exact),
                share(held - exact),
                share(bound),
            ]);
        }
    }
    table
}
