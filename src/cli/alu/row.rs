//! Operations on lines of many numbers: dot products, instructions on vectors, and conversions to and from blocks with
//! a shared scale.

use std::io::Read;

use refsim::device::SumRules;
use refsim::num::{DotOrder, Env, Flags, Format, block::BLOCK, block::BlockFormat, ops};

use super::line::{digits, fields, hex, other_fields, push_hex};
use super::operation::VectorOperation;
use super::stream::{TaskOutput, written};
use crate::cli::Out;
use crate::error::InputError;

/// The operation on a line.
#[derive(Clone, Copy, Debug)]
pub(super) enum RowOperation {
    /// A block of numbers.
    Quantize(BlockFormat),
    /// The numbers of a block.
    Dequantize(BlockFormat),
    /// The sum of the products of neighboring numbers, in an accumulator with this format.
    Dot(DotOrder, Format),
    /// An instruction on vectors.
    Vector(VectorOperation, SumRules),
}

/// An operation on lines of numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowUnit {
    pub(super) operation: RowOperation,
    /// The format of plain numbers.
    pub(super) env: Env,
}

/// The patterns of a line, and the union of the flags that they raise.
#[derive(Debug, PartialEq, Eq)]
struct Converted {
    /// The scale of a quantized block.
    scale: Option<u32>,
    patterns: Vec<u32>,
    flags: Flags,
}

impl RowUnit {
    /// Converts line `number` (counted from 1); `None` if it is blank.
    fn convert(&self, text: &[u8], number: u64) -> Result<Option<Converted>, InputError> {
        let fields: Vec<&[u8]> = fields(text).collect();
        if fields.is_empty() {
            return Ok(None);
        }
        let count = fields.len();
        let (fits, expected) = match self.operation {
            RowOperation::Quantize(_) => (count <= BLOCK, "1 to 32 numbers"),
            RowOperation::Dequantize(_) => ((2..=BLOCK + 1).contains(&count), "a scale and 1 to 32 elements"),
            RowOperation::Dot(..) => (count <= 2 * BLOCK && count.is_multiple_of(2), "1 to 32 pairs of numbers"),
            RowOperation::Vector(operation, _) => {
                let (words, expected) = operation.words();
                (count == words, expected)
            }
        };
        if !fits {
            return Err(other_fields(number, expected, count));
        }
        let read = |fields: &[&[u8]], format: Format| -> Result<Vec<u32>, InputError> {
            fields.iter().map(|field| hex(field, format.width(), number)).collect()
        };
        let plain = self.env.format;
        Ok(Some(match self.operation {
            RowOperation::Quantize(block) => {
                let made = block.quantize(&plain, &read(&fields, plain)?);
                Converted { scale: Some(made.scale), patterns: made.elements, flags: made.flags }
            }
            RowOperation::Dequantize(block) => {
                let scale = hex(fields[0], Format::E8M0.width(), number)?;
                let outcomes = block.dequantize(self.env, scale, &read(&fields[1..], block.element())?);
                let flags = outcomes.iter().fold(Flags::empty(), |flags, outcome| flags | outcome.flags);
                let patterns = outcomes.into_iter().map(|outcome| outcome.bits).collect();
                Converted { scale: None, patterns, flags }
            }
            RowOperation::Vector(operation, sums) => {
                let outcomes = operation.evaluate(self.env, sums, &read(&fields, plain)?);
                let flags = outcomes.iter().fold(Flags::empty(), |flags, outcome| flags | outcome.flags);
                let patterns = outcomes.into_iter().map(|outcome| outcome.bits).collect();
                Converted { scale: None, patterns, flags }
            }
            RowOperation::Dot(order, accumulator) => {
                let terms: Vec<(u32, u32)> =
                    read(&fields, plain)?.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
                let accumulator = accumulator.tininess(self.env.tininess);
                let outcome = ops::dot_accumulated(self.env, accumulator, order, &terms);
                Converted { scale: None, patterns: vec![outcome.bits], flags: outcome.flags }
            }
        }))
    }

    /// Width of a pattern of the result, in bits.
    fn width(&self) -> u32 {
        match self.operation {
            RowOperation::Quantize(block) => block.element().width(),
            RowOperation::Dequantize(_) | RowOperation::Dot(..) | RowOperation::Vector(..) => self.env.format.width(),
        }
    }

    fn push(&self, text: &mut Vec<u8>, converted: &Converted, flags: bool) {
        if let Some(scale) = converted.scale {
            push_hex(text, scale, Format::E8M0.width());
            text.push(b' ');
        }
        for (i, &pattern) in converted.patterns.iter().enumerate() {
            text.extend((i > 0).then_some(b' '));
            push_hex(text, pattern, self.width());
        }
        if flags {
            text.push(b' ');
            push_hex(text, converted.flags.bits().into(), 8);
        }
        text.push(b'\n');
    }

    fn push_json(&self, text: &mut Vec<u8>, converted: &Converted, flags: bool) {
        let patterns: Vec<String> = converted.patterns.iter().map(|&bits| digits(bits, self.width())).collect();
        let mut record = match converted.scale {
            Some(scale) => {
                serde_json::json!({ "scale": digits(scale, Format::E8M0.width()), "elements": patterns })
            }
            None => serde_json::json!({ "results": patterns }),
        };
        if flags {
            record["flags"] = digits(converted.flags.bits().into(), 8).into();
        }
        text.extend_from_slice(record.to_string().as_bytes());
        text.push(b'\n');
    }
}

/// Writes the result of every line.
pub(super) fn run(unit: &RowUnit, flags: bool, input: impl Read, out: &mut Out) -> miette::Result<()> {
    let json = out.json();
    let work = |part: &mut TaskOutput, text: &[u8], number: u64| {
        let Some(converted) = unit.convert(text, number)? else { return Ok(()) };
        if json {
            unit.push_json(&mut part.text, &converted, flags);
        } else {
            unit.push(&mut part.text, &converted, flags);
        }
        Ok(())
    };
    written(input, out, work)
}
