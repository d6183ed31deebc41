//! Step 3 of section 6 by an emulated card: T_p of all vertices as weighted sums of their clusters' T (equation 13).
//! The paper calls it "dense rather than sparse" and "suitable for GPU implementation", but did not do it.
//!
//! A texel is a vertex. Weights and the addresses of clusters stay on the card; T of the representatives is sent for
//! each light. A pass adds sixteen representatives of a segment to four numbers of T_p; ten terms of three channels
//! take eight passes per segment. T_p is read back and sent with the vertices that
//! [`FactoredCard`](super::FactoredCard) draws, because cards of ps_2_0 cannot read vertices from textures.

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::exec::CheckedProgram;
use refsim::isa::Version;
use refsim::machine::{Executor, Machine, TextureId};
use refsim::output::WriteMask;
use refsim::texture::TexelFormat;
use refsim::timing::host::HostOperation;

use super::options::check_samplers;
use crate::all_frequency::code::{CodedSegment, CodedTransfer};
use crate::all_frequency::kernels::{OF_SUM, SUMMED, SumKernel};
use crate::all_frequency::shade::{LightSizeError, Representatives, Shader, TransferredRadiance};
use crate::card::frame_time::host_work;
use crate::card::{CardError, FullScreenPass, PingPong, Texels, WrittenKernel, constants, nearest, require_versions};

/// Everything is in single precision: weights are the integers of the code, whose steps are multiplied into T.
const FORMAT: TexelFormat = TexelFormat::Rgba32f;
/// Vertices per row of texels.
const ROW: usize = 1024;
/// Numbers per texel.
const NUMBERS: usize = 4;

/// A slice of up to sixteen representatives of each cluster of a segment.
#[derive(Debug)]
struct SumPart {
    /// The index of the segment's first representative among those of all segments.
    first: usize,
    /// Per cluster the index of its first representative in the slice, within the segment, and their number.
    clusters: Vec<(usize, usize)>,
    /// Addresses of clusters, shared by all slices of a segment.
    places: TextureId,
    weights: [TextureId; SUMMED / NUMBERS],
    /// T of the representatives, replaced for each group of four numbers.
    representatives: TextureId,
    /// Width and height of that texture.
    size: [usize; 2],
}

/// Coded transfer on a card, which computes its weighted sums.
#[derive(Debug)]
pub struct SumCard {
    machine: Machine,
    shader: Shader,
    rows: usize,
    vertices: usize,
    size: [usize; 2],
    parts: Vec<SumPart>,
    programs: [CheckedProgram; 2],
    targets: PingPong,
}

/// The work of host and card for one light.
#[derive(Clone, Debug, Default)]
pub struct SumLog {
    /// For [`frame_time`](crate::card::frame_time::frame_time): step 2 on the host, the upload of T, passes, and the
    /// read-back of T_p.
    pub events: Vec<Event>,
    /// Number of passes.
    pub passes: usize,
    /// Bytes sent for a light.
    pub sent: u64,
    /// Bytes read back.
    pub returned: u64,
}

