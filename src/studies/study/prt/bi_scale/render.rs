//! Pictures of a model under distant light from bi-scale transfer and bidirectional textures.

use std::time::Instant;

use serde_json::json;

use super::causes;
use super::drawing::BiScaleDrawing;
use super::light::LocalLight;
use super::subject::{BiScaleRendering, SurfaceTexture};
use super::surface::SurfacePixel;
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::study::prt::of_texels;
use crate::study::{ProgressFn, Study, StudyError};

/// Times of the steps of a frame, in seconds.
#[derive(Clone, Copy, Debug)]
struct StepTimes {
    light: f64,
    transfer: f64,
    shading: f64,
}

/// Runs `work`, and returns its result with its time in seconds.
fn timed<R>(work: impl FnOnce() -> R) -> (R, f64) {
    let start = Instant::now();
    let found = work();
    (found, start.elapsed().as_secs_f64())
}

impl Study for BiScaleRendering {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("rays", 0, 2);
        let drawing = BiScaleDrawing::new(self)?;
        progress("radiance", 1, 2);
        let (cube, light) = timed(|| drawing.cube());
        let cube = cube?;
        let local = drawing.local(&cube)?;
        let (drawn, shading) = timed(|| drawing.shade(&local.rows));
        let times = StepTimes { light, transfer: local.seconds, shading };
        let (mut found, exposure) = self.view.findings("Bi-scale transfer", &drawn, of_texels(cube.texels()))?;
        self.conclude(&drawing.pixels, &local, &mut found);
        self.time(&drawing.pixels, times, &mut found);
        if self.reference {
            let pictures = drawing.causes(&cube, &drawn, progress)?;
            causes::report(self, &pictures, exposure, &mut found)?;
        }
        Ok(found)
    }
}

impl BiScaleRendering {
    fn conclude(&self, pixels: &[Option<SurfacePixel>], local: &LocalLight, found: &mut Findings) {
        let shown = pixels.iter().flatten().count();
        found.conclusion(self.view.sentence(shown));
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

    /// Adds the measured times of the steps.
    fn time(&self, pixels: &[Option<SurfacePixel>], times: StepTimes, found: &mut Findings) {
        let lights = self.textures.first().map_or(0, |texture| texture.samples.light().directions().len());
        let shown_pixels = pixels.iter().flatten().count();
        let mut table = Table::new("A frame on this computer", &["step", "time (ms)"]);
        for (step, seconds) in [("light", times.light), ("transfer", times.transfer), ("shading", times.shading)] {
            table.push([step.into(), Cell::measured(1e3 * seconds)]);
        }
        found.heading("Time");
        found.table(FoundTable::from(table).csv("time").field("time"));
        // 16 texels are read per direction of light.
        found.field("texels_read", json!(16 * lights * shown_pixels));
        found.field("seconds", json!({ "light": times.light, "transfer": times.transfer, "shading": times.shading }));
    }
}
