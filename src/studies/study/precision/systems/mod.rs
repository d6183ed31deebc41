//! The six systems as subjects, each on a small input of its own.
//!
//! The input is made by the host and is the same for every format; what is studied are the pixel programs of the card.
//! docs/precision.md describes the inputs.

mod all_frequency;
mod bi_scale;
mod cpca;
mod radiosity;
mod ray_engine;
mod subsurface;
#[cfg(test)]
mod tests;

use std::fmt;

use glam::DVec3;
use refsim::device::Profile;
use refsim::isa::{Program, Stage};
use refsim::machine::{Executor, ExecutorKind};

use super::goal::{Goal, GoalRelation};
use super::runs::exact;
use super::subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};
use crate::geom::Mesh;
use crate::geom::vector::{narrow, wide};
use crate::picture::RgbImage;
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::shader::ShaderText;
use crate::study::StudyError;

use ray_engine::RayEngineSubject;

/// System of the papers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumIter, strum::EnumString, strum::IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
pub enum PaperSystem {
    /// The Ray Engine's intersection program, on the teapot.
    RayEngine,
    /// Equation 4 of matrix radiosity, on the Cornell box.
    Radiosity,
    /// The three passes of subsurface scattering, in a bunny of marble.
    Subsurface,
    /// Clustered principal components, glossy, on the bunny.
    Cpca,
    /// Products of all-frequency transfer per pixel, on the bunny.
    AllFrequency,
    /// Display of bi-scale transfer, on the bunny.
    BiScale,
}

impl PaperSystem {
    /// Card of the paper on which it ran.
    pub fn card(self) -> &'static str {
        match self {
            Self::RayEngine => "r200",
            Self::Radiosity | Self::Subsurface => "nv35",
            Self::Cpca => "r300",
            Self::AllFrequency => "r350",
            Self::BiScale => "gt200",
        }
    }

    /// Subject on a device.
    ///
    /// # Errors
    /// If the device cannot run the system.
    pub fn subject(self, profile: Profile) -> Result<Box<dyn PrecisionSubject>, StudyError> {
        Ok(match self {
            Self::RayEngine => Box::new(RayEngineSubject::new(profile)?),
            Self::Radiosity => Box::new(SystemSubject::new(Box::new(radiosity::CornellBox::new()?), profile)?),
            Self::Subsurface => Box::new(SystemSubject::new(Box::new(subsurface::Marble::new()?), profile)?),
            Self::Cpca => Box::new(SystemSubject::new(Box::new(cpca::GlossyBunny::new()?), profile)?),
            Self::AllFrequency => {
                Box::new(SystemSubject::new(Box::new(all_frequency::FactoredBunny::new()?), profile)?)
            }
            Self::BiScale => Box::new(SystemSubject::new(Box::new(bi_scale::TexturedBunny::new()?), profile)?),
        })
    }
}

/// Input of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SystemInput {
    /// That of the search.
    Searched,
    /// Another view or light.
    HeldBack,
}

/// System with its input, run on a device.
pub(super) trait SystemRun: fmt::Debug {
    /// Title of the study.
    fn title(&self) -> &'static str;

    /// Name of a value: `pixel`, `patch`.
    fn unit(&self) -> &'static str;

    /// Red, green and blue of each pixel or patch. Pictures are exposed, so that white is 1.
    ///
    /// # Errors
    /// If the device cannot run the programs.
    fn values(&self, input: SystemInput, profile: &Profile, executor: &Executor) -> Result<Vec<[f64; 3]>, StudyError>;

    /// Width and height of the picture, if the values are one.
    fn size(&self) -> Option<[u32; 2]> {
        None
    }

    /// Goal if none is given.
    fn default_goal(&self) -> Goal;
}

const MEASURES: [PrecisionMeasure; 5] = [
    PrecisionMeasure {
        name: "largest_relative",
        meaning: "largest relative error of a channel; 1 where only the exact value is 0",
    },
    PrecisionMeasure { name: "mean_relative", meaning: "mean relative error of all channels" },
    PrecisionMeasure { name: "largest_255ths", meaning: "largest error of a channel, in 255ths of white" },
    PrecisionMeasure {
        name: "visible",
        meaning: "share of pixels or patches, in [0, 1], of which a channel is off by more than one 255th",
    },
    PrecisionMeasure { name: "not_finite", meaning: "number of channels that are infinite or NaN" },
];

/// Goal that a measure is at most a bound.
pub(super) fn at_most(measure: &str, bound: f64) -> Goal {
    Goal { measure: measure.to_owned(), relation: GoalRelation::AtMost, bound }
}

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

/// System whose exact values are those of its run in single precision.
struct SystemSubject {
    run: Box<dyn SystemRun>,
    profile: Profile,
    executors: [Executor; 2],
    programs: PixelPrograms,
    exact: Vec<[f64; 3]>,
    exact_held_back: Vec<[f64; 3]>,
}

