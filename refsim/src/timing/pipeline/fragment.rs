//! One fragment in a pixel pipeline.

use crate::device::Rates;
use crate::event::{ArithmeticSlot, MipKind, PhaseWork, ProgramWork, SamplerRecord, TextureSlot};
use crate::isa::Opcode;
use crate::timing::Clocks;

/// Bytes of a plain texel.
const PLAIN_TEXEL: u64 = 4;

/// How long one fragment keeps the units of its pipeline busy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentClocks {
    /// Arithmetic.
    pub arithmetic: Clocks,
    /// Texture issue.
    pub textures: Clocks,
    /// Whether the two take turns; else they work side by side, on different fragments.
    pub takes_turns: bool,
}

impl FragmentClocks {
    /// From one fragment to the next.
    pub fn total(&self) -> Clocks {
        if self.takes_turns { self.arithmetic + self.textures } else { self.arithmetic.max(self.textures) }
    }
}

/// The clocks of a fragment. A phase is a pass through the units, and takes whole clocks of each; a program takes at least
/// one. Of samplers that are not named, plain 32-bit texels are taken.
pub fn fragment_clocks(program: &ProgramWork, samplers: &[SamplerRecord], rates: &Rates) -> FragmentClocks {
    let (mut arithmetic, mut textures) = (0_u64, 0_u64);
    for phase in &program.phases {
        arithmetic = arithmetic.saturating_add(arithmetic_clocks(phase, rates));
        textures = textures.saturating_add(texture_clocks(phase, samplers, rates));
    }
    let pressed = |clocks| under_pressure(clocks, program.live_halves, rates);
    FragmentClocks {
        arithmetic: Clocks(pressed(arithmetic).max(1)),
        textures: Clocks(pressed(textures)),
        takes_turns: rates.texture_blocks_arithmetic == Some(1),
    }
}

/// Slots over slots a clock.
fn arithmetic_clocks(phase: &PhaseWork, rates: &Rates) -> u64 {
    let slots = phase.arithmetic.iter().fold(0_u64, |sum, slot| {
        let once = slot_clocks(slot, rates);
        sum.saturating_add(once.saturating_mul(slot.times))
    });
    slots.div_ceil(rates.alu_pairs_per_clock.unwrap_or(1).max(1))
}

/// Clocks of a slot in a unit that issues one a clock.
fn slot_clocks(slot: &ArithmeticSlot, rates: &Rates) -> u64 {
    let first = listed(slot.opcode, rates).unwrap_or(u64::from(slot.slots));
    let Some(partner) = slot.partner else { return first };
    let second = listed(partner, rates).unwrap_or(u64::from(slot.slots));
    if slot.independent && rates.automatic_pairs != Some(1) { first + second } else { first.max(second) }
}

fn listed(opcode: Opcode, rates: &Rates) -> Option<u64> {
    rates.instruction_clocks.get(opcode.info().mnemonic).map(|&n| u64::from(n))
}

/// Reads with interpolated coordinates at one rate, dependent ones at theirs; a texture instruction that reads no texel
/// takes its place in the unit all the same.
fn texture_clocks(phase: &PhaseWork, samplers: &[SamplerRecord], rates: &Rates) -> u64 {
    let plain_rate = rates.texture_reads_per_clock.unwrap_or(1).max(1);
    let dependent_rate = rates.dependent_reads_per_clock.unwrap_or(plain_rate).max(1);
    let (mut plain, mut dependent) = (0_u64, 0_u64);
    for slot in &phase.textures {
        let clocks = read_clocks(slot, samplers, rates).saturating_mul(slot.times);
        let sum = if slot.dependent { &mut dependent } else { &mut plain };
        *sum = sum.saturating_add(clocks);
    }
    let work = u128::from(plain) * u128::from(dependent_rate) + u128::from(dependent) * u128::from(plain_rate);
    u64::try_from(work.div_ceil(u128::from(plain_rate) * u128::from(dependent_rate))).unwrap_or(u64::MAX)
}

/// Clocks of a read in one texture unit.
fn read_clocks(slot: &TextureSlot, samplers: &[SamplerRecord], rates: &Rates) -> u64 {
    let issue = listed(slot.opcode, rates).unwrap_or(1);
    let Some(number) = slot.sampler else { return issue };
    let bound = samplers.iter().find(|s| s.sampler == number);
    let texel = bound.map_or(PLAIN_TEXEL, |s| s.texel_bytes.into());
    let wide = texel.div_ceil(rates.texel_bytes_per_clock.unwrap_or(PLAIN_TEXEL).max(1));
    let levels = match bound.map(|s| s.mip) {
        Some(MipKind::Linear) => rates.trilinear_clocks.unwrap_or(1),
        _ => 1,
    };
    issue.max(1).saturating_mul(wide.max(1)).saturating_mul(levels.max(1))
}

/// NV30: every two fp32 registers beyond those at full speed add a share of the clocks.
fn under_pressure(clocks: u64, live_halves: u32, rates: &Rates) -> u64 {
    let (Some(free), Some(step)) = (rates.full_speed_registers, rates.register_step_percent) else { return clocks };
    // Two registers are four halves.
    let steps = u64::from(live_halves).saturating_sub(free.saturating_mul(2)).div_ceil(4);
    let percent = 100 + u128::from(steps) * u128::from(step);
    u64::try_from((u128::from(clocks) * percent).div_ceil(100)).unwrap_or(u64::MAX)
}
