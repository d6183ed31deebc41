//! Binding of targets, tests, blending and probes to the emulator's state, and the evaluation of probes.

use std::fmt;

use refsim::{
    num::{Format, to_f64},
    output::{AlphaTest, BlendEquation, BlendState, DepthFormat, DepthState, DepthSurface},
    texture::{Image, SignedTexelMinimum, TexelFormat},
};
use serde_json::{Value, json};
use toml::Spanned;

use super::{
    CaseError,
    binder::Binder,
    schema,
    value::{Number, ONE},
};
use crate::names::did_you_mean;

/// Expected value at a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Probe {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Index of the target.
    pub target: usize,
    /// Expected value.
    pub expected: ProbeValue,
    /// Maximum absolute error of numbers.
    pub tolerance: f64,
}

/// Value at a pixel, expected or found.
#[derive(Clone, Debug, PartialEq)]
pub enum ProbeValue {
    /// Red, green, blue and alpha as numbers, or the first of them.
    Color(Vec<f64>),
    /// Stored channels, compared exactly.
    Raw(Vec<u32>),
    /// Depth as a number.
    Depth(f64),
}

impl fmt::Display for ProbeValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Color(channels) => write!(f, "{channels:?}"),
            Self::Raw(channels) => write!(f, "raw {channels:?}"),
            Self::Depth(depth) => write!(f, "depth {depth:?}"),
        }
    }
}

pub(super) fn targets(binder: &Binder<'_>, target: &schema::TargetTable) -> Result<Vec<TexelFormat>, CaseError> {
    let names = &target.format.get_ref().0;
    if names.is_empty() || names.len() > refsim::output::MAX_TARGETS {
        let message = format!("expected 1 to {} target formats, found {}", refsim::output::MAX_TARGETS, names.len());
        return Err(binder.place.wrong(target.format.span(), message, "write for example `format = \"rgba8\"`"));
    }
    names.iter().map(|name| texel_format(binder, name, target.format.span())).collect()
}

pub(super) fn texel_format(
    binder: &Binder<'_>,
    name: &str,
    span: std::ops::Range<usize>,
) -> Result<TexelFormat, CaseError> {
    name.parse().map_err(|error: refsim::texture::TextureError| {
        let meant = did_you_mean(name, TexelFormat::ALL.iter().map(|format| format.name()));
        let help = format!("{meant}`crossbar devices NAME` lists the formats that a device has");
        binder.place.wrong(span, error.to_string(), help)
    })
}

pub(super) fn write_mask(binder: &Binder<'_>, write: Option<&Spanned<String>>) -> Result<u8, CaseError> {
    let Some(write) = write else { return Ok(0b1111) };
    let mut mask = 0;
    for letter in write.get_ref().chars() {
        let Some(channel) = "rgba".find(letter).filter(|channel| mask >> channel & 1 == 0) else {
            let message = format!("expected some of `rgba`, each once, found `{}`", write.get_ref());
            return Err(binder.place.wrong(write.span(), message, "`write = \"rgb\"` leaves alpha unchanged"));
        };
        mask |= 1 << channel;
    }
    Ok(mask)
}

pub(super) fn depth(binder: &Binder<'_>, depth: &schema::Depth) -> Result<(DepthFormat, u32, DepthState), CaseError> {
    let format = depth.format.as_ref().map_or(Ok(DepthFormat::Unorm24), |format| {
        format.get_ref().parse().map_err(|error: refsim::output::OutputError| {
            binder.place.wrong(format.span(), error.to_string(), "`d24` for example")
        })
    })?;
    if let (None, Some(write)) = (depth.test, depth.write.as_ref().filter(|write| *write.get_ref())) {
        let help = "add `test = \"always\"`: without a test the buffer is neither read nor written";
        return Err(binder.place.wrong(write.span(), "`write = true` without a `test`", help));
    }
    let write = depth.write.as_ref().map_or(depth.test.is_some(), |write| *write.get_ref());
    let state = DepthState { test: depth.test, write };
    let clear = depth.clear.as_ref().map_or(Ok(ONE), |clear| fraction(binder, clear, "a depth"))?;
    Ok((format, clear, state))
}

/// Converts a number from 0 to 1 to an IEEE single.
fn fraction(binder: &Binder<'_>, number: &Spanned<Number>, what: &str) -> Result<u32, CaseError> {
    let value = number.get_ref().double();
    if (0.0..=1.0).contains(&value) {
        return Ok(number.get_ref().single());
    }
    let message = format!("expected {what} from 0 to 1, found {value}");
    Err(binder.place.wrong(number.span(), message, "a card accepts no value outside this range"))
}

