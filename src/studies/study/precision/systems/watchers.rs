//! Watchers of a system's draws: of the fragments of one pixel, and of targets.

use std::sync::{Arc, Mutex, PoisonError};

use refsim::device::Profile;
use refsim::machine::{DrawCall, DrawWatcher, FragmentTrace, Machine, MachineError};

use super::programs::PixelPrograms;
use crate::card::Texels;
use crate::picture::metrics::value_error;
use crate::study::precision::steps::step_results;
use crate::study::precision::subject::StepResult;

/// Draws in which a pixel is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FollowedDraws {
    /// Draws into targets of this width and height.
    IntoTargets([u32; 2]),
    /// One draw: the digest of its program, and its number among the draws of that program, from 0.
    Draw(u64, usize),
}

/// Follows one pixel through draws.
#[derive(Debug)]
pub(super) struct FollowedPixel {
    pixel: [u32; 2],
    draws: FollowedDraws,
    found: Mutex<FoundFragments>,
}

#[derive(Debug, Default)]
struct FoundFragments {
    /// Number of draws of the followed program seen so far.
    draws: usize,
    /// Fragments, each with the digest of its program.
    fragments: Vec<(u64, FragmentTrace)>,
}

impl FollowedPixel {
    pub(super) fn new(pixel: [u32; 2], draws: FollowedDraws) -> Arc<Self> {
        Arc::new(Self { pixel, draws, found: Mutex::default() })
    }

    /// Results of the instructions of the fragments that `wanted` selects, in order of execution.
    pub(super) fn steps(
        &self,
        profile: &Profile,
        programs: &PixelPrograms,
        wanted: impl Fn(&FragmentTrace) -> bool,
    ) -> Vec<StepResult> {
        let found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let known = found.fragments.iter().filter(|(_, fragment)| wanted(fragment));
        let known = known.filter_map(|(digest, fragment)| Some((programs.of_digest(*digest)?, fragment)));
        (0..)
            .zip(known)
            .flat_map(|(number, (program, trace))| step_results(profile, program, (number, trace)))
            .collect()
    }
}

impl DrawWatcher for FollowedPixel {
    fn before(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        let digest = call.pixel_program.digest();
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        let is_wanted = match self.draws {
            FollowedDraws::IntoTargets(size) => !call.targets.is_empty() && machine.target_size(call)? == size,
            FollowedDraws::Draw(program, number) => {
                let is_of_program = program == digest;
                found.draws += usize::from(is_of_program);
                is_of_program && found.draws == number + 1
            }
        };
        if is_wanted {
            let [x, y] = self.pixel;
            found.fragments.extend(machine.trace(call, (x, y))?.into_iter().map(|fragment| (digest, fragment)));
        }
        Ok(())
    }
}

/// Stores the first target of each draw of a program, as it is after the draw.
#[derive(Debug)]
pub(super) struct KeptTargets {
    /// Digest of the program.
    program: u64,
    targets: Mutex<Vec<Texels>>,
}

/// Texel in which two runs differ most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DifferentTexel {
    /// Number of the draw among the draws of the program, from 0.
    pub(super) draw: usize,
    pub(super) pixel: [u32; 2],
}

impl KeptTargets {
    pub(super) fn new(program: u64) -> Arc<Self> {
        Arc::new(Self { program, targets: Mutex::default() })
    }

    /// Texel with the largest absolute difference of a channel, the first one on a tie; `None` if nothing differs. An
    /// infinity or NaN differs from every other number by infinity.
    pub(super) fn most_different(&self, other: &Self) -> Option<DifferentTexel> {
        let lock = |targets: &Self| targets.targets.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let (ours, others) = (lock(self), lock(other));
        let mut most = (0.0_f64, None);
        for (draw, (ours, others)) in ours.iter().zip(&others).enumerate() {
            for (at, (a, b)) in ours.texels.iter().zip(&others.texels).enumerate() {
                let off =
                    a.iter().zip(b).map(|(&a, &b)| value_error(f64::from(a), f64::from(b)).abs()).fold(0.0, f64::max);
                if off > most.0 {
                    let pixel = [at % ours.width, at / ours.width].map(|place| place as u32);
                    most = (off, Some(DifferentTexel { draw, pixel }));
                }
            }
        }
        most.1
    }
}

impl DrawWatcher for KeptTargets {
    fn after(&self, machine: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        if let (Some(&target), true) = (call.targets.first(), call.pixel_program.digest() == self.program) {
            let texels = Texels::read_back(machine, target)?;
            self.targets.lock().unwrap_or_else(PoisonError::into_inner).push(texels);
        }
        Ok(())
    }
}
