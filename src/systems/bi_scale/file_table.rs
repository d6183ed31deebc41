//! Tables of values in `.prt` files: the nearest f64 of each number, then those that no f64 holds as odd integers times
//! powers of two.

use num_bigint::{BigInt, Sign};

use super::exact::ExactNumber;
use super::values::{EntryValues, ValueTable};
use crate::error::InputError;
use crate::transfer::file::read::Reader;

/// Bits of the largest sums of f64 numbers, from 2^-1074 on: of 2^32 numbers below 2^1024, and a sign.
const MOST_BITS: u64 = 1074 + 1024 + 32;

/// The bytes of a table; `None` for values without one.
pub(super) fn table_bytes(values: &EntryValues) -> Option<Vec<u8>> {
    let table = values.table()?;
    let positives = table.nearest.len() - table.negatives;
    let counts = [table.negatives, positives, table.wide.len()].map(|count| count as u32);
    let mut bytes: Vec<u8> = counts.into_iter().flat_map(u32::to_le_bytes).collect();
    bytes.extend(table.nearest.iter().flat_map(|value| value.to_le_bytes()));
    for (index, number) in &table.wide {
        let whole = number.whole().to_signed_bytes_le();
        bytes.extend(index.to_le_bytes());
        bytes.extend(number.exponent().to_le_bytes());
        bytes.extend((whole.len() as u16).to_le_bytes());
        bytes.extend(whole);
    }
    Some(bytes)
}

/// Reads a table; numbers are in increasing order, none is 0, and those that an f64 holds are not given as integers.
pub(super) fn table_of(reader: &mut Reader<'_>, fraction_bits: Option<u32>) -> Result<EntryValues, InputError> {
    let what = "table of values";
    let mut counts = [0; 3];
    for count in &mut counts {
        *count = reader.integer(what)? as usize;
    }
    let [negatives, positives, wide_count] = counts;
    let count = negatives.saturating_add(positives);
    if i32::try_from(count).is_err() || wide_count > count {
        let found = format!("{count} with {wide_count} integers");
        return Err(reader.field(what, format!("at most {} numbers", i32::MAX), found));
    }
    let nearest = reader.doubles(count, what)?;
    let mut wide = Vec::new();
    for _ in 0..wide_count {
        let index = reader.integer(what)?;
        let exponent = i32::from_le_bytes(reader.array(what)?);
        let length = u16::from_le_bytes(reader.array(what)?);
        let bytes = reader.take(length.into(), what)?;
        let whole = BigInt::from_signed_bytes_le(bytes);
        let top = i64::from(exponent) + whole.bits().cast_signed();
        let is_in_range = exponent >= ExactNumber::LEAST_EXPONENT && top <= MOST_BITS.cast_signed() - 1074;
        let is_normal = whole.bit(0) && whole.to_signed_bytes_le() == bytes;
        let number = ExactNumber::new(whole, if is_in_range { exponent } else { 0 });
        let is_there = nearest.get(index as usize).is_some_and(|nearest| *nearest == number.nearest());
        if !(is_in_range && is_normal && is_there && number.double().is_none()) {
            return Err(reader.field(what, "odd integers times powers of two that no double holds", "others"));
        }
        wide.push((index, number));
    }
    let is_wide = |index: usize| wide.binary_search_by_key(&(index as u32), |(index, _)| *index).is_ok();
    let is_finite = (0..count).all(|index| nearest[index].is_finite() || is_wide(index));
    if !is_finite || !wide.is_sorted_by(|a, b| a.0 < b.0) {
        return Err(reader.field(what, "finite numbers, integers by increasing places", "others"));
    }
    let values = EntryValues::of_table(fraction_bits, ValueTable { negatives, nearest, wide });
    let numbers = values.numbers().unwrap_or_default();
    let has_sign = |(entry, number): &(i32, ExactNumber)| {
        number.whole().sign() == if *entry < 0 { Sign::Minus } else { Sign::Plus }
    };
    if !numbers.is_sorted_by(|a, b| a.1 < b.1) || !numbers.iter().all(has_sign) {
        return Err(reader.field(what, "increasing numbers, those below 0 counted", "others"));
    }
    Ok(values)
}
