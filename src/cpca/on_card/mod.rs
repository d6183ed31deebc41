//! Compressed transfer on an emulated card (section 6 of the paper).
//!
//! A [`PrtCard`] holds the mesh in chunks, one per supercluster. For each frame the host multiplies the means and
//! vectors of all clusters by the light ([`Products`]); the card draws the mesh into the depth buffer, then adds up
//! the chunks, glossy transfer in one pass per color channel.

mod chunks;
mod error;
pub mod estimate;
mod exit_map;
pub mod model;
mod options;
pub mod order;
mod products;
mod programs;
pub mod time;
mod transfer;
mod weights;

use std::sync::Arc;

use refsim::device::Profile;
use refsim::event::Event;
use refsim::machine::{DrawCall, Executor, Machine, VertexSource};
use refsim::output::{BlendFactor, BlendOp, BlendState, CompareFunction, DepthState, WriteMask};
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::TexelFormat;
use refsim::timing::host::HostOperation;

pub use error::PrtCardError;
pub use options::PrtCardOptions;
pub use products::Products;
pub use transfer::CompressedTransfer;
pub use weights::{CardWeights, WeightFormat};

use crate::card::{Attribute, BILINEAR, NearestTarget, Texels, ViewTarget, constants, vertex_streams};
use crate::cpca::coherence::Superclusters;
use crate::geom::UnitFrame;
use crate::geom::vector::wide;
use crate::picture::Picture;
use crate::scene::Camera;
use crate::sphere::{HarmonicLight, ParabolicMap};
pub(crate) use chunks::positions;
use chunks::{Chunk, chunks};
pub(crate) use exit_map::map_texture;
use exit_map::{ExitMaps, map_scale};
use model::TransferSize;
use programs::{Programs, kernel, registers};

#[cfg(test)]
mod tests;

/// How the mesh is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrtView {
    /// The camera.
    pub camera: Camera,
    /// What radiances are multiplied by in the picture: 0 to 1e30.
    pub exposure: f64,
    /// The picture's format. Fractions clamp each pass to 0 to 1; floats need a device that blends them.
    pub format: TexelFormat,
}

/// Adds what a pass draws to the target.
const ADD: BlendState = BlendState::both(BlendFactor::One, BlendFactor::One, BlendOp::Add);
/// The write masks of the passes of glossy transfer.
const CHANNELS: [WriteMask; 3] = [WriteMask(1), WriteMask(2), WriteMask(4)];

/// A mesh with compressed transfer on a card.
#[derive(Debug)]
pub struct PrtCard<'a> {
    machine: Machine,
    transfer: CompressedTransfer<'a>,
    size: TransferSize,
    weights: CardWeights,
    frame: UnitFrame,
    positions: Attribute,
    indices: Vec<u32>,
    superclusters: Superclusters,
    chunks: Vec<Chunk>,
    programs: Programs,
    maps: Option<ExitMaps>,
    /// What the functions in the maps are divided by.
    map_scale: f64,
    target: ViewTarget,
}

impl<'a> PrtCard<'a> {
    /// Uploads a mesh with its transfer.
    ///
    /// # Errors
    /// [`PrtCardError`] if the device has no such programs, the number of vectors or functions exceeds a limit,
    /// clusters have more vectors than `transfer` says, or its parts do not go together.
    pub fn new(
        profile: impl Into<Arc<Profile>>,
        executor: impl Into<Executor>,
        transfer: CompressedTransfer<'a>,
        options: &PrtCardOptions,
    ) -> Result<Self, PrtCardError> {
        let profile = profile.into();
        options.check()?;
        let size = transfer.size()?;
        let kernel = kernel(&profile, &transfer, options)?;
        let (clustering, triangles) = (transfer.clustering, transfer.vertices.triangles());
        let registers = registers(&profile, &kernel);
        let superclusters = if options.superclusters {
            Superclusters::new(clustering, triangles, registers)?
        } else {
            Superclusters::apart(clustering, registers)?
        };
        let programs = Programs::new(&profile, kernel)?;
        let mut machine = executor.into().machine(profile)?;
        let map = ParabolicMap::new(options.map_side);
        let (mut maps, mut scale) = (None, 1.0);
        if transfer.is_glossy() {
            scale = map_scale(transfer.basis, map, options.map_format);
            maps = Some(ExitMaps::new(&mut machine, transfer.basis, (map, options.map_format, scale))?);
        }
        let frame = UnitFrame::new(transfer.vertices.positions().iter().copied().map(wide));
        let positions = positions(transfer.vertices, &frame);
        let weights = CardWeights::new(transfer.clustering, options.weights);
        let chunks = chunks((&transfer, &weights), &superclusters, &programs.kernel, &positions);
        let indices = triangles.as_flattened().to_vec();
        let (map_scale, target) = (scale, ViewTarget::default());
        Ok(Self {
            machine,
            transfer,
            size,
            weights,
            frame,
            positions,
            indices,
            superclusters,
            chunks,
            programs,
            maps,
            map_scale,
            target,
        })
    }

    /// The groups in which clusters are drawn.
    pub fn superclusters(&self) -> &Superclusters {
        &self.superclusters
    }

    /// The sizes of the transfer.
    pub fn size(&self) -> TransferSize {
        self.size
    }

