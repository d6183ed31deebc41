//! Picture layers, with channel names that EXR viewers group.

use super::eye::albedo;
use super::film::RenderedPicture;
use super::surfel::Surfel;
use crate::error::InputError;
use crate::geom::vector::narrow;
use crate::picture::{ChannelUnit, Picture, Samples};
use crate::scene::{Camera, Color, Scene};
use crate::tracer::offset::SINGLE;

/// Converts to a picture with color in single precision (`R`, `G`, `B`), and for the first hit through the centre of
/// each pixel: depth along the view (`Z`, infinite for a miss), shading normal (`N.X`, `N.Y`, `N.Z`), total reflectance
/// or transmittance (`albedo.R`, `albedo.G`, `albedo.B`), and `triangle` (`u32::MAX` for a miss). Fails if the picture
/// has no pixels, or the camera has another number of pixels.
pub fn layers(picture: &RenderedPicture, scene: &Scene, camera: &Camera) -> Result<Picture, InputError> {
    let color: Vec<[f32; 3]> = picture.color.iter().map(|color| color.map(|c| c as f32)).collect();
    let surface = |(ray, hit)| Surfel::new(scene, SINGLE, &ray, hit?);
    let seen = camera.rays().into_iter().zip(picture.first.iter().copied()).map(surface);
    let of = |surfel: Surfel<'_>| (narrow(surfel.shading), narrow(albedo(&surfel.material.surface)));
    let (normals, albedos): (Vec<[f32; 3]>, Vec<Color>) = seen.map(|surfel| surfel.map(of).unwrap_or_default()).unzip();
    let depth = picture.first.iter().map(|hit| hit.map_or(f32::INFINITY, |hit| hit.t)).collect();
    let triangles = picture.first.iter().map(|hit| hit.map_or(u32::MAX, |hit| hit.triangle)).collect();
    let layers = Picture::rgb(picture.width, picture.height, &color)
        .with("Z", ChannelUnit::RayLength, Samples::Float(depth))?
        .with("triangle", ChannelUnit::Id, Samples::Uint(triangles))?;
    let layers = with_vectors(layers, ["N.X", "N.Y", "N.Z"], ChannelUnit::Unknown, &normals)?;
    with_vectors(layers, ["albedo.R", "albedo.G", "albedo.B"], ChannelUnit::Linear, &albedos)
}

fn with_vectors(
    picture: Picture,
    names: [&str; 3],
    unit: ChannelUnit,
    vectors: &[[f32; 3]],
) -> Result<Picture, InputError> {
    names.into_iter().enumerate().try_fold(picture, |picture, (component, name)| {
        picture.with(name, unit, Samples::Float(vectors.iter().map(|vector| vector[component]).collect()))
    })
}