impl SystemSubject {
    fn new(run: Box<dyn SystemRun>, profile: Profile) -> Result<Self, StudyError> {
        let executors = [ExecutorKind::Batch, ExecutorKind::Scalar].map(Executor::from);
        let (programs, [exact, exact_held_back]) = PixelPrograms::of(&profile, |device| {
            let values = |input| run.values(input, device, &executors[0]);
            Ok([values(SystemInput::Searched)?, values(SystemInput::HeldBack)?])
        })?;
        Ok(Self { run, profile, executors, programs, exact, exact_held_back })
    }
}

/// Errors of values against exact ones.
fn errors(found: &[[f64; 3]], exact: &[[f64; 3]]) -> (Vec<(&'static str, f64)>, Option<usize>) {
    let (mut sum, mut largest, mut off, mut not_finite, mut visible) = (0.0, 0.0_f64, 0.0_f64, 0_u64, 0_u64);
    let mut worst: Option<(usize, f64)> = None;
    for (at, (ours, right)) in found.iter().zip(exact).enumerate() {
        let mut most = 0.0_f64;
        for (&value, &right) in ours.iter().zip(right) {
            not_finite += u64::from(!value.is_finite());
            let absolute = if value.is_finite() { (value - right).abs() } else { f64::INFINITY };
            let relative = match (absolute == 0.0, right == 0.0) {
                (true, _) => 0.0,
                (false, true) => 1.0,
                (false, false) => absolute / right.abs(),
            };
            sum += relative;
            largest = largest.max(relative);
            most = most.max(255.0 * absolute);
        }
        off = off.max(most);
        visible += u64::from(most > 1.0);
        if most > worst.map_or(0.0, |(_, most)| most) {
            worst = Some((at, most));
        }
    }
    let count = exact.len().max(1) as f64;
    let values = vec![
        ("largest_relative", largest),
        ("mean_relative", sum / (3.0 * count)),
        ("largest_255ths", off),
        ("visible", visible as f64 / count),
        ("not_finite", not_finite as f64),
    ];
    (values, worst.map(|(at, _)| at))
}

impl PrecisionSubject for SystemSubject {
    fn title(&self) -> String {
        self.run.title().to_owned()
    }

    fn profile(&self) -> &Profile {
        &self.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        self.programs.list()
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        &MEASURES
    }

    fn default_goal(&self) -> Goal {
        self.run.default_goal()
    }

    fn measure(&self, profile: &Profile, executor: ExecutorKind, wanted: Option<&str>) -> Result<Measured, StudyError> {
        let executor = &self.executors[usize::from(executor == ExecutorKind::Scalar)];
        let found = self.run.values(SystemInput::Searched, profile, executor)?;
        let (values, worst) = errors(&found, &self.exact);
        let worst = worst.map(|at| {
            let place = match self.run.size() {
                Some([width, _]) => format!("pixel {}, {}", at as u32 % width, at as u32 / width),
                None => format!("{} {at}", self.run.unit()),
            };
            let [ours, exact] = [found[at], self.exact[at]].map(|rgb| rgb.map(|value| value as f32));
            format!("{place}: {ours:?}, not {exact:?}")
        });
        let picture = self.run.size().filter(|_| wanted.is_none()).map(|size| picture(size, &found));
        Ok(Measured { values, worst, picture })
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        let found = self.run.values(SystemInput::HeldBack, profile, &self.executors[0])?;
        let (values, _) = errors(&found, &self.exact_held_back);
        Ok(Some(Measured { values, ..Measured::default() }))
    }
}

/// Picture of linear values.
pub(super) fn picture([width, height]: [u32; 2], values: &[[f64; 3]]) -> RgbImage {
    crate::picture::rgb8(width, height, values.iter().map(|pixel| pixel.map(crate::picture::display::encode)))
}

/// Stanford bunny of few vertices.
pub(super) fn bunny() -> Mesh {
    TransferModel::BiScaleBunny.mesh(3)
}

/// Camera that frames a mesh in a square picture; from another side for the view that is held back.
pub(super) fn camera(mesh: &Mesh, side: u32, input: SystemInput) -> Camera {
    let [low, high] = mesh.bounds().map_or([DVec3::ZERO; 2], |bounds| bounds.map(wide));
    let (middle, radius) = (0.5 * (low + high), 0.5 * (high - low).length());
    let towards = match input {
        SystemInput::Searched => DVec3::new(0.35, -0.9, 0.3),
        SystemInput::HeldBack => DVec3::new(-0.9, 0.2, 0.5),
    };
    let eye = middle + 2.4 * radius * towards.normalize();
    Camera::new(narrow(eye), narrow(middle), [0.0, 0.0, 1.0], 0.42, side, side).expect("an eye outside the mesh")
}
