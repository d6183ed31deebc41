//! Case files as subjects.

use refsim::device::Profile;
use refsim::exec::FragmentFormats;
use refsim::machine::{Executor, ExecutorKind, FragmentTrace};
use refsim::num::to_f64;
use refsim::texture::{Channel, ChannelClass, Image};

use super::goal::Goal;
use super::runs::exact;
use super::subject::{InstructionResults, Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};
use crate::case::{CaseError, Loaded, Setup};
use crate::picture::metrics::{DEFAULT_PPD, ScreenPicture, flip, ssim};
use crate::picture::{ChannelUnit, Picture, PictureError, Samples, display, rgb8};
use crate::study::StudyError;

/// Number of pixels that are traced, at most.
const TRACED: usize = 1024;
/// Relative error from which a pixel is wrong, where its target has no codes.
const WRONG: f64 = 0.01;

const LARGEST_CODES: PrecisionMeasure =
    PrecisionMeasure { name: "largest_codes", meaning: "largest difference of a stored code, of all integer channels" };
const MEASURES: [PrecisionMeasure; 5] = [
    PrecisionMeasure {
        name: "mean_relative",
        meaning: "mean relative error of all channels of all pixels; 1 where only the exact value is 0",
    },
    PrecisionMeasure { name: "largest_relative", meaning: "largest relative error; 1 where only the exact value is 0" },
    PrecisionMeasure { name: "largest_absolute", meaning: "largest absolute error" },
    PrecisionMeasure {
        name: "wrong_pixels",
        meaning: "share of pixels, in [0, 1], with a channel that is off by more than one code, or by more than 1 % of \
                  the exact value if it is a float",
    },
    PrecisionMeasure {
        name: "not_finite",
        meaning: "number of channels that are infinite or NaN where the exact ones are not, or the reverse",
    },
];
const SSIM: PrecisionMeasure =
    PrecisionMeasure { name: "ssim", meaning: "structural similarity of target 0 as displayed; 1 if equal" };
const FLIP: PrecisionMeasure =
    PrecisionMeasure { name: "flip", meaning: "mean FLIP of target 0 as displayed, in [0, 1]; 0 if equal" };

/// Case whose pixel program is studied. The reference is its exact run.
#[derive(Debug)]
pub struct CaseSubject {
    setup: Setup,
    title: String,
    /// Executors, which keep what they decoded: batch and scalar.
    executors: [Executor; 2],
    measures: Vec<PrecisionMeasure>,
    exact: DrawnCase,
}

/// Channel values of a drawn case.
#[derive(Debug)]
struct DrawnCase {
    targets: Vec<DrawnTarget>,
}

/// Stored channels of a target with their values, pixel by pixel.
#[derive(Debug)]
struct DrawnTarget {
    channels: Vec<Channel>,
    values: Vec<f64>,
    /// Red, green, blue as displayed, in linear light.
    linear: Vec<[f32; 3]>,
}

impl CaseSubject {
    /// Draws the exact run of a case; its device is the one as given. `name` is the title of a case without one.
    ///
    /// # Errors
    /// If the device cannot draw the case.
    pub fn new(setup: Setup, name: &str) -> Result<Self, StudyError> {
        let executors = [ExecutorKind::Batch, ExecutorKind::Scalar].map(Executor::from);
        let exact = DrawnCase::new(&setup, &executors[0], &exact(&setup.profile, [&*setup.pixel]))?;
        let has_codes =
            exact.targets.iter().flat_map(|target| &target.channels).any(|channel| codes(*channel).is_some());
        let screen = exact.screen(setup.size)?;
        let perceptual = [(SSIM, ssim(&screen, &screen).is_some()), (FLIP, true)];
        let first = has_codes.then_some(LARGEST_CODES);
        let last = perceptual.into_iter().filter(|(_, has)| *has).map(|(measure, _)| measure);
        let title = setup.title.clone().unwrap_or_else(|| name.to_owned());
        Ok(Self { title, executors, measures: first.into_iter().chain(MEASURES).chain(last).collect(), exact, setup })
    }

    fn executor(&self, kind: ExecutorKind) -> &Executor {
        &self.executors[usize::from(kind == ExecutorKind::Scalar)]
    }
}

/// Number of codes per unit of a channel with integer codes.
fn codes(channel: Channel) -> Option<f64> {
    let most = |bits: u8| ((1_u64 << bits) - 1) as f64;
    match channel.class {
        ChannelClass::Unorm => Some(most(channel.bits)),
        ChannelClass::Snorm => Some(most(channel.bits - 1).max(1.0)),
        _ => None,
    }
}

