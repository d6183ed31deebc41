//! Bi-scale transfer: light times biclusters, then the display of a bidirectional texture.

use refsim::texture::TexelFormat;

use super::subject::{System, bunny, cameras};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::on_card::{BiScaleCard, DisplayOptions, TexturedMesh};
use crate::bi_scale::texture::BidirectionalTexture;
use crate::card::MeshView;
use crate::geom::random::CounterRng;
use crate::study::StudyError;
use crate::transfer::synthetic::signal_at;
use crate::transfer::{Tangents, Vertices};

/// Number of texels, and of view and light directions, per side.
const TEXELS: usize = 8;
const VIEWS: usize = 4;
const LIGHTS: usize = 4;

/// Bunny with a texture of random responses, and local light made of waves.
pub(super) fn textured_bunny() -> Result<System, StudyError> {
    let mesh = bunny();
    let (vertices, cameras) = (Vertices::new(&mesh, Tangents::Any)?, cameras(&mesh));
    let random = CounterRng::new(5);
    let at = |vertex: u32| {
        let [x, y, _] = vertices.positions()[vertex as usize];
        [1.7 * x, 0.9 * y + 0.3]
    };
    let coordinates: Vec<[[f32; 2]; 3]> = vertices.triangles().iter().map(|corners| corners.map(at)).collect();
    let count = (TEXELS * TEXELS * VIEWS * VIEWS * LIGHTS * LIGHTS) as u64;
    let samples = (0..count).map(|at| [0, 1, 2].map(|channel| random.unit(at, channel, 0) as f32)).collect();
    let directions = |side| LocalDirections::new(side).expect("a side above 0");
    let texture = BidirectionalTexture::new(TEXELS, directions(VIEWS), directions(LIGHTS), samples);
    let textures = [texture.expect("as many samples as texels and directions")];
    let lights = LIGHTS * LIGHTS;
    let place = |at: usize| vertices.positions()[at].map(f64::from);
    let signal = signal_at(vertices.len(), 3 * lights, 5, place);
    let scale = 1.0 / lights as f32;
    let waves = signal.values().as_chunks().0.iter();
    let local: Vec<[f32; 3]> = waves.map(|rgb: &[f32; 3]| rgb.map(|x| scale * (1.0 + x))).collect();
    let texture_of = vec![0; coordinates.len()];
    Ok(System::picture("Bi-scale transfer: a bidirectional texture on the bunny", move |input, profile, executor| {
        let mesh = TexturedMesh {
            vertices: &vertices,
            coordinates: &coordinates,
            textures: &textures,
            texture_of: &texture_of,
        };
        let mut card = BiScaleCard::new(profile.clone(), executor.clone(), mesh, DisplayOptions::default())?;
        let view = MeshView { camera: cameras[input], exposure: 0.8, format: TexelFormat::Rgba32f };
        Ok(card.view_texels(&local, &view)?.colors())
    }))
}