    /// The emulated card.
    pub fn machine_mut(&mut self) -> &mut Machine {
        &mut self.machine
    }

    /// A frame. Pixels that show nothing are 0.
    ///
    /// # Errors
    /// [`PrtCardError`] for light of too low an order, an exposure out of range, products that are not finite, and
    /// draws that the card refuses.
    pub fn view(&mut self, light: &HarmonicLight, view: &PrtView) -> Result<Picture, PrtCardError> {
        let Texels { width, height, texels } = self.view_texels(light, view)?;
        let pixels: Vec<[f32; 3]> = texels.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect();
        Ok(Picture::rgb(width as u32, height as u32, &pixels))
    }

    /// As [`Self::view`], as the target holds it.
    ///
    /// # Errors
    /// As [`Self::view`].
    pub fn view_texels(&mut self, light: &HarmonicLight, view: &PrtView) -> Result<Texels, PrtCardError> {
        let target = self.draw(light, view)?;
        Ok(Texels::read_back(&self.machine, target.color)?)
    }

    /// As [`Self::view_texels`], with what the frame asks of host and card, for [`time::frame_time`]: no read-back.
    ///
    /// # Errors
    /// As [`Self::view`].
    pub fn logged_view(&mut self, light: &HarmonicLight, view: &PrtView) -> Result<(Texels, Vec<Event>), PrtCardError> {
        self.machine.record(true);
        let drawn = self.draw(light, view);
        self.machine.record(false);
        let log = self.machine.take_log();
        Ok((Texels::read_back(&self.machine, drawn?.color)?, log))
    }

    /// Draws a frame: products on the host, the mesh into the depth buffer, chunk by chunk into the target.
    fn draw(&mut self, light: &HarmonicLight, view: &PrtView) -> Result<NearestTarget, PrtCardError> {
        let found = view.exposure;
        if !(0.0..=1e30).contains(&found) {
            return Err(PrtCardError::Figure { what: "an exposure of 0 to 1e30", found });
        }
        let products = Products::new(&self.transfer, &self.weights, light, view.exposure * self.map_scale)?;
        self.machine.host_work(HostOperation::MultiplyAdd.name(), self.size.host_multiply_adds() as u64);
        let size = [view.camera.width(), view.camera.height()];
        let target = self.target.of(&mut self.machine, view.format, size)?;
        target.clear(&mut self.machine)?;
        let mut head = view.camera.clip_rows(&self.frame).to_vec();
        self.draw_depth(target, &head)?;
        let [x, y, z] = self.frame.of_scene(wide(view.camera.eye())).to_array().map(|value| value as f32);
        head.push([x, y, z, 1.0]);
        head.truncate(self.programs.kernel.first());
        let masks = if self.maps.is_some() { &CHANNELS[..] } else { &[WriteMask::ALL] };
        for chunk in 0..self.chunks.len() {
            for (channel, &mask) in masks.iter().enumerate() {
                let products = self.chunks[chunk].constants(&products, &self.programs.kernel, channel);
                self.draw_chunk(target, chunk, head.iter().copied().chain(products), mask)?;
            }
        }
        Ok(target)
    }

    /// The whole mesh into the depth buffer alone.
    fn draw_depth(&mut self, target: NearestTarget, head: &[[f32; 4]]) -> Result<(), PrtCardError> {
        let (vertex_constants, pixel_constants) = (constants(head.iter().copied()), constants([]));
        let streams = vertex_streams([&self.positions]);
        let program = &self.programs.depth;
        let source = VertexSource::Program { program, constants: &vertex_constants, streams };
        let pixel = &self.programs.unseen;
        let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, target.color);
        target.keep_nearest(&mut call);
        call.indices = Some(&self.indices);
        call.masks[0] = WriteMask::NONE;
        self.machine.draw(&call)?;
        Ok(())
    }

    /// A chunk, where it is what the depth buffer shows, added to the target.
    fn draw_chunk(
        &mut self,
        target: NearestTarget,
        chunk: usize,
        vertex_constants: impl Iterator<Item = [f32; 4]>,
        mask: WriteMask,
    ) -> Result<(), PrtCardError> {
        let Chunk { attributes, indices, .. } = &self.chunks[chunk];
        if indices.is_empty() {
            return Ok(());
        }
        let (vertex_constants, pixel_constants) = (constants(vertex_constants), constants([]));
        let program = &self.programs.vertex;
        let source =
            VertexSource::Program { program, constants: &vertex_constants, streams: vertex_streams(attributes) };
        let pixel = &self.programs.pixel;
        let mut call = DrawCall::new(source, Primitive::TriangleList, pixel, &pixel_constants, target.color);
        call.center = PixelCenter::OpenGl;
        call.depth = DepthState { test: Some(CompareFunction::Equal), write: false };
        call.depth_buffer = Some(target.depth);
        call.indices = Some(indices);
        call.blend = Some(ADD);
        call.masks[0] = mask;
        for (sampler, &texture) in self.maps.iter().flat_map(|maps| &maps.textures).enumerate() {
            call = call.with_texture(sampler, texture, BILINEAR);
        }
        self.machine.draw(&call)?;
        Ok(())
    }
}
