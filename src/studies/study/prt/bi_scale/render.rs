//! Pictures of a model under distant light from bi-scale transfer and bidirectional textures.

use serde_json::json;

use super::drawing::BiScaleDrawing;
use super::subject::{BiScaleRendering, SurfaceTexture};
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::study::prt::of_texels;
use crate::study::{ProgressFn, Study, StudyError};

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
                "{below} of them see their surface from below the horizon of its interpolated normal, and take the \
                 views at the horizon."
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
