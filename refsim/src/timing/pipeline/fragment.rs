//! Cost of a fragment in a pixel pipeline.

use crate::device::Rates;
use crate::event::{ArithmeticSlot, PhaseWork, ProgramWork, SamplerRecord, TextureSlot};
use crate::isa::Opcode;
use crate::timing::Clocks;

/// Bytes of a texel in the default 32-bit format.
pub(super) const PLAIN_TEXEL: u64 = 4;

/// Busy clocks of a pipeline's units per fragment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FragmentClocks {
    /// Clocks of arithmetic.
    pub arithmetic: Clocks,
    /// Clocks of texture issue.
    pub textures: Clocks,
    /// `true` if arithmetic and textures alternate; else they overlap, on different fragments.
    pub takes_turns: bool,
}

impl FragmentClocks {
    /// Clocks from one fragment to the next.
    pub fn total(&self) -> Clocks {
        if self.takes_turns { self.arithmetic + self.textures } else { self.arithmetic.max(self.textures) }
    }
}

/// Arithmetic work of a phase, in clocks at one slot per clock.
#[derive(Clone, Copy, Debug, Default)]
struct FragmentWork {
    float: u64,
    /// Fixed-point multiplications, two per clock and unit; `operations` are the other fixed-point operations, one per
    /// clock.
    multiplications: u64,
    operations: u64,
}

/// Clocks per fragment. A phase is one pass through the units, with an integer number of clocks in each; a program
/// takes at least one clock. Samplers that are not listed read 32-bit texels.
pub fn fragment_clocks(program: &ProgramWork, samplers: &[SamplerRecord], rates: &Rates) -> FragmentClocks {
    let takes_turns = rates.texture_blocks_arithmetic == Some(1);
    let (mut arithmetic, mut textures) = (0_u64, 0_u64);
    for phase in &program.phases {
        let reads = texture_clocks(phase, samplers, rates);
        let blocked = if takes_turns { reads } else { 0 };
        arithmetic = arithmetic.saturating_add(arithmetic_clocks(phase, blocked, rates));
        textures = textures.saturating_add(reads);
    }
    let pressed = |clocks| under_pressure(clocks, program.live_halves, rates);
    FragmentClocks { arithmetic: Clocks(pressed(arithmetic).max(1)), textures: Clocks(pressed(textures)), takes_turns }
}

/// Arithmetic clocks of a phase. Fixed-point units, if any, work while the float unit is busy (including `blocked`
/// clocks of texture reads); the float unit takes over a share of the remaining fixed-point work.
fn arithmetic_clocks(phase: &PhaseWork, blocked: u64, rates: &Rates) -> u64 {
    let units = rates.fixed_units.unwrap_or(0);
    let mut work = FragmentWork::default();
    for slot in &phase.arithmetic {
        let clocks = slot_clocks(slot, rates).saturating_mul(slot.times);
        let sum = match (slot.fixed && units > 0, slot.opcode) {
            (false, _) => &mut work.float,
            (true, Opcode::Mul) => &mut work.multiplications,
            (true, _) => &mut work.operations,
        };
        *sum = sum.saturating_add(clocks);
    }
    let float = work.float.div_ceil(rates.alu_pairs_per_clock.unwrap_or(1).max(1));
    float.saturating_add(taken_over(&work, float.saturating_add(blocked), units))
}

/// Clocks of the float unit for fixed-point work, after `busy` clocks of its own, so that the fixed-point units finish
/// at the same time. Operations are moved to the float unit first, because one counts as two multiplications.
fn taken_over(work: &FragmentWork, busy: u64, units: u64) -> u64 {
    // Work in units of multiplications. The fixed-point units perform `done` of them per clock.
    let [operations, multiplications, done] =
        [work.operations, work.multiplications, units.saturating_mul(2)].map(u128::from);
    let meanwhile = done * u128::from(busy);
    let left = (2 * operations + multiplications).saturating_sub(meanwhile);
    let clocks = left.div_ceil(2 + done);
    let clocks = match clocks > operations {
        true => (operations + multiplications).saturating_sub(meanwhile).div_ceil(1 + done),
        false => clocks,
    };
    u64::try_from(clocks).unwrap_or(u64::MAX)
}

/// Clocks of a slot in a unit that issues one slot per clock.
fn slot_clocks(slot: &ArithmeticSlot, rates: &Rates) -> u64 {
    let first = listed(slot.opcode, rates).unwrap_or(u64::from(slot.slots));
    let Some(partner) = slot.partner else { return first };
    let second = listed(partner, rates).unwrap_or(u64::from(slot.slots));
    if slot.independent && rates.automatic_pairs != Some(1) { first + second } else { first.max(second) }
}

fn listed(opcode: Opcode, rates: &Rates) -> Option<u64> {
    rates.instruction_clocks.get(opcode.info().mnemonic).map(|&n| u64::from(n))
}

/// Texture clocks of a phase: interpolated and dependent reads at their own rates. Texture instructions that read no
/// texel occupy the unit too.
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
    let levels = if bound.is_some_and(|s| s.trilinear) { rates.trilinear_clocks.unwrap_or(1) } else { 1 };
    issue.max(1).saturating_mul(wide.max(1)).saturating_mul(levels.max(1))
}

/// NV30: every two live fp32 registers above the full-speed number add a percentage of the clocks.
fn under_pressure(clocks: u64, live_halves: u32, rates: &Rates) -> u64 {
    let (Some(free), Some(step)) = (rates.full_speed_registers, rates.register_step_percent) else { return clocks };
    // Two registers are four halves.
    let steps = u64::from(live_halves).saturating_sub(free.saturating_mul(2)).div_ceil(4);
    let percent = 100 + u128::from(steps) * u128::from(step);
    u64::try_from((u128::from(clocks) * percent).div_ceil(100)).unwrap_or(u64::MAX)
}
