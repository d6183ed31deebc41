//! An adapter's own single precision beside IEEE 754, operation by operation: which results have other bits, and which
//! of these WGSL doesn't allow ([`crate::exec::wgsl::accuracy`]), which is a fault of the driver. The executor uses no
//! floats of an adapter; this is for whoever has a GPU or writes a driver for one.

use serde::Serialize;

use super::{Gpu, GpuError};
use crate::exec::wgsl::accuracy::{SingleOperation, allowed, order};
use crate::num::Format;

/// Operand sets of an operation in a full probe.
pub const FULL: usize = 1 << 20;
/// Operand sets of one dispatch.
const BATCH: usize = 1 << 16;
const FP32: Format = Format::FP32;

/// What a probe saw.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProbeReport {
    /// The adapter's name.
    pub adapter: String,
    /// By operation.
    pub operations: Vec<OperationReport>,
}

/// What was seen of one operation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OperationReport {
    /// The operation.
    pub operation: SingleOperation,
    /// Its name in tables.
    pub name: &'static str,
    /// Operands and results that are normal numbers or zero.
    pub normal: Tally,
    /// Some operand, or the exact result, is subnormal.
    pub denormal: Tally,
    /// Some operand, or the exact result, is infinite or NaN.
    pub special: Tally,
}

/// Counts of one class of operands.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Operand sets tried.
    pub tried: u64,
    /// Results with other bits than IEEE 754 has.
    pub different: u64,
    /// Of these, results outside what WGSL allows.
    pub outside: u64,
    /// The largest distance of a number from the right one, in units in the last place.
    pub worst_ulps: u64,
    /// The first difference.
    pub first: Option<ProbeDifference>,
}

/// A result that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProbeDifference {
    /// Bits of the operands.
    pub operands: Vec<u32>,
    /// Bits that the device gave.
    pub got: u32,
    /// Bits of IEEE 754.
    pub want: u32,
    /// Their distance; `None` beside a NaN.
    pub ulps: Option<u64>,
}

impl OperationReport {
    fn new(operation: SingleOperation) -> Self {
        let empty = Tally::default;
        Self { operation, name: operation.name(), normal: empty(), denormal: empty(), special: empty() }
    }

    /// Whether no result differed.
    pub fn exact(&self) -> bool {
        [&self.normal, &self.denormal, &self.special].iter().all(|t| t.different == 0)
    }

    /// Whether no result lay outside what WGSL allows.
    pub fn conforms(&self) -> bool {
        [&self.normal, &self.denormal, &self.special].iter().all(|t| t.outside == 0)
    }
}

impl ProbeReport {
    /// Whether no result lay outside what WGSL allows.
    pub fn conforms(&self) -> bool {
        self.operations.iter().all(OperationReport::conforms)
    }
}

/// Tries every operation on `count` operand sets: all pairs of edge values as far as they fit, then others drawn from a
/// fixed seed. [`FULL`] for a verdict.
///
/// # Errors
/// What the device refuses.
pub fn probe(gpu: &Gpu, count: usize) -> Result<ProbeReport, GpuError> {
    let text = include_str!("probe.wgsl");
    let mut operations = Vec::new();
    for operation in SingleOperation::ALL {
        let mut report = OperationReport::new(operation);
        let mut sets = OperandSets::new(operation);
        let mut left = count;
        while left > 0 {
            let operands: Vec<[u32; 3]> = (0..left.min(BATCH)).map(|_| sets.next()).collect();
            left -= operands.len();
            let word = operation as u32;
            let items: Vec<u32> = operands.iter().flat_map(|&[a, b, c]| [word, a, b, c]).collect();
            let groups = [operands.len().div_ceil(64) as u32, 1, 1];
            let results = gpu.compute(text, "run_probe", &[&items], operands.len(), groups)?;
            for (operands, got) in operands.into_iter().zip(results) {
                note(&mut report, operands, got);
            }
        }
        operations.push(report);
    }
    Ok(ProbeReport { adapter: gpu.adapter().name.clone(), operations })
}

