//! Settings of a device's switches that reproduce measured pixels.

use std::collections::{BTreeMap, BTreeSet};

use refsim::device::{Profile, Switch};
use refsim::machine::ExecutorKind;

use super::file::{CODES, MeasuredCase, MeasuredPixel};
use crate::case::{CaseError, Loaded, Overrides, Setup};
use crate::study::{ProgressFn, StudyError};

/// Maximum number of settings drawn per case, and of settings counted for all cases.
const MOST: [usize; 2] = [4096, 1 << 20];

/// Measured pixels, compared with a device.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Name of the table.
    pub name: String,
    /// Cases with their measured pixels.
    pub cases: Vec<MeasuredCase>,
    /// Device, with the known switches set.
    pub profile: Profile,
    /// Switches that are known, by name, with their values in `profile`.
    pub known: Vec<(String, String)>,
}

/// Values of some switches: index of the switch to index of its value. Other switches have their current values.
pub(super) type Setting = BTreeMap<usize, usize>;

/// Counts of measured codes that each setting reproduces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Survey {
    /// Switches with their possible values: a switch that is known has only its current value.
    pub(super) questions: Vec<Switch>,
    /// Switches that some measured code depends on, by index.
    pub(super) relevant: BTreeSet<usize>,
    /// Settings of the relevant switches with the number of codes that each reproduces, best first.
    pub(super) settings: Vec<(Setting, u64)>,
    /// Number of measured codes.
    pub(super) codes: u64,
    /// Codes that the best setting gets wrong.
    pub(super) wrong: Vec<WrongCode>,
}

/// Measured code that a setting gets wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct WrongCode {
    pub(super) line: u64,
    /// Index into the columns of codes.
    pub(super) column: usize,
    pub(super) measured: u32,
    pub(super) drawn: u32,
}

/// Counts for one case: its relevant switches, and the number of codes that each of their settings reproduces.
struct CaseCounts {
    relevant: BTreeSet<usize>,
    right: BTreeMap<Setting, u64>,
}

impl Survey {
    /// Draws every case under all settings of the switches that its measured pixels depend on. Fails if a case cannot
    /// be drawn on the device as it is, a pixel lies outside its target, or there are too many settings.
    pub(super) fn new(measure: &Measure, progress: &mut ProgressFn<'_>) -> Result<Self, StudyError> {
        let Measure { profile, cases, .. } = measure;
        let mut questions = profile.switches().to_vec();
        for known in questions.iter_mut().filter(|switch| measure.known.iter().any(|(name, _)| *name == switch.name)) {
            known.values = vec![known.current.clone()];
        }
        let mut counts = Vec::new();
        for (done, case) in (0..).zip(cases) {
            progress(&case.path.display().to_string(), done, cases.len() as u64);
            counts.push(MeasuredDraws { profile, questions: &questions, case }.counts()?);
        }
        let relevant: BTreeSet<usize> = counts.iter().flat_map(|case| &case.relevant).copied().collect();
        let all = product(&questions, &relevant, MOST[1])?;
        let total = |setting: Setting| {
            let of = |case: &CaseCounts| {
                let own = setting.iter().filter(|(question, _)| case.relevant.contains(question));
                case.right.get(&own.map(|(&question, &value)| (question, value)).collect()).copied().unwrap_or(0)
            };
            let right = counts.iter().map(of).sum();
            (setting, right)
        };
        let mut settings: Vec<(Setting, u64)> = all.into_iter().map(total).collect();
        settings.sort_by_key(|(_, right)| std::cmp::Reverse(*right));
        let codes = cases.iter().flat_map(|case| &case.pixels).map(|pixel| pixel.measured().count() as u64).sum();
        let mut wrong = Vec::new();
        for case in cases {
            wrong.extend(MeasuredDraws { profile, questions: &questions, case }.wrong(&settings[0].0)?);
        }
        Ok(Self { questions, relevant, settings, codes, wrong })
    }

    /// Settings that reproduce every measured code.
    pub(super) fn fitting(&self) -> impl Iterator<Item = &Setting> {
        self.settings.iter().filter(|(_, right)| *right == self.codes).map(|(setting, _)| setting)
    }

    /// Maximum number of codes that a setting with this value of a switch reproduces.
    pub(super) fn best_with(&self, question: usize, value: usize) -> u64 {
        let with = self.settings.iter().filter(|(setting, _)| setting.get(&question) == Some(&value));
        with.map(|(_, right)| *right).max().unwrap_or(0)
    }
}

/// All combinations of values of some switches.
fn product(questions: &[Switch], some: &BTreeSet<usize>, most: usize) -> Result<Vec<Setting>, StudyError> {
    let count = some.iter().fold(1_usize, |count, &at| count.saturating_mul(questions[at].values.len()));
    if count > most {
        let names: Vec<&str> = some.iter().map(|&at| questions[at].name.as_str()).collect();
        let found = format!(
            "expected at most {most} settings of the switches that the pixels depend on, found {count} of {}",
            names.join(", ")
        );
        let help = "set switches that are known (`--switch NAME=VALUE`), or measure smaller cases";
        return Err(StudyError::new("crossbar::measure::settings", found).with_help(help));
    }
    let mut all = vec![Setting::new()];
    for &at in some {
        let values = 0..questions[at].values.len();
        let with = |setting: &Setting| {
            values.clone().map(|value| setting.iter().map(|(&a, &b)| (a, b)).chain([(at, value)]).collect()).collect()
        };
        all = all.iter().flat_map(|setting| -> Vec<Setting> { with(setting) }).collect();
    }
    Ok(all)
}

