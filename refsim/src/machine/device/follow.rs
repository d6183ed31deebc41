//! Pixel tracing on the GPU: each round advances every pixel to the next triangle that covers the pixel.
//!
//! The kernel works on copies of the pixels' targets, so a trace changes nothing. All pixels of a round share a
//! dispatch.

use super::shader::FOLLOW;
use super::{Card, draw};
use crate::exec::Shading;
use crate::exec::gpu::{Gpu, LoadedProgram};
use crate::exec::wgsl::follow::{FollowDispatch, HEAD, Record};
use crate::exec::wgsl::kernel::{COUNT_WORDS, EXTRA_ROWS, OVERRUN};
use crate::exec::wgsl::program::TRACE_WORDS;
use crate::exec::wgsl::texture;
use crate::machine::trace_layout::{PixelJob, TraceLayout, job_words, near};
use crate::machine::{DrawCall, Machine, MachineError, PixelState};
use crate::raster::TriangleSetup;
use std::ops::Range;
use std::sync::Arc;

/// A fragment of a traced pixel: the index of the triangle's set-up within the pass, the execution of the program, and
/// the pixel's state before and after.
pub(in crate::machine) struct TracedFragment {
    pub(in crate::machine) triangle: usize,
    pub(in crate::machine) before: PixelState,
    pub(in crate::machine) shading: Shading,
    pub(in crate::machine) after: PixelState,
}

/// Traces pixels through a draw.
pub(in crate::machine) struct GpuTracer<'a> {
    card: Card,
    machine: &'a Machine,
    call: &'a DrawCall<'a>,
    pixels: Vec<(u32, u32)>,
    states: Vec<PixelState>,
    layout: TraceLayout,
    shader: LoadedProgram,
    /// `true` if a fragment exceeded the step budget.
    pub(in crate::machine) overrun: bool,
}

/// Progress of a pixel within one pass.
struct PixelProgress {
    triangles: Vec<u32>,
    /// Number of triangles already processed.
    at: usize,
}

impl<'a> GpuTracer<'a> {
    /// Creates a tracer for pixels with the given target contents.
    pub(in crate::machine) fn new(
        machine: &'a Machine,
        call: &'a DrawCall<'a>,
        pixels: &[(u32, u32)],
        states: Vec<PixelState>,
        step_budget: Option<u32>,
    ) -> Result<Self, MachineError> {
        let mut card = match &machine.memory.card {
            Some(card) => Card::new(Arc::clone(card.board.gpu()))?,
            None => Card::new(Arc::new(Gpu::open(None)?))?,
        };
        let (layout, encoded) = TraceLayout::new(&mut card, machine, call, pixels.len(), step_budget)?;
        let (shader, samplers) = encoded.load(card.board.gpu(), &FOLLOW)?;
        card.board.start(&shader, &samplers, COUNT_WORDS)?;
        let tracer = Self { card, machine, call, pixels: pixels.to_vec(), states, layout, shader, overrun: false };
        tracer.send()?;
        Ok(tracer)
    }

    /// Uploads the current contents of the pixels' targets.
    fn send(&self) -> Result<(), MachineError> {
        for (base, words) in self.layout.contents(&self.states) {
            self.card.board.write(base, &words)?;
        }
        Ok(())
    }

    /// Downloads the current contents of the pixels' targets.
    fn fetch(&self) -> Result<Vec<PixelState>, MachineError> {
        let mut states = self.states.clone();
        for (i, (base, image)) in self.layout.colors.iter().enumerate() {
            let mut image = image.clone();
            let words = self.card.board.read(*base, texture::image_size(&image))?;
            texture::words_to_image(&words, &mut image)?;
            for (x, state) in (0u32..).zip(&mut states) {
                state.colors[i] = Some(image.raw(0, 0, 0, x));
            }
        }
        if let Some(base) = self.layout.depth {
            for (state, depth) in states.iter_mut().zip(self.card.board.read(base, self.pixels.len())?) {
                state.depth = Some(depth);
            }
        }
        Ok(states)
    }

