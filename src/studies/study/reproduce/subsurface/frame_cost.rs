//! Modelled time of passes 1 and 3 and of the map's levels, on a model with as many faces as one of the paper's.

use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

use super::gather::{LINKS, Variant};
use super::{StudyError, failed, no_time};
use crate::atlas::Atlas;
use crate::card::{MeshView, Texels};
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::subsurface::kernels::{DirectLight, EyeTransmittance, ViewKernel};
use crate::subsurface::on_card::{
    CardModel, FloatTexels, Light, LightStage, LinkTextures, SubsurfaceCard, SubsurfaceCardOptions, View, pass_times,
};

/// Size of the window in pixels. The paper does not state it.
pub(super) const WINDOW: [u32; 2] = [512, 512];

/// Modelled seconds of the radiosity map of a variant: pass 1, and the map's levels.
#[derive(Clone, Copy, Debug)]
pub(super) struct MapCost {
    pub(super) light: f64,
    pub(super) levels: f64,
}

/// Modelled seconds of the passes of a frame, without pass 2.
#[derive(Clone, Debug)]
pub(super) struct FrameCost {
    /// One per variant that was asked for, in their order.
    pub(super) maps: Vec<MapCost>,
    pub(super) view: f64,
}

impl FrameCost {
    /// Total seconds of a frame of the variant at this place of those asked for, with its pass 2.
    pub(super) fn frame(&self, variant: usize, gather: f64) -> f64 {
        let MapCost { light, levels } = self.maps[variant];
        light + levels + gather + self.view
    }
}

/// Cost of a model's frame on a card: pass 1 and levels of each variant, in their order, and pass 3.
pub(super) fn cost(card: &'static str, mesh: &Mesh, side: u32, variants: &[Variant]) -> Result<FrameCost, StudyError> {
    let profile = Profile::named(card)?;
    let atlas = Atlas::new(mesh, side).map_err(|e| failed(card)(&e))?;
    let model = CardModel::new(&atlas);
    let kernel = ViewKernel { transmittance: EyeTransmittance::Table, direct: DirectLight::ByVertex };
    let shown = MeshView { format: TexelFormat::Bgra8, ..camera(mesh).map_err(|e| failed(card)(&e))?.into() };
    let shown = View { kernel, diffuse: [0.1; 3], ..View::scattered(shown) };
    let sun = Light::Directional { towards: [1.0, -2.0, 3.0], irradiance: [1.0; 3] };
    let mut found = FrameCost { maps: Vec::new(), view: 0.0 };
    for (at, variant) in variants.iter().enumerate() {
        // Pass 1 and levels do not depend on the precision of pass 2.
        let same = |other: &Variant| (other.fixed, other.map) == (variant.fixed, variant.map);
        if let Some(other) = variants[..at].iter().position(same) {
            found.maps.push(found.maps[other]);
            continue;
        }
        // Pass 2 is timed by `gather`, and what is before it does not depend on links: one per texel will do, but for
        // pass 3, which begins with the state that pass 2 leaves.
        let links = if at == 0 { LINKS } else { 1 };
        let mut machine = model_on(profile.clone(), model.clone(), variant, links).map_err(|e| failed(card)(&e))?;
        machine.record(true);
        machine.light(&[sun]).map_err(|e| failed(card)(&e))?;
        if at == 0 {
            machine.view_texels(&shown).map_err(|e| failed(card)(&e))?;
        }
        let [light, levels, _, view] =
            pass_times(&profile, &machine.take_log()).map_err(no_time)?.map(|pass| pass.time.seconds());
        found.maps.push(MapCost { light, levels });
        found.view += view;
    }
    Ok(found)
}

/// Loads a model with links that are all alike, `count` per texel: time does not depend on values.
fn model_on(
    profile: Profile,
    model: CardModel,
    variant: &Variant,
    count: usize,
) -> Result<SubsurfaceCard, Box<dyn std::error::Error + Send + Sync>> {
    let side = model.side();
    let (level, textures, texel) = if variant.fixed {
        (Some(side.ilog2() - count.ilog2() / 2), count.div_ceil(4), [1.0 / 16.0; 4])
    } else {
        (None, count, [0.5, 0.5, 1.0 / 16.0, 0.0])
    };
    let textures = vec![Texels::from_fn([side as usize; 2], |_, _| texel); textures];
    let links = LinkTextures::from_textures(side, level, false, count, textures)?;
    let options = SubsurfaceCardOptions {
        light: LightStage::Vertices,
        map: variant.map,
        links: FloatTexels::Fp16,
        scattered: FloatTexels::Fp16,
        half: false,
        tiles: None,
    };
    Ok(SubsurfaceCard::new(profile, ExecutorKind::Batch, model, &links, 1.3, options)?)
}

/// Camera whose window is filled by the bounding sphere of a mesh.
fn camera(mesh: &Mesh) -> Result<Camera, Box<dyn std::error::Error + Send + Sync>> {
    let [low, high] = mesh.bounds().ok_or("a mesh without faces")?;
    let middle = [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0);
    let radius =
        [0, 1, 2].map(|i| f64::from(high[i] - low[i]) / 2.0).iter().map(|half| half * half).sum::<f64>().sqrt();
    // Half the height of the window is a quarter of its distance.
    let distance = radius * 17.0_f64.sqrt();
    let eye = [middle[0], middle[1] - distance as f32, middle[2]];
    Ok(Camera::new(eye, middle, [0.0, 0.0, 1.0], 0.25, WINDOW[0], WINDOW[1])?)
}

#[cfg(test)]
mod tests {
    use super::super::CARD;
    use super::super::gather::VARIANTS;
    use super::*;

    /// A variant pays for its own map: levels of bytes come from the card, those of floats from passes, and the row of
    /// levels that adaptive links read from more of them.
    #[test]
    fn each_variant_has_its_own_levels() {
        let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let square = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
        let found = cost(CARD, &square, 256, &VARIANTS).expect("the card draws it");
        let of = |name: &str| {
            let place = VARIANTS.iter().position(|variant| variant.name == name).expect("a variant");
            found.maps[place]
        };
        let [bytes, half, single] =
            ["fixed, 8-bit map", "fixed, fp16 map", "fixed, fp32 map"].map(|name| of(name).levels);
        assert!(half > 5.0 * bytes && single > half, "{bytes} {half} {single}");
        assert!(of("adaptive, fp16 map").levels > half);
        assert_eq!(of("adaptive, 8-bit map").levels, bytes, "the map's own levels serve any link");
        assert_eq!(of("fixed, fp16 map, half precision").levels, half);
        assert!(of("fixed, fp32 map").light >= of("fixed, 8-bit map").light, "four times the bytes of pass 1");
    }
}
