//! Products of matrices in matrix units: sixteen columns at a time, in code that the compiler turns into vector
//! instructions. Written apart from [`crate::num::matrix`], which defines every bit.

use super::SimdLevel;
use crate::num::matrix::{Element, MatrixUnit, Operand, ResultFormat, Rule, Value};

/// Columns that are computed at once.
const WIDTH: usize = 16;
/// Products that are added in 32 bits: each is below `2^27`, being below 4 in units of `2^-25`.
const CHUNK: usize = 16;
/// The most bits below the largest exponent that fit.
const MAX_BITS: u32 = 25;
/// Exponent of zeros, below that of all products.
const ZERO: i32 = -1 << 20;

/// Rows of A or columns of B, each along k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatrixRows {
    /// Type of the numbers.
    pub element: Element,
    /// Numbers of a row, at least 1.
    pub length: usize,
    /// Patterns, row after row.
    pub codes: Vec<u64>,
    /// Patterns of the scales, row after row; empty without.
    pub scales: Vec<u8>,
    /// Numbers of a row that share a scale, at least 1.
    pub share: usize,
}

impl MatrixRows {
    /// Number of rows.
    pub fn count(&self) -> usize {
        self.codes.len() / self.length.max(1)
    }

    /// The first `depth` numbers of a row behind `start`, with their scales. `start` is a multiple of the numbers that
    /// share a scale.
    pub fn row(&self, row: usize, start: usize, depth: usize) -> Operand<'_> {
        let codes = &self.codes[row * self.length + start..][..depth];
        let first = row * self.length.div_ceil(self.share) + start / self.share;
        let scales = if self.scales.is_empty() { &[] } else { &self.scales[first..][..depth.div_ceil(self.share)] };
        Operand { element: self.element, codes, scales }
    }
}

/// The numbers of a fast adder: signed magnitudes and exponents.
#[derive(Clone, Copy)]
struct Adder {
    block: usize,
    bits: i32,
    least: i32,
    /// Fraction bits of a product.
    fraction: i32,
    result: ResultFormat,
}

/// Columns of B, unpacked once: sixteen of them side by side.
#[derive(Debug)]
pub struct MatrixColumns<'a> {
    unit: MatrixUnit,
    columns: &'a MatrixRows,
    /// By group of columns, then k.
    magnitudes: Vec<[i32; WIDTH]>,
    exponents: Vec<[i32; WIDTH]>,
    /// By group: `true` if a number of it is none, which is left to the definition.
    special: Vec<bool>,
}

/// Signed magnitude and exponent of each number, with its scale; `None` if one is no number.
fn unpacked(unit: &MatrixUnit, row: Operand<'_>) -> Option<Vec<(i32, i32)>> {
    let scale = |k: usize| -> Option<i32> {
        let Some(scaling) = unit.scaling else { return Some(0) };
        match scaling.decode(row.scales[k / scaling.block]) {
            Value::Finite(scale) => Some(scale.exponent),
            _ => None,
        }
    };
    let number = |(k, &code): (usize, &u64)| match (row.element.decode(code), scale(k)?) {
        (Value::Finite(x), _) if x.magnitude == 0 => Some((0, ZERO)),
        (Value::Finite(x), scale) => {
            let size = x.magnitude as i32;
            Some((if x.negative { -size } else { size }, x.exponent + scale))
        }
        _ => None,
    };
    row.codes.iter().enumerate().map(number).collect()
}

