//! All-frequency transfer on an emulated card: a picture with its errors and its time, and number formats, maps and
//! filters, varied one after the other.

use serde_json::json;

use super::errors::{PictureVariant, PixelErrors, report_blame, report_sweep};
use super::factored::{exact_pixels, factored_precision, seen_by, ways_of_precision};
use super::setting::{CardSetting, HostPicture, report_sizes};
use crate::all_frequency::code::{CodeOptions, CodedTransfer};
use crate::all_frequency::on_card::time::{host_of_table_1, streamed_bytes};
use crate::all_frequency::on_card::{
    FactoredDrawing, ProductOptions, ProductPlace, TransferredMesh, VertexColors, draw,
};
use crate::all_frequency::shade::{Multiplies, TransferredRadiance, plain};
use crate::card::MeshView;
use crate::error::InputError;
use crate::report::{Cell, Findings, Provenance};
use crate::study::prt::all_frequency::singles;
use crate::study::prt::{LitModel, no_all_frequency_card, of_texels};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::light::{HaarLight, LightTruncation};

/// Numbers of bits of a code to try, if the file has more.
const BITS: [u8; 5] = [8, 10, 12, 14, 15];

const SWEEP: &str = "Each row changes one property of a picture with negligible rounding; errors are in steps of \
    1/255. Representatives and weights are coded again with fewer bits; these rows use double-precision sums, and are \
    compared with the file's own code; all other rows are drawn into floats and compared with double-precision \
    products of the same numbers.";
const TIME: &str = "Times are modelled, not measured, by the pipeline model of the card, and for a host whose speed \
    follows from the frame rates of the paper's Table 1. Host and card work in parallel, frame after frame.";

/// A lit model with all-frequency transfer, and the card that draws it.
#[derive(Debug)]
pub struct AllFrequencyOnCard {
    /// The model, its transfer, the light and the camera.
    pub lit: LitModel,
    /// The card that draws.
    pub card: CardSetting,
    /// Where products with G are computed.
    pub place: ProductPlace,
}

/// Steps 1 to 3 of section 6 for the model and its ground, and their counts of multiplications.
struct HostSteps {
    cut: LightTruncation,
    transferred: Vec<TransferredRadiance>,
    multiplies: Multiplies,
}

impl Study for AllFrequencyOnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("host", 0, 2);
        let (steps, lit, card) = (self.steps()?, &self.lit, &self.card);
        let (meshes, camera) = (self.meshes(&steps.transferred), lit.view.camera);
        let seen = seen_by(&card.profile, &meshes, &camera)?;
        let linear = exact_pixels(&meshes, &seen, &self.place, camera.eye(), 1.0);
        let host = HostPicture::new((card, &lit.view), "the same numbers", seen, linear);
        progress("card", 1, 2);
        let view = MeshView { camera, exposure: host.exposure, format: card.format };
        let (profile, executor) = (card.profile.clone(), card.executor.clone());
        let drawing =
            draw(profile, executor, &meshes, self.place, &view, steps.multiplies).map_err(no_all_frequency_card)?;
        let is_clamped = card.is_clamped() || self.place == ProductPlace::Vertices(VertexColors::Bytes);
        let (drawn, radiances) = (drawing.texels.colors(), steps.cut.light.radiances());
        let title = "All-frequency transfer on a card";
        let (mut found, errors) = host.findings(title, &drawn, is_clamped, of_texels(&radiances))?;
        conclude(&drawing, &mut found);
        report_blame(&self.blame(&steps, &host, errors)?, &mut found);
        report_sizes(self.sizes(&steps, &drawing), &mut found);
        let frame = (&drawing.log[..], "a frame of all-frequency transfer");
        card.report_frame(host_of_table_1(), TIME, frame, &mut found)?;
        if card.sweep {
            report_sweep(&self.variants(&steps, &host, progress)?, SWEEP, &mut found);
        }
        found.fields(json!({ "kept": steps.cut.kept, "nonzero": steps.cut.nonzero }));
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

/// Steps 2 and 3 in f64, one rounding to f32 each.
fn in_double(coded: &CodedTransfer, light: &HaarLight) -> Result<TransferredRadiance, InputError> {
    let light: Vec<[f64; 3]> = light.singles().into_iter().map(|rgb| rgb.map(f64::from)).collect();
    Ok(singles(coded.rows, plain::transferred(coded, &light)?))
}

/// Codes of fewer bits than a file's.
fn coarser(of: CodeOptions) -> impl Iterator<Item = (&'static str, u8, CodeOptions)> {
    let representatives = BITS.into_iter().filter(move |&bits| bits < of.representative_bits);
    let weights = BITS.into_iter().filter(move |&bits| bits < of.weight_bits);
    let representatives =
        representatives.map(move |bits| ("representatives", bits, CodeOptions { representative_bits: bits, ..of }));
    representatives.chain(weights.map(move |bits| ("weights", bits, CodeOptions { weight_bits: bits, ..of })))
}

impl AllFrequencyOnCard {
    fn meshes<'a>(&'a self, transferred: &'a [TransferredRadiance]) -> Vec<TransferredMesh<'a>> {
        self.lit.parts().zip(transferred).map(|(part, transferred)| part.on_card(transferred)).collect()
    }

