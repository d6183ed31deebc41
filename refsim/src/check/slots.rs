//! V04: instruction slots.

use super::RuleId;
use super::allowed::Limit;
use super::context::{Context, ordinal};
use crate::isa::{Instruction, Opcode, SlotCost, Span, Stage, Usage, Version};

/// Slots used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlotCount {
    /// Texture instruction slots.
    pub texture: u32,
    /// Arithmetic instruction slots (flow control included).
    pub arithmetic: u32,
}

pub(super) fn check(context: &mut Context<'_>) {
    let phases: &[u8] = match (context.version, context.phase_marker()) {
        (Version::Ps1_4, Some(_)) => &[1, 2],
        (Version::Ps1_4, None) => &[2],
        _ => &[1],
    };
    for &phase in phases {
        budget(context, phase, Limit::TextureInstructions, "texture instructions", |c| u32::from(c.texture));
        budget(context, phase, Limit::ArithmeticInstructions, "arithmetic instruction slots", |c| {
            u32::from(c.arithmetic)
        });
    }
    if context.version != Version::Ps1_4 {
        budget(context, 1, Limit::Instructions, "instruction slots", |c| {
            u32::from(c.texture) + u32::from(c.arithmetic)
        });
    }
}

fn budget(context: &mut Context<'_>, phase: u8, limit: Limit, what: &str, slots: impl Fn(SlotCost) -> u32) {
    let Some(allowed) = context.limit(limit) else { return };
    let mut used = 0_u32;
    let mut first: Option<(Span, u32)> = None;
    for (index, instruction) in context.instructions() {
        if context.phase(index) != phase {
            continue;
        }
        used = used.saturating_add(slots(cost(context, index, instruction)));
        if used > allowed.value && first.is_none() {
            first = Some((instruction.span, used));
        }
    }
    let Some((span, number)) = first else { return };
    let place = if context.version == Version::Ps1_4 { format!(" in phase {phase}") } else { String::new() };
    let message = format!("program uses {used} {what}{place}, {} allows {}", allowed.owner, allowed.value);
    let label = match limit {
        Limit::TextureInstructions => format!("the {} texture instruction{place}", ordinal(number)),
        _ => format!("slot {number}{place}"),
    };
    let advice = match (context.version, phase) {
        (Version::Ps1_4, 2) if context.phase_marker().is_none() => "split the program with `phase`",
        (Version::Ps1_4, _) => "move work into the other phase, pair .rgb with .a, or split into passes",
        _ => "split the program into passes",
    };
    context.breach(RuleId::TooManyInstructions, span, message).label(label).exceeds(used, &allowed, advice);
}

/// Slots of an instruction in context: the second instruction of a pair adds only its cost beyond the first's; in
/// ps_2_x predicates and cube maps cost extra.
fn cost(context: &Context<'_>, index: usize, instruction: &Instruction) -> SlotCost {
    let version = context.version;
    let mut cost = instruction.opcode.info().slot_cost(version);
    if instruction.coissue && index > 0 && context.is_sound(index - 1) {
        let partner = context.program.instructions[index - 1].opcode.info().slot_cost(version);
        cost.arithmetic = cost.arithmetic.saturating_sub(partner.arithmetic);
    }
    if version.is_ps_2_x() {
        let cube = context.sampled_usage(instruction) == Some(Usage::SamplerCube);
        match instruction.opcode {
            Opcode::TexLd if cube => cost.texture = 4,
            Opcode::TexLdP if cube => cost.texture = cost.texture.max(4),
            _ => {}
        }
        if instruction.predicate.is_some() {
            cost.arithmetic += 1;
        }
    }
    cost
}

/// Slots per phase; versions without phases use the first entry only.
pub(super) fn counts(context: &Context<'_>) -> [SlotCount; 2] {
    let mut counts = [SlotCount::default(); 2];
    for (index, instruction) in context.instructions() {
        let entry = usize::from(context.phase(index) == 2);
        let cost = cost(context, index, instruction);
        counts[entry].texture += u32::from(cost.texture);
        counts[entry].arithmetic += u32::from(cost.arithmetic);
    }
    debug_assert!(context.version.stage() == Stage::Pixel || counts[1] == SlotCount::default());
    counts
}
