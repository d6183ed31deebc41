//! The study's parameters, its products, and their errors.

use refsim::num::matrix::{Element, MatrixError, MatrixUnit};

use super::blame::{self, Blame};
use super::multiply::{ExactSum, MatrixOperands};
use super::operands::MatrixInput;
use crate::study::precision::{BitScan, Goal};
use crate::study::{ProgressFn, StudyError};

/// Maximum number of depths of a curve.
const POINTS: usize = 8;
/// Maximum number of bits below the largest exponent that the search for the fewest bits tries.
const MAX_BITS: u8 = 40;

/// A product with the units that compute it.
#[derive(Clone, Debug)]
pub struct MatrixProduct {
    /// A and B.
    pub factors: [MatrixInput; 2],
    /// C; zeros if it is `None`.
    pub addend: Option<MatrixInput>,
    /// The units, at least one.
    pub units: Vec<MatrixUnit>,
    /// Types of A and B; by default the first types of each unit.
    pub elements: [Option<Element>; 2],
    /// Number of products after which a partial sum is added to single precision; `None` for one accumulator.
    pub promotions: Vec<Option<usize>>,
    /// Reference unit of the errors; `None` for the exact product of the quantised operands.
    pub against: Option<MatrixUnit>,
    /// Row and column of an element whose sum is followed.
    pub blame: Option<[usize; 2]>,
    /// Bound for the search of the fewest bits and the rarest promotion of the first unit.
    pub goal: Option<Goal>,
}

/// Names of the measures of [`Errors`].
const MEASURES: &str = "worst, mean, bits, of_addends and differing";

/// Errors of all elements. Relative errors are per element, relative to the reference's magnitude.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    /// Largest relative error.
    pub(super) worst: f64,
    /// Mean signed relative error; positive if results are too large.
    pub(super) mean: f64,
    /// Largest error relative to the sum of the magnitudes of an element's addends.
    pub(super) of_addends: f64,
    /// Elements that differ from the reference.
    pub(super) differing: usize,
    /// Elements that are not finite in the product or the reference; the errors exclude them.
    pub(super) not_finite: usize,
}

impl Errors {
    fn of(found: &[f64], reference: &[ExactSum]) -> Self {
        let (mut errors, mut sum) = (Self::default(), 0.0);
        for (&found, reference) in found.iter().zip(reference) {
            let (error, size) = (reference.error(found), reference.value().abs());
            if !error.is_finite() {
                errors.not_finite += 1;
                let [left, right] = [found, reference.value()];
                errors.differing += usize::from(left != right && !(left.is_nan() && right.is_nan()));
                continue;
            }
            errors.differing += usize::from(error != 0.0);
            let share = |of: f64| if error == 0.0 { 0.0 } else { error / of };
            errors.worst = errors.worst.max(share(size).abs());
            errors.of_addends = errors.of_addends.max(share(reference.magnitudes).abs());
            sum += if reference.value() < 0.0 { -share(size) } else { share(size) };
        }
        errors.mean = sum / (found.len() - errors.not_finite).max(1) as f64;
        errors
    }

    /// Correct bits of the worst element.
    pub(super) fn bits(&self) -> f64 {
        0.0 - crate::elementary::ln(self.worst) / std::f64::consts::LN_2
    }

    fn measure(&self, name: &str) -> Option<f64> {
        Some(match name {
            "worst" => self.worst,
            "mean" => self.mean.abs(),
            "bits" => self.bits(),
            "of_addends" => self.of_addends,
            "differing" => self.differing as f64,
            _ => return None,
        })
    }
}

/// A unit with a promotion: errors by depth, and D.
#[derive(Debug)]
pub(super) struct ProductRow {
    pub(super) unit: MatrixUnit,
    pub(super) promote: Option<usize>,
    pub(super) errors: Vec<Errors>,
    pub(super) product: Vec<f64>,
}

/// Everything that was computed.
#[derive(Debug, Default)]
pub(super) struct ProductOutcome {
    pub(super) shape: [usize; 3],
    pub(super) depths: Vec<usize>,
    pub(super) rows: Vec<ProductRow>,
    pub(super) blame: Option<Blame>,
    /// Fewest bits with one accumulator that meet the goal.
    pub(super) fewest_bits: Option<u8>,
    /// Products between promotions: the largest number that meets the goal; the depth for one accumulator.
    pub(super) rarest_promotion: Option<usize>,
}