impl DrawnCase {
    fn new(setup: &Setup, executor: &Executor, profile: &Profile) -> Result<Self, CaseError> {
        let setup = setup.on_device(profile.clone())?;
        let mut loaded = Loaded::new(&setup, executor)?;
        loaded.draw()?;
        let targets = loaded.targets()?.into_iter().map(|image| DrawnTarget::new(image, profile)).collect();
        Ok(Self { targets })
    }

    /// Target 0 on a screen.
    fn screen(&self, [width, height]: [u32; 2]) -> Result<ScreenPicture, PictureError> {
        let plane = |c: usize| Samples::Float(self.targets[0].linear.iter().map(|pixel| pixel[c]).collect());
        let picture = (0..).zip(["R", "G", "B"]).try_fold(Picture::new(width, height), |picture, (c, name)| {
            picture.with(name, ChannelUnit::Unknown, plane(c))
        })?;
        ScreenPicture::new(&picture, 1.0)
    }
}

impl DrawnTarget {
    fn new(image: &Image, profile: &Profile) -> Self {
        let channels = image.format().record().stored().to_vec();
        let is_encoded = channels.iter().all(|channel| channel.class == ChannelClass::Unorm);
        let (mut values, mut linear) = (Vec::new(), Vec::new());
        for at in 0..image.width() * image.height() {
            let (x, y) = (at % image.width(), at / image.width());
            let texel = image.texel(0, 0, y, x, profile.rules.signed_texel_minimum).to_f64();
            values.extend(channels.iter().map(|channel| texel[usize::from(channel.stored_from)]));
            let [red, green, blue, _] =
                texel.map(|value| if is_encoded { display::decode(value) } else { value } as f32);
            linear.push([red, green, blue]);
        }
        Self { channels, values, linear }
    }
}

/// Sums over all channels of all pixels.
#[derive(Default)]
struct CaseErrors {
    relative: f64,
    channels: u64,
    largest_relative: f64,
    largest_absolute: f64,
    largest_codes: f64,
    wrong: Vec<bool>,
    not_finite: u64,
    /// Target, index of the value, and its badness.
    worst: Option<(usize, usize, f64)>,
}

impl CaseErrors {
    fn new(ours: &DrawnCase, exact: &DrawnCase, pixels: usize) -> Self {
        let mut errors = Self { wrong: vec![false; pixels], ..Self::default() };
        for (target, (ours, exact)) in ours.targets.iter().zip(&exact.targets).enumerate() {
            for (at, (&value, &right)) in ours.values.iter().zip(&exact.values).enumerate() {
                let count = exact.channels.len();
                errors.add([target, at, at / count], exact.channels[at % count], value, right);
            }
        }
        errors
    }

    fn add(&mut self, [target, at, pixel]: [usize; 3], channel: Channel, value: f64, right: f64) {
        self.channels += 1;
        if value == right || (value.is_nan() && right.is_nan()) {
            return;
        }
        let finite = value.is_finite() && right.is_finite();
        let absolute = if finite { (value - right).abs() } else { f64::INFINITY };
        let relative = match (finite, right == 0.0) {
            (true, false) => absolute / right.abs(),
            (true, true) => 1.0,
            (false, _) => f64::INFINITY,
        };
        self.not_finite += u64::from(!finite);
        self.relative += relative;
        self.largest_relative = self.largest_relative.max(relative);
        self.largest_absolute = self.largest_absolute.max(absolute);
        // Codes are integers; the quotients that stand for them here are not.
        let off = codes(channel).map(|codes| (absolute * codes).round());
        self.largest_codes = self.largest_codes.max(off.unwrap_or(0.0));
        self.wrong[pixel] |= off.map_or(relative > WRONG, |off| off > 1.0);
        let badness = off.unwrap_or(relative);
        if self.worst.is_none_or(|(.., worst)| badness > worst) {
            self.worst = Some((target, at, badness));
        }
    }

    fn values(&self) -> [(&'static str, f64); 6] {
        let wrong = self.wrong.iter().filter(|wrong| **wrong).count();
        [
            ("largest_codes", self.largest_codes),
            ("mean_relative", self.relative / (self.channels.max(1) as f64)),
            ("largest_relative", self.largest_relative),
            ("largest_absolute", self.largest_absolute),
            ("wrong_pixels", wrong as f64 / self.wrong.len().max(1) as f64),
            ("not_finite", self.not_finite as f64),
        ]
    }
}

impl PrecisionSubject for CaseSubject {
    fn title(&self) -> String {
        self.title.clone()
    }

    fn profile(&self) -> &Profile {
        &self.setup.profile
    }

    fn programs(&self) -> Vec<StudiedProgram<'_>> {
        vec![StudiedProgram { program: &self.setup.pixel, text: &self.setup.pixel_text }]
    }

