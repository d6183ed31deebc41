//! Kernel for pixel traces: its text, its parameters, and the layout of its records.
//!
//! A record starts with [`HEAD`] words: [`FRAGMENT`] if a triangle covers the pixel; the fragment's fate (1 killed by
//! the program, 2 failed the alpha test, 3 failed the depth test, 4 passed); the number of words of its steps. Then come
//! the steps, [`STEP_WORDS`] words each: the index of the instruction, the components written, four raw values. Input
//! registers come first, with indices after those of the instructions.

use super::kernel::{DrawWords, with_entry};
use super::program::machine;
use super::texture;

/// Entry point; one invocation per pixel, in workgroups of one.
pub const ENTRY: &str = "follow_main";
/// Words of `tiles` per pixel: column, row, offset and length of its triangle list.
pub const JOB_WORDS: usize = 4;
/// Number of words of a record before its steps.
pub const HEAD: usize = 3;
/// Words per step.
pub const STEP_WORDS: usize = 6;
const NOTHING: u32 = 1;
/// Value of the first word of a record with a fragment.
pub const FRAGMENT: u32 = 2;
/// Value of the first word of a record whose dispatch must be repeated.
pub const UNFINISHED: u32 = 3;

/// The complete module: the kernel, the machine that runs programs, and texture reads.
pub fn module() -> String {
    text() + &machine() + &texture::library()
}

/// The kernel's complete text, without program and textures.
pub fn text() -> String {
    let names = [("NOTHING", NOTHING), ("FRAGMENT", FRAGMENT), ("UNFINISHED", UNFINISHED), ("HEAD", HEAD as u32)];
    let constants: String = names.map(|(name, value)| format!("const FOLLOW_{name}: u32 = {value}u;\n")).concat();
    with_entry(&(constants + include_str!("follow.wgsl")))
}

/// Parameters of a dispatch.
#[derive(Clone, Copy, Debug)]
pub struct FollowDispatch {
    /// Number of pixels.
    pub jobs: usize,
    /// Register rows of the program in `scratch`; [`super::kernel::EXTRA_ROWS`] follow.
    pub registers: usize,
    /// Approximate limit of loop iterations per invocation.
    pub passes: u32,
    /// Offset of the records in `video`, in words.
    pub records: usize,
    /// Capacity of a record, in steps.
    pub room: usize,
}

impl FollowDispatch {
    /// Size of a record, in words.
    pub fn record_words(&self) -> usize {
        HEAD + STEP_WORDS * self.room
    }
}

impl DrawWords {
    /// Encodes the words of `draw` for a pixel trace.
    pub fn follow(&mut self, dispatch: &FollowDispatch) -> &[u32] {
        let cost = self.cost();
        self.set("D_TILES", &[dispatch.jobs as u32]);
        self.set("D_STRIDE", &[dispatch.jobs as u32]);
        self.set("D_ROWS", &[dispatch.registers as u32, 0, dispatch.passes.max(cost + 10_000), cost, 3, 5]);
        let kept = [dispatch.records, dispatch.record_words(), STEP_WORDS * dispatch.room];
        self.set("D_FOLLOW", &kept.map(|word| word as u32));
        self.words()
    }
}
