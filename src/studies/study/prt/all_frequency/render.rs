//! Pictures of a model under distant light of all frequencies.

use std::time::Instant;

use serde_json::json;

use super::exact;
use super::lit_model::LitModel;
use super::part::{FrameTimes, Part, Transferred};
use crate::picture::rgb8;
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table};
use crate::scene::Camera;
use crate::study::prt::render::cluster_color;
use crate::study::prt::{SeenSurface, of_texels};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::light::{HaarLight, LightTruncation};

/// Number of segments whose clusters are drawn, as in Figure 4.
const CLUSTER_PICTURES: usize = 3;

/// A lit model, and its pictures.
#[derive(Debug)]
pub struct AllFrequencyRendering {
    /// The model, its transfer, the light and the camera.
    pub lit: LitModel,
}

impl Study for AllFrequencyRendering {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("rays", 0, 2);
        let seen = self.seen();
        progress("radiance", 1, 2);
        let parts = self.lit.parts();
        let mut times = FrameTimes::default();
        let cut = self.light(&mut times)?;
        let transferred: Vec<Transferred> =
            parts.iter().map(|part| part.transferred(&cut.light, &mut times)).collect::<Result<_, _>>()?;
        let of_vertex = radiance(&parts, &transferred, &self.lit.view.camera, &mut times);
        let drawn = seen.colors(&of_vertex, [0.0; 3]);
        let radiances = cut.light.radiances();
        let (mut found, exposure) = self.lit.view.findings("All-frequency transfer", &drawn, of_texels(&radiances))?;
        self.conclude(&seen, &drawn, &cut, &mut found);
        if parts.iter().all(Part::is_coded) {
            time(&parts, &cut.light, times, &mut found);
        }
        if let Some(original) = &self.lit.original {
            let whole = parts[0].exact(original, &cut.light)?;
            let mut exact = parts[0].radiance(&whole, &self.lit.view.camera, &mut FrameTimes::default());
            exact.extend_from_slice(&of_vertex[exact.len()..]);
            self.compare(&seen, (&of_vertex, &drawn), &exact, exposure, &mut found)?;
        }
        self.clusters(&seen, &mut found);
        Ok(found)
    }
}