impl MatrixProduct {
    fn operands(&self, unit: &MatrixUnit) -> Result<MatrixOperands, MatrixError> {
        let [a, b] = &self.factors;
        MatrixOperands::new(*unit, [a, b], self.addend.as_ref(), self.elements)
    }

    pub(super) fn compute(&self, progress: &mut ProgressFn<'_>) -> Result<ProductOutcome, StudyError> {
        if let Some(goal) = self.goal.as_ref().filter(|goal| Errors::default().measure(&goal.measure).is_none()) {
            return Err(StudyError::usage(
                format!("expected a goal of one of {MEASURES}, found `{}`", goal.measure),
                "write it as in `--goal \"worst<=1e-3\"`",
            ));
        }
        let ([rows, depth], columns) = (self.factors[0].shape()?, self.factors[1].shape()?[1]);
        let depths: Vec<usize> = (0..POINTS).rev().map(|half| depth >> half).filter(|&depth| depth > 0).collect();
        let steps = (self.units.len() * self.promotions.len() + 1) as u64;
        let mut outcome =
            ProductOutcome { shape: [rows, depth, columns], depths: depths.clone(), ..ProductOutcome::default() };
        let against = self.against.map(|unit| self.operands(&unit)).transpose()?;
        for (index, unit) in self.units.iter().enumerate() {
            progress(unit.name, outcome.rows.len() as u64, steps);
            let operands = self.operands(unit)?;
            let mut references = operands.exact(&depths);
            if let Some(other) = &against {
                for (&depth, sums) in depths.iter().zip(&mut references) {
                    let product = other.product(&other.unit, depth, None)?;
                    sums.iter_mut().zip(product).for_each(|(sum, value)| *sum = sum.replaced(value));
                }
            }
            for &promote in &self.promotions {
                let mut row = ProductRow { unit: *unit, promote, errors: Vec::new(), product: Vec::new() };
                for (&depth, reference) in depths.iter().zip(&references) {
                    row.product = operands.product(unit, depth, promote)?;
                    row.errors.push(Errors::of(&row.product, reference));
                }
                outcome.rows.push(row);
                progress(unit.name, outcome.rows.len() as u64, steps);
            }
            if let (0, Some(goal), Some(reference)) = (index, &self.goal, references.last()) {
                (outcome.fewest_bits, outcome.rarest_promotion) = search(goal, &operands, reference)?;
            }
            if let (0, Some(place)) = (index, self.blame) {
                outcome.blame = Some(blame::blame(&operands, against.as_ref(), place)?);
            }
        }
        Ok(outcome)
    }
}

/// The fewest bits with one accumulator, and the rarest promotion with the unit's own bits, that meet a goal. Assumes
/// that more bits are never worse.
fn search(
    goal: &Goal,
    operands: &MatrixOperands,
    reference: &[ExactSum],
) -> Result<(Option<u8>, Option<usize>), MatrixError> {
    let (unit, depth) = (operands.unit, operands.a.length);
    let error = |unit: &MatrixUnit, promote| -> Result<f64, MatrixError> {
        let errors = Errors::of(&operands.product(unit, depth, promote)?, reference);
        Ok(errors.measure(&goal.measure).unwrap_or(f64::NAN))
    };
    let mut scan = BitScan::default();
    scan.bisect(1..=MAX_BITS, goal, |bits| {
        unit.with_bits(bits.into()).map_or(Ok(f64::NAN), |unit| error(&unit, None))
    })?;
    let meets = |promote| Ok::<_, MatrixError>(goal.met(error(&unit, promote)?));
    let mut rarest = meets(None)?.then_some(depth);
    let multiple = unit.block.max(operands.a.share);
    let mut step = multiple * (depth / multiple).max(1).next_power_of_two();
    while rarest.is_none() && step >= multiple && unit.result.element == Element::FP32 {
        rarest = (step < depth && meets(Some(step))?).then_some(step);
        step /= 2;
    }
    Ok((scan.smallest, rarest))
}
