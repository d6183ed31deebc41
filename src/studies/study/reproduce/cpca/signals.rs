//! The signals of Table 1 and of Figures 2 to 4, on our own models.

use std::rc::Rc;

use super::{HOST, ModelSize, RunResult, Shared, SharedResult, StudyError};
use crate::clustering::{Clustering, Compression, CpcaForm, CpcaMethod, CpcaOptions, Signal, compress};
use crate::cpca::on_card::model::TransferSize;
use crate::cpca::transfer::{Incident, ScatteringOptions};
use crate::geom::Mesh;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::prt::{ExitRadiance, Precomputation, Scatterer};
use crate::subsurface::{Dipole, materials};
use crate::transfer::brdf::{Brdf, ExitBasis};
use crate::transfer::file::PrtMeaning;
use crate::transfer::{Tangents, Vertices};

/// Edge lengths of reduced models, as multiples of the full models': for diffuse and for glossy transfer.
const DIFFUSE_COARSER: u32 = 4;
const GLOSSY_COARSER: u32 = 6;
/// Iterations per number of vectors: "typically 10-20" (section 4.2); fewer for glossy transfer of reduced models.
const ITERATIONS: usize = 10;
const REDUCED_ITERATIONS: usize = 4;
/// "20 VQ iterations were used" (Figure 2).
const VQ_ITERATIONS: usize = 20;
/// Maximum number of reflections on the Buddha: "multiple bounce interreflections".
const BOUNCES: u32 = 2;
/// Isotropic BRDF: the "glossy phong models" of Figure 8.
const ISOTROPIC: Brdf = Brdf::Phong { albedo: 0.2, specular: 0.5, exponent: 10.0 };
/// Anisotropic BRDF with a Fresnel factor (Figure 7).
const ANISOTROPIC: Brdf = Brdf::Ward { albedo: 0.2, specular: 0.4, roughness: [0.2, 0.5] };
const LAMBERT: Brdf = Brdf::Lambert { albedo: 0.8 };
/// Scattering medium for a marble statuette about 10 mm high: its triangles are smaller than the mean free path.
const MEDIUM: &str = "marble";
const MM_PER_UNIT: f64 = 4.0;
const SOLID_ANGLE: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SignalMaterial {
    Diffuse,
    Isotropic,
    Anisotropic,
    /// Isotropic BRDF over a scattering medium.
    Translucent,
}

/// Signal with its printed sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PaperSignal {
    /// Model and BRDF as named in Table 1.
    pub(super) name: &'static str,
    /// Our stand-in for the paper's model.
    pub(super) model: TransferModel,
    pub(super) material: SignalMaterial,
    /// Printed sizes.
    pub(super) size: TransferSize,
}

const fn signal(
    name: &'static str,
    (model, material): (TransferModel, SignalMaterial),
    (vertices, [rows, columns]): (usize, [usize; 2]),
    (clusters, vectors): (usize, usize),
) -> PaperSignal {
    PaperSignal { name, model, material, size: TransferSize { vertices, rows, columns, clusters, vectors } }
}

use SignalMaterial::{Anisotropic, Diffuse, Isotropic, Translucent};
use TransferModel::{Bird, FoldedBuddha, Head, Polygons};

/// The rows of Table 1, then the signal of Figures 2 to 4.
pub(super) const SIGNALS: [PaperSignal; 8] = [
    signal("Buddha gloss-iso", (FoldedBuddha, Isotropic), (49_990, [16, 25]), (256, 6)),
    signal("Buddha gloss-anis", (FoldedBuddha, Anisotropic), (49_990, [24, 25]), (256, 8)),
    signal("Buddha subsurf+gloss-iso", (FoldedBuddha, Translucent), (49_990, [25, 25]), (256, 8)),
    signal("bird gloss-anis", (Bird, Anisotropic), (48_688, [24, 25]), (256, 8)),
    signal("bird diffuse", (Bird, Diffuse), (48_688, [1, 100]), (256, 8)),
    signal("head gloss-iso", (Head, Isotropic), (50_060, [16, 25]), (256, 6)),
    signal("polys diffuse", (Polygons, Diffuse), (58_624, [1, 100]), (32, 4)),
    signal("bird diffuse, order 5", (Bird, Diffuse), (48_688, [1, 25]), (256, 3)),
];

