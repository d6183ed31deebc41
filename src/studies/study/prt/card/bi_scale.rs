//! Bi-scale transfer on an emulated card: a picture with its errors and its times, and number formats, varied one after
//! the other.

use rayon::prelude::*;
use refsim::event::Event;
use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::errors::{PictureVariant, PixelErrors, held, report_blame, report_sweep};
use super::setting::{CardSetting, HostPicture, report_sizes};
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::bi_scale::bicluster::Biclustering;
use crate::bi_scale::kernels::BlockEdges;
use crate::bi_scale::on_card::{
    BiScaleCard, DisplayCounts, DisplayOptions, GatherCard, GatherCounts, LightFormat, TexturedMesh,
};
use crate::bi_scale::paper;
use crate::bi_scale::texture::BidirectionalTexture;
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::card::{MeshView, SeenPixel, seen_pixels};
use crate::report::digits::{Quantity, shown};
use crate::report::{Cell, Findings, Provenance, Table};
use crate::study::prt::{LitView, of_texels};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::Vertices;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::light::DistantLight;

const SWEEP: &str = "Each row uses one number format of fewer bits, and single precision elsewhere. Errors are in \
    steps of 1/255, against equation 3 and products with light in double precision. 8-bit fractions are relative to \
    the largest number.";
const TIME: &str = "Times are modelled, not measured, by the pipeline model of the card, in which texture reads run \
    at the full rate of the units. Local light stays on the card, as in the paper; if only the view changes, it is \
    reused.";

const FLOATS: TexelFormat = TexelFormat::Rgba32f;
/// Formats of fewer bits of textures and targets.
const TEXELS: [TexelFormat; 2] = [TexelFormat::Rgba8, TexelFormat::Rgba16f];

/// A model with biclusters of its transfer, bidirectional textures, a light and a camera, and the card.
#[derive(Debug)]
pub struct BiScaleOnCard {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's vertices.
    pub vertices: Vertices,
    /// Texture coordinates of each corner, triangle by triangle; one unit is one patch.
    pub coordinates: Vec<[[f32; 2]; 3]>,
    /// Transfer from the light to the textures' directions of light.
    pub biclusters: Biclustering,
    /// The textures.
    pub textures: Vec<BidirectionalTexture>,
    /// Texture index per triangle.
    pub texture_of: Vec<u32>,
    /// The light.
    pub light: DistantLight,
    /// The card that draws.
    pub card: CardSetting,
}

/// L~ as the card computes it, and its counts.
struct CardLight {
    local: Vec<[f32; 3]>,
    counts: GatherCounts,
    log: Vec<Event>,
}

struct Drawn {
    pixels: Vec<[f64; 3]>,
    counts: DisplayCounts,
    log: Vec<Event>,
}

impl Study for BiScaleOnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("transfer", 0, 3);
        self.check()?;
        let (cube, card, options) = (self.light.cube()?, &self.card, DisplayOptions::default());
        // L: radiance of each light texel, multiplied by its solid angle.
        let light = side_by_side(light_vectors(&cube));
        let exact = side_by_side(light_vectors(&cube).map(|channel| paper::multiply(&self.biclusters, &channel)));
        let local = self.local(&light, LightFormat::default())?;
        progress("host", 1, 3);
        let seen = seen_pixels(&card.profile, self.vertices.geometry(), &self.view.camera)?;
        let doubles: Vec<[f64; 3]> = local.local.iter().map(|rgb| rgb.map(f64::from)).collect();
        let linear = self.exact(&doubles, &seen, 1.0);
        let host = HostPicture::new((card, &self.view), "the same local light", seen, linear);
        progress("card", 2, 3);
        let drawn = self.draw(&local.local, options, card.format, host.exposure)?;
        let title = "Bi-scale transfer on a card";
        let (mut found, errors) = host.findings(title, &drawn.pixels, card.is_clamped(), of_texels(cube.texels()))?;
        let whole = self.exact(&exact, &host.seen, host.exposure);
        let of_light = PixelErrors::of(&host.seen, &host.pixels, &whole);
        let blames = [
            ("the card: storage, filters, arithmetic, target", errors),
            ("light times biclusters by the card", of_light),
        ];
        report_blame(&blames, &mut found);
        report_sizes(self.sizes(&local, &drawn), &mut found);
        self.time(&local, &drawn, &mut found)?;
        if card.sweep {
            report_sweep(&self.variants(&light, &exact, &host, progress)?, SWEEP, &mut found);
        }
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        self.card.provenance(provenance)
    }
}