    /// Traces the pixels through a group of triangles; returns the fragments of each pixel, in order.
    pub(in crate::machine) fn pass(
        &mut self,
        setups: &[&TriangleSetup],
    ) -> Result<Vec<Vec<TracedFragment>>, MachineError> {
        let mut packed = Vec::with_capacity(setups.len() * self.layout.words.setup_words());
        setups.iter().for_each(|setup| self.layout.words.setup(setup, &mut packed));
        self.card.board.set_setups(&packed)?;
        let mut progress: Vec<PixelProgress> = self
            .pixels
            .iter()
            .map(|&pixel| PixelProgress { triangles: near(setups.iter().copied(), pixel), at: 0 })
            .collect();
        let mut out: Vec<Vec<TracedFragment>> = self.pixels.iter().map(|_| Vec::new()).collect();
        loop {
            let jobs: Vec<usize> =
                (0..progress.len()).filter(|&p| progress[p].at < progress[p].triangles.len()).collect();
            if jobs.is_empty() {
                return Ok(out);
            }
            self.round(&jobs, &mut progress, &mut out)?;
        }
    }

    /// Advances each pixel to the next triangle that covers it.
    fn round(
        &mut self,
        jobs: &[usize],
        progress: &mut [PixelProgress],
        out: &mut [Vec<TracedFragment>],
    ) -> Result<(), MachineError> {
        let lists: Vec<_> = jobs.iter().map(|&p| (p, p, progress[p].at..progress[p].triangles.len())).collect();
        let words = self.run(&lists, progress, 0)?;
        let size = HEAD + TRACE_WORDS * self.layout.room;
        let after = self.fetch()?;
        for (&p, words) in jobs.iter().zip(words.chunks_exact(size)) {
            let Some(record) = Record::new(words) else { continue };
            let Some(place) = record.triangle() else {
                progress[p].at = progress[p].triangles.len();
                continue;
            };
            let place = progress[p].at + place;
            let steps = self.steps(&record, p, place, progress)?;
            let (x, y) = self.pixels[p];
            let lane = ((x & 1) | (y & 1) << 1) as usize;
            let shading = record.shading(&steps, self.call.pixel_program, &self.machine.profile.rules, lane);
            let triangle = progress[p].triangles[place] as usize;
            out[p].push(TracedFragment { triangle, before: self.states[p], shading, after: after[p] });
            progress[p].at = place + 1;
        }
        self.states = after;
        Ok(())
    }

    /// Returns the words of all steps; steps beyond the record's capacity are obtained by executing the pixel again.
    fn steps(
        &mut self,
        record: &Record<'_>,
        p: usize,
        place: usize,
        progress: &[PixelProgress],
    ) -> Result<Vec<u32>, MachineError> {
        let mut steps = record.kept(0).to_vec();
        while steps.len() < TRACE_WORDS * record.steps() {
            let skipped = steps.len() / TRACE_WORDS;
            let words = self.run(&[(p, self.pixels.len(), place..place + 1)], progress, skipped)?;
            let more = Record::new(&words).map_or(&[][..], |record| record.kept(skipped));
            if more.is_empty() {
                break;
            }
            steps.extend(more);
        }
        Ok(steps)
    }

    /// Runs the kernel and returns the records. A job is a pixel's index, its column in the targets, and a range of its
    /// triangle list.
    fn run(
        &mut self,
        jobs: &[(usize, usize, Range<usize>)],
        progress: &[PixelProgress],
        skipped: usize,
    ) -> Result<Vec<u32>, MachineError> {
        let job = |(p, column, range): &(usize, usize, Range<usize>)| PixelJob {
            pixel: self.pixels[*p],
            column: *column,
            triangles: &progress[*p].triangles[range.clone()],
        };
        let told = job_words(&jobs.iter().map(job).collect::<Vec<_>>());
        let (registers, passes) = (self.shader.registers, draw::passes(self.card.board.gpu()));
        let (records, room) = (self.layout.records, self.layout.room);
        let mut dispatch =
            FollowDispatch { jobs: jobs.len(), registers, resumes: false, passes, records, room, skipped };
        let size = dispatch.record_words();
        loop {
            let words = self.layout.words.follow(&dispatch);
            let rows = (registers + EXTRA_ROWS) * jobs.len();
            self.card.board.dispatch(&self.shader, words, &told, [jobs.len() as u32, 1, 1], rows)?;
            let found = self.card.board.read(records, jobs.len() * size)?;
            if !found.chunks_exact(size).any(|words| Record::new(words).is_some_and(|r| r.is_unfinished())) {
                self.overrun |= self.card.uncut()?.get(OVERRUN).is_some_and(|&n| n != 0);
                return Ok(found);
            }
            dispatch.resumes = true;
        }
    }
}
