//! A system as a subject: its values against its own exact run, and the pixel programs that it draws with.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;
use refsim::device::Profile;
use refsim::isa::Program;
use refsim::machine::{DrawCall, DrawWatcher, Executor, ExecutorKind, Machine, MachineError};

use crate::geom::Mesh;
use crate::geom::vector::{narrow, wide};
use crate::picture::{display, rgb8};
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::shader::ShaderText;
use crate::study::StudyError;
use crate::study::precision::errors::{MEASURES, ValueErrors};
use crate::study::precision::goal::Goal;
use crate::study::precision::runs::exact;
use crate::study::precision::subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};

/// Number of pixels per side of the pictures.
pub(super) const PICTURE: u32 = 64;

/// Indices of the inputs, which are views or lights. The second is held back from the search.
pub(super) const INPUTS: [usize; 2] = [0, 1];

/// Computes from an input on a device. Fails if the device cannot run the programs.
pub(super) type OnDevice<T> = Box<dyn Fn(usize, &Profile, &Executor) -> Result<T, StudyError>>;

/// System whose values are compared with its run in single precision.
pub(super) struct System {
    title: &'static str,
    goal: Goal,
    /// `true` if the values are the pixels of a square picture, exposed, with white at 1; otherwise they are patches.
    is_picture: bool,
    /// Red, green and blue of each pixel or patch.
    values: OnDevice<Vec<[f64; 3]>>,
}

impl System {
    /// System that draws a picture; by default, the error in 8-bit codes is at most one.
    pub(super) fn picture(
        title: &'static str,
        values: impl Fn(usize, &Profile, &Executor) -> Result<Vec<[f64; 3]>, StudyError> + 'static,
    ) -> Self {
        let goal = Goal::at_most("largest_codes", 1.0);
        Self { title, goal, is_picture: true, values: Box::new(values) }
    }

    /// System of patches instead of pixels, with a goal of its own.
    pub(super) fn of_patches(self, goal: Goal) -> Self {
        Self { goal, is_picture: false, ..self }
    }

    pub(super) fn subject(self, profile: Profile) -> Result<SystemSubject, StudyError> {
        let Self { title, goal, is_picture, values } = self;
        let executor = ExecutorKind::Batch.into();
        let (programs, exact) = PixelPrograms::of(&profile, &executor, |device, executor| {
            INPUTS.iter().map(|&input| values(input, device, executor)).collect::<Result<Vec<_>, _>>()
        })?;
        let measure: OnDevice<Measured> = Box::new(move |input, device, executor| {
            let (found, exact) = (values(input, device, executor)?, &exact[input]);
            let pair = [found.as_flattened(), exact.as_flattened()];
            let errors = ValueErrors::of([(pair, &[Some(255.0); 3][..])], exact.len());
            let worst = errors.worst.map(|([_, at], _)| {
                let at = at / 3;
                let (x, y) = (at as u32 % PICTURE, at as u32 / PICTURE);
                let place = if is_picture { format!("pixel {x}, {y}") } else { format!("patch {at}") };
                let [ours, exact] = [found[at], exact[at]].map(|rgb| rgb.map(|value| value as f32));
                format!("{place}: {ours:?}, not {exact:?}")
            });
            let pixels = found.iter().map(|pixel| pixel.map(display::encode));
            let picture = is_picture.then(|| rgb8(PICTURE, PICTURE, pixels));
            Ok(Measured { values: errors.values(), worst, picture })
        });
        Ok(SystemSubject { title, goal, measures: &MEASURES, profile, executor, programs, measure })
    }
}

/// System with its input.
pub(super) struct SystemSubject {
    pub(super) title: &'static str,
    pub(super) goal: Goal,
    pub(super) measures: &'static [PrecisionMeasure],
    pub(super) profile: Profile,
    pub(super) executor: Executor,
    pub(super) programs: PixelPrograms,
    pub(super) measure: OnDevice<Measured>,
}

impl PrecisionSubject for SystemSubject {
    fn title(&self) -> String {
        self.title.to_owned()
    }

    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.programs.0.iter().map(|(program, text)| StudiedProgram { program, text }).collect()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        self.measures
    }

    fn default_goal(&self) -> Goal {
        self.goal.clone()
    }

    fn measure(&self, profile: &Profile, _: Option<&str>) -> Result<Measured, StudyError> {
        (self.measure)(INPUTS[0], profile, &self.executor)
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        (self.measure)(INPUTS[1], profile, &self.executor).map(Some)
    }

    fn chooses_other_programs(&self, profile: &Profile) -> Result<bool, StudyError> {
        let run = |device: &Profile, executor: &Executor| (self.measure)(INPUTS[0], device, executor);
        let (chosen, _) = PixelPrograms::of(profile, &self.executor, run)?;
        let is_known = |digest: u64| self.programs.0.iter().any(|(program, _)| program.digest() == digest);
        Ok(!chosen.0.iter().all(|(program, _)| is_known(program.digest())))
    }
}

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
}

/// Stanford bunny with few vertices.
pub(super) fn bunny() -> Mesh {
    TransferModel::BiScaleBunny.mesh(3)
}

/// Cameras that frame a mesh in a picture, by [`INPUTS`]: from two sides.
pub(super) fn cameras(mesh: &Mesh) -> [Camera; 2] {
    let [low, high] = mesh.bounds().map_or([DVec3::ZERO; 2], |bounds| bounds.map(wide));
    let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    [DVec3::new(0.35, -0.9, 0.3), DVec3::new(-0.9, 0.2, 0.5)].map(|towards| {
        let eye = middle + 2.4 * radius * towards.normalize();
        let (eye, middle) = (narrow(eye), narrow(middle));
        Camera::new(eye, middle, [0.0, 0.0, 1.0], 0.42, PICTURE, PICTURE).expect("an eye outside the mesh")
    })
}