pub(super) fn alpha(binder: &Binder<'_>, alpha: &schema::Alpha) -> Result<AlphaTest, CaseError> {
    let reference = fraction(binder, &alpha.reference, "a reference")?;
    Ok(AlphaTest { function: alpha.test, reference })
}

/// Binds blending; alpha is blended like color unless specified.
pub(super) fn blend(blend: &schema::Blend) -> BlendState {
    let color = BlendEquation { source: blend.source, destination: blend.destination, op: blend.operation };
    let alpha = BlendEquation {
        source: blend.alpha_source.unwrap_or(color.source),
        destination: blend.alpha_destination.unwrap_or(color.destination),
        op: blend.alpha_operation.unwrap_or(color.op),
    };
    BlendState { color, alpha }
}

/// Binds the probes; each must lie inside the target and have one expectation.
pub(super) fn probes(
    binder: &Binder<'_>,
    probes: &[Spanned<schema::Probe>],
    size: [u32; 2],
    targets: usize,
    has_depth: bool,
) -> Result<Vec<Probe>, CaseError> {
    let one = |probe: &Spanned<schema::Probe>| {
        let written = probe.get_ref();
        let pixel = written.pixel.get_ref().0;
        if pixel[0] >= size[0] || pixel[1] >= size[1] {
            let message = format!("pixel ({}, {}) is not in a target of {}x{}", pixel[0], pixel[1], size[0], size[1]);
            return Err(binder.place.wrong(written.pixel.span(), message, "columns and rows count from 0"));
        }
        let target = written.target.as_ref().map_or(0, |target| *target.get_ref() as usize);
        if target >= targets {
            let span = written.target.as_ref().map_or(probe.span(), Spanned::span);
            let message = format!("there is no target {target}: the case has {targets}");
            return Err(binder.place.wrong(span, message, "targets count from 0"));
        }
        if let (Some(_), Some(target)) = (written.depth, &written.target) {
            let help = "remove `target`: there is only one depth buffer";
            return Err(binder.place.wrong(target.span(), "both `target` and `depth`", help));
        }
        if let (Some(_), Some(tolerance)) = (&written.raw, &written.tolerance) {
            let help = "`raw` codes are compared exactly: remove `tolerance`, or write `expected` instead of `raw`";
            return Err(binder.place.wrong(tolerance.span(), "both `tolerance` and `raw`", help));
        }
        let expected = expected(binder, probe, has_depth)?;
        let tolerance = written.tolerance.as_ref().map_or(0.0, |tolerance| tolerance.get_ref().double());
        if tolerance.is_nan() || tolerance < 0.0 {
            let span = written.tolerance.as_ref().map_or(probe.span(), Spanned::span);
            return Err(binder.place.wrong(
                span,
                "expected a tolerance of at least 0",
                "remove `tolerance` for a tolerance of 0",
            ));
        }
        Ok(Probe { pixel, target, expected, tolerance })
    };
    probes.iter().map(one).collect()
}

fn expected(binder: &Binder<'_>, probe: &Spanned<schema::Probe>, has_depth: bool) -> Result<ProbeValue, CaseError> {
    let wrong = |message: &str, help: &str| Err(binder.place.wrong(probe.span(), message, help));
    let four = |found: usize, span| {
        let message = format!("expected 1 to 4 channels, found {found}");
        Err(binder.place.wrong(span, message, "write red, green, blue and alpha, or the first of them"))
    };
    let written = probe.get_ref();
    match (&written.expected, &written.raw, written.depth) {
        (Some(color), None, None) => match color.get_ref().len() {
            1..=4 => Ok(ProbeValue::Color(color.get_ref().iter().map(|number| number.double()).collect())),
            found => four(found, color.span()),
        },
        (None, Some(raw), None) => match raw.get_ref().len() {
            1..=4 => Ok(ProbeValue::Raw(raw.get_ref().clone())),
            found => four(found, raw.span()),
        },
        (None, None, Some(depth)) if has_depth => Ok(ProbeValue::Depth(depth.double())),
        (None, None, Some(_)) => wrong("the probe asks for depth, but the case has no depth buffer", "add [depth]"),
        (None, None, None) => wrong("the probe expects nothing", "write `expected`, `raw` or `depth`"),
        _ => wrong("the probe expects several things at once", "write one probe for each"),
    }
}

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
