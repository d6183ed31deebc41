//! A picture by the card and by the host, and their differences.

use glam::DVec3;
use refsim::device::Profile;
use refsim::event::Event;
use refsim::texture::TexelFormat;

use super::subject::OnCard;
use crate::card::{CardError, MeshView, SeenPixel};
use crate::cpca::on_card::model::TransferSize;
use crate::cpca::on_card::{CompressedTransfer, PrtCard, PrtCardOptions};
use crate::geom::vector::wide;
use crate::study::prt::interpolate::SeenSurface;
use crate::transfer::brdf::ExitBasis;

/// Inputs of a card's picture.
#[derive(Clone, Copy)]
pub(super) struct CardDrawing<'a> {
    pub(super) profile: &'a Profile,
    pub(super) format: TexelFormat,
    pub(super) options: PrtCardOptions,
    /// `true` to log the work of host and card.
    pub(super) timed: bool,
}

/// A picture drawn by a card.
pub(super) struct Drawn {
    /// Radiance times exposure per pixel, as the target holds it.
    pub(super) colors: Vec<[f64; 3]>,
    /// Work of host and card for the frame; empty if it is not timed.
    pub(super) log: Vec<Event>,
    pub(super) size: TransferSize,
    pub(super) draws: ChunkCounts,
}

/// Partition of the mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChunkCounts {
    /// Groups of clusters that are drawn together.
    pub(super) superclusters: usize,
    /// Triangles of the mesh.
    pub(super) triangles: usize,
    /// Number of drawn triangles: each triangle counts once per group that has one of its vertices.
    pub(super) drawn: u64,
}

impl CardDrawing<'_> {
    pub(super) fn draw(
        &self,
        study: &OnCard,
        transfer: CompressedTransfer<'_>,
        exposure: f64,
    ) -> Result<Drawn, CardError> {
        let mut card = PrtCard::new(self.profile.clone(), study.card.executor.clone(), transfer, &self.options)?;
        let view = MeshView { camera: study.view.camera, exposure, format: self.format };
        let (texels, log) = if self.timed {
            card.logged_view(&study.light, &view)?
        } else {
            (card.view_texels(&study.light, &view)?, Vec::new())
        };
        let triangles = transfer.vertices.triangles();
        let groups = card.superclusters();
        let draws = ChunkCounts {
            superclusters: groups.count(),
            triangles: triangles.len(),
            drawn: groups.overdraw(transfer.clustering, triangles),
        };
        Ok(Drawn { colors: texels.colors(), log, size: card.size(), draws })
    }
}

/// Linear radiance of visible pixels, computed from exit coefficients of the vertices.
pub(super) fn on_host(
    study: &OnCard,
    seen: &[Option<SeenPixel>],
    basis: &ExitBasis,
    exit: &[Vec<[f64; 3]>],
) -> Vec<[f64; 3]> {
    let eye = wide(study.view.camera.eye());
    let towards =
        |vertex: usize| study.vertices.frames()[vertex].to_local(eye - wide(study.vertices.positions()[vertex]));
    let view: Vec<DVec3> = (0..study.vertices.len()).map(towards).collect();
    SeenSurface::by_raster(seen).radiance(exit, &view, &|direction, y| basis.values(direction, y))
}
