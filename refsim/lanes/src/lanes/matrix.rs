//! Products of matrices in matrix units: sixteen columns at a time, in code that the compiler turns into vector
//! instructions. Independent of [`crate::num::matrix`], which defines every bit.

use std::ops::Range;

use super::SimdLevel;
use crate::num::matrix::{Element, MatrixUnit, Operand, Rule, Value};
use crate::num::{FormatKind, Rounding};

/// Columns that are computed at once.
const WIDTH: usize = 16;
/// Number of products added in 32 bits: each is below 4 in units of `2^-25`, so below `2^27`.
const CHUNK: usize = 16;
/// The most bits below the largest exponent that 32-bit sums can keep.
const MAX_BITS: u32 = 25;
/// Exponent of zeros. The sum of two such exponents is below the exponents of all products, and fits the type.
const ZERO: i16 = -1 << 13;

/// Rows of A or columns of B, each along k.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MatrixRows {
    /// Type of the numbers.
    pub element: Element,
    /// Count of numbers per row, at least 1.
    pub length: usize,
    /// Patterns, row after row.
    pub codes: Vec<u64>,
    /// Patterns of the scales, row by row; empty if there are no scales.
    pub scales: Vec<u8>,
    /// Count of consecutive numbers that share a scale, at least 1.
    pub share: usize,
}

impl MatrixRows {
    /// Number of rows.
    pub fn count(&self) -> usize {
        self.codes.len() / self.length.max(1)
    }

    /// `depth` numbers of a row from index `start` on, with their scales. `start` is a multiple of `share`.
    pub fn row(&self, row: usize, start: usize, depth: usize) -> Operand<'_> {
        let codes = &self.codes[row * self.length + start..][..depth];
        let first = row * self.length.div_ceil(self.share) + start / self.share;
        let scales = if self.scales.is_empty() { &[] } else { &self.scales[first..][..depth.div_ceil(self.share)] };
        Operand { element: self.element, codes, scales }
    }
}

/// A fast adder, and the layout of its result words.
#[derive(Clone, Copy)]
struct Adder {
    block: usize,
    bits: i32,
    /// Least exponent that addends are aligned to.
    least: i32,
    product_fraction: i32,
    /// Fraction bits of a word, and how many of them a result keeps.
    fraction: i32,
    kept: i32,
    least_result: i32,
    infinity: u64,
    sign: u32,
    nearest: bool,
}

/// An unpacked number: signed magnitude of at most 11 bits, and exponent.
type Unpacked = (i16, i16);
/// Sixteen numbers with the same k: magnitudes, then exponents.
type Lanes = [[i16; WIDTH]; 2];

/// Columns of B, unpacked once: sixteen of them side by side.
#[derive(Debug)]
pub struct MatrixColumns<'a> {
    unit: MatrixUnit,
    columns: &'a MatrixRows,
    /// Decoded numbers for all patterns of the unit's types of up to 16 bits; `None` for infinities and NaN.
    tables: Vec<(Element, Vec<Option<Unpacked>>)>,
    /// Numbers by group of columns, then k.
    numbers: Vec<Lanes>,
    /// Per group of columns: `true` if a number is NaN or infinite; [`crate::num::matrix`] computes such a group.
    special: Vec<bool>,
}

fn unpack(element: Element, code: u64) -> Option<Unpacked> {
    match element.decode(code) {
        Value::Finite(x) if x.magnitude == 0 => Some((0, ZERO)),
        Value::Finite(x) => {
            let size = x.magnitude as i16;
            Some((if x.negative { -size } else { size }, x.exponent as i16))
        }
        _ => None,
    }
}

impl<'a> MatrixColumns<'a> {
    /// Unpacks columns for a unit that accepts their type.
    pub fn new(unit: MatrixUnit, columns: &'a MatrixRows) -> Self {
        let depth = columns.length;
        let groups = columns.count().div_ceil(WIDTH);
        let mut made = Self { unit, columns, tables: Vec::new(), numbers: Vec::new(), special: vec![false; groups] };
        if made.adder(columns.element).is_none() {
            return made;
        }
        let short = unit.operands.iter().filter(|element| element.width() <= 16);
        let table =
            |&element: &Element| (element, (0..1 << element.width()).map(|code| unpack(element, code)).collect());
        made.tables = short.map(table).collect();
        made.numbers = vec![[[0; WIDTH], [ZERO; WIDTH]]; groups * depth];
        for column in 0..columns.count() {
            let (group, lane) = (column / WIDTH, column % WIDTH);
            let Some(numbers) = made.unpacked(columns.row(column, 0, depth)) else {
                made.special[group] = true;
                continue;
            };
            for (lanes, (magnitude, exponent)) in made.numbers[group * depth..].iter_mut().zip(numbers) {
                (lanes[0][lane], lanes[1][lane]) = (magnitude, exponent);
            }
        }
        made
    }

