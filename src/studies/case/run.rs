//! Execution of a case.

use refsim::{
    device::{Profile, Rates},
    event::DrawEvents,
    machine::Executor,
    num::Format,
    output::DepthSurface,
    texture::{ChannelClass, ChannelValue, Image, SignedTexelMinimum},
};
use serde_json::{Map, Value, json};

use super::{
    CaseError, Loaded, ProbeResult, Setup,
    state::{self, Probe},
};
use crate::error::InputError;
use crate::{
    picture::{ChannelUnit, Picture, Rgba, Samples, buffer, exr, png},
    report::NamedFile,
    shader,
};

/// Result of a case.
#[derive(Clone, Debug)]
pub struct CaseOutcome {
    /// Every target, and the depth buffer, as a picture.
    pub pictures: Vec<NamedFile>,
    /// Results of the probes, in their order.
    pub probes: Vec<ProbeResult>,
    /// Counts of the draw, by name: its events, then the instruction slots of its pixel program.
    pub counts: Vec<(&'static str, u64)>,
}

impl CaseOutcome {
    /// The result of a draw, from its events, its targets and its depth buffer. Fails if a picture cannot be encoded.
    pub fn new(
        setup: &Setup,
        events: &DrawEvents,
        surfaces: &[&Image],
        depth: Option<&DepthSurface>,
    ) -> Result<Self, CaseError> {
        let [width, height] = setup.size;
        let minimum = setup.profile.rules.signed_texel_minimum;
        let mut pictures = Vec::new();
        for (index, surface) in surfaces.iter().enumerate() {
            pictures.push(picture_of(&format!("target{index}"), surface, minimum)?);
        }
        if let Some(surface) = depth {
            let single = |&stored: &u32| f32::from_bits(surface.format().to_format(stored, Format::FP32));
            let values: Vec<f32> = surface.data().iter().map(single).collect();
            let picture = Picture::new(width, height).with("depth", ChannelUnit::Unknown, Samples::Float(values))?;
            pictures.push(("depth.exr".to_owned(), exr(&picture)?));
        }
        let answer = |question: &Probe| state::answer(question, surfaces[question.target], depth, minimum);
        let (cost, shaded) = (shader::slots(&setup.pixel), events.fragments.shaded);
        let (texture, arithmetic) = (u64::from(cost.texture), u64::from(cost.arithmetic));
        let mut counts = event_counts(events).to_vec();
        counts.push(("texture slots a fragment", texture));
        counts.push(("arithmetic slots a fragment", arithmetic));
        counts.push(("shader slots", (texture + arithmetic).saturating_mul(shaded)));
        let cycles = pipe_cycles(texture, arithmetic, shaded, &setup.profile.rates);
        counts.extend(cycles.map(|cycles| ("pixel pipe cycles, at least", cycles)));
        Ok(Self { pictures, probes: setup.probes.iter().map(answer).collect(), counts })
    }

    /// Returns `true` if every probe passed.
    pub fn passed(&self) -> bool {
        self.probes.iter().all(|result| result.passed)
    }

    /// JSON document: the device with its switches, counts, probes.
    pub fn document(&self, setup: &Setup) -> Value {
        let counts: Map<String, Value> =
            self.counts.iter().map(|(name, number)| (name.replace(' ', "_"), (*number).into())).collect();
        let profile = &setup.profile;
        json!({
            "title": setup.title,
            "version": env!("CARGO_PKG_VERSION"),
            "device": profile.name,
            "format": profile.rules.format.to_string(),
            "switches": switches_json(profile),
            "counts": counts,
            "probes": self.probes.iter().map(ProbeResult::document).collect::<Vec<_>>(),
            "passed": self.passed(),
        })
    }
}

pub(super) fn event_counts(events: &DrawEvents) -> [(&'static str, u64); 15] {
    [
        ("vertices", events.vertices),
        ("vertex instructions", events.vertex_instructions),
        ("triangles assembled", events.primitives.assembled),
        ("triangles culled", events.primitives.culled),
        ("triangles clipped", events.primitives.clipped),
        ("triangles rasterised", events.primitives.rasterised),
        ("fragments generated", events.fragments.generated),
        ("fragments shaded", events.fragments.shaded),
        ("fragments killed", events.fragments.killed),
        ("alpha test failed", events.fragments.alpha_failed),
        ("depth test failed", events.fragments.depth_failed),
        ("fragments passed", events.fragments.passed),
        ("texture reads", events.fragments.total_fetches()),
        ("bytes read", events.bytes.read()),
        ("bytes written", events.bytes.written()),
    ]
}

pub(super) fn switches_json(profile: &Profile) -> Map<String, Value> {
    profile.switches().iter().map(|switch| (switch.name.clone(), switch.current.clone().into())).collect()
}

/// Draws the case. Fails if the device cannot execute the case, or a picture cannot be encoded.
pub fn run(setup: &Setup, executor: impl Into<Executor>) -> Result<CaseOutcome, CaseError> {
    let mut loaded = Loaded::new(setup, executor)?;
    let events = loaded.draw()?;
    CaseOutcome::new(setup, &events, &loaded.targets()?, loaded.depth()?)
}

/// Minimum number of clocks at the profile's issue rates, if texture and arithmetic slots issue in parallel, every
/// pipeline is always busy, and memory takes no time.
fn pipe_cycles(texture: u64, arithmetic: u64, fragments: u64, rates: &Rates) -> Option<u64> {
    let clocks = |slots: u64, rate: Option<u64>| Some(slots.div_ceil(rate.filter(|r| *r > 0)?));
    let fragment = clocks(texture, rates.texture_reads_per_clock)?.max(clocks(arithmetic, rates.alu_pairs_per_clock)?);
    clocks(fragments.saturating_mul(fragment.max(1)), rates.pixel_pipes)
}

/// Encodes a target as PNG if its channels are unsigned fractions, otherwise as EXR in single precision.
fn picture_of(stem: &str, target: &Image, minimum: SignedTexelMinimum) -> Result<NamedFile, InputError> {
    let (width, height) = (target.width(), target.height());
    let record = target.format().record();
    let texels =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| target.texel(0, 0, y, x, minimum));
    if record.stored().iter().all(|channel| channel.class == ChannelClass::Unorm) {
        let deep = record.stored().iter().any(|channel| channel.bits > 8);
        let bytes = if deep {
            let samples = texels.flat_map(|texel| texel.0.map(|c| scaled(c, 65535) as u16)).collect();
            png(&buffer::<Rgba<u16>>(width, height, samples)?)?
        } else {
            let samples = texels.flat_map(|texel| texel.0.map(|c| scaled(c, 255) as u8)).collect();
            png(&buffer::<Rgba<u8>>(width, height, samples)?)?
        };
        return Ok((format!("{stem}.png"), bytes));
    }
    let values: Vec<[f32; 4]> = texels.map(|texel| texel.to_format(Format::FP32).map(f32::from_bits)).collect();
    let mut picture = Picture::new(width, height);
    for (channel, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
        let plane = Samples::Float(values.iter().map(|value| value[channel]).collect());
        picture = picture.with(name, ChannelUnit::Unknown, plane)?;
    }
    Ok((format!("{stem}.exr"), exr(&picture)?))
}

/// Returns the integer k for which `k / most` is nearest to an unsigned fraction.
fn scaled(value: ChannelValue, most: u64) -> u64 {
    match value {
        ChannelValue::Ratio { numerator, denominator } => {
            let (k, n) = (numerator.max(0).unsigned_abs(), u64::from(denominator));
            ((2 * k * most + n) / (2 * n)).min(most)
        }
        ChannelValue::Float { .. } => 0,
    }
}
