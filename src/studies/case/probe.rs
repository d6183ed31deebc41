//! Evaluation of probes.

use refsim::{
    num::{Format, to_f64},
    output::DepthSurface,
    texture::{Image, SignedTexelMinimum},
};
use serde_json::{Value, json};

use super::state::{Probe, ProbeValue};

/// Result of a probe.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeResult {
    /// The probe.
    pub probe: Probe,
    /// Value found.
    pub found: ProbeValue,
    /// `true` if the value found is the expected one.
    pub passed: bool,
}

impl ProbeResult {
    /// Converts the result to JSON.
    pub fn document(&self) -> Value {
        let found = match &self.found {
            ProbeValue::Color(channels) => channels.iter().map(|channel| number_json(*channel)).collect(),
            ProbeValue::Raw(channels) => json!(channels),
            ProbeValue::Depth(depth) => number_json(*depth),
        };
        json!({
            "pixel": self.probe.pixel,
            "target": self.probe.target,
            "expected": self.probe.expected.to_string(),
            "tolerance": self.probe.tolerance,
            "found": found,
            "passed": self.passed,
        })
    }
}

/// Converts a number to JSON; infinity and NaN, which JSON lacks, become strings.
fn number_json(number: f64) -> Value {
    if number.is_finite() { number.into() } else { number.to_string().into() }
}

/// Evaluates a probe on its target, or on the depth buffer.
pub(super) fn answer(
    probe: &Probe,
    target: &Image,
    depth: Option<&DepthSurface>,
    minimum: SignedTexelMinimum,
) -> ProbeResult {
    let [x, y] = probe.pixel;
    let close = |expected: f64, found: f64| {
        expected == found || (expected.is_nan() && found.is_nan()) || (expected - found).abs() <= probe.tolerance
    };
    let (found, passed) = match &probe.expected {
        ProbeValue::Color(expected) => {
            let found = target.texel(0, 0, y, x, minimum).to_f64();
            let passed = expected.iter().zip(found).all(|(&expected, found)| close(expected, found));
            (ProbeValue::Color(found.to_vec()), passed)
        }
        ProbeValue::Raw(expected) => {
            let raw = target.raw(0, 0, y, x);
            let found: Vec<u32> = target.format().record().stored().iter().map(|channel| channel.code(raw)).collect();
            let passed = expected.len() <= found.len() && found.starts_with(expected);
            (ProbeValue::Raw(found), passed)
        }
        ProbeValue::Depth(expected) => {
            // The set-up rejects depth probes without a depth buffer.
            let found = depth.and_then(|surface| {
                let stored = surface.get(x, y)?;
                Some(to_f64(&Format::FP32, surface.format().to_format(stored, Format::FP32)))
            });
            (ProbeValue::Depth(found.unwrap_or(f64::NAN)), found.is_some_and(|found| close(*expected, found)))
        }
    };
    ProbeResult { probe: probe.clone(), found, passed }
}