    fn measures(&self) -> &[PrecisionMeasure] {
        &self.measures
    }

    /// One code, or one percent on the average where no target has codes.
    fn default_goal(&self) -> Goal {
        let first = self.measures[0];
        let bound = if first == LARGEST_CODES { 1.0 } else { 0.01 };
        Goal { measure: first.name.to_owned(), relation: super::GoalRelation::AtMost, bound }
    }

    fn measure(&self, profile: &Profile, executor: ExecutorKind, wanted: Option<&str>) -> Result<Measured, StudyError> {
        let drawn = DrawnCase::new(&self.setup, self.executor(executor), profile)?;
        let [width, height] = self.setup.size;
        let errors = CaseErrors::new(&drawn, &self.exact, width as usize * height as usize);
        let known = errors.values().into_iter().filter(|(name, _)| self.measures.iter().any(|m| m.name == *name));
        let mut values: Vec<(&'static str, f64)> = known.collect();
        if wanted.is_none_or(|wanted| [SSIM.name, FLIP.name].contains(&wanted)) {
            let [ours, exact] = [drawn.screen(self.setup.size)?, self.exact.screen(self.setup.size)?];
            values.extend(ssim(&ours, &exact).map(|ssim| (SSIM.name, ssim)));
            values.extend(flip(&ours, &exact, DEFAULT_PPD).map(|flip| (FLIP.name, flip.mean)));
        }
        let picture = wanted.is_none().then(|| {
            let pixels = drawn.targets[0].linear.iter();
            rgb8(width, height, pixels.map(|pixel| pixel.map(|channel| display::encode(f64::from(channel)))))
        });
        Ok(Measured { values, worst: errors.worst.map(|worst| self.place(worst, &drawn)), picture })
    }

    fn results(&self, profile: &Profile) -> Result<Option<Vec<InstructionResults>>, StudyError> {
        let setup = self.setup.on_device(profile.clone())?;
        let loaded = Loaded::new(&setup, self.executor(ExecutorKind::Batch))?;
        let [width, height] = self.setup.size;
        let count = width as usize * height as usize;
        let step = count.div_ceil(TRACED).max(1);
        let pixels: Vec<(u32, u32)> = (0..count as u32).step_by(step).map(|at| (at % width, at / width)).collect();
        let traces = loaded.trace(&pixels)?;
        let mut results = InstructionResults::new();
        for (number, fragment) in (0..).zip(traces.iter().flatten()) {
            self.add_results(profile, number, fragment, &mut results);
        }
        Ok(Some(vec![results]))
    }

    fn notes(&self) -> Vec<String> {
        let all = || self.exact.targets.iter().flat_map(|target| &target.values);
        let not_finite = all().filter(|value| !value.is_finite()).count();
        let note = || format!("Of {} channels of the exact run {not_finite} are infinite or NaN.", all().count());
        (not_finite > 0).then(note).into_iter().collect()
    }
}

impl CaseSubject {
    /// Describes the place of a value with the exact one.
    fn place(&self, (target, at, _): (usize, usize, f64), drawn: &DrawnCase) -> String {
        let (ours, exact) = (&drawn.targets[target], &self.exact.targets[target]);
        let (pixel, channel) = (at / exact.channels.len(), exact.channels[at % exact.channels.len()]);
        let width = self.setup.size[0] as usize;
        let name = ["red", "green", "blue", "alpha"].get(usize::from(channel.stored_from)).copied().unwrap_or_default();
        let of = if self.exact.targets.len() > 1 { format!(" of target {target}") } else { String::new() };
        let (x, y) = (pixel % width, pixel / width);
        match codes(channel) {
            Some(codes) => {
                let [ours, exact] = [ours, exact].map(|target| (target.values[at] * codes).round());
                format!("{x}, {y}{of}: {name} {ours}, not {exact}")
            }
            None => format!("{x}, {y}{of}: {name} {}, not {}", ours.values[at] as f32, exact.values[at] as f32),
        }
    }

    /// Adds the first result of each instruction of a fragment.
    fn add_results(&self, profile: &Profile, number: u32, fragment: &FragmentTrace, results: &mut InstructionResults) {
        let formats = FragmentFormats::new(&profile.rules);
        for step in &fragment.shading.steps {
            let Some(destination) = self.setup.pixel.instructions.get(step.instruction).and_then(|i| i.destination)
            else {
                continue;
            };
            let format = formats.of_file(destination.register.file);
            let of_instruction = results.entry(step.instruction).or_default();
            for component in (0..4_u8).filter(|&c| step.mask.contains(usize::from(c))) {
                let value = to_f64(&format, step.value[usize::from(component)]);
                of_instruction.entry((number, component)).or_insert(value);
            }
        }
    }
}
