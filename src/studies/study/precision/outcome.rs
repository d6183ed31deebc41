//! Parameters, and the steps of the study.

use super::bits::{FormatBits, FormatFamily, NAMED};
use super::curve::Curve;
use super::goal::Goal;
use super::half::{HalfExpression, half_expressions};
use super::instructions::{InstructionNeeds, blame, fewest_bits, loss};
use super::runs::{RunError, Runs};
use super::search::{MixedFormats, STARTS, assignment, search};
use super::subject::PrecisionSubject;
use super::switches::{SwitchRow, sensitivity};
use crate::study::{ProgressFn, StudyError};

/// Approximate number of runs per curve.
const RUNS_PER_CURVE: u64 = 30;
/// Approximate number of runs per instruction in one family of formats.
const RUNS_PER_INSTRUCTION: u64 = 55;

/// Parameters of the study.
pub struct Precision {
    /// Programs with their input.
    pub subject: Box<dyn PrecisionSubject>,
    /// Goal; `None` for the default goal of the subject.
    pub goal: Option<Goal>,
    /// Families of formats, each once; at least one.
    pub families: Vec<FormatFamily>,
    /// Maximum number of runs.
    pub budget: u64,
}

/// Results for one family of formats.
#[derive(Debug)]
pub(super) struct FamilyOutcome {
    pub(super) curve: Curve,
    /// Format with one bit less than the smallest uniform format; blame divides its loss among the instructions.
    pub(super) blamed: Option<FormatBits>,
    /// Findings by instruction.
    pub(super) needs: Vec<InstructionNeeds>,
    /// Assignment with the fewest bits that was found.
    pub(super) mixed: Option<MixedFormats>,
    /// Value of the goal's measure with this assignment on the input held back from the search.
    pub(super) held_back: Option<f64>,
}

/// Everything that was found.
#[derive(Debug, Default)]
pub(super) struct PrecisionOutcome {
    /// Value of the exact run.
    pub(super) exact: f64,
    /// Value on the unchanged device.
    pub(super) given: Option<f64>,
    /// Values of formats of cards.
    pub(super) named: Vec<(&'static str, FormatBits, f64)>,
    /// Expressions that may be in half precision, for a shader in WGSL.
    pub(super) half: Vec<HalfExpression>,
    pub(super) families: Vec<FamilyOutcome>,
    pub(super) switches: Vec<SwitchRow>,
    /// `true` if the budget was spent before the study ended.
    pub(super) budget_spent: bool,
}

impl PrecisionOutcome {
    /// The curve and the mixed formats of the family whose mixed formats have the fewest bits.
    pub(super) fn cheapest(&self) -> Option<(&Curve, &MixedFormats)> {
        let mixed = self.families.iter().filter_map(|family| Some((&family.curve, family.mixed.as_ref()?)));
        mixed.min_by_key(|(_, mixed)| mixed.width())
    }
}

impl Precision {
    /// Goal of the study. Fails if the subject does not have the goal's measure.
    pub(super) fn goal(&self) -> Result<Goal, StudyError> {
        let names: Vec<&str> = self.subject.measures().iter().map(|measure| measure.name).collect();
        Goal::chosen(self.goal.as_ref(), &names, self.subject.default_goal())
    }

    /// Runs of the subject. Fails if no runs are allowed, or no instruction has a format.
    pub(super) fn runs<'a>(&'a self, goal: &'a Goal, progress: &'a mut ProgressFn<'a>) -> Result<Runs<'a>, StudyError> {
        if self.budget == 0 {
            let found = "expected a budget of 1 run or more, found 0";
            return Err(StudyError::new("crossbar::precision::budget", found));
        }
        let mut runs = Runs::new(&*self.subject, goal, self.budget, progress);
        if runs.count() == 0 {
            let names: Vec<&str> = runs.programs.iter().map(|program| program.text.name()).collect();
            let found = format!("{}: expected instructions that compute or read texels, found none", names.join(", "));
            return Err(StudyError::new("crossbar::precision::program", found)
                .with_help("a study of precision needs at least one instruction whose result is a number"));
        }
        let values = self.subject.profile().switches().iter().map(|switch| switch.values.len() as u64);
        let per_family = RUNS_PER_CURVE + RUNS_PER_INSTRUCTION * runs.count() as u64;
        runs.expected = self.families.len() as u64 * per_family + 4 * values.sum::<u64>();
        Ok(runs)
    }