/// Adds a result to the tally that it belongs to.
fn note(report: &mut OperationReport, operands: [u32; 3], got: u32) {
    let operation = report.operation;
    let want = operation.exact(operands);
    let used = &operands[..operation.arity()];
    let integer = operation == SingleOperation::FromInteger;
    let any = |holds: fn(u32) -> bool| holds(want) || (!integer && used.iter().any(|&bits| holds(bits)));
    let tally = if any(|bits| !FP32.is_finite(bits)) {
        &mut report.special
    } else if any(|bits| FP32.is_subnormal(bits)) {
        &mut report.denormal
    } else {
        &mut report.normal
    };
    tally.tried += 1;
    if got == want {
        return;
    }
    tally.different += 1;
    tally.outside += u64::from(!allowed(operation, operands).contains(got));
    let ulps = (!FP32.is_nan(got) && !FP32.is_nan(want)).then(|| order(got).abs_diff(order(want)));
    tally.worst_ulps = tally.worst_ulps.max(ulps.unwrap_or(0));
    tally.first.get_or_insert_with(|| ProbeDifference { operands: used.to_vec(), got, want, ulps });
}

/// Operand sets, the same in every run.
struct OperandSets {
    operation: SingleOperation,
    edges: Vec<u32>,
    made: usize,
    state: u64,
}

impl OperandSets {
    fn new(operation: SingleOperation) -> Self {
        // Zero, smallest and largest subnormal, smallest normal, around one half, one and two, largest, infinity, NaN,
        // and an integer that no longer fits.
        let places: [u32; 12] = [
            0,
            1,
            0x007f_ffff,
            0x0080_0000,
            0x3f00_0000,
            0x3f80_0000,
            0x4000_0000,
            0x4b80_0000,
            0x7f7f_ffff,
            0x7f80_0000,
            0x7fc0_0000,
            0x5f00_0000,
        ];
        let near = places.into_iter().flat_map(|p| [p.saturating_sub(1), p, p + 1]);
        let mut edges: Vec<u32> = near.flat_map(|p| [p, p | 1 << 31]).collect();
        edges.sort_unstable();
        edges.dedup();
        Self { operation, edges, made: 0, state: 0x0070_726f_6265 }
    }

    /// splitmix64
    fn word(&mut self) -> u32 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// Any bits, bits around one (where rounding shows), short significands (where results are exact), edges.
    fn operand(&mut self) -> u32 {
        let word = self.word();
        let kind = self.word() % 8;
        match kind {
            0 => self.edges[word as usize % self.edges.len()],
            1 | 2 => word & 0x81ff_ffff | 0x3e00_0000,
            3 => word & 0xfff8_0000,
            4 => word & 0x80ff_ffff,
            _ => word,
        }
    }

    fn next(&mut self) -> [u32; 3] {
        let count = self.edges.len();
        let at = self.made;
        self.made += 1;
        if self.operation != SingleOperation::FromInteger && at < count * count {
            let third = self.operand();
            return [self.edges[at % count], self.edges[at / count], third];
        }
        [self.operand(), self.operand(), self.operand()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A probe that saw these results: operation, operands, bits.
    fn seen(results: &[(SingleOperation, [u32; 3], u32)]) -> ProbeReport {
        let mut operations: Vec<OperationReport> = SingleOperation::ALL.into_iter().map(OperationReport::new).collect();
        for &(operation, operands, got) in results {
            let report = operations.iter_mut().find(|report| report.operation == operation);
            report.into_iter().for_each(|report| note(report, operands, got));
        }
        ProbeReport { adapter: "made up".to_owned(), operations }
    }

    const THIRD: [u32; 3] = [0x3f80_0000, 0x4040_0000, 0];

    #[test]
    fn results_are_judged_by_ieee_754_and_by_wgsl() {
        let exact = SingleOperation::Div.exact(THIRD);
        let find = |results: &[_], operation| {
            let report = seen(results).operations.into_iter().find(|report| report.operation == operation);
            report.map(|report| (report.exact(), report.conforms()))
        };
        assert_eq!(find(&[(SingleOperation::Div, THIRD, exact)], SingleOperation::Div), Some((true, true)));
        // 2.5 ULPs for a division.
        assert_eq!(find(&[(SingleOperation::Div, THIRD, exact + 2)], SingleOperation::Div), Some((false, true)));
        assert_eq!(find(&[(SingleOperation::Div, THIRD, exact + 4)], SingleOperation::Div), Some((false, false)));
        assert_eq!(find(&[(SingleOperation::Add, THIRD, 0x4080_0003)], SingleOperation::Add), Some((false, false)));
        assert!(!seen(&[(SingleOperation::Add, THIRD, 0x4080_0003)]).conforms());
    }
}
