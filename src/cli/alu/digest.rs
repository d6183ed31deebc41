//! One number for all results of an operation.

use miette::Diagnostic;
use rayon::prelude::*;
use serde_json::json;

use super::operation::Unit;
use crate::cli::{Out, ProgressBar};

/// The widest operands whose pairs are all tried.
const WIDEST: u32 = 16;
/// Rows between two steps of the progress bar.
const ROWS_A_STEP: usize = 64;

const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

#[derive(Debug, thiserror::Error, Diagnostic)]
enum TooMany {
    #[error("expected a format of at most {WIDEST} bits for `--exhaustive`, found `{format}` of {width}")]
    #[diagnostic(code(crossbar::alu::exhaustive), help("feed chosen operands through standard input instead"))]
    Width { format: String, width: u32 },
    #[error("expected an operation of one or two operands for `--exhaustive`, found `{name}` of three")]
    #[diagnostic(code(crossbar::alu::exhaustive), help("feed chosen operands through standard input instead"))]
    Operands { name: &'static str },
}

const fn fold(digest: u64, value: u64) -> u64 {
    (digest ^ value).wrapping_mul(FNV_PRIME)
}

/// Prints the digest over all operands.
pub(super) fn run(unit: &Unit, out: &mut Out) -> miette::Result<()> {
    let format = unit.env.format;
    if unit.op.operands() > 2 {
        return Err(TooMany::Operands { name: unit.op.name() }.into());
    }
    if format.width() > WIDEST {
        return Err(TooMany::Width { format: format.to_string(), width: format.width() }.into());
    }
    let digest = format!("{:#018x}", digest(unit));
    if !out.json() {
        return Ok(out.line(digest)?);
    }
    Ok(out.document(&json!({
        "op": unit.op.name(),
        "format": format.to_string(),
        "to": unit.to.to_string(),
        "digest": digest,
    }))?)
}

/// The rows are computed in parallel and folded in order: no number of threads changes the total.
fn digest(unit: &Unit) -> u64 {
    let patterns = 1_u32 << unit.operand_width();
    let row = |first: u32, value: &dyn Fn(u32) -> [u32; 3]| {
        let index = |b: u32| u64::from(first) * u64::from(patterns) + u64::from(b);
        (0..patterns).fold(FNV_START, |h, b| fold(h, u64::from(unit.evaluate(value(b), index(b)).bits)))
    };
    if unit.op.operands() == 1 {
        return fold(FNV_START, row(0, &|a| [a, 0, 0]));
    }
    let progress = ProgressBar::new("operand pairs", u64::from(patterns).pow(2));
    let mut total = FNV_START;
    let firsts: Vec<u32> = (0..patterns).collect();
    for some in firsts.chunks(ROWS_A_STEP) {
        let rows: Vec<u64> = some.par_iter().map(|&a| row(a, &|b| [a, b, 0])).collect();
        total = rows.into_iter().fold(total, fold);
        progress.advance(some.len() as u64 * u64::from(patterns));
    }
    total
}
