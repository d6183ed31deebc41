//! Pictures of a model under distant light from bi-scale transfer and bidirectional textures.

use std::time::Instant;

use glam::DMat3;
use rayon::prelude::*;
use serde_json::json;

use super::causes::Causes;
use super::error::BiScaleError;
use super::light::LocalLight;
use super::subject::{BiScaleRendering, SurfaceTexture};
use super::surface::SurfacePixel;
use crate::prt::all_frequency::light::{CubeLight, Decimation};
use crate::prt::bi_scale::shade::TextureLookup;
use crate::prt::file::BiScaleMeaning;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Provenance, Table};
use crate::sphere::turn_around_z;
use crate::study::prt::render::carried;
use crate::study::prt::{Turning, auto_exposure, linear_picture};
use crate::study::{ProgressFn, Study};

/// What steps of a frame took, in seconds.
#[derive(Clone, Copy, Debug, Default)]
struct StepTimes {
    light: f64,
    transfer: f64,
    shading: f64,
}

impl Study for BiScaleRendering {
    type Error = BiScaleError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, BiScaleError> {
        let meaning = self.file.meaning.ok_or(BiScaleError::NoTransfer)?;
        self.check(&meaning)?;
        let steps = 2 + u64::from(self.frames);
        progress("rays", 0, steps);
        let pixels = self.surface.pixels(&self.camera);
        let lookups: Vec<TextureLookup> =
            self.textures.iter().map(|texture| TextureLookup::new(&texture.samples)).collect();
        progress("radiance", 1, steps);
        let mut times = StepTimes::default();
        let (cube, local) = self.light(&DMat3::IDENTITY, &mut times)?;
        let drawn = shade(&pixels, &lookups, &local.rows, &mut times);
        let exposure = self.exposure.unwrap_or_else(|| auto_exposure(&drawn));
        let mut found = Findings::new("Bi-scale transfer");
        found.taken_from(self.camera.world_to_camera());
        let picture = linear_picture(&self.camera, &drawn);
        let caption = format!("{} under {}", self.model, self.light_name);
        found.pictures(vec![NamedPicture::new("picture", picture.display(exposure)?, caption)]);
        found.keep_layers("picture", picture);
        self.conclude(&pixels, &local, &mut found);
        self.time(&pixels, times, &mut found);
        if self.reference {
            let causes = Causes::new(self, &meaning)?;
            causes.find(&pixels, (&cube, &drawn), exposure, &mut found, progress)?;
        }
        self.frames(&pixels, &lookups, (&local.rows, exposure), &mut found, progress)?;
        found.field("exposure", json!(exposure));
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}

/// Equation 3 at all pixels; black where there is nothing.
fn shade(
    pixels: &[Option<SurfacePixel>],
    lookups: &[TextureLookup],
    local: &[[f64; 3]],
    times: &mut StepTimes,
) -> Vec<[f64; 3]> {
    let start = Instant::now();
    let color = |b: &mut Vec<[f64; 3]>, pixel: &Option<SurfacePixel>| {
        let pixel = pixel.as_ref();
        pixel.map_or([0.0; 3], |pixel| lookups[pixel.texture].radiance(local, &pixel.shaded, b))
    };
    let colors = pixels.par_iter().map_init(Vec::new, color).collect();
    times.shading = start.elapsed().as_secs_f64();
    colors
}

impl BiScaleRendering {
    /// Whether the textures go with the transfer.
    fn check(&self, meaning: &BiScaleMeaning) -> Result<(), BiScaleError> {
        let expected = (meaning.side as usize).pow(2);
        for SurfaceTexture { name, samples, patch } in &self.textures {
            let found = samples.light().directions().len();
            if found != expected {
                return Err(BiScaleError::Directions { name: name.clone(), expected, found });
            }
            if self.reference && patch.is_none() {
                return Err(BiScaleError::NoPatch { name: name.clone() });
            }
        }
        Ok(())
    }

