//! Clustered principal components on an emulated card: a picture with its errors and its time, and number formats, maps
//! and targets, varied one after the other.

use glam::DVec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::texture::TexelFormat;
use strum::IntoEnumIterator;

use super::errors::{PictureVariant, PixelErrors, held, report_sweep};
use super::setting::{CardSetting, HostPicture, report_sizes};
use crate::card::{MeshView, SeenPixel, seen_pixels};
use crate::clustering::Clustering;
use crate::cpca::on_card::time::host_of_section_7;
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions, WeightFormat};
use crate::geom::vector::wide;
use crate::report::{Cell, Findings, Provenance};
use crate::sphere::HarmonicLight;
use crate::study::prt::render::no_transfer;
use crate::study::prt::{Lit, LitView, SeenSurface, no_cpca_card};
use crate::study::{ProgressFn, Study, StudyError};
use crate::transfer::Vertices;
use crate::transfer::brdf::ExitBasis;
use crate::transfer::file::PrtMeaning;

/// Side of the maps of a sweep's reference picture, in texels.
const FINE: usize = 512;
/// Sides of maps to try, in texels.
const SIDES: [usize; 5] = [8, 16, 32, 64, 128];

const SWEEP: &str = "Each row changes one thing in a picture in single precision, with maps of 512 x 512 texels in \
    floats and a target of floats, and is compared with that picture where pixels show the mesh. visible_% is the \
    share of pixels with a channel that is off by more than 1/255. Targets that store fractions clamp at 0 after each \
    group of clusters: negative light is lost if the group that balances it is drawn later. `together` draws clusters \
    in groups, `alone` one after the other.";
const TIME: &str = "Times are modelled, not measured, by the pipeline model of the card, and for a host whose speed \
    follows from the paper's 2.9 frames per second of uncompressed transfer. Host and card work in parallel, frame \
    after frame.";

/// A model with compressed transfer, a light and a camera, and the card that draws it.
#[derive(Debug)]
pub struct OnCard {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's vertices, which are the points of the clusters.
    pub vertices: Vertices,
    /// Meaning of the numbers at a vertex.
    pub meaning: PrtMeaning,
    /// Clusters of the compressed transfer.
    pub clustering: Clustering,
    /// The light, with the same order as the transfer.
    pub light: HarmonicLight,
    /// The card that draws.
    pub card: CardSetting,
}

impl Study for OnCard {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        let PrtMeaning::Transfer { channels, exit_functions, .. } = &self.meaning else { return Err(no_transfer()) };
        let basis = ExitBasis::of_functions(exit_functions)?;
        let Self { vertices, clustering, card, light, .. } = self;
        let vectors = clustering.subspaces().iter().map(|subspace| subspace.len()).max().unwrap_or(0);
        let transfer =
            CompressedTransfer { vertices, clustering, basis: &basis, channels: *channels as usize, vectors };
        let choices = choices(transfer.is_glossy());
        let steps = 2 + if card.sweep { 1 + choices.len() as u64 } else { 0 };
        progress("host", 0, steps);
        let seen = seen_pixels(&card.profile, vertices.geometry(), &self.view.camera)?;
        let exit = Lit::new(&self.meaning, light).ok_or_else(no_transfer)?.of_clusters(clustering);
        let linear = self.on_host(&seen, &basis, &exit);
        let host = HostPicture::new((card, &self.view), "the same clusters", seen, linear);
        progress("card", 1, steps);
        let draw = |profile: &Profile, options: &PrtCardOptions, format| {
            self.draw(profile, transfer, (options, format), host.exposure)
        };
        let (drawn, pixels, log) = draw(&card.profile, &PrtCardOptions::of(&card.profile), card.format)?;
        let radiance = |direction| light.radiance(direction);
        let (mut found, _) = host.findings("Compressed transfer on a card", &pixels, card.is_clamped(), radiance)?;
        report_sizes(sizes(&drawn, &transfer), &mut found);
        let frame = (&log[..], "a frame of compressed transfer");
        card.report_frame(host_of_section_7(), TIME, frame, &mut found)?;
        if card.sweep {
            let draw = |choice: &Choice| -> Result<Vec<[f64; 3]>, StudyError> {
                let (_, pixels, _) = draw(&Profile::named(choice.device)?, &choice.options, choice.format)?;
                Ok(held(&pixels, true))
            };
            let expected = draw(&reference())?;
            let mut variants = Vec::new();
            for choice in choices {
                progress("sweep", 3 + variants.len() as u64, steps);
                let errors = PixelErrors::of(&host.seen, &draw(&choice)?, &expected);
                let Choice { axis, label: choice, .. } = choice;
                variants.push(PictureVariant { axis, choice, errors, below_zero: None });
            }
            report_sweep(&variants, SWEEP, &mut found);
        }
        Ok(found)
    }

    fn provenance(&self, provenance: Provenance) -> Provenance {
        self.card.provenance(provenance)
    }
}

