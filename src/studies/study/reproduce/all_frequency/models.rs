//! Models of Table 1, or our stand-ins for them, compressed and coded.

use std::cell::OnceCell;
use std::rc::Rc;

use serde::{Deserialize, Serialize};

use super::forms::{TERMS, cook_torrance, factorization, schlick};
use super::segments::SegmentSums;
use super::{HOST, RunResult, Shared, StudyError};
use crate::all_frequency::Reflectance;
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::transfer::transfer_of;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::kept::KeptResults;
use crate::scene::built::ground::{GROUND_SIDE, on_ground};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::ModelSize;
use crate::tracer::HostTracer;
use crate::transfer::grid::LIGHT_TEXELS;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};
use crate::transfer::{Tangents, Vertices};

/// Segments that represent all: a quarter of a side face, of the upper face and of the lower face. Compressing all
/// segments of Table 1's models would take some 20 hours of processor time at full size.
pub(super) const SAMPLED_SEGMENTS: [usize; 3] = [0, 17, 21];
/// Iterations per number of representatives on reduced models.
pub(super) const REDUCED_ITERATIONS: usize = 2;
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableModel {
    Bunny,
    Teapot,
    Tweety,
    Buddha,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableMaterial {
    Diffuse,
    Cook,
    Schlick,
}

impl TableModel {
    /// Builds the mesh; a reduced mesh has some hundred vertices, for a run without verdicts.
    fn mesh(self, size: ModelSize) -> Result<Mesh, StudyError> {
        let built = |model: TransferModel, coarser: u32| model.mesh(size.pick(1, coarser));
        Ok(match self {
            Self::Bunny => built(TransferModel::Bunny, 8),
            Self::Tweety => built(TransferModel::Tweety, 12),
            Self::Buddha => built(TransferModel::Buddha, 12),
            Self::Teapot => teapot(size.pick(40, 3)).on(HOST)?,
        })
    }
}

impl TableMaterial {
    /// Returns the reflectance in the textbook form of the model, with ten terms.
    pub(super) fn reflectance(self) -> Result<Reflectance, StudyError> {
        let (_, lobe, _) = match self {
            Self::Diffuse => return Ok(Reflectance::Diffuse),
            Self::Cook => cook_torrance()[0],
            Self::Schlick => schlick()[0],
        };
        Ok(Reflectance::Factored(factorization(&lobe, TERMS)?.factors(TERMS)))
    }
}

/// Number of vertices along an edge of the ground.
pub(super) fn ground_side(size: ModelSize) -> u32 {
    size.pick(GROUND_SIDE, 14)
}

/// Visibility at the vertices of a model, or of its ground.
pub(super) struct ModelVisibility {
    vertices: Vertices,
    maps: VisibilityMaps,
    hats: LinearBasis,
    size: ModelSize,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct CompressedModel {
    pub(super) vertices: usize,
    pub(super) omega: f64,
    /// Bytes of raw transfer in single precision.
    pub(super) raw: f64,
    /// Number of vertices in all segments over that in the compressed segments: exactly 1 if all are compressed.
    all_over_sampled: f64,
    /// Sums over the compressed segments.
    sums: SegmentSums,
    /// Number and results of each compressed segment.
    pub(super) segments: Vec<(usize, SegmentSums)>,
}

impl CompressedModel {
    /// Number of clusters; an estimate if some segments represent all.
    pub(super) fn clusters(&self) -> usize {
        (self.all_over_sampled * self.sums.clusters as f64).round() as usize
    }

    /// Bytes of weights and representatives in single precision.
    pub(super) fn clustered(&self) -> f64 {
        4.0 * self.all_over_sampled * self.sums.numbers as f64
    }

    /// Bytes of representatives and weights in 16 bits, without or with the numbers of columns, steps and clusters.
    pub(super) fn coded(&self, coding: usize, headers: bool) -> f64 {
        let code = &self.sums.coded[coding];
        let bytes = |bytes: u64| self.all_over_sampled * bytes as f64;
        bytes(code.numbers) + if headers { bytes(code.headers) } else { 0.0 }
    }

    /// Squared error relative to the sum of squares.
    pub(super) fn squared_error(&self, coding: usize) -> f64 {
        self.sums.coded[coding].squared_error / self.sums.squares
    }

    /// Bytes of nonzero quantised Haar coefficients.
    pub(super) fn haar(&self) -> f64 {
        self.all_over_sampled * self.sums.haar
    }

    /// Relative squared error by number of representatives.
    pub(super) fn error_of(&self) -> impl Iterator<Item = (usize, f64)> {
        self.sums.error_of.iter().map(|(vectors, error)| (*vectors, error / self.sums.squares))
    }
}

impl ModelVisibility {
    /// Computes visibility of a model without ground by ray casting.
    pub(super) fn alone(model: TableModel, size: ModelSize) -> Result<Self, StudyError> {
        let mesh = model.mesh(size)?;
        let vertices = Vertices::new(&mesh, Tangents::default()).on(HOST)?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        Self::traced(&mesh, vertices, &all, size)
    }

    /// Computes visibility of a model on a ground, or of that ground.
    pub(super) fn on_ground(model: TableModel, of_ground: bool, size: ModelSize) -> Result<Self, StudyError> {
        let (mesh, materials) = on_ground(&model.mesh(size)?, ground_side(size)).on(HOST)?;
        let vertices = Vertices::with_materials(&mesh, &materials, Tangents::default()).on(HOST)?;
        let is_wanted = |&vertex: &u32| (vertices.materials()[vertex as usize] == 1) == of_ground;
        let wanted: Vec<u32> = (0..vertices.len() as u32).filter(is_wanted).collect();
        Self::traced(&mesh, vertices, &wanted, size)
    }

    fn traced(mesh: &Mesh, vertices: Vertices, wanted: &[u32], size: ModelSize) -> Result<Self, StudyError> {
        let mut tracer = HostTracer::new(mesh, Sides::Both);
        let maps = VisibilityMaps::trace(&vertices, wanted, &mut tracer, &mut |_, _| ());
        Ok(Self { maps: maps.on(HOST)?, vertices, hats: LinearBasis::new(BasisWidth::TwoTexels), size })
    }

    /// Compresses and codes some segments of the transfer, which represent all: the others are assumed to have the same
    /// size per vertex. Each segment is stored as a piece of the work `name`.
    pub(super) fn compressed(
        &self,
        reflectance: &Reflectance,
        segments: impl IntoIterator<Item = usize>,
        (shared, name): (&Shared, &str),
    ) -> Result<CompressedModel, StudyError> {
        let transfer = transfer_of(&self.vertices, &self.maps, &self.hats, reflectance);
        let iterations = self.size.pick(SegmentOptions::default().iterations, REDUCED_ITERATIONS);
        let (rows, vertices) = (reflectance.terms(), self.maps.len());
        let of_segment = |segment: usize| {
            let found = transfer.segment(segment).on(HOST)?;
            found.map(|found| SegmentSums::new(found, iterations, (rows, vertices))).transpose()
        };
        let (mut sums, mut all) = (SegmentSums::default(), Vec::new());
        for segment in segments {
            if let Some(found) = shared.piece(&format!("{name}-segment-{segment:02}"), || of_segment(segment))? {
                sums.add(&found);
                all.push((segment, found));
            }
        }
        let census = SegmentCensus::new(&self.vertices, &self.maps, &self.hats);
        Ok(CompressedModel {
            vertices,
            omega: census.omega(),
            raw: (4 * LIGHT_TEXELS * rows * vertices) as f64,
            all_over_sampled: census.nonempty as f64 / sums.points as f64,
            sums,
            segments: all,
        })
    }
}

/// Visibility of a model without and with the ground, computed on first use: stored pieces do not need it.
pub(super) struct SeenModel {
    pub(super) model: TableModel,
    size: ModelSize,
    seen: [OnceCell<ModelVisibility>; 2],
}

impl SeenModel {
    pub(super) const fn new(model: TableModel, size: ModelSize) -> Self {
        Self { model, size, seen: [OnceCell::new(), OnceCell::new()] }
    }

    pub(super) fn get(&self, on_ground: bool) -> Result<&ModelVisibility, StudyError> {
        let cell = &self.seen[usize::from(on_ground)];
        if let Some(found) = cell.get() {
            return Ok(found);
        }
        let found = if on_ground {
            ModelVisibility::on_ground(self.model, false, self.size)?
        } else {
            ModelVisibility::alone(self.model, self.size)?
        };
        Ok(cell.get_or_init(|| found))
    }
}

/// Compresses the diffuse bunny of Table 1, reduced, in pieces that are stored if requested. Returns the model as text,
/// and `true` if its visibility was computed. Fails if the model cannot be compressed, or its pieces cannot be stored.
pub fn bunny_in_pieces(kept: Option<Rc<KeptResults>>) -> Result<(String, bool), StudyError> {
    let shared = Shared::new(ModelSize::Reduced).keeping(kept);
    let seen = SeenModel::new(TableModel::Bunny, ModelSize::Reduced);
    let compress = || seen.get(false)?.compressed(&Reflectance::Diffuse, SAMPLED_SEGMENTS, (&shared, "bunny"));
    let model = shared.piece("bunny", compress)?;
    Ok((format!("{model:?}"), seen.seen[0].get().is_some()))
}