    /// The light's texels, and L~.
    fn light(&self, rotation: &DMat3, times: &mut StepTimes) -> Result<(CubeLight, LocalLight), BiScaleError> {
        let start = Instant::now();
        let cube = self.light.cube(rotation, Decimation::SolidAngle)?;
        times.light = start.elapsed().as_secs_f64();
        let local = LocalLight::new(&self.file, &cube).ok_or(BiScaleError::NoTransfer)?;
        times.transfer = local.seconds;
        Ok((cube, local))
    }

    fn conclude(&self, pixels: &[Option<SurfacePixel>], local: &LocalLight, found: &mut Findings) {
        let (shown, all) = (pixels.iter().flatten().count(), pixels.len());
        found.conclusion(format!("{shown} of {all} pixels show {} under {}.", self.model, self.light_name));
        let below = pixels.iter().flatten().filter(|pixel| pixel.shaded.view.z <= 0.0).count();
        if below > 0 {
            found.conclusion(format!(
                "{below} of them see their surface from below the horizon of its interpolated normal, and take the \
                 views at the horizon."
            ));
        }
        found.field("pixels_shown", json!(shown));
        found.field("views_below_horizon", json!(below));
        found.field("way", json!(local.way));
        let mut table = Table::new("Textures", &["texture", "texels", "views", "lights", "MB, 8 bits a channel"]);
        for SurfaceTexture { name, samples, .. } in &self.textures {
            let megabytes = samples.samples().len() as f64 * 3.0 / 1e6;
            table.push([
                name.as_str().into(),
                samples.size().pow(2).into(),
                samples.view().directions().len().into(),
                samples.light().directions().len().into(),
                Cell::measured(megabytes),
            ]);
        }
        found.heading("Textures");
        found.table(FoundTable::from(table).csv("textures").field("textures"));
    }

    /// What the steps took here.
    fn time(&self, pixels: &[Option<SurfacePixel>], times: StepTimes, found: &mut Findings) {
        let lights = self.textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        let shown_pixels = pixels.iter().flatten().count();
        let mut table = Table::new("A frame on this computer", &["step", "time (ms)"]);
        for (step, seconds) in [("light", times.light), ("transfer", times.transfer), ("shading", times.shading)] {
            table.push([step.into(), Cell::measured(1e3 * seconds)]);
        }
        found.heading("Time");
        found.table(FoundTable::from(table).csv("time").field("time"));
        // 16 texels are read for each direction of light.
        found.field("texels_read", json!(16 * lights * shown_pixels));
        found.field("seconds", json!({ "light": times.light, "transfer": times.transfer, "shading": times.shading }));
    }

    /// Frames with light or camera carried round z.
    fn frames(
        &self,
        pixels: &[Option<SurfacePixel>],
        lookups: &[TextureLookup],
        (still, exposure): (&[[f64; 3]], f64),
        found: &mut Findings,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(), BiScaleError> {
        let mut frames = Vec::new();
        let mut times = StepTimes::default();
        for frame in 0..self.frames {
            progress("frames", 2 + u64::from(frame), 2 + u64::from(self.frames));
            let turns = f64::from(frame) / f64::from(self.frames);
            let turn = turn_around_z(turns);
            let colors = match self.turning {
                Turning::Light => {
                    let (_, local) = self.light(&turn, &mut times)?;
                    shade(pixels, lookups, &local.rows, &mut times)
                }
                // View alone changed: L~ is that of before.
                Turning::Camera => {
                    let camera = carried(&self.camera, &self.surface.mesh, &turn);
                    shade(&self.surface.pixels(&camera), lookups, still, &mut times)
                }
            };
            let image = linear_picture(&self.camera, &colors).display(exposure)?;
            let caption = format!("turned by {} degrees", shown(360.0 * turns, Quantity::Measured));
            frames.push(NamedPicture::new(format!("frame-{frame}"), image, caption));
        }
        if !frames.is_empty() {
            found.heading(self.turning.heading());
            found.pictures(frames);
        }
        Ok(())
    }
}
