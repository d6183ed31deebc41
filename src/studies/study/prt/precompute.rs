//! Computes the transfer of a model's vertices.

use crate::clustering::Signal;
use crate::cpca::transfer::{Incident, Response, ScatteringOptions, TracedRays, Transfer, TransferCounts};
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::picture::metrics::ErrorSums;
use crate::sphere::{DirectionRule, MAX_ORDER};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::{Dipole, fresnel_transmittance};
use crate::tracer::{Caster, HostTracer};
use crate::transfer::Vertices;
use crate::transfer::brdf::{BRDF_DEGREE, Brdf, ExitBasis};
use crate::transfer::file::{MeshDigest, PrtFile, PrtMeaning};

/// Degree up to which a rule of many heights is exact: the degree of products of two functions of the largest order.
const EXACT_DEGREE: usize = 2 * MAX_ORDER - 2;

/// Representation of exit radiance.
#[derive(Clone, Debug)]
pub enum ExitRadiance {
    /// Without a basis: diffuse transfer.
    Diffuse,
    /// In harmonics: glossy transfer.
    Glossy {
        /// Functions of the basis.
        basis: ExitBasis,
        /// `true` for least squares, `false` for integrals over the hemisphere.
        least_squares: bool,
        /// Quantity of light that the BRDF receives.
        incident: Incident,
    },
}

/// A medium below the surface.
#[derive(Clone, Copy, Debug)]
pub struct Scatterer {
    /// Dipoles of red, green and blue.
    pub dipoles: [Dipole; 3],
    /// Lengths, and the criterion by which a cluster of vertices counts as one point.
    pub options: ScatteringOptions,
}

/// All inputs of the transfer computation.
#[derive(Debug)]
pub struct Precomputation<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Its vertices.
    pub vertices: &'a Vertices,
    /// Color channels of the transfer, 0 to 2 for red, green and blue; each with one BRDF per material.
    pub channels: Vec<(usize, Vec<Brdf>)>,
    /// Meaning of the rows of each matrix.
    pub exit: ExitRadiance,
    /// The order of the light.
    pub order: usize,
    /// Size of the direction rule over each vertex's hemisphere: from 40 on, [`DirectionRule::spread`], whose heights
    /// are all different; below, [`DirectionRule::hemisphere`] of this degree.
    pub degree: usize,
    /// Number of interreflections.
    pub bounces: u32,
    /// A medium below the surface, if there is one.
    pub scatterer: Option<Scatterer>,
}

/// Computed transfer, with its counts.
#[derive(Debug)]
pub struct Precomputed {
    /// The transfer.
    pub file: PrtFile,
    /// Number of directions per vertex.
    pub directions: usize,
    /// Rays.
    pub counts: TransferCounts,
    /// Contribution of each bounce, per channel, relative to the direct transfer.
    pub bounces: Vec<Vec<f64>>,
}

impl Precomputed {
    /// Difference of this transfer from another for the same vertices: the number of coefficients that differ, and the
    /// RMS of the differences relative to the RMS of the other's coefficients.
    pub fn off(&self, other: &Self) -> (u64, f64) {
        let values = |of: &Self| of.file.transfer.as_ref().map_or_else(Vec::new, |signal| signal.values().to_vec());
        let (mut off, mut all, mut differing) = (ErrorSums::default(), ErrorSums::default(), 0);
        for (found, expected) in values(self).into_iter().zip(values(other)) {
            differing += u64::from(found != expected);
            off.add(f64::from(found) - f64::from(expected), 1.0);
            all.add(f64::from(expected), 1.0);
        }
        (differing, if off.rms() > 0.0 { off.rms() / all.rms() } else { 0.0 })
    }
}

/// Responses of a channel's materials, and to light that enters the medium below the surface, with its dipole.
type ChannelResponses = (Vec<Response>, Option<(Vec<Response>, Dipole)>);

