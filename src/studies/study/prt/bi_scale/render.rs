//! Pictures of a model under distant light from bi-scale transfer and bidirectional textures.

use rayon::prelude::*;
use serde_json::json;

use super::causes::CausePictures;
use super::subject::{BiScaleRendering, LocalLight, SurfacePixel, SurfaceTexture, no_mesh_transfer};
use crate::bi_scale::file::BiScaleMeaning;
use crate::bi_scale::shade::TextureLookup;
use crate::error::InputError;
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::study::prt::of_texels;
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::light::CubeLight;

impl Study for BiScaleRendering {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("rays", 0, 2);
        let drawing = BiScaleDrawing::new(self)?;
        progress("radiance", 1, 2);
        let cube = drawing.cube()?;
        let local = drawing.local(&cube)?;
        let drawn = drawing.shade(&local.rows);
        let seen = drawing.pixels.iter().flatten().count();
        let (mut found, exposure) = self.view.findings("Bi-scale transfer", &drawn, of_texels(cube.texels()), seen)?;
        let below = drawing.pixels.iter().flatten().filter(|pixel| pixel.shaded.view.z <= 0.0).count();
        if below > 0 {
            found.conclusion(format!(
                "{below} of them see their surface from below the horizon of its interpolated normal, and use the \
                 texture's views at the horizon."
            ));
        }
        let lights = self.textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        // 16 texels are read per direction of light.
        found.fields(json!({
            "pixels_shown": seen, "views_below_horizon": below, "way": local.way, "texels_read": 16 * lights * seen,
        }));
        found.heading("Textures");
        let row = |SurfaceTexture { name, samples, .. }: &SurfaceTexture| {
            [
                name.as_str().into(),
                samples.size().pow(2).into(),
                samples.view().directions().len().into(),
                samples.light().directions().len().into(),
                Cell::measured(samples.samples().len() as f64 * 3.0 / 1e6),
            ]
        };
        let headings = ["texture", "texels", "views", "lights", "MB, 8 bits a channel"];
        let table = Table::new("Textures", &headings).with(self.textures.iter().map(row));
        found.table(FoundTable::from(table).csv("textures").field("textures"));
        if self.reference {
            drawing.causes(&cube, &drawn, progress)?.report(self, exposure, &mut found)?;
        }
        Ok(found)
    }
}

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
                    format!("{name}: expected {expected} directions of light, as in the transfer, found {found}");
                let help = "give the texture and the transfer the same `--directions`";
                return Err(StudyError::new("crossbar::prt::directions", what).with_help(help));
            }
            if rendering.reference && patch.is_none() {
                let what = format!("{name}: expected a patch of heights to cast rays at, found samples only");
                let help = "give a patch, such as `mail`, instead of a file";
                return Err(StudyError::new("crossbar::prt::no_patch", what).with_help(help));
            }
        }
        let lookups = rendering.textures.iter().map(|texture| TextureLookup::new(&texture.samples)).collect();
        Ok(Self { rendering, meaning, pixels: rendering.surface.pixels(&rendering.view.camera), lookups })
    }

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
