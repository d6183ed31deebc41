//! Pictures of a model under distant light of all frequencies.

use serde_json::json;

use super::model::LitModel;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table};
use crate::study::prt::lit_view::relative_rms;
use crate::study::prt::render::cluster_picture;
use crate::study::prt::{SeenSurface, of_texels};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::light::LightTruncation;

/// Number of segments whose clusters are drawn, as in Figure 4.
const CLUSTER_PICTURES: usize = 3;

impl Study for LitModel {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("rays", 0, 2);
        // Vertices of the ground follow those of the model.
        let seen = SeenSurface::of_parts(self.parts().map(|part| (&part.mesh, &part.vertices)), &self.view.camera);
        progress("radiance", 1, 2);
        let cut = self.cut(self.keep)?;
        let mut of_vertex = Vec::new();
        for part in self.parts() {
            of_vertex.extend(part.radiance(&part.transferred(&cut.light)?, &self.view.camera));
        }
        let drawn = seen.colors(&of_vertex, [0.0; 3]);
        let radiances = cut.light.radiances();
        let (mut found, exposure) =
            self.view.findings("All-frequency transfer", &drawn, of_texels(&radiances), seen.count())?;
        conclude(&drawn, &cut, &mut found);
        if let Some(original) = &self.original {
            let mut exact = self.model.radiance(&self.model.exact(original, &cut.light)?, &self.view.camera);
            exact.extend_from_slice(&of_vertex[exact.len()..]);
            self.compare(&seen, (&of_vertex, &drawn), &exact, exposure, &mut found)?;
        }
        self.clusters(&seen, &mut found);
        Ok(found)
    }
}

fn conclude(drawn: &[[f64; 3]], cut: &LightTruncation, found: &mut Findings) {
    let share = shown(100.0 * cut.kept_energy, Quantity::Measured);
    found.conclusion(format!(
        "{} of the {} light coefficients that are not 0 are kept, with {share} % of their energy.",
        cut.kept, cut.nonzero
    ));
    let negative = drawn.iter().filter(|color| color.iter().any(|&value| value < 0.0)).count();
    let least = drawn.iter().flatten().fold(0.0_f64, |least, &value| least.min(value));
    if negative > 0 {
        let least = shown(least, Quantity::Measured);
        found.conclusion(format!(
            "{negative} pixels are below 0, down to {least}: factors that are cut off after some terms have negative \
             lobes."
        ));
    }
    found.fields(json!({
        "nonzero": cut.nonzero, "kept": cut.kept, "energy": cut.energy, "kept_energy": cut.kept_energy,
        "negative_pixels": negative, "least_radiance": least,
    }));
}

impl LitModel {
    fn compare(
        &self,
        seen: &SeenSurface,
        (of_vertex, drawn): (&[[f64; 3]], &[[f64; 3]]),
        exact: &[[f64; 3]],
        exposure: f64,
        found: &mut Findings,
    ) -> Result<(), StudyError> {
        let picture = seen.colors(exact, [0.0; 3]);
        let (pictures, _, largest) =
            self.view.against_original(drawn, &picture, exposure, "coded minus uncompressed")?;
        let share = |a: &[[f64; 3]], b: &[[f64; 3]]| {
            let differences = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| a - b);
            relative_rms(differences, b.iter().flatten().copied())
        };
        let pixels = share(drawn, &picture);
        let of_pixels =
            "root mean square difference of the pixels, relative to the root mean square of the picture (%)";
        let table = Table::new("Coded against uncompressed", &["figure", "value"]).with([
            [of_pixels.into(), pixels.map(Cell::measured).into()],
            ["the same for vertices (%)".into(), share(of_vertex, exact).map(Cell::measured).into()],
            ["largest difference of a pixel (radiance)".into(), Cell::measured(largest)],
        ]);
        found.heading("Against uncompressed transfer");
        found.pictures(pictures);
        found.table(FoundTable::from(table).csv("comparison").field("comparison"));
        found.field("picture_rms_percent", json!(pixels));
        Ok(())
    }

    /// The clusters of the three segments with most vertices, as in Figure 4.
    fn clusters(&self, seen: &SeenSurface, found: &mut Findings) {
        let Some(coded) = &self.model.file.coded else { return };
        let mut largest: Vec<_> = coded.segments.iter().collect();
        largest.sort_by_key(|part| std::cmp::Reverse(part.vertices.len()));
        let pictures = largest.into_iter().take(CLUSTER_PICTURES).map(|part| {
            let mut of_vertex = vec![None; self.model.vertices.len()];
            for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
                of_vertex[vertex as usize] = Some(u32::from(cluster));
            }
            let image = cluster_picture(seen, &self.view.camera, |vertex| *of_vertex.get(vertex as usize)?);
            let name = format!("clusters-{}", part.segment);
            let caption = format!(
                "segment {}; clusters: {}; black: vertices that none of the segment's light reaches",
                part.segment,
                part.counts.len()
            );
            NamedPicture::new(name, image, caption)
        });
        let pictures: Vec<_> = pictures.collect();
        if !pictures.is_empty() {
            found.heading("Clusters of three segments");
            found.pictures(pictures);
        }
    }
}
