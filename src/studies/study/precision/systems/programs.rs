//! The pixel programs that a system runs.

use refsim::device::Profile;
use refsim::isa::{Program, Stage};

use crate::shader::ShaderText;
use crate::study::StudyError;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::StudiedProgram;

/// Pixel programs of a system, in the order in which it checks them.
pub(super) struct PixelPrograms(Vec<(Program, ShaderText)>);

impl PixelPrograms {
    /// Runs `run` on the exact device, and collects the pixel programs that are checked meanwhile.
    pub(super) fn of<T>(
        profile: &Profile,
        run: impl FnOnce(&Profile) -> Result<T, StudyError>,
    ) -> Result<(Self, T), StudyError> {
        let mut device = exact(profile, []);
        let log = device.log_programs();
        let found = run(&device)?;
        let pixel = log.programs().into_iter().filter(|program| program.version.stage() == Stage::Pixel);
        let programs = pixel.zip(1..).map(|(program, number): (Program, u32)| {
            let name = format!("program {number}, {}", program.version);
            let text = ShaderText::new(name, program.text.as_str());
            (program, text)
        });
        Ok((Self(programs.collect()), found))
    }

    /// Index and program of a digest.
    pub(super) fn of_digest(&self, digest: u64) -> Option<(usize, &Program)> {
        let mut all = self.0.iter().enumerate().map(|(index, (program, _))| (index, program));
        all.find(|(_, program)| program.digest() == digest)
    }

    /// Program at an index.
    pub(super) fn get(&self, index: usize) -> Option<&Program> {
        self.0.get(index).map(|(program, _)| program)
    }

    pub(super) fn list(&self) -> Vec<StudiedProgram<'_>> {
        self.0.iter().map(|(program, text)| StudiedProgram { program, text }).collect()
    }
}
