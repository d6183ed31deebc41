//! Log of a machine: the host's calls in order.

use super::{DrawEvents, HostOperation, ProgramWork, SAMPLERS, SamplerTraffic};
use std::sync::Arc;

/// Identifies a resource in the card's memory by the number in its handle.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ResourceId {
    /// A texture or a colour target (which is a texture).
    Texture(usize),
    /// A depth buffer.
    Depth(usize),
}

/// Identifies a fence of one machine (NV_fence).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FenceId(pub u32);

/// Synchronisation of a read-back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReadBackMode {
    /// The host waits until all bytes have arrived.
    Synchronous,
    /// The host continues; a fence signals the arrival of the bytes.
    Asynchronous,
}

/// Operations of the host between two calls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HostWork {
    /// Kind of operation.
    pub kind: HostOperation,
    /// Number of operations.
    pub operations: u64,
}

/// A call of the host, or work that the host does itself.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// Data sent to the card.
    Upload {
        /// Destination.
        resource: ResourceId,
        /// Size in bytes.
        bytes: u64,
    },
    /// The next draw uses a state that differs from the previous draw's.
    StateChange {
        /// Number of state groups that differ. The groups are: each program, each program's constants, each sampler,
        /// targets, depth buffer, depth test, alpha test, blending, write masks, viewport with scissor and culling,
        /// bump state.
        changes: u32,
        /// Number of float constants (of four numbers) that differ in either program; these are sent to the card.
        constants: u32,
    },
    /// A target or depth buffer filled with one value.
    Clear {
        /// The target or depth buffer.
        resource: ResourceId,
        /// Its size in bytes.
        bytes: u64,
    },
    /// A draw.
    Draw(Box<DrawRecord>),
    /// Mip levels generated from level 0 of a texture.
    GenerateMipmaps(MipmapRecord),
    /// Data read back from the card.
    ReadBack {
        /// Source.
        resource: ResourceId,
        /// Size in bytes.
        bytes: u64,
        /// Synchronisation.
        mode: ReadBackMode,
        /// Fence of an asynchronous read-back; it is signalled when the last byte has arrived.
        fence: Option<FenceId>,
    },
    /// The host waits for a fence.
    FinishFence(FenceId),
    /// Work of the host itself.
    Host(HostWork),
}

/// A texture that is bound in a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerRecord {
    /// The sampler (ps_1_x: the stage).
    pub sampler: u8,
    /// The texture.
    pub texture: ResourceId,
    /// Bytes per texel.
    pub texel_bytes: u32,
    /// Bytes of the whole texture, mip levels included.
    pub texture_bytes: u64,
    /// `true` if texels of two mip levels are interpolated.
    pub trilinear: bool,
    /// Cache traffic of its texels, if observed.
    pub traffic: Option<SamplerTraffic>,
}

/// A colour target of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetRecord {
    /// The target.
    pub target: ResourceId,
    /// Bytes per pixel.
    pub pixel_bytes: u32,
    /// `true` if passing fragments write it.
    pub written: bool,
    /// `true` if passing fragments also read the target, for blending or a partial write mask.
    pub read: bool,
}

/// The depth buffer of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthRecord {
    /// The depth buffer.
    pub buffer: ResourceId,
    /// Bytes per pixel.
    pub pixel_bytes: u32,
    /// `true` if depth is tested.
    pub test: bool,
    /// `true` if passing fragments write their depth.
    pub write: bool,
    /// `true` if the pixel program writes the depth.
    pub replaced: bool,
}

/// A generated mip level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MipmapLevel {
    /// Width, height, and slices or faces, in texels.
    pub extents: [u32; 3],
    /// Number of different texels of the previous level that are read.
    pub texels_read: u64,
}

impl MipmapLevel {
    /// Number of texels of the level; each is written once.
    pub fn texels_written(&self) -> u64 {
        self.extents.iter().map(|&extent| u64::from(extent)).product()
    }
}

/// The generation of a texture's mip levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipmapRecord {
    /// The texture.
    pub texture: ResourceId,
    /// Bytes per texel.
    pub texel_bytes: u32,
    /// The levels from 1 on, each generated from the previous one.
    pub levels: Vec<MipmapLevel>,
}

impl MipmapRecord {
    /// Total number of texels read.
    pub fn texels_read(&self) -> u64 {
        self.levels.iter().map(|level| level.texels_read).sum()
    }

    /// Total number of texels written.
    pub fn texels_written(&self) -> u64 {
        self.levels.iter().map(MipmapLevel::texels_written).sum()
    }
}

/// One draw: its counts, programs, textures and targets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawRecord {
    /// Event counts.
    pub counts: DrawEvents,
    /// Vertices processed by the card, with post-transform caches of half the profile's size, the profile's size, and
    /// twice the profile's size. An indexed vertex is processed again if it has left the cache. Equal to the number of
    /// vertices if there are no indices, or if the profile states no cache.
    pub vertices_run: [u64; 3],
    /// Number of 2x2 quads that ran the pixel program, per triangle that covers at least one of their pixels. Cards
    /// shade whole quads, so lanes outside the triangle cost as much as those inside.
    pub quads: u64,
    /// The pixel program.
    pub pixel: Arc<ProgramWork>,
    /// The vertex program; `None` if the vertices were already transformed.
    pub vertex: Option<Arc<ProgramWork>>,
    /// The bound textures, in ascending order of the sampler.
    pub samplers: Vec<SamplerRecord>,
    /// The colour targets.
    pub targets: Vec<TargetRecord>,
    /// The depth buffer.
    pub depth: Option<DepthRecord>,
    /// `true` if the alpha test was enabled.
    pub alpha_test: bool,
    /// `true` if blending was enabled.
    pub blend: bool,
}

impl DrawRecord {
    /// Resources that the draw reads: textures, and the targets and the depth buffer if they are read.
    pub fn reads(&self) -> Vec<ResourceId> {
        let mut out: Vec<_> = self.samplers.iter().map(|s| s.texture).collect();
        out.extend(self.targets.iter().filter(|t| t.read).map(|t| t.target));
        out.extend(self.depth.iter().filter(|d| d.test).map(|d| d.buffer));
        out
    }

    /// Resources that the draw writes: targets, and the depth buffer if it is written.
    pub fn writes(&self) -> Vec<ResourceId> {
        let mut out: Vec<_> = self.targets.iter().filter(|t| t.written).map(|t| t.target).collect();
        out.extend(self.depth.iter().filter(|d| d.test && d.write).map(|d| d.buffer));
        out
    }

    /// `true` if texture reads were observed; then every bound sampler has traffic counts.
    pub fn is_observed(&self) -> bool {
        self.samplers.iter().all(|s| s.traffic.is_some())
    }

    /// Number of texel reads of a sampler (0 to 15).
    pub fn fetches(&self, sampler: u8) -> u64 {
        let index = usize::from(sampler).min(SAMPLERS - 1);
        self.counts.fragments.fetches.get(index).copied().unwrap_or_default()
    }
}