/// Draws of a case under settings.
struct MeasuredDraws<'a> {
    profile: &'a Profile,
    questions: &'a [Switch],
    case: &'a MeasuredCase,
}

impl MeasuredDraws<'_> {
    fn counts(&self) -> Result<CaseCounts, StudyError> {
        let expected: Vec<u32> =
            self.case.pixels.iter().flat_map(MeasuredPixel::measured).map(|(_, code)| code).collect();
        let relevant = self.relevant()?;
        let mut right = BTreeMap::new();
        for setting in product(self.questions, &relevant, MOST[0])? {
            // The card drew the case, so a setting that cannot draw it is not the card's.
            let drawn = self.draw(&setting).unwrap_or_default();
            let equal = drawn.iter().zip(&expected).filter(|(drawn, expected)| drawn == expected).count();
            right.insert(setting, equal as u64);
        }
        Ok(CaseCounts { relevant, right })
    }

    /// Switches that a measured code depends on, alone or together with a changed value of another such switch.
    fn relevant(&self) -> Result<BTreeSet<usize>, StudyError> {
        let base = self.draw(&Setting::new())?;
        let draw = |setting: Setting| self.draw(&setting).ok();
        let others: Vec<(usize, usize)> = self.questions.iter().enumerate().flat_map(others).collect();
        let alone: Vec<_> = others.iter().map(|&one| draw(Setting::from([one]))).collect();
        let differs = || others.iter().zip(&alone).filter(|(_, drawn)| drawn.as_ref() != Some(&base));
        let mut relevant: BTreeSet<usize> = differs().map(|(one, _)| one.0).collect();
        let hidden = others.iter().filter(|one| !relevant.contains(&one.0));
        let shows = |one: (usize, usize)| differs().any(|(&two, drawn)| draw(Setting::from([one, two])) != *drawn);
        let shown: Vec<usize> = hidden.filter(|&&one| shows(one)).map(|one| one.0).collect();
        relevant.extend(shown);
        Ok(relevant)
    }

    /// Measured codes that a setting gets wrong.
    fn wrong(&self, setting: &Setting) -> Result<Vec<WrongCode>, StudyError> {
        let drawn = self.draw(setting)?;
        let all = self.case.pixels.iter().flat_map(|pixel| pixel.measured().map(|code| (pixel.line, code)));
        let pairs = all.zip(drawn).filter(|((_, (_, measured)), drawn)| measured != drawn);
        Ok(pairs.map(|((line, (column, measured)), drawn)| WrongCode { line, column, measured, drawn }).collect())
    }

    /// Codes of the measured pixels under a setting.
    fn draw(&self, setting: &Setting) -> Result<Vec<u32>, StudyError> {
        let value = |(&at, &value): (&usize, &usize)| {
            let question = &self.questions[at];
            (question.name.clone(), question.values[value].clone())
        };
        let overrides = Overrides {
            device: Some(self.profile.clone()),
            switches: setting.iter().map(value).collect(),
            ..Overrides::default()
        };
        let setup = Setup::read_with(&self.case.path, &overrides)?;
        self.require_places(&setup)?;
        Ok(codes(&setup, &self.case.pixels)?)
    }

    /// Rejects pixels and channels that the case does not draw.
    fn require_places(&self, setup: &Setup) -> Result<(), StudyError> {
        let channels = setup.targets[0].record().stored().len();
        let found = |pixel: &MeasuredPixel| {
            let [x, y] = pixel.place;
            let [width, height] = setup.size;
            let missing = |(at, _): (usize, u32)| if at < 4 { at >= channels } else { setup.depth.is_none() };
            if x >= width || y >= height {
                Some(format!("a pixel of the {width}x{height} target, found column {x}, row {y}"))
            } else {
                let at = pixel.measured().find(|&code| missing(code))?.0;
                Some(format!("a code that the case stores, found one for {}", CODES[at]))
            }
        };
        match self.case.pixels.iter().find_map(|pixel| Some((pixel.line, found(pixel)?))) {
            None => Ok(()),
            Some((line, found)) => {
                let found = format!("line {line}, {}: expected {found}", self.case.path.display());
                Err(StudyError::new("crossbar::measure::place", found).with_help(
                    "columns and rows count from 0 at the top left; a code is a channel that the case's target 0 stores, \
                     or its depth",
                ))
            }
        }
    }
}

/// Values of a switch except the current one, each with the switch's index.
fn others((at, question): (usize, &Switch)) -> Vec<(usize, usize)> {
    let values = 0..question.values.len();
    values.filter(|&value| question.values[value] != question.current).map(|value| (at, value)).collect()
}

/// Draws a case and returns the stored codes at measured pixels.
fn codes(setup: &Setup, pixels: &[MeasuredPixel]) -> Result<Vec<u32>, CaseError> {
    let mut loaded = Loaded::new(setup, ExecutorKind::Scalar)?;
    loaded.draw()?;
    let (targets, depth) = (loaded.targets()?, loaded.depth()?);
    let channels = targets[0].format().record().stored();
    let code = |[x, y]: [u32; 2], at: usize| match channels.get(at) {
        Some(channel) => channel.code(targets[0].raw(0, 0, y, x)),
        _ => depth.and_then(|surface| surface.get(x, y)).unwrap_or_default(),
    };
    Ok(pixels.iter().flat_map(|pixel| pixel.measured().map(|(at, _)| code(pixel.place, at))).collect())
}
