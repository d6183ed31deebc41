//! A rendering in progress: visible surfaces of its pixels, and its textures.

use rayon::prelude::*;

use super::causes::CausePictures;
use super::subject::{BiScaleRendering, LocalLight, SurfaceTexture, no_mesh_transfer};
use super::surface::SurfacePixel;
use crate::bi_scale::file::BiScaleMeaning;
use crate::bi_scale::shade::TextureLookup;
use crate::error::InputError;
use crate::study::{ProgressFn, StudyError};
use crate::transfer::light::CubeLight;

/// A rendering whose visible surfaces are known.
pub(in crate::study) struct BiScaleDrawing<'a> {
    rendering: &'a BiScaleRendering,
    meaning: BiScaleMeaning,
    pub(super) pixels: Vec<Option<SurfacePixel>>,
    lookups: Vec<TextureLookup>,
}

impl<'a> BiScaleDrawing<'a> {
    /// Casts the rays of the camera.
    ///
    /// # Errors
    /// If the file is not transfer of a mesh, or a texture has other directions or no patch for ray tracing.
    pub(in crate::study) fn new(rendering: &'a BiScaleRendering) -> Result<Self, StudyError> {
        let meaning = rendering.file.meaning.ok_or_else(no_mesh_transfer)?;
        let expected = (meaning.side as usize).pow(2);
        for SurfaceTexture { name, samples, patch } in &rendering.textures {
            let found = samples.light().directions().len();
            if found != expected {
                let what =
                    format!("{name}: expected {expected} directions of light, as the transfer has, found {found}");
                let help = "make the texture, or the transfer, with the other's `--directions`";
                return Err(StudyError::new("crossbar::prt::directions", what).with_help(help));
            }
            if rendering.reference && patch.is_none() {
                let what = format!("{name}: expected a patch of heights to cast rays at, found samples only");
                let help = "name a patch, such as `mail`, in place of a file";
                return Err(StudyError::new("crossbar::prt::no_patch", what).with_help(help));
            }
        }
        let lookups = rendering.textures.iter().map(|texture| TextureLookup::new(&texture.samples)).collect();
        Ok(Self { rendering, meaning, pixels: rendering.surface.pixels(&rendering.view.camera), lookups })
    }

    /// The light's texels.
    pub(in crate::study) fn cube(&self) -> Result<CubeLight, InputError> {
        self.rendering.light.cube()
    }

    /// L~, light from the light's texels. Fails if the file is not transfer of a mesh.
    pub(in crate::study) fn local(&self, cube: &CubeLight) -> Result<LocalLight, StudyError> {
        LocalLight::new(&self.rendering.file, cube).ok_or_else(no_mesh_transfer)
    }

    /// Equation 3 at all pixels with L~; black where no surface is visible.
    pub(in crate::study) fn shade(&self, local: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let color = |b: &mut Vec<[f64; 3]>, pixel: &Option<SurfacePixel>| {
            let pixel = pixel.as_ref();
            pixel.map_or([0.0; 3], |pixel| self.lookups[pixel.texture].radiance(local, &pixel.shaded, b))
        };
        self.pixels.par_iter().map_init(Vec::new, color).collect()
    }

    /// The pictures from the ray-traced one to `drawn`, the picture from transfer. Fails if the light is invalid, or
    /// the file is not transfer of a mesh.
    pub(in crate::study) fn causes(
        &self,
        cube: &CubeLight,
        drawn: &[[f64; 3]],
        progress: &mut ProgressFn<'_>,
    ) -> Result<CausePictures, StudyError> {
        CausePictures::new(self.rendering, &self.meaning, &self.pixels, (cube, drawn), progress)
    }
}
