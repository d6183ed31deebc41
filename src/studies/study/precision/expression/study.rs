//! The study: expressions, and the results for each of them.

use std::path::Path;
use std::sync::Arc;

use super::super::bits::{FormatBits, FormatFamily, NAMED};
use super::super::curve::Curve;
use super::super::goal::Goal;
use super::arithmetic::Arithmetic;
use super::blame::OperationError;
use super::errors::{BitErrors, MEASURES};
use super::graph::Expression;
use super::sample::{self, InputDraw, Samples};
use super::syntax::{self, ExpressionError};
use super::{blame, errors};
use crate::io::read_limited;
use crate::report::SourceText;
use crate::report::digits::exact;
use crate::report::words::counted;
use crate::study::StudyError;
use crate::study::error::library_errors;
use refsim::num::Format;

/// Longest FPCore file, in bytes (1 MiB).
const MAX_BYTES: u64 = 1 << 20;

/// Expressions, with the parameters of their study.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpressionStudy {
    /// Source of the expressions: a file, or the formula.
    pub(super) title: String,
    pub(super) expressions: Vec<Expression>,
    /// Name, position and reason of each rejected expression.
    pub(super) refused: Vec<ExpressionError>,
    /// Goal that formats must meet; the default is `mean_relative<=0.01`.
    pub goal: Option<Goal>,
    /// Families that are searched for the smallest format.
    pub families: Vec<FormatFamily>,
    /// Number of inputs per expression and format.
    pub samples: usize,
    /// Seed of the inputs.
    pub seed: u64,
    /// Distribution of the inputs.
    pub draw: InputDraw,
}

/// Errors of one expression in one format.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FormatErrors {
    pub(super) name: &'static str,
    pub(super) arithmetic: Arithmetic,
    pub(super) samples: Samples,
    pub(super) bits: BitErrors,
    /// Value of the goal's measure.
    pub(super) value: f64,
}

/// Results for one expression.
#[derive(Debug)]
pub(super) struct ExpressionOutcome {
    pub(super) formats: Vec<FormatErrors>,
    pub(super) curves: Vec<Curve>,
    /// The format in which operations are blamed, and the blame.
    pub(super) blamed: (String, Vec<OperationError>),
}

library_errors! {
    ExpressionError;
}

impl ExpressionStudy {
    /// A study of a formula in infix notation, or of an expression in FPCore.
    ///
    /// # Errors
    /// If the text is not a formula; the error has the position.
    pub fn of_formula(text: &str, ranges: &[String]) -> Result<Self, ExpressionError> {
        let source = Arc::new(SourceText::new("--expr", text));
        if text.trim_start().starts_with("(FPCore") {
            return Self::new(text.trim(), &source, ranges);
        }
        let mut expression = syntax::formula(&source)?;
        expression.preconditions.extend(syntax::bounds(ranges, &expression.variables)?);
        Ok(Self::with(text.trim().to_owned(), vec![expression], Vec::new()))
    }

    /// A study of all expressions of an FPCore file.
    ///
    /// # Errors
    /// If the file cannot be read, is not FPCore, or contains no supported expression.
    pub fn of_file(path: &Path, ranges: &[String]) -> Result<Self, StudyError> {
        let name = path.display().to_string();
        let unreadable = |found: String| {
            StudyError::new("crossbar::expression::file", found).with_help("give a text file in FPCore, up to 1 MiB")
        };
        let bytes = read_limited(path, MAX_BYTES)
            .map_err(|error| unreadable(format!("cannot read {name}")).with_source(error))?
            .ok_or_else(|| unreadable(format!("{name}: expected at most {MAX_BYTES} bytes, found more")))?;
        let text = String::from_utf8(bytes)
            .map_err(|error| unreadable(format!("{name}: expected text in UTF-8")).with_source(error))?;
        let source = Arc::new(SourceText::new(name.clone(), text));
        Ok(Self::new(&name, &source, ranges)?)
    }

    fn new(title: &str, source: &Arc<SourceText>, ranges: &[String]) -> Result<Self, ExpressionError> {
        let (mut expressions, mut refused) = (Vec::new(), Vec::new());
        for core in syntax::cores(source)? {
            match core {
                Ok(mut expression) => {
                    expression.preconditions.extend(syntax::bounds(ranges, &expression.variables)?);
                    expressions.push(expression);
                }
                Err(error) => refused.push(error),
            }
        }
        match refused.first() {
            Some(error) if expressions.is_empty() => Err(error.clone()),
            _ => Ok(Self::with(title.to_owned(), expressions, refused)),
        }
    }

    fn with(title: String, expressions: Vec<Expression>, refused: Vec<ExpressionError>) -> Self {
        let families = vec![FormatFamily::Float];
        Self { title, expressions, refused, goal: None, families, samples: 1000, seed: 0, draw: InputDraw::Floats }
    }

    /// Names of the accepted expressions, and the errors of the others.
    pub fn taken(&self) -> (Vec<&str>, &[ExpressionError]) {
        (self.expressions.iter().map(|expression| expression.name.as_str()).collect(), &self.refused)
    }

    /// Mean bits of error of each expression in a format, or in double precision, each with its standard error.
    pub fn mean_bits(&self, format: Option<Format>) -> Vec<[f64; 2]> {
        let arithmetic = format.map_or(Arithmetic::Double, Arithmetic::Number);
        let of = |expression: &Expression| {
            let samples = sample::sample(expression, arithmetic, self.samples, self.draw, self.seed);
            let bits = errors::bits(expression, arithmetic, &samples);
            [bits.mean, bits.standard_error]
        };
        self.expressions.iter().map(of).collect()
    }

