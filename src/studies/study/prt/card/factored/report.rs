//! What was found, as a page.

use serde_json::json;

use super::coding::{coarse_codes, ways_to_code};
use super::pixels::exact_pixels;
use super::precision::{factored_precision, factored_precision_table, push_errors, ways_of_precision};
use super::subject::{AllFrequencyCardError, AllFrequencyOnCard, CardSums, HostSteps, in_double};
use super::tables::{Blame, TIME, report_blame};
use crate::all_frequency::on_card::time::{host_of_table_1, streamed_bytes};
use crate::all_frequency::on_card::{
    FactoredDrawing, ProductOptions, ProductPlace, TransferredMesh, VertexColors, draw,
};
use crate::card::{MeshView, SeenPixel, seen_pixels};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, FoundTable, Provenance, Table};
use crate::study::prt::card::difference::{ComparedPicture, PixelErrors};
use crate::study::prt::card::frame;
use crate::study::prt::render::auto_exposure;
use crate::study::prt::{light_picture, of_texels};
use crate::study::{ProgressFn, Study, timeline_trace};

const SWEEP: &str = "Each row is one thing made coarse and the rest without rounding to speak of, in 255ths of white. \
    Representatives and weights are coded again from the file's bits, with sums in double precision, and compared with the file's \
    own code; all others are drawn into floats and compared with products in double precision of the same numbers.";

/// What card and host compute from.
const FROM: &str = "the same numbers";