    /// Computes the host's steps, before a card draws.
    fn steps(&self) -> Result<HostSteps, StudyError> {
        let cut = self.lit.cut(self.lit.keep)?;
        let (mut transferred, mut multiplies) = (Vec::new(), Multiplies::default());
        for part in self.lit.parts() {
            transferred.push(part.transferred(&cut.light)?.singles());
            let Multiplies { per_cluster, per_vertex } = part.multiplies(&cut.light);
            multiplies.per_cluster += per_cluster;
            multiplies.per_vertex += per_vertex;
        }
        Ok(HostSteps { cut, transferred, multiplies })
    }

    /// Transferred radiance of the model and its ground in f64, one rounding to f32 each.
    fn in_double(&self, light: &HaarLight) -> Result<Vec<TransferredRadiance>, StudyError> {
        let parts = self.lit.parts().map(|part| match &part.file.coded {
            Some(coded) => Ok(in_double(coded, light)?),
            None => Ok(part.transferred(light)?.singles()),
        });
        parts.collect()
    }

    /// The pixels of an exact card from transferred radiance.
    fn exact(&self, transferred: &[TransferredRadiance], place: ProductPlace, host: &HostPicture<'_>) -> Vec<[f64; 3]> {
        let eye = self.lit.view.camera.eye();
        exact_pixels(&self.meshes(transferred), &host.seen, &place, eye, host.exposure)
    }

    /// The error of each step from light to picture.
    fn blame(
        &self,
        steps: &HostSteps,
        host: &HostPicture<'_>,
        of_card: PixelErrors,
    ) -> Result<Vec<(&'static str, PixelErrors)>, StudyError> {
        let products = |transferred: &[TransferredRadiance]| {
            self.exact(transferred, ProductPlace::Pixels(ProductOptions::default()), host)
        };
        let mut found = vec![("the card: arithmetic, storage, target", of_card)];
        let mut push = |step, a: &[[f64; 3]], b: &[[f64; 3]]| found.push((step, PixelErrors::of(&host.seen, a, b)));
        let ours = products(&steps.transferred);
        if self.lit.model.file.reflectance.terms() > 1 {
            let colors = self.exact(&steps.transferred, ProductPlace::Vertices(VertexColors::Floats), host);
            push("colors of vertices interpolated, not products", &colors, &ours);
        }
        if self.lit.parts().any(|part| part.file.coded.is_some()) {
            let exact = products(&self.in_double(&steps.cut.light)?);
            push("sums over representatives in single precision", &ours, &exact);
        }
        if let (Some(original), Some(_)) = (&self.lit.original, &self.lit.model.file.coded) {
            let mut raw = steps.transferred.clone();
            raw[0] = self.lit.model.exact(original, &steps.cut.light)?.singles();
            push("compression and coding", &ours, &products(&raw));
        }
        if steps.cut.kept < steps.cut.nonzero {
            let whole = self.lit.cut(None)?.light;
            push("light coefficients left out", &ours, &products(&self.in_double(&whole)?));
        }
        Ok(found)
    }

    fn sizes(&self, steps: &HostSteps, drawing: &FactoredDrawing) -> impl Iterator<Item = (&'static str, Cell)> {
        let LitModel { model, ground, .. } = &self.lit;
        let terms = model.file.reflectance.terms();
        let (numbers, passes) = match &self.place {
            ProductPlace::Pixels(options) if terms > 1 => {
                (options.layout(terms).numbers(), if options.is_pass_per_channel { 3 } else { 1 })
            }
            _ => (3, 1),
        };
        let [reads, arithmetic] = drawing.pixel_slots;
        let rows = [
            ("vertices", Some(model.vertices.len() as u64)),
            ("triangles", Some(model.vertices.triangles().len() as u64)),
            ("vertices of the ground", ground.as_ref().map(|ground| ground.vertices.len() as u64)),
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
        rows.into_iter().map(|(what, number)| (what, number.into()))
    }

    /// Varies G, arithmetic and filters, then the code of the model, whose sums and pixels are in f64.
    fn variants(
        &self,
        steps: &HostSteps,
        host: &HostPicture<'_>,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Vec<PictureVariant>, StudyError> {
        let (meshes, coded) = (self.meshes(&steps.transferred), self.lit.model.file.coded.as_ref());
        let all = ways_of_precision(&meshes) + coded.map_or(0, |coded| 1 + coarser(coded.options).count() as u64);
        let camera = self.lit.view.camera;
        let mut done = |done| progress("sweep", done, all);
        let mut variants = factored_precision(&meshes, &self.card.executor, camera, host.exposure, &mut done)
            .map_err(no_all_frequency_card)?;
        let Some(coded) = coded else { return Ok(variants) };
        let light = &steps.cut.light;
        let mut transferred = self.in_double(light)?;
        let mut pixels = |coded: &CodedTransfer| -> Result<Vec<[f64; 3]>, StudyError> {
            transferred[0] = in_double(coded, light)?;
            Ok(self.exact(&transferred, ProductPlace::Pixels(ProductOptions::default()), host))
        };
        let expected = pixels(coded)?;
        for (axis, bits, options) in coarser(coded.options) {
            done(1 + variants.len() as u64);
            let errors = PixelErrors::of(&host.seen, &pixels(&coded.recoded(options)?)?, &expected);
            variants.push(PictureVariant { axis, choice: format!("{bits} bits"), errors, below_zero: None });
        }
        Ok(variants)
    }
}
