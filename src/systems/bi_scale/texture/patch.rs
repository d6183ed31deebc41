//! A patch of heights with a material per texel: b(u, e, d) for any directions.
//!
//! A point u of the mesh's surface shows the point of the patch behind it along the view (parallax). The response is
//! that point's BRDF times the cosine at the patch's surface, or 0 if the patch blocks the light.

use std::f64::consts::FRAC_1_PI;
use std::ops::ControlFlow;

use glam::DVec3;

use super::field::HeightField;
use super::ray::{TexelRay, follow};
use crate::elementary::on_circle;
use crate::error::{InputError, ensure, input_error};
use crate::transfer::LocalFrame;
use crate::transfer::brdf::Brdf;

/// A diffuse color and a glossy lobe.
#[derive(Clone, Debug, PartialEq)]
pub struct MesoMaterial {
    /// Reflectance of the diffuse part: red, green, blue.
    pub color: [f64; 3],
    /// The lobe, in the frame of the surface with x along the texel's tangent.
    pub lobe: Option<Brdf>,
    /// Factors of the lobe: red, green, blue.
    pub lobe_color: [f64; 3],
}

impl MesoMaterial {
    /// A Lambert surface.
    pub fn diffuse(color: [f64; 3]) -> Self {
        Self { color, lobe: None, lobe_color: [0.0; 3] }
    }

    /// Checks that all parameters are in range. Fails with [`InputError`] for the first that is not.
    pub fn check(&self) -> Result<(), InputError> {
        for albedo in self.color.into_iter().chain(self.lobe_color) {
            Brdf::Lambert { albedo }.check()?;
        }
        self.lobe.map_or(Ok(()), |lobe| lobe.check())
    }

    /// The BRDF per channel, in 1/sr; 0 unless both directions are above the surface.
    pub fn value(&self, view: DVec3, light: DVec3) -> [f64; 3] {
        if !(view.z > 0.0 && light.z > 0.0) {
            return [0.0; 3];
        }
        let lobe = self.lobe.map_or(0.0, |lobe| lobe.value(view, light));
        [0, 1, 2].map(|channel| self.color[channel] * FRAC_1_PI + self.lobe_color[channel] * lobe)
    }
}

/// A repeating patch.
#[derive(Clone, Debug, PartialEq)]
pub struct MesoPatch {
    heights: HeightField,
    materials: Vec<MesoMaterial>,
    texels: Vec<MesoTexel>,
}

/// Material and tangent of a texel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MesoTexel {
    /// The index of its material.
    pub material: u32,
    /// The tangent's angle from u towards v, in turns.
    pub turns: f64,
}

/// The point of the patch that a view sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenPoint {
    /// Its position in texels, in the patch's repetition that was hit.
    at: [f64; 2],
    /// Its height, in edges of the patch.
    height: f64,
    /// The surface's frame relative to the mesh's local frame: x along the texel's tangent.
    frame: LocalFrame,
    /// The direction to the eye in this frame.
    view: DVec3,
    material: usize,
}

impl MesoPatch {
    /// A patch of heights, with texels row by row and their materials.
    pub fn new(heights: HeightField, materials: Vec<MesoMaterial>, texels: Vec<MesoTexel>) -> Result<Self, InputError> {
        let (expected, side) = (heights.heights().len(), heights.side());
        ensure!(texels.len() == expected, "expected {expected} texels, one per height, found {}", texels.len());
        let is_good = |texel: &MesoTexel| (texel.material as usize) < materials.len() && texel.turns.is_finite();
        if let Some(at) = texels.iter().position(|texel| !is_good(texel)) {
            let (row, column) = (at / side, at % side);
            return Err(input_error!(
                "expected a material below {} and a finite tangent, found {} and {} in row {row}, column {column}",
                materials.len(),
                texels[at].material,
                texels[at].turns
            ));
        }
        for (material, of) in materials.iter().enumerate() {
            of.check().map_err(|reason| input_error!("material {material} (counted from 0): {reason}"))?;
        }
        Ok(Self { heights, materials, texels })
    }

    /// A flat patch of one material: a spatially invariant BRDF.
    pub fn plain(material: MesoMaterial) -> Result<Self, InputError> {
        Self::new(HeightField::flat(), vec![material], vec![MesoTexel::default()])
    }

    /// The heights.
    pub fn heights(&self) -> &HeightField {
        &self.heights
    }

    /// b(u, e, d): radiance towards `view` at texture coordinates `place`, per radiance times solid angle from `light`.
    /// Directions have length 1, in the mesh's local frame; light from below the horizon gives 0, and a view from below
    /// is moved to the horizon.
    pub fn response(&self, place: [f64; 2], view: DVec3, light: DVec3) -> [f64; 3] {
        self.reflected(&self.seen(place, view), light)
    }

    /// The point that a view sees through texture coordinates `place`.
    pub fn seen(&self, place: [f64; 2], view: DVec3) -> SeenPoint {
        let field = &self.heights;
        let view = if view.z > 0.0 { view } else { level(view) };
        let through = field.texels(place);
        let floor = |at: [f64; 2]| at.map(|at| at.floor() as isize);
        let ray = TexelRay::new(field.side(), through, 0.0, (-view).to_array(), -field.depth());
        // A ray without a hit ends at the lowest height, or after the maximum distance.
        let end = ray.place(ray.end.max(0.0));
        let hit = follow(&ray, |span| ray.hit(field, span).map_or(ControlFlow::Continue(()), ControlFlow::Break));
        let (at, cell) = hit.map_or_else(|| (end, floor(end)), |hit| (hit.at, hit.cell));
        let texel = self.texels[field.wrapped((at[0] + 0.5).floor() as isize, (at[1] + 0.5).floor() as isize)];
        let normal = field.normal_in(cell, at);
        let [x, y] = on_circle(texel.turns);
        // Normals point upwards, so no tangent in the plane is parallel to one.
        let frame = LocalFrame::new(normal, DVec3::new(x, y, 0.0)).unwrap_or_else(|| LocalFrame::of_normal(normal));
        SeenPoint {
            at,
            height: field.height_at(at),
            frame,
            view: frame.to_local(view),
            material: texel.material as usize,
        }
    }

    /// The response b of a seen point for light from a direction, one value per channel.
    pub fn reflected(&self, seen: &SeenPoint, light: DVec3) -> [f64; 3] {
        let local = seen.frame.to_local(light);
        if !(light.z > 0.0 && local.z > 0.0 && seen.view.z > 0.0) {
            return [0.0; 3];
        }
        let field = &self.heights;
        let ray = TexelRay::new(field.side(), seen.at, seen.height, light.to_array(), -field.depth());
        let dips = |is: bool| if is { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        if follow(&ray, |span| dips(ray.dips(field, span))).is_some() {
            return [0.0; 3];
        }
        self.materials[seen.material].value(seen.view, local).map(|value| value * local.z)
    }
}

impl SeenPoint {
    /// The point's position u, v and height in edges of the patch; parallax moves it from the texture coordinates
    /// through which it is seen.
    pub fn point(&self, patch: &MesoPatch) -> DVec3 {
        let [u, v] = self.at.map(|at| (at + 0.5) / patch.heights().side() as f64);
        DVec3::new(u, v, self.height)
    }
}

/// Moves a direction below the horizon to the horizon.
fn level(view: DVec3) -> DVec3 {
    DVec3::new(view.x, view.y, 0.0).try_normalize().unwrap_or(DVec3::Z)
}