impl Study for AllFrequencyOnCard {
    type Error = AllFrequencyCardError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, AllFrequencyCardError> {
        progress("host", 0, 2);
        let steps = self.steps()?;
        let mesh = self.mesh_of(&steps.transferred);
        let (eye, seen) =
            (self.lit.camera.eye(), seen_pixels(&self.profile, self.lit.vertices.geometry(), &self.lit.camera)?);
        let linear = exact_pixels(&mesh, &seen, &self.place, (eye, 1.0));
        let exposure = self.lit.exposure.unwrap_or_else(|| auto_exposure(&linear));
        let host: Vec<[f64; 3]> = linear.into_iter().map(|color| color.map(|value| exposure * value)).collect();
        progress("card", 1, 2);
        let view = MeshView { camera: self.lit.camera, exposure, format: self.format };
        let card = (self.profile.clone(), self.executor.clone());
        let mut drawing = draw(mesh, card, self.place, &view, steps.multiplies)?;
        if let Some(sums) = &steps.sums {
            drawing.log = sums.log.events.iter().cloned().chain(drawing.log).collect();
        }
        let mut found = Findings::new("All-frequency transfer on a card");
        found.taken_from(self.lit.camera.world_to_camera());
        let drawn = drawing.texels.texels.iter();
        let drawn: Vec<[f64; 3]> = drawn.map(|&[red, green, blue, _]| [red, green, blue].map(f64::from)).collect();
        let is_clamped = !self.format.record().is_float() || self.place == ProductPlace::Vertices(VertexColors::Bytes);
        let compared = ComparedPicture::new(&seen, &drawn, (&host, is_clamped));
        found.conclusion(compared.sentence(&self.profile.title, FROM));
        conclude(&drawing, &mut found);
        let time = frame::modelled(&self.profile, &drawing.log, host_of_table_1())?;
        if let Some(time) = &time {
            found.conclusion(format!("{}.", frame::rate(time, &self.profile.title)));
        }
        let title = format!("{} under {} on the {}", self.lit.model, self.lit.light_name, self.profile.title);
        compared.report(&self.lit.camera, (title, FROM), &mut found)?;
        let radiances = steps.cut.light.radiances();
        found.pictures(vec![light_picture("light", &self.lit.light_name, of_texels(&radiances))?]);
        let blames = self.blame(&steps, (&seen, exposure), (&mesh, compared.errors))?;
        report_blame(&blames, &mut found);
        found.heading("What is drawn");
        found.table(FoundTable::from(self.sizes(&steps, &drawing)).field("sizes"));
        if let Some(time) = &time {
            found.heading("Modelled time");
            found.explained_table(FoundTable::from(frame::times(time)).field("time"), TIME);
            if let Some(bytes) = timeline_trace::file(&self.profile, &drawing.log, "a frame of all-frequency transfer")?
            {
                found.keep_file("timeline.json", bytes);
            }
        }
        if self.sweep {
            self.sweep(&steps, (&seen, exposure), &mesh, &mut found, progress)?;
        }
        found.field("exposure", json!(exposure));
        found.field("kept", json!(steps.cut.kept));
        found.field("nonzero", json!(steps.cut.nonzero));
        Ok(found)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}

/// Counts of colors that a picture cannot show.
fn conclude(drawing: &FactoredDrawing, found: &mut Findings) {
    let counts = &drawing.counts;
    for (count, what) in [
        (counts.below_zero, "pixels are below 0 in a channel before the target clamps"),
        (counts.vertices_below_zero, "vertices are below 0 in a channel before their colors clamp"),
        (counts.vertices_above_one, "vertices are above 1 in a channel, which bytes do not hold"),
    ] {
        if let Some(count) = count.filter(|&count| count > 0) {
            found.conclusion(format!("{count} {what}."));
        }
    }
}

impl AllFrequencyOnCard {
    /// Step by step from light to picture.
    fn blame(
        &self,
        steps: &HostSteps,
        (seen, exposure): (&[Option<SeenPixel>], f64),
        (mesh, of_card): (&TransferredMesh<'_>, PixelErrors),
    ) -> Result<Vec<Blame>, AllFrequencyCardError> {
        let view = (self.lit.camera.eye(), exposure);
        let products = ProductPlace::Pixels(ProductOptions::default());
        let mut found = vec![Blame { step: "the card: arithmetic, storage, target", errors: of_card }];
        let mut push =
            |step, a: &[[f64; 3]], b: &[[f64; 3]]| found.push(Blame { step, errors: PixelErrors::of(seen, a, b) });
        let ours = exact_pixels(mesh, seen, &products, view);
        if self.lit.file.reflectance.terms() > 1 {
            let colors = exact_pixels(mesh, seen, &ProductPlace::Vertices(VertexColors::Floats), view);
            push("colors of vertices interpolated, not products", &colors, &ours);
        }
        if let Some(coded) = &self.lit.file.coded {
            let exact = in_double(coded, &steps.cut.light)?;
            push(
                if self.sums_on_card {
                    "sums over representatives by the card"
                } else {
                    "sums over representatives in single precision"
                },
                &ours,
                &exact_pixels(&self.mesh_of(&exact), seen, &products, view),
            );
        }
        let compressed = self.lit.original.as_ref().filter(|_| self.lit.file.coded.is_some());
        if let Some(original) = compressed {
            let raw = self.raw(original, &steps.cut.light)?;
            let raw = exact_pixels(&self.mesh_of(&raw), seen, &products, view);
            push("compression and coding", &ours, &raw);
        }
        if steps.cut.kept < steps.cut.nonzero {
            let whole = self.cut(None)?.light;
            let whole = match &self.lit.file.coded {
                Some(coded) => in_double(coded, &whole)?,
                None => self.raw(&self.lit.file, &whole)?,
            };
            push("light coefficients left out", &ours, &exact_pixels(&self.mesh_of(&whole), seen, &products, view));
        }
        Ok(found)
    }

    fn sizes(&self, steps: &HostSteps, drawing: &FactoredDrawing) -> Table {
        let terms = self.lit.file.reflectance.terms();
        let mut table = Table::new("Sizes and counts", &["what", "number"]);
        let numbers = match &self.place {
            ProductPlace::Pixels(options) if terms > 1 => options.layout(terms).numbers(),
            _ => 3,
        };
        let passes = match &self.place {
            ProductPlace::Pixels(options) if terms > 1 && options.is_pass_per_channel => 3,
            _ => 1,
        };
        let [reads, arithmetic] = drawing.pixel_slots;
        let rows = [
            ("vertices", Some(self.lit.vertices.len() as u64)),
            ("triangles", Some(self.lit.vertices.triangles().len() as u64)),
            ("terms", Some(terms as u64)),
            ("light coefficients kept", Some(steps.cut.kept as u64)),
            ("host multiplications for clusters", Some(steps.multiplies.per_cluster)),
            ("host multiplications for vertices", Some(steps.multiplies.per_vertex)),
            ("bytes sent per vertex", Some(streamed_bytes(&self.place, terms) as u64)),
            ("numbers interpolated in a pass", Some(numbers as u64)),
            ("passes", Some(passes)),
            ("texture reads of the pixel program", Some(u64::from(reads))),
            ("arithmetic slots of the pixel program", Some(u64::from(arithmetic))),
            ("pixels covered", drawing.counts.covered),
            ("pixels below 0", drawing.counts.below_zero),
            ("vertices below 0", drawing.counts.vertices_below_zero),
            ("vertices above 1", drawing.counts.vertices_above_one),
        ];
        let of_sums = |of: fn(&CardSums) -> u64| steps.sums.as_ref().map(of);
        let of_sums = [
            ("passes of sums", of_sums(|sums| sums.log.passes as u64)),
            ("bytes sent for sums", of_sums(|sums| sums.log.sent)),
            ("bytes read back", of_sums(|sums| sums.log.returned)),
            ("bytes of textures for sums", of_sums(|sums| sums.texture_bytes)),
        ];
        let rows = rows.into_iter().chain(of_sums.into_iter().filter(|_| self.sums_on_card));
        for (what, number) in rows {
            table.push([what.into(), number.map_or(Cell::Empty, Cell::from)]);
        }
        table
    }

    /// Representatives, weights, G, arithmetic and filters made coarse.
    fn sweep(
        &self,
        steps: &HostSteps,
        (seen, exposure): (&[Option<SeenPixel>], f64),
        mesh: &TransferredMesh<'_>,
        found: &mut Findings,
        progress: &mut ProgressFn<'_>,
    ) -> Result<(), AllFrequencyCardError> {
        let drawn = ways_of_precision(mesh);
        let all = drawn + self.lit.file.coded.as_ref().map_or(0, ways_to_code);
        let view = (self.lit.camera, exposure);
        let ways = factored_precision(*mesh, &self.executor, view, &mut |done| progress("sweep", done, all))?;
        let mut table = factored_precision_table(&ways);
        let mut worst: Vec<(String, f64)> = Vec::new();
        for way in ways.iter().filter(|way| way.axis != "card") {
            worst.push((format!("{} {}", way.axis, way.choice), way.errors.off_255ths[0]));
        }
        if let Some(coded) = &self.lit.file.coded {
            let mut done = |done| progress("sweep", drawn + done, all);
            for code in coarse_codes(self, (coded, &steps.cut.light), (seen, exposure), &mut done)? {
                let choice = format!("{} bits", code.bits);
                worst.push((format!("{} of {choice}", code.axis), code.errors.off_255ths[0]));
                push_errors(&mut table, code.axis, choice, &code.errors);
            }
        }
        if let Some((choice, rms)) = worst.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
            let rms = shown(rms, Quantity::Measured);
            found.conclusion(format!("Of all that was made coarse, most shows of {choice}: {rms} 255ths."));
        }
        found.heading("What shows");
        found.explained_table(FoundTable::from(table).csv("precision").field("precision"), SWEEP);
        Ok(())
    }
}
