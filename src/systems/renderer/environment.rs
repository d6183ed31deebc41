//! Environment mapping: mirrors show a cube map of their surroundings, drawn by a card.
//!
//! The Ray Engine's Figure 1 shows this method next to traced reflections. The map holds the scene without its mirrors,
//! in 8-bit texels, as seen from the visible mirror point whose pixel is nearest to the mean of all mirror pixels. A
//! vertex program reflects the view vector, and the pixel program looks up the reflected vector. So objects appear as
//! if they were infinitely far away: a reflection does not touch its object, and mirrors do not reflect each other.

use glam::{DVec2, DVec3};
use refsim::device::Profile;
use refsim::machine::{Executor, Machine, TextureId};
use refsim::num::Format;
use refsim::output::WriteMask;
use refsim::texture::{Image, TargetRounding, TexelFormat, TextureKind};

use super::counting::WatchProgress;
use super::film::RenderedPicture;
use super::settings::settings_error;
use super::{Settings, whitted};
use crate::card::{
    Attribute, BILINEAR, CardError, DepthPrograms, KeptFragments, MeshDisplay, MeshDraw, MeshView, TO_CLIP, Texels,
    attribute, checked,
};
use crate::error::InputError;
use crate::geom::exact::Sides;
use crate::geom::vector::{area_vector, narrow, unit, wide};
use crate::geom::{Hit, Mesh};
use crate::scene::{Camera, Scene, Surface};
use crate::sphere::CUBE_FACES;
use crate::tracer::{Caster, HostTracer};

/// Texels along an edge of the map.
const SIDE: u32 = 128;
/// Pixel program that looks up the reflected vector in the map; c0 is the reflectance.
const LOOKUP: &str = "ps_1_1\ntex t0\nmul r0, t0, c0\n";

/// Card that draws mirrors.
#[derive(Clone, Copy, Debug)]
pub struct EnvironmentCard<'a> {
    /// Profile of the card.
    pub profile: &'a Profile,
    /// Executor of the card's draws.
    pub executor: &'a Executor,
}

/// Renders as [`whitted::render`] with one sample per pixel and no reflected rays, and draws the mirrors on a card.
/// Fails as [`whitted::render`] does, for more than one sample, and if the card rejects a draw.
pub fn render<'a>(
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    card: EnvironmentCard<'_>,
    caster: &'a mut dyn Caster,
    watch: &'a mut WatchProgress<'a>,
) -> Result<RenderedPicture, InputError> {
    if settings.samples != 1 || settings.lens.is_some() {
        let found = format!("{} and {:?}", settings.samples, settings.lens);
        return Err(settings_error("samples and lens", "one sample per pixel and no lens", found));
    }
    let plain = Settings { depth: 0, ..settings.clone() };
    let mut picture = whitted::render(scene, camera, &plain, caster, watch)?;
    let mirrors: Vec<u32> = (0..scene.mesh().len() as u32).filter(|&at| reflectance(scene, at).is_some()).collect();
    let pixel = |at: usize| [at % camera.width() as usize, at / camera.width() as usize].map(|at| at as u32);
    let is_mirror = |hit: &Hit| mirrors.binary_search(&hit.triangle).is_ok();
    let seen: Vec<(DVec2, DVec3)> = (0..)
        .zip(&picture.first)
        .filter_map(|(at, hit)| Some((pixel(at), hit.filter(is_mirror)?)))
        .map(|([x, y], hit)| (DVec2::new(x.into(), y.into()), f64::from(hit.t) * wide(camera.direction(x, y))))
        .collect();
    let middle = seen.iter().map(|seen| seen.0).sum::<DVec2>() / seen.len().max(1) as f64;
    let far = |seen: &(DVec2, DVec3)| seen.0.distance_squared(middle);
    let Some((_, place)) = seen.iter().min_by(|one, other| far(one).total_cmp(&far(other))) else { return Ok(picture) };
    let map = map(scene, &mirrors, wide(camera.eye()) + *place, &plain)?;
    let texels = drawn(scene, camera, &mirrors, &map, card).map_err(|error| InputError::of("", error))?;
    for (color, texel) in picture.color.iter_mut().zip(&texels.texels).filter(|(_, texel)| texel[3] != 0.0) {
        *color = [texel[0], texel[1], texel[2]].map(f64::from);
    }
    Ok(picture)
}

fn reflectance(scene: &Scene, triangle: u32) -> Option<[f32; 3]> {
    match scene.material(triangle).surface {
        Surface::Mirror { reflectance } => Some(reflectance),
        _ => None,
    }
}

