//! Counters of a draw call.

use std::ops::AddAssign;

/// Texture units that a program can address.
pub const SAMPLERS: usize = 16;

/// What became of the fragments of a draw, or of one tile of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct FragmentCounts {
    /// Fragments that rasterisation produced: pixels covered, once for each triangle that covers them.
    pub generated: u64,
    /// Fragments that ran the pixel program. Helper lanes of a 2x2 quad are never counted. The emulated cards test
    /// depth after the program, so this equals [`Self::generated`].
    pub shaded: u64,
    /// Fragments that `texkill` removed.
    pub killed: u64,
    /// Fragments that failed the alpha test.
    pub alpha_failed: u64,
    /// Fragments that failed the depth test.
    pub depth_failed: u64,
    /// Fragments that reached the targets.
    pub passed: u64,
    /// Texture reads by sampler: one for each texture instruction that a covered fragment executed, whatever the
    /// filter, and whether or not a texture was bound. A fragment that was killed earlier in the program still
    /// reads; a lane masked off by flow control does not.
    pub fetches: [u64; SAMPLERS],
}

impl FragmentCounts {
    /// Texture reads over all samplers.
    pub fn total_fetches(&self) -> u64 {
        self.fetches.iter().sum()
    }
}

impl AddAssign for FragmentCounts {
    fn add_assign(&mut self, other: Self) {
        self.generated += other.generated;
        self.shaded += other.shaded;
        self.killed += other.killed;
        self.alpha_failed += other.alpha_failed;
        self.depth_failed += other.depth_failed;
        self.passed += other.passed;
        for (a, b) in self.fetches.iter_mut().zip(other.fetches) {
            *a += b;
        }
    }
}

/// What became of the primitives of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct PrimitiveCounts {
    /// Triangles that assembly produced (a quad counts as two).
    pub assembled: u64,
    /// Triangles dropped whole: behind the eye, outside the depth range, back-facing where culling is on, without
    /// area, or with a position that is not a number.
    pub culled: u64,
    /// Triangles that a clip plane cut into something else.
    pub clipped: u64,
    /// Triangles that reached the rasteriser, after clipping.
    pub rasterised: u64,
}

impl AddAssign for PrimitiveCounts {
    fn add_assign(&mut self, other: Self) {
        self.assembled += other.assembled;
        self.culled += other.culled;
        self.clipped += other.clipped;
        self.rasterised += other.rasterised;
    }
}

/// Bytes that a draw moved, nominally: every access counts in full, caches and compression are the timing model's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct ByteCounts {
    /// Vertex data read.
    pub vertices: u64,
    /// Texels read: one texel for each fetch from a bound texture, whatever the filter.
    pub textures: u64,
    /// Depth values read for the depth test.
    pub depth_read: u64,
    /// Depth values written.
    pub depth_written: u64,
    /// Target pixels read for blending or for partial write masks.
    pub color_read: u64,
    /// Target pixels written.
    pub color_written: u64,
}

impl ByteCounts {
    /// All bytes read.
    pub fn read(&self) -> u64 {
        self.vertices + self.textures + self.depth_read + self.color_read
    }

    /// All bytes written.
    pub fn written(&self) -> u64 {
        self.depth_written + self.color_written
    }
}

impl AddAssign for ByteCounts {
    fn add_assign(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.textures += other.textures;
        self.depth_read += other.depth_read;
        self.depth_written += other.depth_written;
        self.color_read += other.color_read;
        self.color_written += other.color_written;
    }
}

/// Everything that a draw call did, as counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct DrawEvents {
    /// Draw calls.
    pub draws: u64,
    /// Copies of the geometry that were drawn (1 for a call without instances).
    pub instances: u64,
    /// Vertices processed.
    pub vertices: u64,
    /// Vertex program instructions executed, summed over the vertices.
    pub vertex_instructions: u64,
    /// What became of the primitives.
    pub primitives: PrimitiveCounts,
    /// What became of the fragments.
    pub fragments: FragmentCounts,
    /// Memory traffic.
    pub bytes: ByteCounts,
}

impl AddAssign for DrawEvents {
    fn add_assign(&mut self, other: Self) {
        self.draws += other.draws;
        self.instances += other.instances;
        self.vertices += other.vertices;
        self.vertex_instructions += other.vertex_instructions;
        self.primitives += other.primitives;
        self.fragments += other.fragments;
        self.bytes += other.bytes;
    }
}