impl BiScaleOnCard {
    fn mesh(&self) -> TexturedMesh<'_> {
        let Self { vertices, coordinates, textures, texture_of, .. } = self;
        TexturedMesh { vertices, coordinates, textures, texture_of }
    }

    fn directions(&self) -> usize {
        self.textures.first().map_or(0, |texture| texture.light().directions().len())
    }

    /// Rejects biclusters that do not match the vertices, directions or light.
    fn check(&self) -> Result<(), StudyError> {
        let [rows, columns] = self.biclusters.matrix_size();
        let expected = self.vertices.len() * self.directions();
        for (what, expected, found) in [
            ("vertices times the texture's directions of light", expected, rows),
            ("light texels", LIGHT_TEXELS, columns),
        ] {
            if expected != found {
                let what = format!("expected transfer of {expected} {what}, found {found}");
                let help = "precompute the transfer with the texture's number of light `--directions`";
                return Err(StudyError::new("crossbar::prt::bi_scale", what).with_help(help));
            }
        }
        Ok(())
    }

    /// Algorithm 2 on the card.
    fn local(&self, light: &[[f64; 3]], format: LightFormat) -> Result<CardLight, StudyError> {
        let singles: Vec<[f32; 3]> = light.iter().map(|texel| texel.map(|value| value as f32)).collect();
        let CardSetting { profile, executor, .. } = &self.card;
        let mut card = GatherCard::new(profile.clone(), executor.clone(), &self.biclusters, format)?;
        let (local, log) = card.logged_multiply(&singles)?;
        Ok(CardLight { local, counts: card.counts(), log })
    }

    fn draw(
        &self,
        local: &[[f32; 3]],
        options: DisplayOptions,
        format: TexelFormat,
        exposure: f64,
    ) -> Result<Drawn, StudyError> {
        let CardSetting { profile, executor, .. } = &self.card;
        let mut card = BiScaleCard::new(profile.clone(), executor.clone(), self.mesh(), options)?;
        let view = MeshView { camera: self.view.camera, exposure, format };
        let (texels, log) = card.logged_view(local, &view)?;
        Ok(Drawn { pixels: texels.colors(), counts: card.counts(), log })
    }

    /// Equation 3 in f64 without seams, exposed, neither clamped nor quantised. Pixels without a surface are 0.
    fn exact(&self, local: &[[f64; 3]], seen: &[Option<SeenPixel>], exposure: f64) -> Vec<[f64; 3]> {
        let (mesh, eye) = (self.mesh(), self.view.camera.eye());
        let of = |seen: &Option<SeenPixel>| {
            let color = seen.map_or([0.0; 3], |seen| mesh.pixel(local, eye, &seen));
            color.map(|value| exposure * value)
        };
        seen.par_iter().map(of).collect()
    }

    fn sizes(&self, local: &CardLight, drawn: &Drawn) -> [(&'static str, Cell); 17] {
        let (gather, display) = (local.counts, drawn.counts);
        [
            ("vertices", self.vertices.len() as u64),
            ("vertices of the card", display.vertices as u64),
            ("triangles", display.triangles as u64),
            ("directions of light", self.directions() as u64),
            ("textures", self.textures.len() as u64),
            ("biclusters", self.biclusters.len() as u64),
            ("passes for the bicluster buffer", gather.passes[0] as u64),
            ("passes for rows", gather.passes[1] as u64),
            ("places read for the buffer", gather.places[0]),
            ("places read for rows", gather.places[1]),
            ("bytes of lists", gather.list_bytes.iter().sum()),
            ("bytes of volumes", display.volume_bytes),
            ("passes of the display for a texture", display.passes as u64),
            ("draws of the display", display.draws as u64),
            ("directions per pass", display.directions_per_pass as u64),
            ("texture reads per pixel of a pass", u64::from(display.pixel_slots[0])),
            ("arithmetic slots per pixel of a pass", u64::from(display.pixel_slots[1])),
        ]
        .map(|(what, number)| (what, number.into()))
    }

    /// Adds the times of a frame with a new view only, and with a new light too, if the card's rates are known.
    fn time(&self, local: &CardLight, drawn: &Drawn, found: &mut Findings) -> Result<(), StudyError> {
        let (card, log) = (&self.card, [&local.log[..], &drawn.log[..]].concat());
        let view = card.modelled(&drawn.log, host_of_table_1())?;
        let Some((view, both)) = view.zip(card.modelled(&log, host_of_table_1())?) else { return Ok(()) };
        let [alone, together] = [view, both].map(|time| shown(time.per_second(), Quantity::Measured));
        found.conclusion(format!(
            "{}: {alone} frames per second (modelled) when only the view changes, {together} when light changes too.",
            card.profile.title
        ));
        let times = [
            ("frame to frame, only the view changed", view.frame),
            ("frame to frame, view and light changed", both.frame),
            ("draws of the display", view.draws),
            ("upload of light", both.uploads),
            ("state and constants", both.state),
        ];
        let times = times.map(|(part, time)| [part.into(), Cell::measured(1e3 * time.seconds())]);
        let table = Table::new("A frame", &["part", "ms"]).with(times);
        card.report_time(table, TIME, (&log[..], "a frame of bi-scale transfer"), found)
    }

    /// Draws each variant on the study's card. Pixels are compared with equation 3 in f64 from L~ in f64.
    fn variants(
        &self,
        light: &[[f64; 3]],
        exact: &[[f64; 3]],
        host: &HostPicture<'_>,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Vec<PictureVariant>, StudyError> {
        let expected = self.exact(exact, &host.seen, host.exposure);
        let (mut variants, mut local) = (Vec::new(), self.local(light, FINE.0)?.local);
        let (mut light_format, ways) = (FINE.0, ways());
        let count = ways.len() as u64;
        for (axis, choice, (format, options, target)) in ways {
            if format != light_format {
                (light_format, local) = (format, self.local(light, format)?.local);
            }
            let drawn = self.draw(&local, options, target, host.exposure)?;
            let expected = held(&expected, !target.record().is_float());
            let errors = PixelErrors::of(&host.seen, &drawn.pixels, &expected);
            variants.push(PictureVariant { axis, choice, errors, below_zero: None });
            progress("sweep", variants.len() as u64, count);
        }
        Ok(variants)
    }
}

