//! Compressed transfer on an emulated card (section 6 of the paper).
//!
//! A [`PrtCard`] holds the mesh in chunks, one per supercluster. For each frame the host multiplies the means and
//! vectors of all clusters by the light ([`Products`]); the card draws the mesh into the depth buffer, then sums the
//! chunks by blending, for glossy transfer in one pass per color channel.

mod attributes;
pub mod model;
mod products;
mod programs;
pub mod time;
mod transfer;
mod weights;

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::Executor;
use refsim::output::WriteMask;
use refsim::timing::host::HostOperation;

pub use products::Products;
pub use transfer::CompressedTransfer;
pub use weights::{CardWeights, PrtCardOptions, WeightFormat};

use crate::card::frame_time::host_work;
use crate::card::{CardError, KeptFragments, MeshDisplay, MeshDraw, MeshView, ReadTexture, Texels};
use crate::cpca::coherence::Superclusters;
use crate::sphere::{HarmonicLight, ParabolicMap};
use attributes::{Chunk, chunks};
use model::TransferSize;
use programs::{ShadingPrograms, exit_maps, kernel, registers};

const CHANNELS: [WriteMask; 3] = [WriteMask(1), WriteMask(2), WriteMask(4)];

/// A mesh with compressed transfer on a card.
#[derive(Debug)]
pub struct PrtCard<'a> {
    display: MeshDisplay,
    transfer: CompressedTransfer<'a>,
    size: TransferSize,
    weights: CardWeights,
    indices: Vec<u32>,
    superclusters: Superclusters,
    chunks: Vec<Chunk>,
    programs: ShadingPrograms,
    /// Maps of the functions of exit radiance; empty for diffuse transfer.
    maps: Vec<ReadTexture>,
    /// The divisor of the functions in the maps.
    map_scale: f64,
}

impl<'a> PrtCard<'a> {
    /// Uploads a mesh with its transfer.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        transfer: CompressedTransfer<'a>,
        options: &PrtCardOptions,
    ) -> Result<Self, CardError> {
        let profile = profile.into();
        options.check()?;
        let size = transfer.size()?;
        let kernel = kernel(&profile, &transfer)?;
        let (clustering, triangles) = (transfer.clustering, transfer.vertices.triangles());
        let registers = registers(&profile, &kernel);
        let superclusters = match options.superclusters {
            true => Superclusters::new(clustering, triangles, registers),
            false => Superclusters::apart(clustering, registers),
        };
        let superclusters = superclusters.map_err(CardError::input)?;
        let programs = ShadingPrograms::new(&profile, kernel)?;
        let mut machine = executor.into().machine(profile)?;
        let map = ParabolicMap::new(options.map_side);
        let (maps, map_scale) = match transfer.is_glossy() {
            true => exit_maps(&mut machine, transfer.basis, map, options.map_format)?,
            false => (Vec::new(), 1.0),
        };
        let display = MeshDisplay::new(machine, transfer.vertices.positions().iter().copied());
        let weights = CardWeights::new(transfer.clustering, options.weights);
        let chunks = chunks(&transfer, &weights, &superclusters, &programs.kernel, display.positions());
        let indices = triangles.as_flattened().to_vec();
        Ok(Self { display, transfer, size, weights, indices, superclusters, chunks, programs, maps, map_scale })
    }

    /// The groups in which clusters are drawn.
    pub fn superclusters(&self) -> &Superclusters {
        &self.superclusters
    }

    /// The sizes of the transfer.
    pub fn size(&self) -> TransferSize {
        self.size
    }

    /// Draws a frame and returns the target. Background pixels are 0.
    pub fn view_texels(&mut self, light: &HarmonicLight, view: &MeshView) -> Result<Texels, CardError> {
        Ok(self.show(light, view, false)?.0)
    }

    /// Like [`Self::view_texels`], but also returns the log of host and card, without the read-back, for
    /// [`frame_time`](crate::card::frame_time::frame_time).
    pub fn logged_view(&mut self, light: &HarmonicLight, view: &MeshView) -> Result<(Texels, Vec<Event>), CardError> {
        let (texels, mut log) = self.show(light, view, true)?;
        let work = self.size.multiply_adds(self.transfer.representatives());
        log.insert(0, host_work(HostOperation::MultiplyAdd, work as u64));
        Ok((texels, log))
    }

    fn show(
        &mut self,
        light: &HarmonicLight,
        view: &MeshView,
        is_logged: bool,
    ) -> Result<(Texels, Vec<Event>), CardError> {
        let Self { transfer, weights, programs, maps, .. } = self;
        let masks = if maps.is_empty() { &[WriteMask::ALL][..] } else { &CHANNELS };
        let factor = view.exposure * self.map_scale;
        self.display.show(view, is_logged, |pass| {
            let products = Products::new(transfer, weights, light, factor)?;
            pass.draw_depth(&programs.depth, &self.indices)?;
            let mut head = pass.head();
            head.truncate(programs.kernel.first());
            for chunk in self.chunks.iter().filter(|chunk| !chunk.indices.is_empty()) {
                for (channel, &mask) in masks.iter().enumerate() {
                    let constants = chunk.constants(&products, &programs.kernel, channel);
                    pass.draw(MeshDraw {
                        vertex: (&programs.vertex, head.iter().copied().chain(constants).collect()),
                        attributes: chunk.attributes.iter().collect(),
                        indices: Some(&chunk.indices),
                        pixel: (&programs.pixel, Vec::new()),
                        textures: maps.clone(),
                        fragments: KeptFragments::Added,
                        mask,
                    })?;
                }
            }
            Ok(())
        })
    }
}
