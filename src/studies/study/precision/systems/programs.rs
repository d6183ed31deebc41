//! The pixel programs that a system runs.

use std::sync::{Arc, Mutex, PoisonError};

use refsim::device::Profile;
use refsim::isa::Program;
use refsim::machine::{DrawCall, DrawWatcher, Executor, Machine, MachineError};

use crate::shader::ShaderText;
use crate::study::StudyError;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::StudiedProgram;

/// Pixel programs of a system, in order of their first draw.
pub(super) struct PixelPrograms(Vec<(Program, ShaderText)>);

/// Keeps each pixel program of the draws, once.
#[derive(Debug, Default)]
struct DrawnPrograms(Mutex<Vec<Program>>);

impl DrawWatcher for DrawnPrograms {
    fn before(&self, _: &Machine, call: &DrawCall<'_>) -> Result<(), MachineError> {
        let mut programs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let program: &Program = call.pixel_program;
        if !programs.contains(program) {
            programs.push(program.clone());
        }
        Ok(())
    }
}

impl PixelPrograms {
    /// Runs `run` on the exact device, and collects the pixel programs that it draws with.
    pub(super) fn of<T>(
        profile: &Profile,
        executor: &Executor,
        run: impl FnOnce(&Profile, &Executor) -> Result<T, StudyError>,
    ) -> Result<(Self, T), StudyError> {
        let drawn = Arc::new(DrawnPrograms::default());
        let found = run(&exact(profile, []), &executor.watched(drawn.clone()))?;
        let drawn = drawn.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let programs = drawn.into_iter().zip(1..).map(|(program, number): (Program, u32)| {
            let name = format!("program {number}, {}", program.version);
            let text = ShaderText::new(name, program.text.as_str());
            (program, text)
        });
        Ok((Self(programs.collect()), found))
    }

    /// Returns `true` if all programs are among the others.
    pub(super) fn are_among(&self, others: &Self) -> bool {
        let is_known = |digest: u64| others.0.iter().any(|(program, _)| program.digest() == digest);
        self.0.iter().all(|(program, _)| is_known(program.digest()))
    }

    pub(super) fn list(&self) -> Vec<StudiedProgram<'_>> {
        self.0.iter().map(|(program, text)| StudiedProgram { program, text }).collect()
    }
}
