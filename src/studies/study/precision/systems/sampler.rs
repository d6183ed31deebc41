//! Results of instructions in a sample of a system's fragments.

use std::sync::{Arc, Mutex, PoisonError};

use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Program;
use refsim::machine::{DrawCall, DrawWatcher, FragmentTrace, Machine, MachineError};

use super::programs::PixelPrograms;
use crate::study::StudyError;
use crate::study::precision::steps::{first_results, with_rounded};
use crate::study::precision::subject::{
    FragmentResults, InstructionResults, RoundedInstruction, SampledResults, StudiedProgram,
};

/// Maximum number of fragments kept per draw.
const KEPT: usize = 128;
/// Minimum number of pixels traced per draw, if the target has that many: a pixel may have thousands of fragments.
const PIXELS: usize = 16;

/// Samples the results of instructions in the exact run of a system. Its draws are traced again with the program of
/// each rounded instruction.
#[derive(Debug)]
pub(super) struct ResultSampler {
    /// Pixel programs, in the order of the subject.
    programs: Vec<Program>,
    rounded: Vec<RoundedProgram>,
    found: Mutex<Sampled>,
}

/// Program of a rounded instruction, checked for its device.
#[derive(Debug)]
struct RoundedProgram {
    rounded: RoundedInstruction,
    checked: CheckedProgram,
}

#[derive(Debug)]
struct Sampled {
    /// Number of draws seen, per program.
    draws: Vec<usize>,
    /// Number of fragments sampled, per program.
    fragments: Vec<u32>,
    results: SampledResults,
}

impl ResultSampler {
    pub(super) fn new(
        programs: &PixelPrograms,
        exact: &Profile,
        rounded: &[RoundedInstruction],
    ) -> Result<Arc<Self>, StudyError> {
        let list = programs.list();
        let of = |rounded: &RoundedInstruction| {
            let StudiedProgram { program, text } = list[rounded.program];
            let checked = text.check(program.clone(), &with_rounded(exact, program, *rounded))?;
            Ok(RoundedProgram { rounded: *rounded, checked })
        };
        let rounded: Vec<_> = rounded.iter().map(of).collect::<Result<_, StudyError>>()?;
        let results = SampledResults {
            exact: vec![InstructionResults::new(); list.len()],
            rounded: vec![FragmentResults::new(); rounded.len()],
        };
        let found = Sampled { draws: vec![0; list.len()], fragments: vec![0; list.len()], results };
        let programs = list.iter().map(|studied| studied.program.clone()).collect();
        Ok(Arc::new(Self { programs, rounded, found: Mutex::new(found) }))
    }

    /// Results of the samples.
    pub(super) fn results(&self) -> SampledResults {
        self.found.lock().unwrap_or_else(PoisonError::into_inner).results.clone()
    }
}

impl DrawWatcher for ResultSampler {
    /// Samples the draws number 0, 1, 2, 4, 8 and so on of each program, to include errors that grow from draw to draw.
    fn before(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        let digest = call.pixel_program.digest();
        let Some(index) = self.programs.iter().position(|program| program.digest() == digest) else { return Ok(()) };
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let number = found.draws[index];
        found.draws[index] += 1;
        if number > 0 && !number.is_power_of_two() {
            return Ok(());
        }
        // This program has no per-instruction formats: results are in the registers' format.
        let (profile, program) = (machine.profile(), &self.programs[index]);
        let (sample, exact) = Sample::new(machine, call)?;
        let first = found.fragments[index];
        found.fragments[index] += exact.len() as u32;
        for (instruction, results) in first_results(profile, program, (first, &exact), |_| true) {
            found.results.exact[index].entry(instruction).or_default().extend(results);
        }
        for (at, own) in self.rounded.iter().enumerate().filter(|(_, own)| own.rounded.program == index) {
            let instruction = own.rounded.instruction;
            let call = DrawCall { pixel_program: &own.checked, ..call.clone() };
            let traced = sample.trace(machine, &call)?;
            let results = first_results(profile, program, (first, &traced), |at| at == instruction);
            found.results.rounded[at].extend(results.into_values().flatten());
        }
        Ok(())
    }
}

/// Sample of the fragments of a draw.
struct Sample {
    /// Pixels that contain sampled fragments.
    pixels: Vec<(u32, u32)>,
    /// Indices of the sampled fragments among all fragments of these pixels.
    kept: Vec<usize>,
}

impl Sample {
    /// Traces pixels spread over the target until there are enough fragments, or no pixels are left; keeps and returns
    /// evenly spread fragments. The choice does not depend on formats: a fragment is traced if its triangle covers the
    /// pixel.
    fn new(machine: &Machine, call: &DrawCall<'_>) -> Result<(Self, Vec<FragmentTrace>), MachineError> {
        let [width, height] = machine.target_size(call)?;
        let mut order = spread(width * height).map(|at| (at % width, at / width)).peekable();
        let (mut pixels, mut traced) = (Vec::new(), Vec::new());
        while order.peek().is_some() && (pixels.len() < PIXELS || traced.iter().map(Vec::len).sum::<usize>() < KEPT) {
            // Doubles the number of pixels each time, since each call sets up all triangles.
            let more: Vec<_> = order.by_ref().take(pixels.len().max(PIXELS)).collect();
            traced.extend(machine.trace_pixels(call, &more)?);
            pixels.extend(more);
        }
        let step = traced.iter().map(Vec::len).sum::<usize>().div_ceil(KEPT).max(1);
        let (mut sample, mut exact) = (Self { pixels: Vec::new(), kept: Vec::new() }, Vec::new());
        // Index of the next fragment among all fragments, and among the fragments of sampled pixels.
        let (mut next, mut next_of_sample) = (0, 0);
        for (pixel, fragments) in pixels.into_iter().zip(traced) {
            let (first, count, before) = (next, fragments.len(), exact.len());
            for (at, fragment) in fragments.into_iter().enumerate().filter(|(at, _)| (first + *at).is_multiple_of(step))
            {
                sample.kept.push(next_of_sample + at);
                exact.push(fragment);
            }
            next += count;
            if exact.len() > before {
                sample.pixels.push(pixel);
                next_of_sample += count;
            }
        }
        Ok((sample, exact))
    }

    /// Traces the fragments.
    fn trace(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<Vec<FragmentTrace>, MachineError> {
        let mut kept = self.kept.iter().peekable();
        let all = machine.trace_pixels(call, &self.pixels)?.into_iter().flatten().enumerate();
        Ok(all.filter(|(at, _)| kept.next_if_eq(&at).is_some()).map(|(_, fragment)| fragment).collect())
    }
}

/// The numbers below `count`, each once, in an order whose prefixes are evenly spread: steps of the golden section.
pub fn spread(count: u32) -> impl Iterator<Item = u32> {
    let divides = |step: u32| (2..=step).any(|d| step.is_multiple_of(d) && count.is_multiple_of(d));
    let section = ((f64::from(count) * 0.618) as u32).max(1);
    let step = (section..=count).find(|&step| !divides(step)).unwrap_or(1);
    (0..count).map(move |at| (u64::from(at) * u64::from(step) % u64::from(count.max(1))) as u32)
}
