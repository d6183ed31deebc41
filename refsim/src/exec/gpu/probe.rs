//! Compares an adapter's own single precision with IEEE 754, operation by operation: reports results that differ, and
//! those that WGSL doesn't allow ([`crate::exec::wgsl::accuracy`]), which are driver bugs. The executor uses no floats
//! of the adapter; the probe is a tool for users and writers of drivers.

use serde::Serialize;

use super::{Gpu, GpuError};
use crate::exec::wgsl::accuracy::{SingleOperation, allowed, order};
use crate::num::Format;

/// Operand sets per operation in a full probe.
pub const FULL: usize = 1 << 20;
/// Operand sets per dispatch.
const BATCH: usize = 1 << 16;
const FP32: Format = Format::FP32;

/// Result of a probe.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProbeReport {
    /// Name of the adapter.
    pub adapter: String,
    /// Results by operation.
    pub operations: Vec<OperationReport>,
}

/// Results of one operation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OperationReport {
    /// The operation.
    pub operation: SingleOperation,
    /// Name in tables.
    pub name: &'static str,
    /// Cases whose operands and exact result are normal numbers or zero.
    pub normal: Tally,
    /// Cases with a subnormal operand or exact result.
    pub denormal: Tally,
    /// Cases with an infinite or NaN operand or exact result.
    pub special: Tally,
}

/// Counts of one class of cases.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Operand sets tested.
    pub tried: u64,
    /// Results that differ from IEEE 754.
    pub different: u64,
    /// Of these, results that WGSL does not allow.
    pub outside: u64,
    /// Largest error, in units in the last place.
    pub worst_ulps: u64,
    /// The first difference.
    pub first: Option<ProbeDifference>,
}

/// A result that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ProbeDifference {
    /// Operands, as bits.
    pub operands: Vec<u32>,
    /// Result of the adapter, as bits.
    pub got: u32,
    /// Result of IEEE 754, as bits.
    pub want: u32,
    /// Error in units in the last place; `None` if one of them is NaN.
    pub ulps: Option<u64>,
}

impl OperationReport {
    fn new(operation: SingleOperation) -> Self {
        let empty = Tally::default;
        Self { operation, name: operation.name(), normal: empty(), denormal: empty(), special: empty() }
    }

    /// Returns `true` if no result differs from IEEE 754.
    pub fn exact(&self) -> bool {
        [&self.normal, &self.denormal, &self.special].iter().all(|t| t.different == 0)
    }

    /// Returns `true` if WGSL allows all results.
    pub fn conforms(&self) -> bool {
        [&self.normal, &self.denormal, &self.special].iter().all(|t| t.outside == 0)
    }
}

impl ProbeReport {
    /// Returns `true` if WGSL allows all results.
    pub fn conforms(&self) -> bool {
        self.operations.iter().all(OperationReport::conforms)
    }
}

/// Tests every operation on `count` operand sets: first all pairs of edge cases, then pseudo-random ones from a fixed
/// seed. Use [`FULL`] for a verdict.
///
/// # Errors
/// Errors of the device.
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

/// Adds a result to its tally.
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

/// Deterministic sequence of operand sets.
struct OperandSets {
    operation: SingleOperation,
    edges: Vec<u32>,
    made: usize,
    state: u64,
}

impl OperandSets {
    fn new(operation: SingleOperation) -> Self {
        // Zero, smallest and largest subnormal, smallest normal, around one half, one and two, largest, infinity, NaN,
        // and an integer beyond 24 bits.
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

    /// Next word of splitmix64.
    fn word(&mut self) -> u32 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// Random bits, numbers near one (for rounding), short significands (for exact results), or edge cases.
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

    /// A report of these results: operation, operands, bits.
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