impl SumCard {
    /// Uploads weights and the addresses of clusters.
    ///
    /// # Errors
    /// [`CardError`] if the device lacks the program version, samplers, texture formats or sizes.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        coded: &CodedTransfer,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        require_versions(&profile, &[Version::ArbFp1_0], "sums over representatives")?;
        let kernels = [true, false].map(|is_first| SumKernel { is_first });
        check_samplers(&profile, coded.rows, FORMAT, kernels[1].samplers())?;
        let side = profile.limits.max_texture_size.map_or(4096, |limit| limit as usize).min(4096);
        let [first, next] = kernels.map(|kernel| kernel.checked(&profile));
        let programs = [first?, next?];
        let size = [coded.vertices.clamp(1, ROW.min(side)), coded.vertices.div_ceil(ROW.min(side)).max(1)];
        within("vertices", coded.vertices, size[1], side, &profile)?;
        let mut machine = executor.into().machine(profile.clone())?;
        let mut parts = Vec::new();
        let mut first = 0;
        for part in &coded.segments {
            let most = part.counts.iter().map(|&count| usize::from(count)).max().unwrap_or(0);
            let columns = (side / SUMMED).min(part.counts.len()).max(1);
            let extents = [columns * SUMMED, part.counts.len().div_ceil(columns).max(1)];
            within("clusters of a segment", part.counts.len(), extents[1], side, &profile)?;
            let places = places(part, columns, size).upload(&mut machine, FORMAT)?;
            for slice in 0..most.div_ceil(SUMMED) {
                let weights = weights(part, slice, size);
                let uploads = weights.each_ref().map(|texels| texels.upload(&mut machine, FORMAT));
                let [a, b, c, d] = uploads;
                let empty = Texels::from_fn(extents, |_, _| [0.0; NUMBERS]);
                parts.push(SumPart {
                    first,
                    clusters: slices(part, slice),
                    places,
                    weights: [a?, b?, c?, d?],
                    representatives: empty.upload(&mut machine, FORMAT)?,
                    size: extents,
                });
            }
            first += part.representatives.rows();
        }
        let targets = PingPong::new(&mut machine, FORMAT, size)?;
        let shader = Shader::new(coded, Representatives::Sparse);
        Ok(Self { machine, shader, rows: coded.rows, vertices: coded.vertices, size, parts, programs, targets })
    }

    /// The emulated card.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// Bytes of textures that stay on the card.
    pub fn texture_bytes(&self) -> u64 {
        let of_vertices = (self.size[0] * self.size[1]) as u64;
        let part = |part: &SumPart| {
            let own = (part.size[0] * part.size[1]) as u64;
            (1 + SUMMED / NUMBERS) as u64 * of_vertices + own
        };
        16 * (2 * of_vertices + self.parts.iter().map(part).sum::<u64>())
    }

    /// T_p of all vertices under light: step 2 on the host, step 3 on the card.
    ///
    /// # Errors
    /// [`CardError`]: light for fewer segments, draws that the card refuses.
    pub fn transferred(&mut self, light: &[[f32; 3]]) -> Result<(TransferredRadiance, SumLog), CardError> {
        let products = self.shader.per_cluster(light).map_err(|LightSizeError { expected, found, .. }| {
            CardError::input(format!("expected {expected} light coefficients, found {found}"))
        })?;
        let numbers = 3 * self.rows;
        let mut log = SumLog::default();
        log.events.push(host_work(HostOperation::MultiplyAdd, self.shader.multiplies(light).per_cluster));
        let mut values = vec![[0.0_f32; 3]; self.vertices * self.rows];
        let into = values.as_flattened_mut();
        self.machine.record(true);
        for group in 0..numbers.div_ceil(NUMBERS) {
            let summed = self.group(group, &products, &mut log);
            // Recording ends with an error too, so that later work of the card is not logged.
            if summed.is_err() {
                self.machine.record(false);
            }
            for (vertex, texel) in summed?.texels.iter().take(self.vertices).enumerate() {
                let begin = vertex * numbers + NUMBERS * group;
                let end = (begin + NUMBERS).min((vertex + 1) * numbers);
                into[begin..end].copy_from_slice(&texel[..end - begin]);
            }
        }
        self.machine.record(false);
        log.events.extend(self.machine.take_log());
        Ok((TransferredRadiance::new(self.rows, values), log))
    }

    /// Four numbers of T_p for all vertices.
    fn group(&mut self, group: usize, products: &[f32], log: &mut SumLog) -> Result<Texels, CardError> {
        let none = constants([]);
        for (pass, part) in self.parts.iter().enumerate() {
            let texels = part.texels(&self.shader, products, group, 3 * self.rows);
            texels.update(&mut self.machine, part.representatives, FORMAT)?;
            log.sent += 16 * texels.texels.len() as u64;
            let [a, b, c, d] = part.weights;
            let mut textures = nearest([part.places, a, b, c, d, part.representatives]).to_vec();
            if pass > 0 {
                debug_assert_eq!(textures.len(), OF_SUM, "the sum's sampler");
                textures.extend(nearest([self.targets.read_by(pass)]));
            }
            let pass_of = FullScreenPass {
                program: &self.programs[usize::from(pass > 0)],
                constants: &none,
                textures: &textures,
                target: self.targets.written_by(pass),
                mask: WriteMask::ALL,
                part: None,
            };
            pass_of.draw_counting(&mut self.machine, self.size)?;
            log.passes += 1;
        }
        let Some(last) = self.parts.len().checked_sub(1) else {
            return Ok(Texels::from_fn(self.size, |_, _| [0.0; NUMBERS]));
        };
        let texels = Texels::read_back(&self.machine, self.targets.written_by(last))?;
        log.returned += 16 * texels.texels.len() as u64;
        Ok(texels)
    }
}

