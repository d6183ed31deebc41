//! Traces as buffer contents, for WebGPU hosts that run the trace kernel themselves, such as a browser.

use std::collections::BTreeMap;

use super::trace_layout::{TraceLayout, VideoMemory, job_words};
use super::{DrawCall, Machine, MachineError, PixelState, validate};
use crate::exec::wgsl::follow::FollowDispatch;
use crate::exec::wgsl::kernel::{COUNT_WORDS, EXTRA_ROWS};
use crate::exec::wgsl::parts::Parts;
use crate::exec::wgsl::texture;
use crate::raster::TriangleSetup;
use crate::texture::Image;

/// Approximate limit of loop iterations per invocation; some software adapters need such a limit.
const PASSES: u32 = 16_000;

/// A trace of pixels, as the contents of the trace kernel's buffers by binding. A dispatch with one workgroup per pixel
/// runs [`crate::exec::wgsl::follow::ENTRY`] of [`crate::exec::wgsl::follow::module`], reduced to
/// [`TraceBuffers::parts`]. Then `video` holds a record per pixel ([`crate::exec::wgsl::follow`] describes it). While a
/// record is unfinished, repeat the dispatch on the same buffers with 1 in word [`crate::exec::wgsl::kernel::RESUMES`]
/// of `draw`.
#[derive(Clone, Debug)]
pub struct TraceBuffers {
    /// Binding 0, parameters. The first eight words are the format of the registers.
    pub draw: Vec<u32>,
    /// Binding 1, set-ups of triangles.
    pub setups: Vec<u32>,
    /// Binding 2, pixels and their triangles.
    pub tiles: Vec<u32>,
    /// Binding 3, samplers.
    pub samplers: Vec<u32>,
    /// Binding 4, without the records, which follow.
    pub video: Vec<u32>,
    /// Words per record. Binding 4 needs space for the records after `video`.
    pub record_words: usize,
    /// Binding 5, the program.
    pub code: Vec<u32>,
    /// Number of words of binding 6.
    pub scratch_words: usize,
    /// Number of words of binding 7, initially zero.
    pub count_words: usize,
    /// Parts of the module that the trace uses.
    pub parts: Parts,
}

#[derive(Default)]
struct WordMemory {
    words: Vec<u32>,
    /// First word of each texture.
    textures: BTreeMap<usize, usize>,
}

impl VideoMemory for WordMemory {
    fn allocate(&mut self, words: usize) -> Result<usize, MachineError> {
        let base = self.words.len();
        self.words.resize(base + words, 0);
        Ok(base)
    }

    fn place_texture(&mut self, number: usize, image: &Image) -> Result<usize, MachineError> {
        if let Some(&base) = self.textures.get(&number) {
            return Ok(base);
        }
        let base = self.allocate(0)?;
        self.words.extend(texture::image_words(image));
        self.textures.insert(number, base);
        Ok(base)
    }
}

impl Machine {
    /// Encodes a trace of pixels, each up to the first triangle that covers it ([`Machine::trace_pixels`] traces all
    /// triangles).
    ///
    /// # Errors
    /// As [`Machine::trace`], and [`MachineError::GpuProgram`].
    pub fn trace_buffers(&self, call: &DrawCall<'_>, pixels: &[(u32, u32)]) -> Result<TraceBuffers, MachineError> {
        let plan = validate::plan(&self.profile, &self.memory, call)?;
        let states = pixels.iter().map(|&pixel| Ok(PixelState::of(&self.start(call, pixel)?.tile)));
        let states = states.collect::<Result<Vec<_>, MachineError>>()?;
        let mut video = WordMemory::default();
        let (mut layout, encoded) = TraceLayout::new(&mut video, self, call, pixels.len())?;
        for (base, words) in layout.contents(&states) {
            video.words[base..base + words.len()].copy_from_slice(&words);
        }
        video.words.truncate(layout.records);

        let mut setups: Vec<TriangleSetup> = Vec::new();
        self.rounds(call, &plan, |placed| {
            setups.extend(placed.iter().map(|(.., setup)| setup.clone()));
            Ok(())
        })?;
        let mut packed = Vec::with_capacity(setups.len() * layout.words.setup_words());
        setups.iter().for_each(|setup| layout.words.setup(setup, &mut packed));
        let dispatch = FollowDispatch {
            jobs: pixels.len(),
            registers: encoded.code.slots,
            passes: PASSES,
            records: layout.records,
            room: layout.room,
        };
        Ok(TraceBuffers {
            draw: layout.words.follow(&dispatch).to_vec(),
            setups: packed,
            tiles: job_words(pixels, &setups),
            samplers: encoded.samplers,
            video: video.words,
            record_words: dispatch.record_words(),
            scratch_words: 4 * (encoded.code.slots + EXTRA_ROWS) * pixels.len(),
            code: encoded.code.words,
            count_words: COUNT_WORDS,
            parts: encoded.parts,
        })
    }
}