    /// The numbers of a row, multiplied by their scales; `None` if one is NaN or infinite.
    fn unpacked(&self, row: Operand<'_>) -> Option<Vec<Unpacked>> {
        let table = self.tables.iter().find(|(element, _)| *element == row.element);
        let numbers: Option<Vec<Unpacked>> = match table {
            Some((_, table)) => row.codes.iter().map(|&code| table[code as usize & (table.len() - 1)]).collect(),
            None => row.codes.iter().map(|&code| unpack(row.element, code)).collect(),
        };
        let Some((share, scale)) = self.unit.scaling else { return numbers };
        let mut numbers = numbers?;
        for (numbers, &code) in numbers.chunks_mut(share).zip(row.scales) {
            let Value::Finite(scale) = scale.decode(code.into()) else { return None };
            numbers.iter_mut().filter(|number| number.0 != 0).for_each(|number| number.1 += scale.exponent as i16);
        }
        Some(numbers)
    }

    /// The unit's adder; `None` if this module does not implement it.
    fn adder(&self, a: Element) -> Option<Adder> {
        let MatrixUnit { rule: Rule::Aligned { least }, bits: Some(bits), block, result, .. } = self.unit else {
            return None;
        };
        let format = result.element.format?;
        let FormatKind::Float { man_bits: kept, .. } = result.format.kind else { return None };
        let fits = bits <= MAX_BITS && self.unit.addend == result.element;
        fits.then_some(Adder {
            block,
            bits: bits.cast_signed(),
            least,
            product_fraction: (a.fields().1 + self.columns.element.fields().1).cast_signed(),
            fraction: result.element.fields().1.cast_signed(),
            kept: kept.into(),
            least_result: format.exponents().0,
            infinity: format.infinity(false)?.into(),
            sign: format.width() - 1,
            nearest: result.format.rounding == Rounding::NearestEven,
        })
    }

    /// Computes rows of D for rows of A, as words of [`MatrixUnit::dot`], over `depth` products from index `start` on,
    /// a multiple of the block size. `c` holds a pattern for each element of these rows of D.
    pub fn multiply(&self, a: &MatrixRows, rows: Range<usize>, start: usize, depth: usize, c: &[u64]) -> Vec<u64> {
        let count = self.columns.count();
        let mut sums = c.to_vec();
        let adder = self.adder(a.element);
        let numbers: Vec<Option<Vec<Unpacked>>> =
            rows.clone().map(|row| adder.and_then(|_| self.unpacked(a.row(row, start, depth)))).collect();
        for group in 0..count.div_ceil(WIDTH) {
            let lanes = group * WIDTH..count.min((group + 1) * WIDTH);
            let is_fast = |numbers: &Option<Vec<Unpacked>>| numbers.is_some() && !self.special[group];
            for (place, row) in rows.clone().enumerate().filter(|&(place, _)| !is_fast(&numbers[place])) {
                for column in lanes.clone() {
                    let sum = &mut sums[place * count + column];
                    *sum = self.unit.dot(a.row(row, start, depth), self.columns.row(column, start, depth), *sum);
                }
            }
            let Some(adder) = adder else { continue };
            let fast: Vec<(usize, &[Unpacked])> = numbers
                .iter()
                .enumerate()
                .filter(|(_, numbers)| is_fast(numbers))
                .filter_map(|(place, numbers)| Some((place, numbers.as_deref()?)))
                .collect();
            let mut words = vec![[0; WIDTH]; fast.len()];
            for ((place, _), words) in fast.iter().zip(&mut words) {
                words[..lanes.len()].copy_from_slice(&sums[place * count..][lanes.clone()]);
            }
            let b = self.numbers.get(group * self.columns.length + start..).unwrap_or_default();
            SimdLevel::widest().run(
                #[inline(always)]
                || chains(&adder, &fast, &b[..depth.min(b.len())], &mut words),
            );
            for ((place, _), words) in fast.iter().zip(&words) {
                sums[place * count..][lanes.clone()].copy_from_slice(&words[..lanes.len()]);
            }
        }
        sums
    }
}