impl OnCard {
    /// Linear radiance of visible pixels, computed from exit coefficients of the vertices.
    fn on_host(&self, seen: &[Option<SeenPixel>], basis: &ExitBasis, exit: &[Vec<[f64; 3]>]) -> Vec<[f64; 3]> {
        let (eye, vertices) = (wide(self.view.camera.eye()), &self.vertices);
        let towards = |vertex: usize| vertices.frames()[vertex].to_local(eye - wide(vertices.positions()[vertex]));
        let view: Vec<DVec3> = (0..vertices.len()).map(towards).collect();
        SeenSurface::by_raster(seen).radiance(exit, &view, basis)
    }

    /// Draws a picture: the card, radiance times exposure per pixel as the target holds it, and the work of host and
    /// card for the frame.
    fn draw<'a>(
        &self,
        profile: &Profile,
        transfer: CompressedTransfer<'a>,
        (options, format): (&PrtCardOptions, TexelFormat),
        exposure: f64,
    ) -> Result<DrawnTransfer<'a>, StudyError> {
        let executor = self.card.executor.clone();
        let mut card = PrtCard::new(profile.clone(), executor, transfer, options).map_err(no_cpca_card)?;
        let view = MeshView { camera: self.view.camera, exposure, format };
        let (texels, log) = card.logged_view(&self.light, &view).map_err(no_cpca_card)?;
        Ok((card, texels.colors(), log))
    }
}

/// A card, the radiance times exposure of its pixels, and its log.
type DrawnTransfer<'a> = (PrtCard<'a>, Vec<[f64; 3]>, Vec<Event>);

/// Sizes and counts: the columns of the paper's Table 1, and the counts that section 6.2 derives from them. A triangle
/// is drawn once per group of clusters that has one of its vertices.
fn sizes(card: &PrtCard<'_>, transfer: &CompressedTransfer<'_>) -> impl Iterator<Item = (&'static str, Cell)> {
    let (size, groups, triangles) = (card.size(), card.superclusters(), transfer.vertices.triangles());
    let (clustering, representatives) = (transfer.clustering, transfer.representatives());
    let drawn = groups.overdraw(clustering, triangles);
    let rows = [
        ("vertices", size.vertices as u64),
        ("clusters", size.clusters as u64),
        ("vectors of a cluster", size.vectors as u64),
        ("numbers uncompressed", (clustering.points() * clustering.dimension()) as u64),
        ("numbers stored", clustering.stored_numbers() as u64),
        ("constants of a cluster", size.registers_per_cluster() as u64),
        ("superclusters", groups.count() as u64),
        ("passes over each", size.passes() as u64),
        ("constants sent for a frame", size.uploaded_registers(representatives) as u64),
        ("host multiply-adds of a frame", size.multiply_adds(representatives) as u64),
        ("triangles", triangles.len() as u64),
        ("triangles drawn in a pass", drawn),
    ];
    let overdraw = Cell::ratio(drawn as f64 / triangles.len().max(1) as f64);
    rows.map(|(what, number)| (what, number.into())).into_iter().chain([("overdraw", overdraw)])
}

struct Choice {
    /// The varied setting.
    axis: &'static str,
    label: String,
    device: &'static str,
    format: TexelFormat,
    options: PrtCardOptions,
}

/// The reference: single precision everywhere, large maps in single precision, and a float target.
fn reference() -> Choice {
    let options = PrtCardOptions { map_side: FINE, map_format: TexelFormat::Rgba32f, ..PrtCardOptions::default() };
    let (axis, label) = ("reference", format!("fp32, maps of {FINE}"));
    Choice { axis, label, device: "ideal-fp32", format: TexelFormat::Rgba32f, options }
}

fn choices(glossy: bool) -> Vec<Choice> {
    let of = |axis, label: String| Choice { axis, label, ..reference() };
    let fine = reference().options;
    let mut all = Vec::new();
    for device in ["ideal-fp24", "ideal-fp16"] {
        all.push(Choice { device, ..of("pixel arithmetic", device.to_owned()) });
    }
    for weights in WeightFormat::iter().filter(|&weights| weights != WeightFormat::Fp32) {
        let options = PrtCardOptions { weights, ..fine };
        all.push(Choice { options, ..of("weights", weights.to_string()) });
    }
    if glossy {
        for map_side in SIDES {
            let options = PrtCardOptions { map_side, ..fine };
            all.push(Choice { options, ..of("map texels", format!("{map_side} x {map_side}")) });
        }
        for (map_format, name) in
            [(TexelFormat::Rgba16Snorm, "signed 16 bits"), (TexelFormat::Rgba8Snorm, "signed 8 bits")]
        {
            let options = PrtCardOptions { map_format, ..fine };
            all.push(Choice { options, ..of("map format", name.to_owned()) });
        }
    }
    for (format, name) in
        [(TexelFormat::Rgba16f, "fp16"), (TexelFormat::Rgba16, "16 bits"), (TexelFormat::Bgra8, "8 bits")]
    {
        for (superclusters, how) in [(true, "together"), (false, "alone")] {
            let options = PrtCardOptions { superclusters, ..fine };
            all.push(Choice { format, options, ..of("target", format!("{name}, {how}")) });
        }
    }
    all
}
