//! Whether an adapter's own single precision is IEEE 754, bit for bit, operation by operation.
//!
//! Native mode uses those operations of the device that this found exact, and integers for the others: so its results have the
//! very bits of IEEE 754 on every adapter. What an operation may give that isn't exact is the interval that WGSL allows
//! ([`crate::exec::wgsl::accuracy`]); a result outside it is a fault of the driver.

use serde::Serialize;

use super::{Gpu, GpuError};
use crate::exec::wgsl::accuracy::{SingleOperation, allowed, order};
use crate::exec::wgsl::number::{NativeOperations, NumberMode, library};
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
    pub first: Option<Difference>,
}

/// A result that differs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Difference {
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
    /// The operations that native mode may leave to the device: those whose every result was right.
    pub fn native(&self) -> NativeOperations {
        let mut native = NativeOperations::all();
        for report in self.operations.iter().filter(|r| !r.exact()) {
            native.remove(report.operation.native());
        }
        native
    }

    /// The operations that differ from IEEE 754 somewhere.
    pub fn differing(&self) -> impl Iterator<Item = &OperationReport> {
        self.operations.iter().filter(|report| !report.exact())
    }

    /// Says which operations differ, what becomes of that, and where the adapter leaves WGSL; `None` if none does.
    pub fn departures(&self) -> Option<String> {
        let names = |of: &mut dyn Iterator<Item = &OperationReport>| of.map(|r| r.name).collect::<Vec<_>>().join(", ");
        let differing = names(&mut self.differing());
        if differing.is_empty() {
            return None;
        }
        let outside = names(&mut self.differing().filter(|report| !report.conforms()));
        let within = match outside.as_str() {
            "" => "within what WGSL allows".to_owned(),
            outside => format!("outside of what WGSL allows in {outside}"),
        };
        let adapter = &self.adapter;
        Some(format!(
            "in the floats of {adapter}, results of {differing} differ from IEEE 754, {within}; native mode computes them by integers"
        ))
    }

    /// Whether a result of the adapter's own floats may stand: an operation that the probe found exact must give the bits of
    /// IEEE 754, one that it found to differ a result in the interval that WGSL allows.
    pub fn accepts(&self, operation: SingleOperation, operands: [u32; 3], got: u32) -> bool {
        let differs = self.differing().any(|report| report.operation == operation);
        got == operation.exact(operands) || (differs && allowed(operation, operands).contains(got))
    }

    /// Whether no result lay outside what WGSL allows.
    pub fn conforms(&self) -> bool {
        self.operations.iter().all(OperationReport::conforms)
    }
}

/// Tries every operation on `count` operand sets: all pairs of edge values as far as they fit, then others drawn from a fixed
/// seed. [`FULL`] for a verdict.
///
/// # Errors
/// What the device refuses.
pub fn probe(gpu: &Gpu, count: usize) -> Result<ProbeReport, GpuError> {
    let text = library(NumberMode::Native, NativeOperations::all()) + include_str!("probe.wgsl");
    let mut operations = Vec::new();
    for operation in SingleOperation::ALL {
        let mut report = OperationReport::new(operation);
        let mut drawn = Drawn::new(operation);
        let mut left = count;
        while left > 0 {
            let operands: Vec<[u32; 3]> = (0..left.min(BATCH)).map(|_| drawn.next()).collect();
            left -= operands.len();
            let word = operation.operation().word();
            let items: Vec<u32> = operands.iter().flat_map(|&[a, b, c]| [word, a, b, c]).collect();
            let groups = [operands.len().div_ceil(64) as u32, 1, 1];
            let results = gpu.compute(&text, "run_probe", &[&items], operands.len(), groups)?;
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
    tally.first.get_or_insert_with(|| Difference { operands: used.to_vec(), got, want, ulps });
}

/// Operand sets, the same in every run.
struct Drawn {
    operation: SingleOperation,
    edges: Vec<u32>,
    made: usize,
    state: u64,
}

impl Drawn {
    fn new(operation: SingleOperation) -> Self {
        // Zero, smallest and largest subnormal, smallest normal, around one half, one and two, largest, infinity, NaN, and
        // an integer that no longer fits.
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
    fn an_exact_adapter_owes_the_very_bits() {
        let exact = SingleOperation::Div.exact(THIRD);
        let report = seen(&[(SingleOperation::Div, THIRD, exact)]);
        assert_eq!((report.departures(), report.native()), (None, NativeOperations::all()));
        assert!(report.accepts(SingleOperation::Div, THIRD, exact));
        assert!(!report.accepts(SingleOperation::Div, THIRD, exact + 1));
    }

    #[test]
    fn operations_that_differ_are_named_and_held_to_their_interval() {
        let exact = SingleOperation::Div.exact(THIRD);
        let report = seen(&[(SingleOperation::Div, THIRD, exact + 2), (SingleOperation::Add, THIRD, 0x4080_0000)]);
        assert_eq!(
            report.departures().as_deref(),
            Some(
                "in the floats of made up, results of div differ from IEEE 754, within what WGSL allows; native mode computes them \
                 by integers"
            )
        );
        assert_eq!(report.native(), NativeOperations::all().difference(NativeOperations::DIV));
        // 2.5 ULPs for a division; nothing for what the probe found exact.
        assert!(report.accepts(SingleOperation::Div, THIRD, exact + 2));
        assert!(!report.accepts(SingleOperation::Div, THIRD, exact + 4));
        assert!(!report.accepts(SingleOperation::Add, THIRD, 0x4080_0001));
    }

    #[test]
    fn results_outside_of_wgsl_are_named() {
        let report = seen(&[(SingleOperation::Add, THIRD, 0x4080_0003), (SingleOperation::Min, [0, 1 << 31, 0], 0)]);
        let text = report.departures().unwrap_or_default();
        assert!(text.contains("outside of what WGSL allows in add;"), "{text}");
        assert!(!report.conforms() && !report.native().contains(NativeOperations::ADD));
    }
}