impl SumPart {
    /// Four numbers of T for each representative.
    fn texels(&self, shader: &Shader, products: &[f32], group: usize, numbers: usize) -> Texels {
        let columns = self.size[0] / SUMMED;
        Texels::from_fn(self.size, |x, y| {
            let cluster = y * columns + x / SUMMED;
            let Some(&(first, count)) = self.clusters.get(cluster) else { return [0.0; NUMBERS] };
            if x % SUMMED >= count {
                return [0.0; NUMBERS];
            }
            let of = shader.product_of(products, self.first + first + x % SUMMED);
            [0, 1, 2, 3].map(|k| if NUMBERS * group + k < numbers { of[NUMBERS * group + k] } else { 0.0 })
        })
    }
}

/// Refuses more rows of texels than a texture can have.
fn within(what: &'static str, count: usize, needed: usize, found: usize, profile: &Profile) -> Result<(), CardError> {
    if needed <= found {
        return Ok(());
    }
    let device = &profile.name;
    Err(CardError::input(format!(
        "{count} {what} need {needed} rows of texels; `{device}` has textures of {found} (limits.max_texture_size); \
         take fewer"
    )))
}

/// Per vertex the texel of its cluster's first representative; the first texel for a vertex outside the segment.
fn places(part: &CodedSegment, columns: usize, size: [usize; 2]) -> Texels {
    let mut texels = Texels::from_fn(size, |_, _| [0.5, 0.5, 0.0, 0.0]);
    for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
        let cluster = usize::from(cluster);
        let [x, y] = [SUMMED * (cluster % columns), cluster / columns].map(|at| at as f32 + 0.5);
        texels.texels[vertex as usize] = [x, y, 0.0, 0.0];
    }
    texels
}

/// Per vertex the integer weights of a slice's sixteen representatives; 0 for those that it does not have.
fn weights(part: &CodedSegment, slice: usize, size: [usize; 2]) -> [Texels; SUMMED / NUMBERS] {
    let mut texels = [0, 1, 2, 3].map(|_| Texels::from_fn(size, |_, _| [0.0; NUMBERS]));
    let mut begin = 0;
    for (&vertex, &cluster) in part.vertices.iter().zip(&part.cluster_of) {
        let count = usize::from(part.counts[usize::from(cluster)]);
        let own = &part.weights[begin..begin + count];
        begin += count;
        for (k, &weight) in own.iter().skip(SUMMED * slice).take(SUMMED).enumerate() {
            texels[k / NUMBERS].texels[vertex as usize][k % NUMBERS] = f32::from(weight);
        }
    }
    texels
}

/// Per cluster the representatives of a slice: the index of the first within the segment, and their number.
fn slices(part: &CodedSegment, slice: usize) -> Vec<(usize, usize)> {
    let counts = part.counts.iter().zip(part.firsts());
    let of = |(&count, first): (&u8, usize)| {
        (first + SUMMED * slice, usize::from(count).saturating_sub(SUMMED * slice).min(SUMMED))
    };
    counts.map(of).collect()
}