/// Glossy part of Figure 9, with the same number of rows as the sum.
pub(super) const GLOSS_OF_FIGURE_9: PaperSignal =
    signal("Buddha gloss-iso, 25 rows", (FoldedBuddha, Isotropic), (49_990, [25, 25]), (256, 8));

/// Index in [`SIGNALS`].
pub(super) const GLOSSY_BUDDHA: usize = 0;
pub(super) const HEAD: usize = 5;
pub(super) const BUDDHA: usize = 1;
pub(super) const TRANSLUCENT_BUDDHA: usize = 2;
pub(super) const BIRD: usize = 3;
pub(super) const POLYGONS: usize = 6;
pub(super) const DIFFUSE_BIRD: usize = 7;

impl PaperSignal {
    /// Degree of the direction rule over a vertex's hemisphere: it has 2,016 directions; for reduced models 496, or 276
    /// for glossy transfer.
    fn degree(&self, models: ModelSize) -> usize {
        models.pick(62, if self.material == Diffuse { 30 } else { 22 })
    }

    /// Edge length of our model, as a multiple of the full model's.
    fn coarser(&self, models: ModelSize) -> u32 {
        models.pick(1, if self.material == Diffuse { DIFFUSE_COARSER } else { GLOSSY_COARSER })
    }
}

pub(super) struct ComputedSignal {
    pub(super) paper: &'static PaperSignal,
    pub(super) mesh: Mesh,
    pub(super) vertices: Vertices,
    pub(super) meaning: PrtMeaning,
    pub(super) signal: Signal,
    pub(super) models: ModelSize,
}

/// A signal of [`SIGNALS`], by its index.
impl SharedResult for ComputedSignal {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        Self::new(&SIGNALS[at], shared.models)
    }
}

/// Iterative clustering of a signal with the printed numbers of clusters and vectors; reduced models have a fraction of
/// the clusters.
impl SharedResult for Clustering {
    type Key = usize;

    fn compute(&at: &usize, shared: &Shared) -> Result<Self, StudyError> {
        let size = SIGNALS[at].size;
        let signal = shared.get::<ComputedSignal>(at)?;
        signal.compressed(size.clusters, size.vectors, CpcaMethod::Iterative)
    }
}

/// Returns a signal with its iterative clustering.
pub(super) fn iterative(shared: &Shared, at: usize) -> Result<(Rc<ComputedSignal>, Rc<Clustering>), StudyError> {
    Ok((shared.get(at)?, shared.get(at)?))
}

impl ComputedSignal {
    /// Computes a signal of Table 1, projected by least squares.
    pub(super) fn new(paper: &'static PaperSignal, models: ModelSize) -> Result<Self, StudyError> {
        Self::projected(paper, exit_radiance(paper)?, models)
    }

    /// Computes a signal with another projection of its exit radiance.
    pub(super) fn projected(
        paper: &'static PaperSignal,
        exit: ExitRadiance,
        models: ModelSize,
    ) -> Result<Self, StudyError> {
        let mesh = paper.model.mesh(paper.coarser(models));
        let vertices = Vertices::new(&mesh, Tangents::Texture).on(HOST)?;
        let precomputation = Precomputation {
            mesh: &mesh,
            vertices: &vertices,
            channels: vec![(0, vec![paper.material.brdf()])],
            exit,
            order: paper.size.columns.isqrt(),
            degree: paper.degree(models),
            bounces: if paper.model == FoldedBuddha { BOUNCES } else { 0 },
            scatterer: if paper.material == Translucent { Some(scatterer()?) } else { None },
        };
        let computed = precomputation.run(&mut |_, _, _| ()).on(HOST)?;
        let signal = computed.file.transfer.ok_or("no transfer was computed").on(HOST)?;
        Ok(Self { paper, meaning: computed.file.meaning, mesh, vertices, signal, models })
    }

    /// Scales a printed number of clusters to our model, so that the number of points per cluster is the same.
    pub(super) fn clusters(&self, printed: usize) -> usize {
        (printed / self.paper.coarser(self.models).pow(2) as usize).max(1)
    }

