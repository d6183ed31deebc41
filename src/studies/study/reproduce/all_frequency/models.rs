//! Models of Table 1, or our stand-ins, compressed and encoded.

use std::rc::Rc;

use super::codings::CODINGS;
use super::forms::{Form, TERMS, cook_torrance, schlick};
use super::{HOST, StudyError, failed};
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodedSegment, CodedTransfer};
use crate::all_frequency::compressed::{CompressedSegment, SegmentOptions};
use crate::all_frequency::factor::Factorization;
use crate::all_frequency::transfer::transfer_of;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::scene::built::ground::{GROUND_SIDE, on_ground};
use crate::scene::built::transfer_models::TransferModel;
use crate::study::reproduce::ModelSize;
use crate::tracer::HostTracer;
use crate::transfer::clustering::{CpcaStep, CpcaStepKind};
use crate::transfer::grid::Segmentation;
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::{SegmentCensus, VisibilityMaps};
use crate::transfer::{Signal, Tangents, Vertices};

/// Segments compressed for reduced models: a quarter of three faces.
const SOME_SEGMENTS: [usize; 3] = [0, 10, 21];
/// Iterations for each number of representatives on reduced models.
pub(super) const REDUCED_ITERATIONS: usize = 2;
/// Bits per number in the coding of Haar coefficients alone: those of the earlier work first.
pub(super) const HAAR_BITS: [u32; 3] = [8, 12, 16];

/// Model of Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableModel {
    Bunny,
    Teapot,
    Tweety,
    Buddha,
}

/// Material of a model in Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TableMaterial {
    Diffuse,
    Cook,
    Schlick,
}

impl TableModel {
    /// Builds the mesh; a reduced one has some hundred vertices, for a run that judges nothing.
    fn mesh(self, size: ModelSize) -> Result<Mesh, StudyError> {
        let built =
            |model: TransferModel, coarser: u32| model.mesh(if size == ModelSize::Printed { 1 } else { coarser });
        Ok(match self {
            Self::Bunny => built(TransferModel::Bunny, 8),
            Self::Tweety => built(TransferModel::Tweety, 12),
            Self::Buddha => built(TransferModel::Buddha, 12),
            Self::Teapot => {
                let rate = if size == ModelSize::Printed { 40 } else { 3 };
                crate::geom::teapot::teapot(rate).map_err(|e| failed(HOST)(&e))?
            }
        })
    }
}

impl TableMaterial {
    /// Returns the reflectance in the textbooks' form of the model, with ten terms.
    pub(super) fn reflectance(self) -> Result<Reflectance, StudyError> {
        let (_, lobe, sampling): Form = match self {
            Self::Diffuse => return Ok(Reflectance::Diffuse),
            Self::Cook => cook_torrance()[0],
            Self::Schlick => schlick()[0],
        };
        let fail = failed(HOST);
        let table = sampling.table(&lobe, &mut |_, _| ()).map_err(|e| fail(&e))?;
        let factors = Factorization::new(&table, TERMS).map_err(|e| fail(&e))?;
        Ok(Reflectance::Factored(factors.factors(TERMS)))
    }
}

/// Vertices along an edge of the ground.
pub(super) const fn ground_side(size: ModelSize) -> u32 {
    match size {
        ModelSize::Printed => GROUND_SIDE,
        ModelSize::Reduced => 24,
    }
}

/// Visibility at the vertices of a model, or of its ground.
pub(super) struct ModelVisibility {
    vertices: Rc<Vertices>,
    maps: VisibilityMaps,
    hats: Rc<LinearBasis>,
    size: ModelSize,
}

/// Compressed model.
#[derive(Clone, Debug)]
pub(super) struct CompressedModel {
    pub(super) vertices: usize,
    /// Number of compressed segments.
    pub(super) segments: usize,
    pub(super) omega: f64,
    pub(super) clusters: usize,
    /// Bytes of raw transfer in single precision, of all compressed segments.
    pub(super) raw: f64,
    /// Bytes of weights and representatives in single precision.
    pub(super) clustered: f64,
    /// Results for each of [`CODINGS`].
    pub(super) coded: Vec<CodedModel>,
    /// Bytes of non-zero quantised Haar coefficients, for each of [`HAAR_BITS`].
    pub(super) haar: [f64; 3],
    /// Relative squared error by number of representatives.
    pub(super) error_of: Vec<(usize, f64)>,
}