/// The scene without its mirrors, seen from the point `place`, as texels of a cube map.
fn map(scene: &Scene, mirrors: &[u32], place: DVec3, settings: &Settings) -> Result<Vec<[f64; 3]>, InputError> {
    let others: Vec<u32> = (0..scene.mesh().len() as u32).filter(|at| mirrors.binary_search(at).is_err()).collect();
    let pick = |at: &u32| scene.mesh().triangles()[*at as usize];
    let mesh = Mesh::new(scene.mesh().positions().to_vec(), others.iter().map(pick).collect())?;
    let material_of = others.iter().map(|&at| scene.material_of()[at as usize]).collect();
    let normals = others.iter().map(|&at| scene.corner_normals(at).unwrap_or_default()).collect();
    let mut around = Scene::new(mesh, scene.materials().to_vec(), material_of, normals)?;
    around.point_lights.clone_from(&scene.point_lights);
    let mut tracer = HostTracer::new(around.mesh(), Sides::Both);
    seen_around(place, SIDE, |camera| Ok(whitted::render(&around, camera, settings, &mut tracer, &mut |_| {})?.color))
}

/// Texels of a cube map of what is seen from a place, face by face as in [`CUBE_FACES`]. `seen` returns the pixels of a
/// camera, row by row. Fails as `seen` does, and for a place that is not finite.
pub fn seen_around(
    place: DVec3,
    side: u32,
    mut seen: impl FnMut(&Camera) -> Result<Vec<[f64; 3]>, InputError>,
) -> Result<Vec<[f64; 3]>, InputError> {
    let mut texels = Vec::new();
    for face in CUBE_FACES {
        let [eye, target, up] = [place, place + face.center, -face.down].map(narrow);
        let pixels = seen(&Camera::new(eye, target, up, 1.0, side, side)?)?;
        // Faces of cube maps are seen from outside.
        texels.extend(pixels.chunks(side as usize).flat_map(|row| row.iter().rev().copied()));
    }
    Ok(texels)
}

/// The mirrors as the card shows them; alpha is 0 elsewhere.
fn drawn(
    scene: &Scene,
    camera: &Camera,
    mirrors: &[u32],
    map: &[[f64; 3]],
    EnvironmentCard { profile, executor }: EnvironmentCard<'_>,
) -> Result<Texels, CardError> {
    let reflect = format!(
        "vs_1_1\ndcl_position v0\ndcl_normal v1\n{TO_CLIP}; the view from the eye, reflected about the normal\nadd r0.xyz, v0, -c4\n\
         dp3 r1.x, r0, v1\nadd r1.x, r1.x, r1.x\nmad oT0.xyz, -r1.x, v1, r0\n"
    );
    let reflect = checked(profile, "the reflection".to_owned(), &reflect)?;
    let lookup = checked(profile, "the lookup".to_owned(), LOOKUP)?;
    let depth = DepthPrograms::new(profile)?;
    let mut machine = executor.machine(profile.clone())?;
    let texture = upload(&mut machine, map)?;
    let own = |corners: [[f32; 3]; 3]| [unit(area_vector(corners.map(wide))).map_or([0.0; 3], narrow); 3];
    let normals: Attribute = (0..)
        .zip(scene.mesh().iter_corners())
        .flat_map(|(at, corners)| scene.corner_normals(at).unwrap_or_else(|| own(corners)))
        .map(|normal| attribute(normal.map(f64::from), 0.0))
        .collect();
    let positions: Vec<[f32; 3]> = scene.mesh().iter_corners().flatten().collect();
    let all: Vec<u32> = (0..positions.len() as u32).collect();
    let view = MeshView { format: TexelFormat::Bgra8, ..(*camera).into() };
    let (texels, _) = MeshDisplay::new(machine, positions).show(&view, false, |pass| {
        pass.draw_depth(&depth, &all)?;
        let of = |at: &u32| reflectance(scene, *at).map_or([0.0; 3], |color| color).map(f32::to_bits);
        for part in mirrors.chunk_by(|one, other| of(one) == of(other)) {
            let indices: Vec<u32> = part.iter().flat_map(|&at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
            let [red, green, blue] = of(&part[0]).map(f32::from_bits);
            pass.draw(MeshDraw {
                vertex: (&reflect, pass.head()),
                attributes: vec![pass.positions(), &normals],
                indices: Some(&indices),
                pixel: (&lookup, vec![[red, green, blue, 1.0]]),
                textures: vec![(texture, BILINEAR)],
                fragments: KeptFragments::Visible,
                mask: WriteMask::ALL,
            })?;
        }
        Ok(())
    })?;
    Ok(texels)
}

fn upload(machine: &mut Machine, map: &[[f64; 3]]) -> Result<TextureId, CardError> {
    let values: Vec<[u32; 4]> =
        map.iter().map(|&[r, g, b]| [r, g, b, 1.0].map(|value| (value as f32).to_bits())).collect();
    let (format, rounding) = (TexelFormat::Bgra8, TargetRounding::Nearest);
    let image = Image::from_values(format, TextureKind::Cube, [SIDE, SIDE, 1], Format::FP32, &values, rounding);
    Ok(machine.create_texture(image?)?)
}