    /// Runs the study until it ends or its budget is spent. Fails if the exact run misses the goal, or the subject
    /// cannot be run.
    pub(super) fn outcome(&self, runs: &mut Runs<'_>) -> Result<PrecisionOutcome, StudyError> {
        let mut outcome = PrecisionOutcome::default();
        match self.run(runs, &mut outcome) {
            Ok(()) => {}
            Err(RunError::Budget) => outcome.budget_spent = true,
            Err(RunError::Study(error)) => return Err(error),
        }
        for family in &mut outcome.families {
            family.verify(runs)?;
        }
        Ok(outcome)
    }

    fn run(&self, runs: &mut Runs<'_>, outcome: &mut PrecisionOutcome) -> Result<(), RunError> {
        outcome.exact = exact_run(runs)?;
        runs.step("the device as given");
        outcome.given = Some(runs.measure(runs.subject.profile())?.value(&runs.goal.measure));
        for &family in &self.families {
            let mut curve = Curve::empty(family);
            runs.step(format!("{} formats", family.name()));
            let end = curve.compute(runs.goal, &mut |bits| runs.value(&runs.uniform(bits)));
            outcome.families.push(FamilyOutcome::new(curve, runs.count()));
            end?;
        }
        runs.step("formats of cards");
        for (name, bits) in NAMED {
            let value = runs.value(&runs.uniform(bits))?;
            outcome.named.push((name, bits, value));
        }
        half_expressions(runs, &mut outcome.half)?;
        for family in &mut outcome.families {
            family.run(runs)?;
        }
        runs.step("open switches");
        let at_curve = |curve: &Curve| curve.minimum.map(|minimum| FormatBits { range: curve.range, ..minimum });
        let minimum = outcome.families.iter().find_map(|family| at_curve(&family.curve));
        sensitivity(minimum, runs, &mut outcome.switches)
    }
}

/// Value of the exact run, which meets the goal.
fn exact_run(runs: &mut Runs<'_>) -> Result<f64, RunError> {
    runs.step("the exact run");
    let (goal, exact) = (runs.goal, runs.value(&vec![None; runs.count()])?);
    if goal.met(exact) {
        return Ok(exact);
    }
    let found = format!("expected a goal that the exact run meets, found {goal}, and {} {exact} there", goal.measure);
    Err(StudyError::new("crossbar::precision::goal", found)
        .with_help("no number format can be better than registers of single precision: state a wider bound")
        .into())
}

impl FamilyOutcome {
    /// Creates the outcome of a family that has no findings yet.
    fn new(curve: Curve, instructions: usize) -> Self {
        let needs = vec![InstructionNeeds::default(); instructions];
        Self { curve, blamed: None, needs, mixed: None, held_back: None }
    }

    /// Index and share of blame of the most blamed instruction; the first one on a tie.
    pub(super) fn most_blamed(&self) -> Option<(usize, f64)> {
        let shares = self.needs.iter().enumerate().filter_map(|(place, needs)| Some((place, needs.blame?)));
        shares.min_by(|a, b| b.1.total_cmp(&a.1))
    }

    /// Runs the mixed formats on held-back input.
    fn verify(&mut self, runs: &Runs<'_>) -> Result<(), StudyError> {
        if let Some(mixed) = &self.mixed
            && let Some(device) = runs.device(runs.subject.profile(), &assignment(&mixed.formats))
        {
            let measured = runs.subject.held_back(&device)?;
            self.held_back = measured.map(|measured| measured.value(&runs.goal.measure));
        }
        Ok(())
    }

    /// Finds the bits that each instruction needs, and the mixed formats.
    fn run(&mut self, runs: &mut Runs<'_>) -> Result<(), RunError> {
        let Some(minimum) = self.curve.minimum else { return Ok(()) };
        let order = self.share_blame(minimum, runs)?;
        for more in STARTS {
            search((minimum, more), &order, runs, &mut self.mixed)?;
        }
        runs.step("bits per instruction");
        for (place, needs) in self.needs.iter_mut().enumerate() {
            fewest_bits(needs, place, minimum, self.curve.range, runs)?;
        }
        Ok(())
    }

    /// Computes the blame of each instruction; returns their indices, least blamed first.
    fn share_blame(&mut self, minimum: FormatBits, runs: &mut Runs<'_>) -> Result<Vec<usize>, RunError> {
        runs.step("blame");
        // The narrowest format has no narrower neighbor.
        let bits = minimum.narrower().next().unwrap_or(minimum);
        let all = loss(runs, &runs.uniform(bits))?;
        self.blamed = Some(bits);
        blame(&mut self.needs, (bits, all), runs)?;
        let blame = |place: &usize| self.needs[*place].blame.unwrap_or(0.0);
        let mut order: Vec<usize> = (0..self.needs.len()).collect();
        order.sort_by(|a, b| blame(a).total_cmp(&blame(b)));
        Ok(order)
    }
}
