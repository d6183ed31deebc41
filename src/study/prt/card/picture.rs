//! A picture by a card and by the host, and how they differ.

use glam::DVec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::texture::TexelFormat;
use serde_json::{Value, json};

use super::subject::{CardError, OnCard};
use crate::cpca::on_card::model::TransferSize;
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions, PrtView};
use crate::geom::vector::wide;
use crate::report::digits::{Quantity, shown};
use crate::report::words::percent;
use crate::study::prt::interpolate::Seen;
use crate::transfer::brdf::ExitBasis;

/// Steps of a picture of 8 bits.
const STEPS: f64 = 255.0;

/// A way to draw.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    pub(super) profile: &'a Profile,
    pub(super) format: TexelFormat,
    pub(super) options: PrtCardOptions,
    /// Whether what is asked of host and card is kept.
    pub(super) timed: bool,
}

/// What a card drew.
pub(super) struct Drawn {
    /// Radiance times exposure per pixel, clamped to 0 to 1 as screens do.
    pub(super) colors: Vec<[f64; 3]>,
    /// What the frame asked of host and card; nothing if it is not timed.
    pub(super) log: Vec<Event>,
    pub(super) size: TransferSize,
    pub(super) draws: ChunkCounts,
}

/// How the mesh was cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChunkCounts {
    /// Groups of clusters that are drawn together.
    pub(super) superclusters: usize,
    /// Triangles of the mesh.
    pub(super) triangles: usize,
    /// Triangles drawn, one for each group that a triangle has a vertex in.
    pub(super) drawn: u64,
}

impl Way<'_> {
    pub(super) fn draw(
        &self,
        study: &OnCard,
        transfer: CompressedTransfer<'_>,
        exposure: f64,
    ) -> Result<Drawn, CardError> {
        let mut card = PrtCard::new(self.profile.clone(), study.executor.clone(), transfer, &self.options)?;
        let view = PrtView { camera: study.camera, exposure, format: self.format };
        let (texels, log) = if self.timed {
            card.logged_view(&study.light, &view)?
        } else {
            (card.view_texels(&study.light, &view)?, Vec::new())
        };
        let clamped = |value: f32| f64::from(value).clamp(0.0, 1.0);
        let colors = texels.texels.into_iter().map(|[red, green, blue, _]| [red, green, blue].map(clamped)).collect();
        let triangles = transfer.vertices.triangles();
        let groups = card.superclusters();
        let draws = ChunkCounts {
            superclusters: groups.count(),
            triangles: triangles.len(),
            drawn: groups.overdraw(transfer.clustering, triangles),
        };
        Ok(Drawn { colors, log, size: card.size(), draws })
    }
}

/// Linear radiance of all pixels from exit coefficients of the vertices.
pub(super) fn on_host(study: &OnCard, basis: &ExitBasis, exit: &[Vec<[f64; 3]>]) -> Vec<[f64; 3]> {
    let seen = Seen::new(&study.mesh, &study.vertices, &study.camera);
    let eye = wide(study.camera.eye());
    let towards =
        |vertex: usize| study.vertices.frames()[vertex].to_local(eye - wide(study.vertices.positions()[vertex]));
    let view: Vec<DVec3> = (0..study.vertices.len()).map(towards).collect();
    seen.radiance(exit, &view, &|direction, y| basis.values(direction, y))
}

/// How two pictures of values from 0 to 1 differ.
pub(super) struct Difference {
    /// Per pixel the signed difference of the channel that differs most.
    pub(super) of_pixel: Vec<f64>,
    pub(super) largest: f64,
    pub(super) rms: f64,
    /// Pixels that differ by more than a step of 8 bits.
    pub(super) visible: usize,
}

impl Difference {
    /// Of a picture and one that it should equal, clamped to the same range.
    pub(super) fn of(found: &[[f64; 3]], expected: &[[f64; 3]]) -> Self {
        let worst = |(found, expected): (&[f64; 3], &[f64; 3])| {
            let channels = found.iter().zip(expected).map(|(found, expected)| found - expected.clamp(0.0, 1.0));
            channels.fold(0.0, |worst: f64, value| if value.abs() > worst.abs() { value } else { worst })
        };
        let of_pixel: Vec<f64> = found.iter().zip(expected).map(worst).collect();
        let largest = of_pixel.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let squares = of_pixel.iter().map(|value| value * value).sum::<f64>();
        let rms = (squares / of_pixel.len().max(1) as f64).sqrt();
        let visible = of_pixel.iter().filter(|value| value.abs() * STEPS > 1.0).count();
        Self { of_pixel, largest, rms, visible }
    }

    /// Whether no pixel differs by more than a step of 8 bits.
    pub(super) fn shows_nothing(&self) -> bool {
        self.visible == 0
    }

    pub(super) fn largest_steps(&self) -> f64 {
        STEPS * self.largest
    }

    pub(super) fn rms_steps(&self) -> f64 {
        STEPS * self.rms
    }

    /// The share of pixels that differ by more than a step.
    pub(super) fn visible_share(&self) -> f64 {
        self.visible as f64 / self.of_pixel.len().max(1) as f64
    }

    pub(super) fn sentence(&self, card: &str) -> String {
        let [rms, largest] = [self.rms_steps(), self.largest_steps()].map(|steps| shown(steps, Quantity::Measured));
        format!(
            "{card}: off by {rms} 255ths (root mean square; largest {largest}) of what the host computes in double \
             precision from the same clusters; {} of the pixels by more than one.",
            percent(self.visible_share())
        )
    }

    pub(super) fn json(&self) -> Value {
        json!({ "rms_255ths": self.rms_steps(), "largest_255ths": self.largest_steps(), "pixels_beyond_one": self.visible })
    }
}
