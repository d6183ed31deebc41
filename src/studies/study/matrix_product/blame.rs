//! One element of a product, block by block: where it parts, and what each addend lost there.

use refsim::num::matrix::{Element, MatrixError};

use super::multiply::{ExactSum, Operands};
use super::operands::{number, power};

/// The fate of an addend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AddendFate {
    pub(super) unit: &'static str,
    /// Its k, or `c`, or `result` for the rounding of the block's sum.
    pub(super) addend: String,
    pub(super) exact: f64,
    pub(super) kept: f64,
}

/// The place where an element first differs from its reference; with one accumulator.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blame {
    pub(super) place: [usize; 2],
    /// First k of the block, and that behind it; equal if the sums never part.
    pub(super) block: [usize; 2],
    /// Sums of the unit and of the reference before the block, and behind it.
    pub(super) sums: [[f64; 2]; 2],
    /// Addends in the order of k, those of the unit first.
    pub(super) addends: Vec<AddendFate>,
}

/// The sum at a k, as the word that enters the block there.
type Sums = Vec<(usize, (u64, Element))>;

/// Sums before each block and behind the last.
fn trace(operands: &Operands, [row, column]: [usize; 2]) -> Sums {
    let (unit, depth) = (operands.unit, operands.a.length);
    let [a, b] = [operands.a.row(row, 0, depth), operands.b.row(column, 0, depth)];
    let c = operands.c[row * operands.columns() + column];
    let mut sum = (super::operands::code(unit.addend, c).unwrap_or(0), unit.addend);
    let mut sums = vec![(0, sum)];
    for start in (0..depth).step_by(unit.block()) {
        sum = (unit.block_sum(a, b, start, sum), unit.result.element());
        sums.push(((start + unit.block()).min(depth), sum));
    }
    sums
}

/// Follows an element. Against another unit, the block is the first behind which the sums differ; against the exact
/// sum, the one that adds most to the error.
pub(super) fn blame(operands: &Operands, other: Option<&Operands>, place: [usize; 2]) -> Result<Blame, MatrixError> {
    let size = [operands.a.count(), operands.columns()];
    if place[0] >= size[0] || place[1] >= size[1] {
        return Err(MatrixError::new("place of an element", format!("below {size:?}"), format!("{place:?}")));
    }
    let value = |(_, (word, element)): &(usize, (u64, Element))| number(*element, *word);
    let ours = trace(operands, place);
    let theirs = other.map(|other| trace(other, place));
    let depths: Vec<usize> = ours.iter().map(|sum| sum.0).collect();
    // Both sums where both are at the end of a block.
    let both: Vec<(usize, [f64; 2])> = match &theirs {
        Some(theirs) => ours
            .iter()
            .filter_map(|sum| Some((sum.0, [value(sum), value(theirs.iter().find(|other| other.0 == sum.0)?)])))
            .collect(),
        None => {
            let element = |sums: Vec<ExactSum>| sums[place[0] * size[1] + place[1]].value();
            let exact = operands.exact(&depths).into_iter().map(element);
            ours.iter().zip(exact).map(|(sum, exact)| (sum.0, [value(sum), exact])).collect()
        }
    };
    let error = |(_, [ours, theirs]): &(usize, [f64; 2])| ours - theirs;
    let steps = || both.windows(2).enumerate();
    let found = match theirs {
        Some(_) => steps().find(|(_, pair)| error(&pair[1]) != 0.0),
        None => steps().filter(|(_, pair)| error(&pair[1]) != error(&pair[0])).max_by(|(_, x), (_, y)| {
            let growth = |pair: &[(usize, [f64; 2])]| (error(&pair[1]) - error(&pair[0])).abs();
            growth(x).total_cmp(&growth(y))
        }),
    };
    let Some((_, [before, behind])) = found.map(|(at, pair)| (at, [pair[0], pair[1]])) else {
        let end = both.last().copied().unwrap_or_default();
        return Ok(Blame { place, block: [end.0; 2], sums: [end.1; 2], addends: Vec::new() });
    };
    let block = [before.0, behind.0];
    let mut addends = fates(operands, &ours, place, block);
    if let (Some(other), Some(theirs)) = (other, &theirs) {
        addends.extend(fates(other, theirs, place, block));
    }
    Ok(Blame { place, block, sums: [before.1, behind.1], addends })
}

/// Addends of the blocks within a range of k; none of units without an aligned adder.
fn fates(operands: &Operands, sums: &Sums, [row, column]: [usize; 2], [first, end]: [usize; 2]) -> Vec<AddendFate> {
    let (unit, depth) = (operands.unit, operands.a.length);
    let [a, b] = [operands.a.row(row, 0, depth), operands.b.row(column, 0, depth)];
    let mut fates = Vec::new();
    for pair in sums.windows(2).filter(|pair| (first..end).contains(&pair[0].0)) {
        let (start, sum) = pair[0];
        let Some((addends, unit_exponent)) = unit.kept(a, b, start, sum) else { continue };
        let signed = |negative: bool, size: f64| if negative { -size } else { size };
        let mut total = 0.0;
        let count = addends.len();
        for (at, (addend, kept)) in addends.into_iter().enumerate() {
            let scale = power(addend.exponent) * power(-addend.fraction.cast_signed());
            let fate = AddendFate {
                unit: unit.name,
                addend: if at + 1 == count { "c".to_owned() } else { (start + at).to_string() },
                exact: signed(addend.negative, addend.magnitude as f64 * scale),
                kept: kept as f64 * power(unit_exponent),
            };
            total += fate.kept;
            fates.push(fate);
        }
        let kept = number(pair[1].1.1, pair[1].1.0);
        fates.push(AddendFate { unit: unit.name, addend: "result".to_owned(), exact: total, kept });
    }
    fates
}