impl<'a> MatrixColumns<'a> {
    /// Unpacks columns for a unit that takes their type.
    pub fn new(unit: MatrixUnit, columns: &'a MatrixRows) -> Self {
        let depth = columns.length;
        let groups = columns.count().div_ceil(WIDTH);
        let mut made = Self {
            unit,
            columns,
            magnitudes: vec![[0; WIDTH]; groups * depth],
            exponents: vec![[ZERO; WIDTH]; groups * depth],
            special: vec![false; groups],
        };
        if made.adder(columns.element).is_none() {
            return made;
        }
        for column in 0..columns.count() {
            let (group, lane) = (column / WIDTH, column % WIDTH);
            match unpacked(&unit, columns.row(column, 0, depth)) {
                None => made.special[group] = true,
                Some(numbers) => {
                    for (k, (magnitude, exponent)) in numbers.into_iter().enumerate() {
                        made.magnitudes[group * depth + k][lane] = magnitude;
                        made.exponents[group * depth + k][lane] = exponent;
                    }
                }
            }
        }
        made
    }

    /// The unit's adder, if it is one that is computed here.
    fn adder(&self, a: Element) -> Option<Adder> {
        let Rule::Aligned { block, bits, least } = self.unit.rule else { return None };
        let fits = bits <= MAX_BITS && self.unit.addend == self.unit.result.element();
        let fraction = (a.fraction_bits + self.columns.element.fraction_bits).cast_signed();
        fits.then_some(Adder { block, bits: bits.cast_signed(), least, fraction, result: self.unit.result })
    }

    /// The row of D for a row of A and one of C: words of the result, as [`MatrixUnit::dot`] gives them, over `depth`
    /// products behind `start`, which is a multiple of the block. `c` holds a pattern for each column.
    pub fn multiply(&self, a: &MatrixRows, row: usize, start: usize, depth: usize, c: &[u64]) -> Vec<u64> {
        let operand = a.row(row, start, depth);
        let defined = |column: usize| self.unit.dot(operand, self.columns.row(column, start, depth), c[column]);
        let count = self.columns.count();
        let adder = self.adder(a.element);
        let Some((adder, numbers)) = adder.and_then(|adder| Some((adder, unpacked(&self.unit, operand)?))) else {
            return (0..count).map(defined).collect();
        };
        let mut sums = Vec::with_capacity(count);
        for group in 0..count.div_ceil(WIDTH) {
            let lanes = group * WIDTH..count.min((group + 1) * WIDTH);
            if self.special[group] {
                sums.extend(lanes.map(defined));
                continue;
            }
            let mut words = [0; WIDTH];
            words[..lanes.len()].copy_from_slice(&c[lanes.clone()]);
            let first = group * self.columns.length + start;
            let (magnitudes, exponents) = (&self.magnitudes[first..][..depth], &self.exponents[first..][..depth]);
            SimdLevel::widest().run(
                #[inline(always)]
                || chain(&adder, &numbers, magnitudes, exponents, &mut words),
            );
            sums.extend_from_slice(&words[..lanes.len()]);
        }
        sums
    }
}

/// All blocks of sixteen elements of D.
#[inline(always)]
fn chain(adder: &Adder, a: &[(i32, i32)], b: &[[i32; WIDTH]], exponents: &[[i32; WIDTH]], words: &mut [u64; WIDTH]) {
    let layout = Layout::of(adder.result);
    let blocks = a.chunks(adder.block).zip(b.chunks(adder.block)).zip(exponents.chunks(adder.block));
    for ((a, b), exponents) in blocks {
        let mut top = [adder.least; WIDTH];
        for lane in 0..WIDTH {
            top[lane] = top[lane].max(layout.exponent(words[lane]));
        }
        for (&(_, e), exponents) in a.iter().zip(exponents) {
            for lane in 0..WIDTH {
                top[lane] = top[lane].max(e + exponents[lane]);
            }
        }
        let mut total = [0_i64; WIDTH];
        for ((a, b), exponents) in a.chunks(CHUNK).zip(b.chunks(CHUNK)).zip(exponents.chunks(CHUNK)) {
            let part = chunk(adder, a, b, exponents, &top);
            for lane in 0..WIDTH {
                total[lane] += i64::from(part[lane]);
            }
        }
        for lane in 0..WIDTH {
            words[lane] = layout.finish(adder, words[lane], total[lane], top[lane]);
        }
    }
}