impl Precomputation<'_> {
    /// Traces the rays and computes the matrices. Fails if the mesh or a material does not suit the transfer, or its
    /// numbers exceed f32.
    pub fn run(&self, progress: &mut ProgressFn<'_>) -> Result<Precomputed, StudyError> {
        let mut tracer = HostTracer::new(self.mesh, Sides::Both);
        self.run_by(&mut tracer, progress)
    }

    /// Like [`Self::run`], with a caster of the mesh that sees both sides.
    pub fn run_by(&self, caster: &mut dyn Caster, progress: &mut ProgressFn<'_>) -> Result<Precomputed, StudyError> {
        let rule = DirectionRule::spread(self.degree, EXACT_DEGREE);
        let responses = self.channels.iter().map(|(channel, brdfs)| self.responses(&rule, *channel, brdfs));
        let responses = responses.collect::<Result<Vec<_>, _>>()?;
        let (directions, steps) = (rule.len(), 1 + self.channels.len() as u64);
        progress("rays", 0, steps);
        let rays = TracedRays::trace(self.vertices, rule, caster, self.bounces != 0)?;
        let mut channels = Vec::new();
        for (responses, step) in responses.iter().zip(1..) {
            progress("transfer", step, steps);
            channels.push(self.channel(&rays, responses)?);
        }
        let counts = rays.counts().clone();
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
        let file = PrtFile { meaning, mesh, transfer, clustering: None, provenance: None };
        Ok(Precomputed { file, directions, counts, bounces })
    }

    fn responses(&self, rule: &DirectionRule, channel: usize, brdfs: &[Brdf]) -> Result<ChannelResponses, StudyError> {
        let views = DirectionRule::hemisphere(BRDF_DEGREE);
        let response = |(material, brdf): (usize, &Brdf)| match (&self.exit, brdf) {
            (ExitRadiance::Diffuse, &Brdf::Lambert { albedo }) => Ok(Response::diffuse(albedo, rule)?),
            (ExitRadiance::Diffuse, found) => {
                let what = format!(
                    "expected diffuse materials for diffuse transfer, found {found:?} as material {material} (counted \
                     from 0)"
                );
                let help = "ask for glossy transfer, or give a diffuse reflectance for all";
                Err(StudyError::new("crossbar::prt::glossy", what).with_help(help))
            }
            (ExitRadiance::Glossy { basis, least_squares, incident }, brdf) => {
                Ok(Response::glossy(brdf, basis, *least_squares, *incident, rule, &views)?)
            }
        };
        let of_materials = brdfs.iter().enumerate().map(response).collect::<Result<_, _>>()?;
        let entering = self.scatterer.as_ref().map(|scatterer| {
            let dipole = scatterer.dipoles[channel];
            let entering = Response::entering(|cosine| fresnel_transmittance(dipole.eta(), cosine), rule);
            (vec![entering; brdfs.len()], dipole)
        });
        Ok((of_materials, entering))
    }

    /// Transfer of a channel, from direct light on the surface and from light that enters below the surface.
    fn channel(&self, rays: &TracedRays, (of_materials, entering): &ChannelResponses) -> Result<Transfer, InputError> {
        let whole =
            |responses: &[Response], bounces: u32| Transfer::new(self.vertices, rays, responses, self.order, bounces);
        let mut transfer = whole(of_materials, self.bounces)?;
        if let (Some((of_entering, dipole)), Some(Scatterer { options, .. })) = (entering, &self.scatterer) {
            let entering = whole(of_entering, 0)?;
            transfer.add(&Transfer::scattered(self.vertices, &entering, |r| dipole.r_d(r), *options)?)?;
        }
        Ok(transfer)
    }
}

/// Joins all channels into one signal: point by point, channel by channel.
fn together(channels: Vec<Transfer>) -> Result<Signal, InputError> {
    let size = channels.first().map_or(0, |one| one.row_count() * one.column_count());
    let parts: Vec<Vec<f32>> = channels.into_iter().map(Transfer::into_values).collect();
    let points = parts.first().map_or(0, |part| part.len() / size.max(1));
    let mut values = Vec::with_capacity(points * parts.len() * size);
    for point in 0..points {
        parts.iter().for_each(|part| values.extend_from_slice(&part[point * size..(point + 1) * size]));
    }
    Signal::new(parts.len() * size, values)
}
