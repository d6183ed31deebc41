//! Findings of all-frequency transfer on a card.

use serde_json::json;

use super::coding::{coarse_codes, ways_to_code};
use super::pixels::{exact_pixels, seen_by};
use super::precision::{factored_precision, ways_of_precision};
use super::subject::{AllFrequencyOnCard, HostSteps};
use crate::all_frequency::on_card::time::{host_of_table_1, streamed_bytes};
use crate::all_frequency::on_card::{FactoredDrawing, ProductOptions, ProductPlace, VertexColors, draw};
use crate::all_frequency::shade::TransferredRadiance;
use crate::card::{MeshView, SeenPixel};
use crate::report::{Cell, Findings, Provenance};
use crate::study::prt::all_frequency::Part;
use crate::study::prt::card::blame::{Blame, report_blame};
use crate::study::prt::card::difference::ComparedPicture;
use crate::study::prt::card::setting::{PictureStudy, report_sizes};
use crate::study::prt::card::sweep::report_sweep;
use crate::study::prt::card::{PictureVariant, PixelErrors, frame};
use crate::study::prt::{no_all_frequency_card, of_texels};
use crate::study::{ProgressFn, Study, StudyError};

const SWEEP: &str = "Each row changes one property of a picture with negligible rounding; errors are in 255ths of white. Representatives and weights \
    are recoded from the file's bits, with double-precision sums, and compared with the file's own code; all other rows are drawn into floats and \
    compared with double-precision products of the same numbers.";
const TIME: &str = "Modelled, not measured: the pipeline model of the card, and a host whose speed follows from the \
    frame rates of the paper's Table 1. Host and card work in parallel, frame after frame.";

impl Study for AllFrequencyOnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("host", 0, 2);
        let (steps, lit, card) = (self.steps()?, &self.lit, &self.card);
        let meshes = self.meshes(&steps.transferred);
        let seen = seen_by(&card.profile, &meshes, &lit.view.camera)?;
        let study = PictureStudy { card, view: &lit.view, from: "the same numbers" };
        let (exposure, host) = study.exposed(exact_pixels(&meshes, &seen, &self.place, lit.view.camera.eye(), 1.0));
        progress("card", 1, 2);
        let view = MeshView { camera: lit.view.camera, exposure, format: card.format };
        let (profile, executor) = (card.profile.clone(), card.executor.clone());
        let drawing =
            draw(profile, executor, &meshes, self.place, &view, steps.multiplies).map_err(no_all_frequency_card)?;
        let drawn = drawing.texels.colors();
        let is_clamped = card.is_clamped() || self.place == ProductPlace::Vertices(VertexColors::Bytes);
        let compared = ComparedPicture::new(&seen, &drawn, &host, is_clamped);
        let mut found = study.findings("All-frequency transfer on a card", &compared, exposure)?;
        conclude(&drawing, &mut found);
        let radiances = steps.cut.light.radiances();
        found.pictures(vec![lit.view.light_picture(of_texels(&radiances))?]);
        report_blame(&self.blame(&steps, &seen, exposure, compared.errors)?, &mut found);
        report_sizes(self.sizes(&steps, &drawing), &mut found);
        if let Some(time) = frame::modelled(&card.profile, &drawing.log, host_of_table_1())? {
            found.conclusion(format!("{}.", frame::rate(&time, &card.profile.title)));
            let what = "a frame of all-frequency transfer";
            study.report_time(frame::times(&time), TIME, &drawing.log, what, &mut found)?;
        }
        if card.sweep {
            report_sweep(&self.variants(&steps, &seen, exposure, progress)?, SWEEP, &mut found);
        }
        found.field("kept", json!(steps.cut.kept));
        found.field("nonzero", json!(steps.cut.nonzero));
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        self.card.provenance(provenance)
    }
}

/// Reports the number of colors that a picture cannot show.
fn conclude(drawing: &FactoredDrawing, found: &mut Findings) {
    let counts = &drawing.counts;
    for (count, what) in [
        (counts.below_zero, "pixels are below 0 in a channel before the target clamps"),
        (counts.vertices_below_zero, "vertices are below 0 in a channel before their colors clamp"),
        (counts.vertices_above_one, "vertices are above 1 in a channel, which bytes cannot store"),
    ] {
        if let Some(count) = count.filter(|&count| count > 0) {
            found.conclusion(format!("{count} {what}."));
        }
    }
}

