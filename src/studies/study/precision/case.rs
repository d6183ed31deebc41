//! Case files as subjects.

use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::{Channel, ChannelClass, Image};

use super::errors::{LARGEST_CODES, MEASURES, ValueErrors};
use super::goal::Goal;
use super::runs::exact;
use super::subject::{Measured, PrecisionMeasure, PrecisionSubject, StudiedProgram};
use crate::case::{CaseError, Loaded, Setup};
use crate::error::InputError;
use crate::picture::metrics::{DEFAULT_PPD, ScreenPicture, flip, ssim};
use crate::picture::{ChannelUnit, Picture, RgbImage, Samples, display, rgb8};
use crate::shader::ShaderText;
use crate::study::StudyError;

const SSIM: PrecisionMeasure =
    PrecisionMeasure { name: "ssim", meaning: "structural similarity of target 0 as displayed; 1 if equal" };
const FLIP: PrecisionMeasure =
    PrecisionMeasure { name: "flip", meaning: "mean FLIP of target 0 as displayed, in [0, 1]; 0 if equal" };

/// Case whose pixel program is studied. The reference is its exact run.
#[derive(Debug)]
pub struct CaseSubject {
    setup: Setup,
    title: String,
    executor: Executor,
    measures: Vec<PrecisionMeasure>,
    exact: Vec<DrawnTarget>,
    /// Another case with the same pixel program, which tests the mixed formats that were searched on this case.
    held_back: Option<Box<CaseSubject>>,
}

impl CaseSubject {
    /// Draws the exact run of a case, whose device is used unchanged. `name` is the title of a case without one. Fails
    /// if the device cannot draw the case.
    pub fn new(setup: Setup, name: &str) -> Result<Self, StudyError> {
        let executor = ExecutorKind::Batch.into();
        let exact = drawn(&setup, &executor, &exact(&setup.profile, [&*setup.pixel]))?;
        let screen = exact[0].screen(setup.size)?;
        let has_codes = exact.iter().any(|target| target.codes.iter().any(Option::is_some));
        let has_ssim = ssim(&screen, &screen).is_some();
        let of_values = MEASURES.into_iter().filter(|measure| has_codes || *measure != LARGEST_CODES);
        let measures = of_values.chain(Some(SSIM).filter(|_| has_ssim)).chain([FLIP]).collect();
        let title = setup.title.clone().unwrap_or_else(|| name.to_owned());
        Ok(Self { title, executor, measures, exact, setup, held_back: None })
    }

    /// Holds back a case: formats found on this case are tested on it, on this case's device. `name` says where it
    /// comes from. Fails if it has another pixel program, this case's device cannot draw it, or it lacks a measure of
    /// this case.
    pub fn holding_back(mut self, other: &Setup, name: &str) -> Result<Self, StudyError> {
        let other = Self::new(other.on_device(self.setup.profile.clone())?, name)?;
        let refused = |what: &str, help: &str| {
            StudyError::new("crossbar::precision::held_back", format!("{name}: expected a case with {what}"))
                .with_help(help)
        };
        if other.setup.pixel.digest() != self.setup.pixel.digest() {
            let help = "give a case with other textures, constants or geometry";
            return Err(refused("the same pixel program, found another program", help));
        }
        if let Some(missing) = self.measures.iter().find(|measure| !other.measures.contains(measure)) {
            let help = "give its targets the formats and sizes of the case that is searched";
            return Err(refused(&format!("the measure `{}`, found none", missing.name), help));
        }
        self.held_back = Some(Box::new(other));
        Ok(self)
    }

    /// Draws a case of the same size and targets, and measures it against the exact run.
    fn measured(&self, setup: &Setup, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        let drawn = drawn(setup, &self.executor, profile)?;
        let [width, height] = self.setup.size;
        let pairs = drawn.iter().zip(&self.exact);
        let targets = pairs.map(|(ours, exact)| ([&ours.values[..], &exact.values[..]], &exact.codes[..]));
        let errors = ValueErrors::of(targets, width as usize * height as usize);
        let mut values = errors.values();
        values.retain(|(name, _)| self.measures.iter().any(|measure| measure.name == *name));
        if wanted.is_none_or(|wanted| [SSIM.name, FLIP.name].contains(&wanted)) {
            let [ours, exact] = [drawn[0].screen(self.setup.size)?, self.exact[0].screen(self.setup.size)?];
            values.extend(ssim(&ours, &exact).map(|ssim| (SSIM.name, ssim)));
            values.extend(flip(&ours, &exact, DEFAULT_PPD).map(|flip| (FLIP.name, flip.mean)));
        }
        let worst = errors.worst.map(|(place, _)| self.place(place, &drawn));
        Ok(Measured { values, worst, picture: wanted.is_none().then(|| drawn[0].picture(self.setup.size)) })
    }