    /// The correctly rounded and the computed result of an expression in a format, or in double precision. Results and
    /// inputs are bit patterns. `None` for an unknown name, or if no result is finite and decided.
    pub fn results(&self, name: &str, format: Option<Format>, inputs: &[u64]) -> Option<[u64; 2]> {
        let arithmetic = format.map_or(Arithmetic::Double, Arithmetic::Number);
        let expression = self.expressions.iter().find(|expression| expression.name == name)?;
        let exact = sample::exact(expression, arithmetic, inputs.to_vec())?.exact;
        let constants = arithmetic.constants(&expression.body);
        Some([exact, arithmetic.values(&expression.body, inputs, &constants).pop()?])
    }

    pub(super) fn goal(&self) -> Result<Goal, StudyError> {
        Goal::chosen(self.goal.as_ref(), &MEASURES, Goal::at_most(MEASURES[0], 0.01))
    }

    /// Formats whose errors are shown: double precision, and cards' formats of the families.
    fn formats(&self) -> Vec<(&'static str, Arithmetic)> {
        let named = NAMED.into_iter().filter(|(_, bits)| self.families.contains(&bits.family));
        named.map(|(name, bits)| (name, number(bits))).chain([("fp64", Arithmetic::Double)]).collect()
    }

    pub(super) fn outcome(&self, expression: &Expression, goal: &Goal) -> Result<ExpressionOutcome, StudyError> {
        let single = Arithmetic::Number(Format::FP32);
        let sampled = |arithmetic| sample::sample(expression, arithmetic, self.samples, self.draw, self.seed);
        let reference = sampled(single);
        if reference.kept.is_empty() {
            return Err(without_inputs(expression, single, &reference));
        }
        let value = |arithmetic, ends_early| {
            errors::relative_errors(expression, arithmetic, (&reference, single), goal, ends_early)
        };
        let mut formats = Vec::new();
        for (name, arithmetic) in self.formats() {
            let samples = if arithmetic == single { reference.clone() } else { sampled(arithmetic) };
            let bits = errors::bits(expression, arithmetic, &samples);
            formats.push(FormatErrors { name, arithmetic, samples, bits, value: value(arithmetic, false) });
        }
        let curve = |&family: &FormatFamily| {
            let mut curve = Curve::empty(family);
            curve.minimum = smallest(family, goal, |bits| value(number(bits), true));
            curve.range = curve.minimum.map_or(curve.range, |bits| bits.range);
            let range = curve.range;
            let at = |digits| (digits, value(number(FormatBits { family, range, digits }), false));
            curve.scan.points = family.digit_bits(range).map(at).collect();
            curve
        };
        let curves: Vec<Curve> = self.families.iter().map(curve).collect();
        let minimum = curves.iter().find_map(|curve| curve.minimum);
        let blamed = match minimum {
            Some(bits) => (bits.to_string(), blame::blame(expression, number(bits), &sampled(number(bits)))),
            None => ("e8m23".to_owned(), blame::blame(expression, single, &reference)),
        };
        Ok(ExpressionOutcome { formats, curves, blamed })
    }
}

/// The format of a family with the fewest bits that meets a goal. Among formats of equal width, the best value decides,
/// then the fewest bits of range. Tries every format, because fewer bits can have a smaller error than more.
fn smallest(family: FormatFamily, goal: &Goal, value: impl Fn(FormatBits) -> f64) -> Option<FormatBits> {
    let digits = |range| family.digit_bits(range).map(move |digits| FormatBits { family, range, digits });
    let all: Vec<FormatBits> = family.range_bits().flat_map(digits).collect();
    (1..=32).find_map(|width| {
        let values = all.iter().filter(|bits| bits.width() == width).map(|bits| (*bits, value(*bits)));
        let met = values.filter(|(_, value)| goal.met(*value));
        met.min_by(|a, b| goal.badness(a.1).total_cmp(&goal.badness(b.1))).map(|(bits, _)| bits)
    })
}

/// Error that states why no input of an expression can be judged.
fn without_inputs(expression: &Expression, arithmetic: Arithmetic, samples: &Samples) -> StudyError {
    let failed = |reason: &str, help: &str| {
        let found = format!("{}: {reason}", expression.name);
        StudyError::new("crossbar::expression::inputs", found).with_help(help.to_owned())
    };
    let number = |ordinal| exact(arithmetic.value(arithmetic.at_ordinal(ordinal)));
    let spans = sample::spans(expression, arithmetic);
    for ([low, high], name) in spans.into_iter().zip(&expression.variables) {
        let reason = format!("expected numbers of single precision within the bounds of `{name}`, found none");
        if low == high + 1 {
            let help = format!("widen its range: the next numbers are {} and {}", number(high), number(low));
            return failed(&reason, &help);
        } else if low > high {
            return failed(&reason, "its bounds contradict each other");
        }
    }
    if samples.discarded == 0 {
        return failed("expected inputs that meet the precondition, found none", "give the precondition wider bounds");
    }
    let tried = counted(samples.discarded as u64, "input", "inputs");
    failed(
        &format!("expected a real, finite result in single precision, found none at {tried}"),
        "the expression divides by zero, leaves a function's domain, is too large or compares equal numbers",
    )
}

/// A format with the default rules.
fn number(bits: FormatBits) -> Arithmetic {
    Arithmetic::Number(bits.format(Format::FP32))
}
