//! The log of a machine: the host's calls in order.

use super::{DrawEvents, ProgramWork, SAMPLERS, SamplerTraffic};
use std::borrow::Cow;
use std::sync::Arc;

/// Names something in the memory of one card, as its handles number them.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ResourceId {
    /// A texture or a colour target: a target is a texture.
    Texture(usize),
    /// A depth buffer.
    Depth(usize),
}

/// Names a fence of one machine (NV_fence).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FenceId(pub u32);

/// Whether the host waits for what it reads back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ReadBackMode {
    /// The host waits until the last byte is there.
    Synchronous,
    /// The host goes on; a fence tells when the bytes are there.
    Asynchronous,
}

/// Work of the host between two calls, counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HostWork {
    /// Which kind of operation, as the host model names it.
    pub kind: Cow<'static, str>,
    /// How many of them.
    pub operations: u64,
}

/// One thing that the host asked of the card, or did itself.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// Data went to the card.
    Upload {
        /// Where to.
        resource: ResourceId,
        /// How many bytes.
        bytes: u64,
    },
    /// The next draw runs under other state than the last.
    StateChange {
        /// How many pieces of state differ: each program, each program's constants, each sampler, targets, depth
        /// buffer, depth test, alpha test, blending, write masks, viewport with scissor and culling, bump state.
        changes: u32,
        /// How many float constants of four numbers differ, in both programs: what goes to the card.
        constants: u32,
    },
    /// A target or depth buffer was filled with one value.
    Clear {
        /// Which.
        resource: ResourceId,
        /// Its size.
        bytes: u64,
    },
    /// A draw.
    Draw(Box<DrawRecord>),
    /// The mip levels of a texture were filled from its level 0.
    GenerateMipmaps(MipmapRecord),
    /// Data came back from the card.
    ReadBack {
        /// Where from.
        resource: ResourceId,
        /// How many bytes.
        bytes: u64,
        /// Whether the host waited.
        mode: ReadBackMode,
        /// The fence behind an asynchronous read-back: it is passed when the last byte has come.
        fence: Option<FenceId>,
    },
    /// A fence was put behind everything asked so far.
    SetFence(FenceId),
    /// The host looked whether a fence is passed.
    TestFence(FenceId),
    /// The host waited until a fence was passed.
    FinishFence(FenceId),
    /// The host worked on its own.
    Host(HostWork),
}

/// How texels of one level are combined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FilterKind {
    /// One texel.
    #[default]
    Nearest,
    /// Two along each axis, where texels are magnified, minified or both.
    Linear,
}

/// How levels are combined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MipKind {
    /// One level, always the same.
    #[default]
    None,
    /// One level, the nearest.
    Nearest,
    /// Two levels.
    Linear,
}

/// A texture as a draw had it bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerRecord {
    /// The sampler, in ps_1_x the stage.
    pub sampler: u8,
    /// The texture.
    pub texture: ResourceId,
    /// Name of the texel format.
    pub format: &'static str,
    /// Bytes of a texel.
    pub texel_bytes: u32,
    /// Bytes of the whole texture, mip levels included.
    pub texture_bytes: u64,
    /// Filter within a level.
    pub filter: FilterKind,
    /// Filter between levels; `None` too where the texture has a single level.
    pub mip: MipKind,
    /// What became of the texels touched, if that was observed.
    pub traffic: Option<SamplerTraffic>,
}

/// A colour target of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetRecord {
    /// The target.
    pub target: ResourceId,
    /// Bytes of a pixel.
    pub pixel_bytes: u32,
    /// Whether fragments that pass write it.
    pub written: bool,
    /// Whether they read it first, for blending or for a partial write mask.
    pub read: bool,
}

/// The depth buffer of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthRecord {
    /// The depth buffer.
    pub buffer: ResourceId,
    /// Bytes of a pixel.
    pub pixel_bytes: u32,
    /// Whether depth is tested.
    pub test: bool,
    /// Whether the depth of a fragment that passes is stored.
    pub write: bool,
    /// Whether the pixel program decides the depth.
    pub replaced: bool,
}

/// One generated mip level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MipmapLevel {
    /// Width, height, and slices or faces, in texels.
    pub extents: [u32; 3],
    /// Different texels of the level before that were read.
    pub texels_read: u64,
}

impl MipmapLevel {
    /// Texels of the level, each written once.
    pub fn texels_written(&self) -> u64 {
        self.extents.iter().map(|&extent| u64::from(extent)).product()
    }
}

/// The generation of a texture's mip levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MipmapRecord {
    /// The texture.
    pub texture: ResourceId,
    /// Bytes of a texel.
    pub texel_bytes: u32,
    /// The levels from 1 on, each made from the one before.
    pub levels: Vec<MipmapLevel>,
}

impl MipmapRecord {
    /// Texels read, over all levels.
    pub fn texels_read(&self) -> u64 {
        self.levels.iter().map(|level| level.texels_read).sum()
    }

    /// Texels written, over all levels.
    pub fn texels_written(&self) -> u64 {
        self.levels.iter().map(MipmapLevel::texels_written).sum()
    }
}

/// One draw: its counts, programs, textures and targets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DrawRecord {
    /// What happened.
    pub counts: DrawEvents,
    /// Vertices that the card processes: an indexed vertex once more each time that it has left the cache of finished
    /// vertices. By size of that cache: half of what the profile states, that, twice that. All vertices once where
    /// there are no indices or no such cache is stated.
    pub vertices_run: [u64; 3],
    /// Two-by-two quads that ran the pixel program, once for each triangle that covers a pixel of them. A card shades
    /// whole quads: the lanes outside the triangle cost what the others do.
    pub quads: u64,
    /// The pixel program.
    pub pixel: Arc<ProgramWork>,
    /// The vertex program, if vertices did not come transformed.
    pub vertex: Option<Arc<ProgramWork>>,
    /// The textures, by rising sampler.
    pub samplers: Vec<SamplerRecord>,
    /// The colour targets.
    pub targets: Vec<TargetRecord>,
    /// The depth buffer.
    pub depth: Option<DepthRecord>,
    /// Whether there was an alpha test.
    pub alpha_test: bool,
    /// Whether targets were blended into.
    pub blend: bool,
}

impl DrawRecord {
    /// What the draw reads: its textures, and targets and depth buffer where they are read.
    pub fn reads(&self) -> Vec<ResourceId> {
        let mut out: Vec<_> = self.samplers.iter().map(|s| s.texture).collect();
        out.extend(self.targets.iter().filter(|t| t.read).map(|t| t.target));
        out.extend(self.depth.iter().filter(|d| d.test).map(|d| d.buffer));
        out
    }

    /// What the draw writes: targets, and the depth buffer where it is written.
    pub fn writes(&self) -> Vec<ResourceId> {
        let mut out: Vec<_> = self.targets.iter().filter(|t| t.written).map(|t| t.target).collect();
        out.extend(self.depth.iter().filter(|d| d.test && d.write).map(|d| d.buffer));
        out
    }

    /// Whether the textures were observed: then every bound sampler has its traffic.
    pub fn is_observed(&self) -> bool {
        self.samplers.iter().all(|s| s.traffic.is_some())
    }

    /// Texel reads of a sampler (0 to 15).
    pub fn fetches(&self, sampler: u8) -> u64 {
        let index = usize::from(sampler).min(SAMPLERS - 1);
        self.counts.fragments.fetches.get(index).copied().unwrap_or_default()
    }
}