/// Result of one coding.
#[derive(Clone, Copy, Debug)]
pub(super) struct CodedModel {
    /// Bytes of representatives and weights, all numbers stored in 16 bits.
    pub(super) numbers: f64,
    /// Bytes of counts of columns, steps and clusters.
    pub(super) headers: f64,
    /// Squared error relative to the sum of squares.
    pub(super) squared_error: f64,
}

impl ModelVisibility {
    /// Computes visibility by ray casting, of a model by itself.
    pub(super) fn alone(model: TableModel, size: ModelSize) -> Result<Self, StudyError> {
        let fail = failed(HOST);
        let mesh = model.mesh(size)?;
        let vertices = Vertices::new(&mesh, Tangents::default()).map_err(|e| fail(&e))?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let mut tracer = HostTracer::new(&mesh, Sides::Both);
        let maps = VisibilityMaps::trace(&vertices, &all, &mut tracer, &mut |_, _| ()).map_err(|e| fail(&e))?;
        Ok(Self { vertices: Rc::new(vertices), maps, hats: Rc::new(LinearBasis::new(BasisWidth::TwoTexels)), size })
    }

    /// Computes visibility of a model on a ground, and of that ground.
    pub(super) fn on_ground(model: TableModel, size: ModelSize) -> Result<[Self; 2], StudyError> {
        let fail = failed(HOST);
        let (mesh, materials) = on_ground(&model.mesh(size)?, ground_side(size)).map_err(|e| fail(&e))?;
        let vertices = Vertices::with_materials(&mesh, &materials, Tangents::default()).map_err(|e| fail(&e))?;
        let is_ground = |&vertex: &u32| vertices.materials()[vertex as usize] == 1;
        let (ground, own): (Vec<u32>, Vec<u32>) = (0..vertices.len() as u32).partition(is_ground);
        let mut tracer = HostTracer::new(&mesh, Sides::Both);
        let mut trace = |of: &[u32]| VisibilityMaps::trace(&vertices, of, &mut tracer, &mut |_, _| ());
        let [own, ground] = [trace(&own).map_err(|e| fail(&e))?, trace(&ground).map_err(|e| fail(&e))?];
        let (vertices, hats) = (Rc::new(vertices), Rc::new(LinearBasis::new(BasisWidth::TwoTexels)));
        let of = |maps| Self { vertices: Rc::clone(&vertices), maps, hats: Rc::clone(&hats), size };
        Ok([own, ground].map(of))
    }

    /// Share of the segments that hold transfer.
    pub(super) fn omega(&self) -> f64 {
        SegmentCensus::new(&self.vertices, &self.maps, &self.hats).omega()
    }

    /// Compresses and encodes the transfer: of some segments for reduced models, unless all are wanted.
    pub(super) fn compressed(&self, reflectance: &Reflectance, wants_all: bool) -> Result<CompressedModel, StudyError> {
        let fail = failed(HOST);
        let transfer = transfer_of(&self.vertices, &self.maps, &self.hats, reflectance);
        let reduced = self.size == ModelSize::Reduced;
        let all: Vec<usize> = (0..Segmentation::Quarters.count()).collect();
        let wanted = if reduced && !wants_all { &SOME_SEGMENTS[..] } else { &all[..] };
        let mut work = SegmentSums::default();
        for &segment in wanted {
            if let Some(found) = transfer.segment(segment).map_err(|e| fail(&e))? {
                let iterations = if reduced { REDUCED_ITERATIONS } else { SegmentOptions::default().iterations };
                work.add(segment, found.vertices, &found.signal, iterations)?;
            }
        }
        let (rows, coefficients) = (reflectance.terms(), Segmentation::Quarters.len());
        let (vertices, squares) = (self.maps.len(), work.squares);
        let coded = CODINGS.into_iter().zip(work.coded).zip(work.coded_errors).map(|((coding, segments), error)| {
            let options = coding.counted();
            let size = CodedTransfer { rows, coefficients, vertices, options, segments }.size();
            let numbers = size.as_the_paper_counts();
            let headers = (size.total() - numbers) as f64;
            CodedModel { numbers: numbers as f64, headers, squared_error: error / squares }
        });
        let coded = coded.collect();
        Ok(CompressedModel {
            vertices,
            segments: wanted.len(),
            omega: self.omega(),
            clusters: work.clusters,
            raw: (4 * wanted.len() * coefficients * rows * vertices) as f64,
            clustered: 4.0 * work.numbers as f64,
            coded,
            haar: work.haar,
            error_of: work.error_of.into_iter().map(|(vectors, error)| (vectors, error / squares)).collect(),
        })
    }
}