    fn iterations(&self) -> usize {
        if self.paper.coarser(self.models) < GLOSSY_COARSER { ITERATIONS } else { REDUCED_ITERATIONS }
    }

    fn compression(
        &self,
        [clusters, vectors]: [usize; 2],
        method: CpcaMethod,
        iterations: usize,
    ) -> Result<Compression, StudyError> {
        let (vq_iterations, form) = (iterations, CpcaForm::Affine);
        let options = CpcaOptions { clusters, vectors, vq_iterations, iterations, method, form, seed: 1 };
        compress(&self.signal, &options, |_| ()).on(HOST)
    }

    /// Compresses the signal to the paper's number of clusters, scaled to our model.
    pub(super) fn compressed(
        &self,
        clusters: usize,
        vectors: usize,
        method: CpcaMethod,
    ) -> Result<Clustering, StudyError> {
        self.compressed_to(self.clusters(clusters), vectors, method)
    }

    pub(super) fn compressed_to(
        &self,
        clusters: usize,
        vectors: usize,
        method: CpcaMethod,
    ) -> Result<Clustering, StudyError> {
        Ok(self.compression([clusters, vectors], method, self.iterations())?.clustering)
    }

    /// Squared error with 0 to `most` vectors; static clusters do not depend on the number of vectors.
    ///
    /// By the formula of section 4.1: dropping vector i adds D_i^2.
    pub(super) fn static_errors(&self, clusters: usize, most: usize) -> Result<Vec<f64>, StudyError> {
        let clustering = self.compression([clusters, most], CpcaMethod::Static, VQ_ITERATIONS)?.clustering;
        let gained = |vector: usize| -> f64 {
            clustering.subspaces().iter().filter_map(|subspace| subspace.eigenvalues.get(vector)).sum()
        };
        let mut errors = vec![self.error(&clustering)];
        for vector in (0..most).rev() {
            errors.push(errors[errors.len() - 1] + gained(vector));
        }
        errors.reverse();
        Ok(errors)
    }

    /// Squared error with 0 to `most` vectors, added one by one (section 4.2).
    pub(super) fn iterative_errors(&self, clusters: usize, most: usize) -> Result<Vec<f64>, StudyError> {
        let compression = self.compression([clusters, most], CpcaMethod::Iterative, self.iterations())?;
        let last = |vectors: usize| compression.steps.iter().rev().find(|step| step.vectors == vectors);
        Ok((0..=most).filter_map(last).map(|step| step.squared_error).collect())
    }

    pub(super) fn energy(&self) -> f64 {
        self.signal.values().iter().map(|&value| f64::from(value) * f64::from(value)).sum()
    }

    /// Squared error of all points.
    pub(super) fn error(&self, clustering: &Clustering) -> f64 {
        clustering.squared_error(&self.signal)
    }
}

impl SignalMaterial {
    pub(super) fn brdf(self) -> Brdf {
        match self {
            Diffuse => LAMBERT,
            Isotropic | Translucent => ISOTROPIC,
            Anisotropic => ANISOTROPIC,
        }
    }
}

fn exit_radiance(paper: &PaperSignal) -> Result<ExitRadiance, StudyError> {
    let basis = match paper.size.rows {
        1 => return Ok(ExitRadiance::Diffuse),
        24 => ExitBasis::without_1_0(5).on(HOST)?,
        rows => ExitBasis::of_order(rows.isqrt()),
    };
    Ok(ExitRadiance::Glossy { basis, least_squares: true, incident: Incident::Harmonics { order: 5, inverse: true } })
}

fn scatterer() -> Result<Scatterer, StudyError> {
    let medium = materials::named(MEDIUM).ok_or("the medium is not known").on(HOST)?.material();
    let [red, green, blue] = medium.channels.map(|channel| Dipole::new(channel, medium.eta));
    let dipoles = [red.on(HOST)?, green.on(HOST)?, blue.on(HOST)?];
    Ok(Scatterer { dipoles, options: ScatteringOptions { mm_per_unit: MM_PER_UNIT, solid_angle: SOLID_ANGLE } })
}
