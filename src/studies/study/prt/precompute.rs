//! From a model to the transfer of its vertices.

use crate::cpca::transfer::{Bounces, Incident, Response, ScatteringOptions, TracedRays, Transfer, TransferCounts};
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::sphere::{DirectionRule, MAX_ORDER};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::{Dipole, fresnel_transmittance};
use crate::tracer::HostTracer;
use crate::transfer::brdf::{BRDF_DEGREE, Brdf, ExitBasis};
use crate::transfer::file::{MeshDigest, PrtFile, PrtMeaning};
use crate::transfer::{Signal, SignalError, TransferError, Vertices};

/// Degree up to which a rule of many heights is exact: that of products of two functions of the largest order.
const EXACT_DEGREE: usize = 2 * MAX_ORDER - 2;

/// How exit radiance is expressed.
#[derive(Clone, Debug)]
pub enum ExitRadiance {
    /// By itself: diffuse transfer.
    Diffuse,
    /// In harmonics: glossy transfer.
    Glossy {
        /// Their functions.
        basis: ExitBasis,
        /// True for least squares; else by integrals over the hemisphere.
        least_squares: bool,
        /// How light reaches the BRDF.
        incident: Incident,
    },
}

/// A medium below the surface.
#[derive(Clone, Copy, Debug)]
pub struct Scatterer {
    /// Per color channel.
    pub dipoles: [Dipole; 3],
    /// Lengths, and when a cluster of vertices is one point.
    pub options: ScatteringOptions,
}

/// Everything that transfer is computed from.
#[derive(Debug)]
pub struct Precomputation<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Its vertices.
    pub vertices: &'a Vertices,
    /// Color channels of the transfer, 0 to 2 for red, green and blue; per channel a BRDF of each material.
    pub channels: Vec<(usize, Vec<Brdf>)>,
    /// The rows of each matrix.
    pub exit: ExitRadiance,
    /// The order of the light.
    pub order: usize,
    /// The size of the rule of directions over each vertex's hemisphere: [`DirectionRule::spread`], whose heights are
    /// all different, from 40 on; below, [`DirectionRule::hemisphere`] of this degree.
    pub degree: usize,
    /// How often light is reflected on its way.
    pub bounces: Bounces,
    /// A medium below the surface, if there is one.
    pub scatterer: Option<Scatterer>,
}

/// Transfer, and what was counted.
#[derive(Debug)]
pub struct Precomputed {
    /// The transfer.
    pub file: PrtFile,
    /// Directions of each vertex.
    pub directions: usize,
    /// Rays.
    pub counts: TransferCounts,
    /// Per channel what each bounce added, as a share of the direct transfer.
    pub bounces: Vec<Vec<f64>>,
}

impl Precomputation<'_> {
    /// Traces the rays and computes the matrices.
    ///
    /// # Errors
    /// If the mesh or a material does not suit the transfer, or its numbers exceed f32.
    pub fn run(&self, progress: &mut ProgressFn<'_>) -> Result<Precomputed, StudyError> {
        self.check()?;
        let steps = 1 + self.channels.len() as u64;
        progress("rays", 0, steps);
        let rule = DirectionRule::spread(self.degree, EXACT_DEGREE);
        let mut tracer = HostTracer::new(self.mesh, Sides::Both);
        let keep_hits = self.bounces != Bounces::Count(0);
        let mut rays = TracedRays::trace(self.vertices, rule, &mut tracer, keep_hits)?;
        let mut channels = Vec::new();
        for ((channel, brdfs), step) in self.channels.iter().zip(1..) {
            progress("transfer", step, steps);
            channels.push(self.channel(&rays, *channel, brdfs)?);
        }
        let basis = channels.first().map_or(&ExitBasis::Radiance, Transfer::basis);
        let meaning = PrtMeaning::Transfer {
            channels: channels.len() as u32,
            exit_functions: match basis.functions() {
                [] => vec![0],
                functions => functions.iter().map(|&function| function as u16).collect(),
            },
            light_order: self.order as u32,
            includes_albedo: true,
        };
        let bounces = channels.iter().map(|transfer| transfer.bounces.clone()).collect();
        let transfer = Some(together(channels)?);
        let mesh = Some(MeshDigest::new(self.vertices));
        Ok(Precomputed {
            file: PrtFile { meaning, mesh, transfer, clustering: None, superclusters: None, provenance: None },
            directions: rays.rule().len(),
            counts: std::mem::take(&mut rays.counts),
            bounces,
        })
    }

    fn check(&self) -> Result<(), StudyError> {
        let glossy = |(material, brdf): (usize, &Brdf)| match brdf {
            Brdf::Lambert { .. } => None,
            found => {
                let what = format!(
                    "expected diffuse materials for diffuse transfer, found {found:?} as material {material} (counted \
                     from 0)"
                );
                let help = "ask for glossy transfer, or give a diffuse reflectance for all";
                Some(StudyError::new("crossbar::prt::glossy", what).with_help(help))
            }
        };
        let mut all = self.channels.iter().flat_map(|(_, brdfs)| brdfs.iter().enumerate());
        match self.exit {
            ExitRadiance::Diffuse => all.find_map(glossy).map_or(Ok(()), Err),
            ExitRadiance::Glossy { .. } => Ok(()),
        }
    }

    fn channel(&self, rays: &TracedRays, channel: usize, brdfs: &[Brdf]) -> Result<Transfer, TransferError> {
        let views = DirectionRule::hemisphere(BRDF_DEGREE);
        let response = |brdf: &Brdf| match (&self.exit, *brdf) {
            (ExitRadiance::Diffuse, Brdf::Lambert { albedo }) => Response::diffuse(albedo, rays.rule()),
            (ExitRadiance::Diffuse, _) => Response::diffuse(0.0, rays.rule()),
            (ExitRadiance::Glossy { basis, least_squares, incident }, brdf) => {
                Response::glossy(&brdf, basis, *least_squares, *incident, rays.rule(), &views)
            }
        };
        let responses: Vec<Response> = brdfs.iter().map(response).collect::<Result<_, _>>()?;
        let mut transfer = Transfer::new(self.vertices, rays, &responses, self.order, self.bounces)?;
        if let Some(Scatterer { dipoles, options }) = &self.scatterer {
            let dipole = &dipoles[channel];
            let entering = Response::entering(|cosine| fresnel_transmittance(dipole.eta(), cosine), rays.rule());
            let entering = vec![entering; brdfs.len()];
            let entering = Transfer::new(self.vertices, rays, &entering, self.order, Bounces::Count(0))?;
            transfer.add(&Transfer::scattered(self.vertices, &entering, |r| dipole.r_d(r), *options)?)?;
        }
        Ok(transfer)
    }
}

/// One signal of all channels: point by point, channel by channel.
fn together(channels: Vec<Transfer>) -> Result<Signal, SignalError> {
    let size = channels.first().map_or(0, |one| one.row_count() * one.column_count());
    let count = channels.len();
    let mut parts: Vec<Vec<f32>> = channels.into_iter().map(Transfer::into_values).collect();
    if let ([values], _) = (&mut parts[..], count) {
        return Signal::new(size, std::mem::take(values));
    }
    let points = parts.first().map_or(0, |part| part.len() / size.max(1));
    let mut values = Vec::with_capacity(points * count * size);
    for point in 0..points {
        parts.iter().for_each(|part| values.extend_from_slice(&part[point * size..(point + 1) * size]));
    }
    Signal::new(count * size, values)
}