/// Exit radiance (step 4) at all parts' vertices, in order.
fn radiance(parts: &[Part<'_>], transferred: &[Transferred], camera: &Camera, times: &mut FrameTimes) -> Vec<[f64; 3]> {
    parts.iter().zip(transferred).flat_map(|(part, transferred)| part.radiance(transferred, camera, times)).collect()
}

/// Adds the multiplications of rendering, and the measured time.
fn time(parts: &[Part<'_>], light: &HaarLight, times: FrameTimes, found: &mut Findings) {
    let light = light.singles();
    let sums = parts.iter().map(|part| part.multiplies(&light));
    let [per_cluster, per_vertex, per_view] = sums.fold([0; 3], |sum, of| [0, 1, 2].map(|step| sum[step] + of[step]));
    let mut table = Table::new("A frame on this computer", &["step", "multiplications", "time (ms)", "alone (fps)"]);
    let steps = [
        ("1 light", None, times.light),
        ("2 clusters", Some(per_cluster), times.clusters),
        ("3 vertices", Some(per_vertex), times.vertices),
        ("4 view", Some(per_view), times.view),
    ];
    for (step, multiplies, seconds) in steps {
        let count = multiplies.map_or(Cell::Empty, Cell::from);
        table.push([step.into(), count, Cell::measured(1e3 * seconds), Cell::measured(1.0 / seconds)]);
    }
    let total = times.total();
    let all = per_cluster + per_vertex + per_view;
    table.push(["all".into(), all.into(), Cell::measured(1e3 * total), Cell::measured(1.0 / total)]);
    found.heading("Time");
    found.table(FoundTable::from(table).csv("time").field("time"));
    found.field("multiplies", json!({ "clusters": per_cluster, "vertices": per_vertex, "view": per_view }));
    found.field(
        "seconds",
        json!({ "light": times.light, "clusters": times.clusters, "vertices": times.vertices, "view": times.view }),
    );
    found.field("fps", json!(1.0 / total));
}

impl AllFrequencyRendering {
    /// The surface point in each of the camera's pixels; vertices of the ground follow those of the model.
    fn seen(&self) -> SeenSurface {
        let ground = self.lit.ground.as_ref().map(|ground| (&ground.mesh, &ground.vertices));
        let parts: Vec<_> = std::iter::once((&self.lit.mesh, &self.lit.vertices)).chain(ground).collect();
        SeenSurface::of_parts(&parts, &self.lit.view.camera)
    }

    /// Step 1: the light's coefficients.
    fn light(&self, times: &mut FrameTimes) -> Result<LightTruncation, StudyError> {
        let start = Instant::now();
        let cut = exact::coefficients(&self.lit.light, self.lit.keep)?;
        times.light = start.elapsed().as_secs_f64();
        Ok(cut)
    }

    fn conclude(&self, seen: &SeenSurface, drawn: &[[f64; 3]], cut: &LightTruncation, found: &mut Findings) {
        found.conclusion(self.lit.view.sentence(seen.count()));
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
                "{negative} pixels are below 0, down to {least}: factors cut off after m terms have negative lobes."
            ));
        }
        found.field("nonzero", json!(cut.nonzero));
        found.field("kept", json!(cut.kept));
        found.field("energy", json!(cut.energy));
        found.field("kept_energy", json!(cut.kept_energy));
        found.field("negative_pixels", json!(negative));
        found.field("least_radiance", json!(least));
    }

    /// Compares pictures of coded and uncompressed transfer.
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
            self.lit.view.against_original(drawn, &picture, exposure, "coded less uncompressed")?;
        let squares = |a: &[[f64; 3]]| a.iter().flatten().map(|value| value * value).sum::<f64>();
        let apart = |a: &[[f64; 3]], b: &[[f64; 3]]| -> f64 {
            a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b) * (a - b)).sum()
        };
        let share = |a: &[[f64; 3]], b: &[[f64; 3]]| 100.0 * (apart(a, b) / squares(b)).sqrt();
        let mut table = Table::new("Coded against uncompressed", &["figure", "value"]);
        let pixels = share(drawn, &picture);
        table.push([
            "root mean square of pixels' differences, relative to the picture's (%)".into(),
            Cell::measured(pixels),
        ]);
        let vertices = share(of_vertex, exact);
        table.push(["the same of vertices (%)".into(), Cell::measured(vertices)]);
        table.push(["largest difference of a pixel (radiance)".into(), Cell::measured(largest)]);
        found.heading("Against uncompressed transfer");
        found.pictures(pictures);
        found.table(FoundTable::from(table).csv("comparison").field("comparison"));
        found.field("picture_rms_percent", json!(pixels));
        Ok(())
    }

    /// The clusters of the three segments with most vertices, as in Figure 4.
    fn clusters(&self, seen: &SeenSurface, found: &mut Findings) {
        let Some(coded) = &self.lit.file.coded else { return };
        let mut largest: Vec<_> = coded.segments.iter().collect();
        largest.sort_by_key(|part| std::cmp::Reverse(part.vertices.len()));
        let pictures = largest.into_iter().take(CLUSTER_PICTURES).map(|part| {
            let mut of_vertex = vec![None; self.lit.vertices.len()];
            for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
                of_vertex[vertex as usize] = Some(cluster);
            }
            let color = |vertex: Option<u32>| {
                let cluster = vertex.and_then(|vertex| of_vertex.get(vertex as usize).copied().flatten());
                cluster.map_or([0; 3], |cluster| cluster_color(u32::from(cluster)))
            };
            let image = rgb8(self.lit.view.camera.width(), self.lit.view.camera.height(), seen.nearest().map(color));
            let name = format!("clusters-{}", part.segment);
            let caption =
                format!("segment {}; clusters: {}; black sees none of its light", part.segment, part.counts.len());
            NamedPicture::new(name, image, caption)
        });
        let pictures: Vec<_> = pictures.collect();
        if !pictures.is_empty() {
            found.heading("Clusters of three segments");
            found.pictures(pictures);
        }
    }
}
