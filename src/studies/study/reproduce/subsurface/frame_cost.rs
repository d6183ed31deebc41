//! Modelled time of passes 1 and 3 and of the map's mip levels, on a model with the face count of one of the paper's
//! models. [`super::gather`] times pass 2.

use refsim::device::Profile;
use refsim::texture::TexelFormat;

use super::gather::{VARIANTS, loaded};
use super::{RunResult, StudyError, no_time};
use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::subsurface::kernels::{DirectLight, EyeTransmittance, ViewKernel};
use crate::subsurface::on_card::{CardModel, Light, View, pass_times};

/// Size of the window in pixels. The paper does not state it.
pub(super) const WINDOW: [u32; 2] = [512, 512];

/// Modelled seconds of the passes of a frame, without pass 2: pass 1, the map's levels, and pass 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameCost {
    pub(super) light: f64,
    pub(super) levels: f64,
    pub(super) view: f64,
}

impl FrameCost {
    /// Total seconds of a frame, with its pass 2.
    pub(super) fn frame(&self, gather: f64) -> f64 {
        self.light + self.levels + gather + self.view
    }
}

/// Cost of a model's frame on a card, with fixed links and an 8-bit map.
pub(super) fn cost(card: &'static str, mesh: &Mesh, side: u32) -> Result<FrameCost, StudyError> {
    let profile = Profile::named(card)?;
    let atlas = Atlas::new(mesh, side).on(card)?;
    let kernel = ViewKernel { transmittance: EyeTransmittance::Table, direct: DirectLight::ByVertex };
    let shown = MeshView { format: TexelFormat::Bgra8, ..camera(mesh).on(card)?.into() };
    let shown = View { kernel, diffuse: [0.1; 3], ..View::scattered(shown) };
    let sun = Light::Directional { towards: [1.0, -2.0, 3.0], irradiance: [1.0; 3] };
    // Pass 3 begins with the state that pass 2 leaves.
    let mut machine = loaded(profile.clone(), CardModel::new(&atlas), VARIANTS[0]).on(card)?;
    machine.record(true);
    machine.light(&[sun]).on(card)?;
    machine.view_texels(&shown).on(card)?;
    let [light, levels, _, view] =
        pass_times(&profile, &machine.take_log()).map_err(no_time)?.map(|pass| pass.time.seconds());
    Ok(FrameCost { light, levels, view })
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