/// Computes D in blocks of sixteen columns: a block of B stays in the cache while all rows of A are multiplied.
#[inline(always)]
fn chains(adder: &Adder, rows: &[(usize, &[Unpacked])], b: &[Lanes], words: &mut [[u64; WIDTH]]) {
    for (at, b) in b.chunks(adder.block).enumerate() {
        for ((_, a), words) in rows.iter().zip(words.iter_mut()) {
            block(adder, &a[at * adder.block..][..b.len()], b, words);
        }
    }
}

/// One block of sixteen elements of D.
#[inline(always)]
fn block(adder: &Adder, a: &[Unpacked], b: &[Lanes], words: &mut [u64; WIDTH]) {
    let mut top = [adder.least; WIDTH];
    for lane in 0..WIDTH {
        top[lane] = top[lane].max(adder.exponent(words[lane]));
    }
    for (&(_, e), [_, exponents]) in a.iter().zip(b) {
        for lane in 0..WIDTH {
            top[lane] = top[lane].max(i32::from(e) + i32::from(exponents[lane]));
        }
    }
    let mut total = [0_i64; WIDTH];
    for (a, b) in a.chunks(CHUNK).zip(b.chunks(CHUNK)) {
        let part = chunk(adder, a, b, &top);
        for lane in 0..WIDTH {
            total[lane] += i64::from(part[lane]);
        }
    }
    for lane in 0..WIDTH {
        words[lane] = adder.finish(words[lane], total[lane], top[lane]);
    }
}

/// The sum of up to sixteen products, each truncated to the adder's bits below `top`.
#[inline(always)]
fn chunk(adder: &Adder, a: &[Unpacked], b: &[Lanes], top: &[i32; WIDTH]) -> [i32; WIDTH] {
    let up = (adder.bits - adder.product_fraction).max(0).cast_unsigned();
    let down = (adder.product_fraction - adder.bits).max(0);
    let mut sum = [0_i32; WIDTH];
    for (&(m, e), [magnitudes, exponents]) in a.iter().zip(b) {
        let (m, e) = (i32::from(m), i32::from(e) - down);
        for lane in 0..WIDTH {
            let product = m * i32::from(magnitudes[lane]);
            let sign = product >> 31;
            let size = ((product ^ sign) - sign).cast_unsigned() << up;
            let cut = (top[lane] - e - i32::from(exponents[lane])).cast_unsigned().min(31);
            let kept = (size >> cut).cast_signed();
            sum[lane] += (kept ^ sign) - sign;
        }
    }
    sum
}

impl Adder {
    /// Exponent of an addend; [`i32::MIN`] / 2 for zeros.
    #[inline(always)]
    fn exponent(self, word: u64) -> i32 {
        let size = word & ((1 << self.sign) - 1);
        let exponent = self.least_result + ((size >> self.fraction) as i32).max(1) - 1;
        if size == 0 { i32::MIN / 2 } else { exponent }
    }

    /// The result of a block: `total * 2^(top - bits)` and the addend `c`.
    #[inline(always)]
    fn finish(self, c: u64, total: i64, top: i32) -> u64 {
        let size = c & ((1 << self.sign) - 1);
        if size >= self.infinity {
            return if size > self.infinity { (1 << self.sign) - 1 } else { c };
        }
        let field = size >> self.fraction;
        let significand = size & ((1 << self.fraction) - 1) | u64::from(field != 0) << self.fraction;
        // The magnitude has 35 more bits than the fraction; every unit's `bits` is less than 35.
        let cut = (top - self.exponent(c) + 35 - self.bits + self.fraction).clamp(0, 63);
        let kept = ((significand << 35) >> cut).cast_signed();
        let sum = total + if c >> self.sign == 0 { kept } else { -kept };
        if sum == 0 {
            return 0;
        }
        let size = sum.unsigned_abs();
        let unit = top - self.bits;
        let exponent = (63 - size.leading_zeros().cast_signed() + unit).max(self.least_result);
        let dropped = exponent - self.kept - unit;
        let mut digits = if dropped <= 0 { size << -dropped } else { size >> dropped.min(63) };
        if self.nearest && dropped > 0 {
            let shift = dropped.min(62);
            let (rest, half) = (size & ((1 << shift) - 1), 1 << (shift - 1));
            digits += u64::from(rest > half || rest == half && digits & 1 == 1);
        }
        let word = ((exponent - self.least_result) as u64) << self.kept;
        let word = ((word + digits) << (self.fraction - self.kept)).min(self.infinity);
        if word == 0 { 0 } else { word | u64::from(sum < 0) << self.sign }
    }
}