impl AllFrequencyOnCard {
    /// Adds the error of each step from light to picture.
    fn blame(
        &self,
        steps: &HostSteps,
        seen: &[Option<SeenPixel>],
        exposure: f64,
        of_card: PixelErrors,
    ) -> Result<Vec<Blame>, StudyError> {
        let eye = self.lit.view.camera.eye();
        let pixels = |transferred: &[TransferredRadiance], place| {
            exact_pixels(&self.meshes(transferred), seen, place, eye, exposure)
        };
        let products = ProductPlace::Pixels(ProductOptions::default());
        let mut found = vec![Blame { step: "the card: arithmetic, storage, target", errors: of_card }];
        let mut push =
            |step, a: &[[f64; 3]], b: &[[f64; 3]]| found.push(Blame { step, errors: PixelErrors::of(seen, a, b) });
        let ours = pixels(&steps.transferred, &products);
        if self.lit.file.reflectance.terms() > 1 {
            let colors = pixels(&steps.transferred, &ProductPlace::Vertices(VertexColors::Floats));
            push("colors of vertices interpolated, not products", &colors, &ours);
        }
        if self.lit.parts().iter().any(Part::is_coded) {
            let exact = pixels(&self.in_double(&steps.cut.light)?, &products);
            push("sums over representatives in single precision", &ours, &exact);
        }
        let compressed = self.lit.original.as_ref().filter(|_| self.lit.file.coded.is_some());
        if let Some(original) = compressed {
            let mut raw = steps.transferred.clone();
            raw[0] = self.lit.parts()[0].exact(original, &steps.cut.light)?.singles();
            push("compression and coding", &ours, &pixels(&raw, &products));
        }
        if steps.cut.kept < steps.cut.nonzero {
            let whole = self.cut(None)?.light;
            push("light coefficients left out", &ours, &pixels(&self.in_double(&whole)?, &products));
        }
        Ok(found)
    }

    fn sizes(&self, steps: &HostSteps, drawing: &FactoredDrawing) -> Vec<(&'static str, Cell)> {
        let terms = self.lit.file.reflectance.terms();
        let numbers = match &self.place {
            ProductPlace::Pixels(options) if terms > 1 => options.layout(terms).numbers(),
            _ => 3,
        };
        let passes = match &self.place {
            ProductPlace::Pixels(options) if terms > 1 && options.is_pass_per_channel => 3,
            _ => 1,
        };
        let ([reads, arithmetic], ground) = (drawing.pixel_slots, self.lit.ground.as_ref());
        let rows = [
            ("vertices", Some(self.lit.vertices.len() as u64)),
            ("triangles", Some(self.lit.vertices.triangles().len() as u64)),
            ("vertices of the ground", ground.map(|ground| ground.vertices.len() as u64)),
            ("terms", Some(terms as u64)),
            ("light coefficients kept", Some(steps.cut.kept as u64)),
            ("host multiplications for clusters", Some(steps.multiplies.per_cluster)),
            ("host multiplications for vertices", Some(steps.multiplies.per_vertex)),
            ("bytes sent per vertex", Some(streamed_bytes(&self.place, terms) as u64)),
            ("numbers interpolated per pass", Some(numbers as u64)),
            ("passes", Some(passes)),
            ("texture reads of the pixel program", Some(u64::from(reads))),
            ("arithmetic slots of the pixel program", Some(u64::from(arithmetic))),
            ("pixels covered", drawing.counts.covered),
            ("pixels below 0", drawing.counts.below_zero),
            ("vertices below 0", drawing.counts.vertices_below_zero),
            ("vertices above 1", drawing.counts.vertices_above_one),
        ];
        rows.into_iter().map(|(what, number)| (what, number.map_or(Cell::Empty, Cell::from))).collect()
    }

    /// Varies representatives, weights, G, arithmetic and filters, one after the other.
    fn variants(
        &self,
        steps: &HostSteps,
        seen: &[Option<SeenPixel>],
        exposure: f64,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Vec<PictureVariant>, StudyError> {
        let meshes = self.meshes(&steps.transferred);
        let drawn = ways_of_precision(&meshes);
        let all = drawn + self.lit.file.coded.as_ref().map_or(0, ways_to_code);
        let mut done = |done| progress("sweep", done, all);
        let camera = self.lit.view.camera;
        let variants = factored_precision(&meshes, &self.card.executor, camera, exposure, &mut done);
        let mut variants = variants.map_err(no_all_frequency_card)?;
        if let Some(coded) = &self.lit.file.coded {
            let mut done = |done| progress("sweep", drawn + done, all);
            variants.extend(coarse_codes(self, (coded, &steps.cut.light), seen, exposure, &mut done)?);
        }
        Ok(variants)
    }
}
