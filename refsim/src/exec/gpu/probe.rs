//! Whether an adapter's own single precision is IEEE 754, bit for bit, operation by operation.
//!
//! Native mode uses those operations of the device that this found exact. Where they aren't, results are compared inside the
//! interval that WGSL allows ([`crate::exec::wgsl::accuracy`]).

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
