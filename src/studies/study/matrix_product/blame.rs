//! One element of a product, block by block: the block with the first difference, and the loss of each addend there.

use refsim::num::matrix::{Element, MatrixError};

use super::multiply::MatrixOperands;

/// An addend's exact value, and the value that the unit keeps of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct AddendFate {
    pub(super) unit: &'static str,
    /// Index k of the addend, or `c`, or `result` for the rounding of the block's sum.
    pub(super) addend: String,
    pub(super) exact: f64,
    pub(super) kept: f64,
}

/// Partial sums of a unit and of its reference before index k.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SumsAt {
    pub(super) k: usize,
    pub(super) ours: f64,
    pub(super) theirs: f64,
}

impl SumsAt {
    fn error(self) -> f64 {
        self.ours - self.theirs
    }
}

/// Block where an element's sum first differs from its reference, with one accumulator.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Blame {
    pub(super) place: [usize; 2],
    /// Sums before and after the block; both have the same k if the sums never differ.
    pub(super) block: [SumsAt; 2],
    /// Sums at the end.
    pub(super) end: SumsAt,
    /// Addends in ascending k, the unit's before the reference's; empty for units without an aligned adder.
    pub(super) addends: Vec<AddendFate>,
}

/// Index k and the sum (a word and its type), before each block and after the last.
type Sums = Vec<(usize, (u64, Element))>;

fn trace(operands: &MatrixOperands, [row, column]: [usize; 2]) -> Sums {
    let (unit, depth) = (operands.unit, operands.a.length);
    let [a, b] = [operands.a.row(row, 0, depth), operands.b.row(column, 0, depth)];
    let mut sums = vec![(0, (operands.c[row * operands.b.count() + column], unit.addend))];
    for start in (0..depth).step_by(unit.block) {
        let sum = unit.block_sum(a, b, start, sums[sums.len() - 1].1);
        sums.push(((start + unit.block).min(depth), (sum, unit.result.element)));
    }
    sums
}

/// Follows an element's sum. Against another unit, the block is the first after which the sums differ; against the
/// exact sum, it is the block that adds most to the error.
pub(super) fn blame(
    operands: &MatrixOperands,
    other: Option<&MatrixOperands>,
    place: [usize; 2],
) -> Result<Blame, MatrixError> {
    let size = operands.shape();
    if place[0] >= size[0] || place[1] >= size[1] {
        return Err(MatrixError::new("place of an element", format!("below {size:?}"), format!("{place:?}")));
    }
    let number = |(word, element): (u64, Element)| element.number(word);
    let ours = trace(operands, place);
    let theirs = other.map(|other| trace(other, place));
    // Both sums, at each k where both units end a block.
    let reference: Vec<(usize, f64)> = match &theirs {
        Some(theirs) => theirs.iter().map(|&(k, sum)| (k, number(sum))).collect(),
        None => {
            let depths: Vec<usize> = ours.iter().map(|sum| sum.0).collect();
            let exact = operands.exact_element(place[0] * size[1] + place[1], &depths);
            depths.into_iter().zip(exact.into_iter().map(|sum| sum.value())).collect()
        }
    };
    let both: Vec<SumsAt> = ours
        .iter()
        .filter_map(|&(k, sum)| {
            let theirs = reference.iter().find(|other| other.0 == k)?.1;
            Some(SumsAt { k, ours: number(sum), theirs })
        })
        .collect();
    let growth = |pair: &[SumsAt]| (pair[1].error() - pair[0].error()).abs();
    let mut parted = both.windows(2).filter(|pair| growth(pair) != 0.0);
    let found = match theirs {
        Some(_) => parted.next(),
        None => parted.max_by(|x, y| growth(x).total_cmp(&growth(y))),
    };
    let end = both.last().copied().unwrap_or_default();
    let block = found.map_or([end; 2], |pair| [pair[0], pair[1]]);
    let mut addends = fates(operands, &ours, place, block);
    if let (Some(other), Some(theirs)) = (other, &theirs) {
        addends.extend(fates(other, theirs, place, block));
    }
    Ok(Blame { place, block, end, addends })
}

/// Addends of the blocks within a range of k.
fn fates(operands: &MatrixOperands, sums: &Sums, [row, column]: [usize; 2], range: [SumsAt; 2]) -> Vec<AddendFate> {
    let (unit, depth) = (operands.unit, operands.a.length);
    let [a, b] = [operands.a.row(row, 0, depth), operands.b.row(column, 0, depth)];
    let mut fates = Vec::new();
    for pair in sums.windows(2).filter(|pair| (range[0].k..range[1].k).contains(&pair[0].0)) {
        let (start, sum) = pair[0];
        let Some(addends) = unit.kept(a, b, start, sum) else { continue };
        let total = addends.iter().map(|both| both[1]).sum();
        let last = addends.len() - 1;
        for (at, [exact, kept]) in addends.into_iter().enumerate() {
            let addend = if at == last { "c".to_owned() } else { (start + at).to_string() };
            fates.push(AddendFate { unit: unit.name, addend, exact, kept });
        }
        let kept = pair[1].1.1.number(pair[1].1.0);
        fates.push(AddendFate { unit: unit.name, addend: "result".to_owned(), exact: total, kept });
    }
    fates
}