    /// Describes the location of a value, and the exact value there.
    fn place(&self, [target, at]: [usize; 2], drawn: &[DrawnTarget]) -> String {
        let (ours, exact) = (&drawn[target], &self.exact[target]);
        let (pixel, channel) = (at / exact.codes.len(), at % exact.codes.len());
        let width = self.setup.size[0] as usize;
        let of = if self.exact.len() > 1 { format!(" of target {target}") } else { String::new() };
        let place = format!("{}, {}{of}: {}", pixel % width, pixel / width, exact.names[channel]);
        let values = [ours.values[at], exact.values[at]];
        match exact.codes[channel] {
            Some(codes) => {
                let [ours, exact] = values.map(|value| (value * codes).round());
                format!("{place} {ours}, not {exact}")
            }
            None => format!("{place} {}, not {}", values[0] as f32, values[1] as f32),
        }
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
        Goal::at_most(first.name, bound)
    }

    fn measure(&self, profile: &Profile, wanted: Option<&str>) -> Result<Measured, StudyError> {
        self.measured(&self.setup, profile, wanted)
    }

    fn measure_text(&self, text: &ShaderText, wanted: &str) -> Result<Option<Measured>, StudyError> {
        let profile = exact(&self.setup.profile, []);
        let pixel = text.assemble().and_then(|program| text.check(program, &profile)).map_err(CaseError::from)?;
        let setup = Setup { pixel, pixel_text: text.clone(), ..self.setup.clone() };
        Ok(Some(self.measured(&setup, &profile, Some(wanted))?))
    }

    fn held_back(&self, profile: &Profile) -> Result<Option<Measured>, StudyError> {
        self.held_back.as_deref().map(|other| other.measure(profile, None)).transpose()
    }

    fn notes(&self) -> Vec<String> {
        let all = || self.exact.iter().flat_map(|target| &target.values);
        let not_finite = all().filter(|value| !value.is_finite()).count();
        let note = || format!("Of {} channels of the exact run, {not_finite} are infinite or NaN.", all().count());
        let warnings = self.setup.warnings.iter().map(|warning| format!("Warning: {warning}."));
        (not_finite > 0).then(note).into_iter().chain(warnings).collect()
    }
}

/// Target of a drawn case.
#[derive(Debug)]
struct DrawnTarget {
    /// Per stored channel: its name, and the number of codes per unit if it has integer codes.
    names: Vec<&'static str>,
    codes: Vec<Option<f64>>,
    /// Values of the stored channels, pixel by pixel.
    values: Vec<f64>,
    /// Displayed red, green and blue per pixel, in linear light.
    linear: Vec<[f32; 3]>,
}

/// Draws a case on a device.
fn drawn(setup: &Setup, executor: &Executor, profile: &Profile) -> Result<Vec<DrawnTarget>, CaseError> {
    let setup = setup.on_device(profile.clone())?;
    let mut loaded = Loaded::new(&setup, executor)?;
    loaded.draw()?;
    Ok(loaded.targets()?.into_iter().map(|image| DrawnTarget::new(image, profile)).collect())
}

/// Number of codes per unit of a channel with integer codes.
fn codes(channel: &Channel) -> Option<f64> {
    let most = |bits: u8| ((1_u64 << bits) - 1) as f64;
    match channel.class {
        ChannelClass::Unorm => Some(most(channel.bits)),
        ChannelClass::Snorm => Some(most(channel.bits - 1).max(1.0)),
        _ => None,
    }
}

impl DrawnTarget {
    fn new(image: &Image, profile: &Profile) -> Self {
        let channels = image.format().record().stored();
        let is_encoded = channels.iter().all(|channel| channel.class == ChannelClass::Unorm);
        let places: Vec<usize> = channels.iter().map(|channel| usize::from(channel.stored_from)).collect();
        let (mut values, mut linear) = (Vec::new(), Vec::new());
        for at in 0..image.width() * image.height() {
            let (x, y) = (at % image.width(), at / image.width());
            let texel = image.texel(0, 0, y, x, profile.rules.signed_texel_minimum).to_f64();
            values.extend(places.iter().map(|&place| texel[place]));
            let [red, green, blue, _] =
                texel.map(|value| if is_encoded { display::decode(value) } else { value } as f32);
            linear.push([red, green, blue]);
        }
        let names = places.iter().map(|&place| ["red", "green", "blue", "alpha"][place]).collect();
        Self { names, codes: channels.iter().map(codes).collect(), values, linear }
    }

    /// The target as it appears on a screen.
    fn screen(&self, [width, height]: [u32; 2]) -> Result<ScreenPicture, InputError> {
        let plane = |c: usize| Samples::Float(self.linear.iter().map(|pixel| pixel[c]).collect());
        let picture = (0..).zip(["R", "G", "B"]).try_fold(Picture::new(width, height), |picture, (c, name)| {
            picture.with(name, ChannelUnit::Unknown, plane(c))
        })?;
        ScreenPicture::new(&picture, 1.0)
    }

    /// The target as displayed.
    fn picture(&self, [width, height]: [u32; 2]) -> RgbImage {
        let pixels = self.linear.iter();
        rgb8(width, height, pixels.map(|pixel| pixel.map(|channel| display::encode(f64::from(channel)))))
    }
}
