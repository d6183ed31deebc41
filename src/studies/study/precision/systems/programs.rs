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

    pub(super) fn list(&self) -> Vec<StudiedProgram<'_>> {
        self.0.iter().map(|(program, text)| StudiedProgram { program, text }).collect()
    }
}