/// The sum of up to sixteen products, cut below `top`.
#[inline(always)]
fn chunk(
    adder: &Adder,
    a: &[(i32, i32)],
    b: &[[i32; WIDTH]],
    exponents: &[[i32; WIDTH]],
    top: &[i32; WIDTH],
) -> [i32; WIDTH] {
    let up = (adder.bits - adder.fraction).max(0).cast_unsigned();
    let down = (adder.fraction - adder.bits).max(0);
    let mut sum = [0_i32; WIDTH];
    for ((&(m, e), b), exponents) in a.iter().zip(b).zip(exponents) {
        for lane in 0..WIDTH {
            let product = m * b[lane];
            let sign = product >> 31;
            let size = ((product ^ sign) - sign).cast_unsigned() << up;
            let cut = (top[lane] - e - exponents[lane] + down).cast_unsigned().min(31);
            let kept = (size >> cut).cast_signed();
            sum[lane] += (kept ^ sign) - sign;
        }
    }
    sum
}

/// Fields of the words of a result.
#[derive(Clone, Copy)]
struct Layout {
    fraction: i32,
    /// Fraction bits of results, fewer in e8m13.
    kept: i32,
    least: i32,
    infinity: u64,
    sign: u32,
    nearest: bool,
}

impl Layout {
    #[inline(always)]
    fn of(result: ResultFormat) -> Self {
        match result {
            ResultFormat::Nearest16 => {
                Self { fraction: 10, kept: 10, least: -14, infinity: 0x7c00, sign: 15, nearest: true }
            }
            _ => {
                let kept = if result == ResultFormat::Cut22 { 13 } else { 23 };
                Self { fraction: 23, kept, least: -126, infinity: 0x7f80_0000, sign: 31, nearest: false }
            }
        }
    }

    /// Exponent of an addend; [`ZERO`] of zeros.
    #[inline(always)]
    fn exponent(self, word: u64) -> i32 {
        let size = word & ((1 << self.sign) - 1);
        let exponent = self.least + ((size >> self.fraction) as i32).max(1) - 1;
        if size == 0 { ZERO } else { exponent }
    }

    /// The result of a block: `total * 2^(top - bits)` and the addend `c`.
    #[inline(always)]
    fn finish(self, adder: &Adder, c: u64, total: i64, top: i32) -> u64 {
        let size = c & ((1 << self.sign) - 1);
        if size >= self.infinity {
            return if size > self.infinity { (1 << self.sign) - 1 } else { c };
        }
        let field = size >> self.fraction;
        let significand = size & ((1 << self.fraction) - 1) | u64::from(field != 0) << self.fraction;
        // 35 bits more than the fraction: the largest `bits` is within them.
        let cut = (top - self.exponent(c) + 35 - adder.bits + self.fraction).clamp(0, 63);
        let kept = ((significand << 35) >> cut).cast_signed();
        let sum = total + if c >> self.sign == 0 { kept } else { -kept };
        if sum == 0 {
            return 0;
        }
        let size = sum.unsigned_abs();
        let unit = top - adder.bits;
        let exponent = (63 - size.leading_zeros().cast_signed() + unit).max(self.least);
        let dropped = exponent - self.kept - unit;
        let mut digits = if dropped <= 0 { size << -dropped } else { size >> dropped.min(63) };
        if self.nearest && dropped > 0 {
            let shift = dropped.min(62);
            let (rest, half) = (size & ((1 << shift) - 1), 1 << (shift - 1));
            digits += u64::from(rest > half || rest == half && digits & 1 == 1);
        }
        let word = ((exponent - self.least) as u64) << self.kept;
        let word = ((word + digits) << (self.fraction - self.kept)).min(self.infinity);
        if word == 0 { 0 } else { word | u64::from(sum < 0) << self.sign }
    }
}