/// Sums over segments.
#[derive(Default)]
struct SegmentSums {
    clusters: usize,
    numbers: usize,
    squares: f64,
    coded: [Vec<CodedSegment>; CODINGS.len()],
    coded_errors: [f64; CODINGS.len()],
    haar: [f64; 3],
    error_of: Vec<(usize, f64)>,
}

impl SegmentSums {
    fn add(
        &mut self,
        segment: usize,
        vertices: Vec<u32>,
        signal: &Signal,
        iterations: usize,
    ) -> Result<(), StudyError> {
        let fail = failed(HOST);
        let options = SegmentOptions { iterations, ..SegmentOptions::default() };
        let mut steps: Vec<CpcaStep> = Vec::new();
        let compressed = CompressedSegment::new(segment, vertices, signal, &options, |step| steps.push(*step));
        let compressed = compressed.map_err(|e| fail(&e))?;
        for (at, coding) in CODINGS.into_iter().enumerate() {
            let coded = coding.code(&compressed)?;
            self.coded_errors[at] += coded.squared_errors(signal).iter().sum::<f64>();
            self.coded[at].push(coded);
        }
        self.clusters += compressed.clustering.subspaces().len();
        self.numbers += compressed.clustering.stored_numbers();
        self.squares += signal.sum_of_squares();
        for (bytes, bits) in self.haar.iter_mut().zip(HAAR_BITS) {
            *bytes += haar_bytes(signal, bits);
        }
        let last = last_of_each(&steps);
        self.error_of.resize(last.len().max(self.error_of.len()), (0, 0.0));
        for (sum, (vectors, error)) in self.error_of.iter_mut().zip(last) {
            *sum = (vectors, sum.1 + error);
        }
        Ok(())
    }
}

/// Squared error of the last fit for each number of representatives except 0.
fn last_of_each(steps: &[CpcaStep]) -> Vec<(usize, f64)> {
    let fits = steps.iter().filter(|step| step.kind == CpcaStepKind::Fitted && step.vectors > 0);
    let mut last: Vec<(usize, f64)> = Vec::new();
    for step in fits {
        match last.last_mut().filter(|last| last.0 == step.vectors) {
            Some(last) => last.1 = step.squared_error,
            None => last.push((step.vectors, step.squared_error)),
        }
    }
    last
}

/// Bytes of a segment without clusters: a byte for the row and a value for each coefficient that is non-zero after
/// quantisation, in which the largest of the vertex fills integers of `bits` bits.
fn haar_bytes(signal: &Signal, bits: u32) -> f64 {
    let nonzeros = |point: usize| {
        let values = signal.point(point);
        let largest = values.iter().fold(0.0_f32, |largest, value| largest.max(value.abs()));
        let half = 0.5 * f64::from(largest) / f64::from((1_u32 << (bits - 1)) - 1);
        values.iter().filter(|value| f64::from(value.abs()) > half).count()
    };
    let nonzeros: usize = (0..signal.points()).map(nonzeros).sum();
    nonzeros as f64 * (1.0 + f64::from(bits) / 8.0)
}