/// Number formats of one frame: light, display options, target.
type CardDrawing = (LightFormat, DisplayOptions, TexelFormat);

/// Single precision throughout.
const FINE: CardDrawing = (
    LightFormat::Fp32,
    DisplayOptions { edges: BlockEdges::Wrapped, texture: FLOATS, local: LightFormat::Fp32 },
    FLOATS,
);

fn ways() -> Vec<(&'static str, String, CardDrawing)> {
    let (fine_light, fine, _) = FINE;
    let mut all = vec![("none", "fp32".to_owned(), FINE)];
    for light in LightFormat::iter().filter(|light| *light != fine_light) {
        all.push(("light L", light.to_string(), (light, fine, FLOATS)));
    }
    for local in LightFormat::iter().filter(|local| *local != fine.local) {
        all.push(("interpolated L~", local.to_string(), (fine_light, DisplayOptions { local, ..fine }, FLOATS)));
    }
    for texture in TEXELS {
        let options = DisplayOptions { texture, ..fine };
        all.push(("bidirectional texture", texture.to_string(), (fine_light, options, FLOATS)));
    }
    for target in TEXELS {
        all.push(("target", target.to_string(), (fine_light, fine, target)));
    }
    let options = DisplayOptions { edges: BlockEdges::Touching, ..fine };
    all.push(("blocks", "touching, with seams".to_owned(), (fine_light, options, FLOATS)));
    all
}
