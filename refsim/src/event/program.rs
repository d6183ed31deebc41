//! Instruction mix of a program, in a card's issue units.

use std::collections::BTreeMap;

use crate::isa::{
    ConstantValue, Destination, Instruction, Mask, Modifier, Opcode, OpcodeClass, Precision, Program, Register,
    RegisterFile, ResultKind, Source, Stage, Version,
};

/// Maximum number of iterations of a loop, as in the executors.
const MAX_PASSES: u64 = 255;

/// An arithmetic slot: an instruction, or a pair of one colour and one alpha instruction issued together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ArithmeticSlot {
    /// The instruction (the first of the pair).
    pub opcode: Opcode,
    /// The second instruction of the pair: co-issued by the program (ps_1_x), or a candidate for pairing on a card with
    /// a vector and a scalar unit ([`Self::independent`]).
    pub partner: Option<Opcode>,
    /// `true` for two adjacent independent instructions that the program does not co-issue: one writes only colour, the
    /// other only alpha.
    pub independent: bool,
    /// `true` for fixed-point arithmetic (suffix X of `!!FP1.0`).
    pub fixed: bool,
    /// Slots by the opcode table; for a pair, the larger number.
    pub slots: u16,
    /// Executions per fragment or vertex, with loops unrolled.
    pub times: u64,
}

/// One texture instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureSlot {
    /// The instruction.
    pub opcode: Opcode,
    /// The sampler read; `None` for instructions that read no texel (`texcrd`, `texkill`, `texm3x2pad`...).
    pub sampler: Option<u8>,
    /// `true` if the coordinates are computed, `false` if they are interpolated.
    pub dependent: bool,
    /// Executions per fragment.
    pub times: u64,
}

/// The work of one phase. Only ps_1_4 programs have two; others have one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct PhaseWork {
    /// The arithmetic slots, in order.
    pub arithmetic: Vec<ArithmeticSlot>,
    /// The texture instructions, in order.
    pub textures: Vec<TextureSlot>,
}

/// The instruction mix of a program.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ProgramWork {
    /// Its version.
    pub version: Version,
    /// Its phases, in order.
    pub phases: Vec<PhaseWork>,
    /// Maximum number of simultaneously live temporaries, in halves. A temporary counts 2, or 1 if only `_pp`
    /// instructions write it; in `!!FP1.0`, `R#` counts 2 and `H#` counts 1.
    pub live_halves: u32,
    /// Number of flow control instructions, each counted once.
    pub flow: u32,
}

/// Integer and boolean constants set by the host, for static flow control; the program's own definitions take
/// precedence.
#[derive(Clone, Copy, Debug, Default)]
pub struct FlowConstants<'a> {
    /// Values of `i0` and up.
    pub int: &'a [[i32; 4]],
    /// Values of `b0` and up.
    pub boolean: &'a [bool],
}

impl ProgramWork {
    /// Analyses a program. Loops are unrolled with the values of their constants, and calls are followed. For a branch
    /// on a constant only the branch taken counts; for a branch on a computed value both count, as on cards that use
    /// predication.
    pub fn new(program: &Program, constants: FlowConstants<'_>) -> Self {
        let times = executions(program, constants);
        let marker = program.phase_marker();
        let mut phases = vec![PhaseWork::default(); if marker.is_some() { 2 } else { 1 }];
        let mut at = 0;
        let code = &program.instructions;
        while let Some(instruction) = code.get(at) {
            let phase = usize::from(marker.is_some_and(|m| at > m));
            let mut taken = 1;
            match instruction.opcode.info().class {
                OpcodeClass::Arithmetic => {
                    let (slot, count) = arithmetic(program, at, times[at]);
                    phases[phase].arithmetic.push(slot);
                    taken = count;
                }
                OpcodeClass::Texture => phases[phase].textures.push(texture(program, at, times[at])),
                OpcodeClass::Flow | OpcodeClass::Marker => {}
            }
            at += taken;
        }
        for phase in &mut phases {
            phase.arithmetic.retain(|slot| slot.times > 0);
            phase.textures.retain(|slot| slot.times > 0);
        }
        let flow = code.iter().filter(|i| i.opcode.info().class == OpcodeClass::Flow).count() as u32;
        Self { version: program.version, phases, live_halves: live_halves(program), flow }
    }

    /// Arithmetic slots executed per fragment or vertex; a pair co-issued by the program counts once.
    pub fn arithmetic_slots(&self) -> u64 {
        let slots = self.phases.iter().flat_map(|p| &p.arithmetic);
        slots.map(|s| s.times.saturating_mul(s.slots.into())).fold(0, u64::saturating_add)
    }

    /// Texture instructions executed per fragment.
    pub fn texture_slots(&self) -> u64 {
        self.phases.iter().flat_map(|p| &p.textures).map(|s| s.times).fold(0, u64::saturating_add)
    }
}

/// The arithmetic slot at `at`, and its number of instructions.
fn arithmetic(program: &Program, at: usize, times: u64) -> (ArithmeticSlot, usize) {
    let code = &program.instructions;
    let instruction = &code[at];
    let cost = |i: &Instruction| i.opcode.info().slot_cost(program.version).arithmetic;
    let alone = ArithmeticSlot {
        opcode: instruction.opcode,
        partner: None,
        independent: false,
        fixed: program.version == Version::Fp1_0 && instruction.precision() == Precision::Fixed,
        slots: cost(instruction),
        times,
    };
    let Some(next) = code.get(at + 1).filter(|i| i.opcode.info().class == OpcodeClass::Arithmetic) else {
        return (alone, 1);
    };
    let slots = cost(instruction).max(cost(next));
    if next.coissue {
        return (ArithmeticSlot { partner: Some(next.opcode), slots, ..alone }, 2);
    }
    let lone = !code.get(at + 2).is_some_and(|i| i.coissue);
    if program.version.is_ps_2() && lone && slots == 1 && can_pair(instruction, next) {
        return (ArithmeticSlot { partner: Some(next.opcode), independent: true, slots, ..alone }, 2);
    }
    (alone, 1)
}

/// Returns `true` if a card with a vector and a scalar unit can issue two adjacent instructions together.
fn can_pair(first: &Instruction, second: &Instruction) -> bool {
    let (Some(a), Some(b)) = (first.destination, second.destination) else { return false };
    if first.predicate.is_some() || second.predicate.is_some() {
        return false;
    }
    let color = |d: &Destination| d.mask.0 != 0 && d.mask.0 & Mask::ALPHA.0 == 0;
    let alpha = |d: &Destination| d.mask == Mask::ALPHA;
    let split = (color(&a) && alpha(&b)) || (alpha(&a) && color(&b));
    split && !second.sources.iter().any(|s| s.register == a.register)
}

fn texture(program: &Program, at: usize, times: u64) -> TextureSlot {
    let instruction = &program.instructions[at];
    let opcode = instruction.opcode;
    let reads = opcode.info().result == ResultKind::Texel;
    let sampler = match instruction.sources.get(1) {
        Some(sampler) if program.version.reads_coordinates() => Some(sampler.register.index),
        _ => instruction.destination.map(|d| d.register.index),
    };
    // From ps_1_4 on, the source gives the coordinates. In earlier versions a read is dependent if it uses another
    // stage's result.
    let dependent = match instruction.sources.first() {
        None => false,
        Some(_) if program.version.is_ps_1_1_to_1_3() => true,
        Some(source) => source.register.file != RegisterFile::Texture,
    };
    let sampler = sampler.filter(|_| reads).and_then(|n| u8::try_from(n).ok());
    TextureSlot { opcode, sampler, dependent: dependent && reads, times }
}

/// Number of executions of each instruction; one pass over the text, for any nesting of loops and calls.
fn executions(program: &Program, constants: FlowConstants<'_>) -> Vec<u64> {
    let code = &program.instructions;
    let label = |i: &Instruction| i.sources.first().map(|s| s.register.index);
    let labels = code.iter().enumerate().rev().filter(|(_, i)| i.opcode == Opcode::Label);
    let labels: BTreeMap<_, _> = labels.map(|(at, i)| (label(i), at)).collect();
    let mut times = vec![0u64; code.len()];
    // Number of calls of each subroutine, by label. Calls lead forward, so the number is final when the walk reaches
    // the label.
    let mut called = vec![0u64; code.len()];
    let (mut now, mut open) = (1u64, Vec::<OpenBranch>::new());
    for (at, instruction) in code.iter().enumerate() {
        match instruction.opcode {
            Opcode::Label => (now, open) = (called[at], Vec::new()),
            Opcode::Else => {
                if let Some(block) = open.last() {
                    now = if block.taken == Some(true) { 0 } else { block.outside };
                }
            }
            Opcode::EndIf | Opcode::EndRep | Opcode::EndLoop => {
                now = open.pop().map_or(now, |block| block.outside);
            }
            _ => {}
        }
        times[at] = now;
        match instruction.opcode {
            Opcode::If | Opcode::IfC => {
                let condition = || boolean_value(program, constants, instruction.sources.first());
                let taken = if instruction.opcode == Opcode::If { condition() } else { None };
                open.push(OpenBranch { outside: now, taken });
                now = if taken == Some(false) { 0 } else { now };
            }
            Opcode::Rep | Opcode::Loop => {
                open.push(OpenBranch { outside: now, taken: None });
                now = now.saturating_mul(passes(program, constants, instruction));
            }
            Opcode::Call | Opcode::CallNz => {
                let never = instruction.opcode == Opcode::CallNz
                    && boolean_value(program, constants, instruction.sources.get(1)) == Some(false);
                if let Some(&target) = labels.get(&label(instruction)).filter(|&&target| target > at && !never) {
                    called[target] = called[target].saturating_add(now);
                }
            }
            Opcode::Ret if open.is_empty() => now = 0,
            _ => {}
        }
    }
    times
}

/// An open block: the number of executions of the enclosing block and, for `if` on a constant, the branch taken.
struct OpenBranch {
    outside: u64,
    taken: Option<bool>,
}

/// Number of iterations of a loop.
fn passes(program: &Program, constants: FlowConstants<'_>, instruction: &Instruction) -> u64 {
    let files = instruction.sources.iter().map(|s| s.register);
    let Some(register) = files.into_iter().find(|r| r.file == RegisterFile::ConstantInt) else { return 1 };
    let defined = program.constants.iter().rev().find_map(|c| match c.value {
        ConstantValue::Int(value) if c.register.index == register.index => Some(value[0]),
        _ => None,
    });
    let set = constants.int.get(usize::from(register.index)).map(|v| v[0]);
    u64::try_from(defined.or(set).unwrap_or(0)).unwrap_or(0).min(MAX_PASSES)
}

/// The value of a boolean operand; `None` if it is computed.
fn boolean_value(program: &Program, constants: FlowConstants<'_>, source: Option<&Source>) -> Option<bool> {
    let source = source.filter(|s| s.register.file == RegisterFile::ConstantBool)?;
    let index = source.register.index;
    let defined = program.constants.iter().rev().find_map(|c| match c.value {
        ConstantValue::Bool(value) if c.register.index == index => Some(value),
        _ => None,
    });
    let value = defined.or_else(|| constants.boolean.get(usize::from(index)).copied()).unwrap_or(false);
    Some(value != (source.modifier == Modifier::Not))
}

/// Number of temporaries that a program can name: 64 `r#`, followed by 64 of half precision.
const TEMPORARIES: usize = 2 * FULL;
const FULL: usize = 64;

/// Index of a temporary, below [`TEMPORARIES`]; `None` for other registers.
fn temporary(register: Register) -> Option<usize> {
    let number = usize::from(register.index);
    match register.file {
        RegisterFile::Temp if number < FULL => Some(number),
        RegisterFile::Half if number < FULL => Some(FULL + number),
        _ => None,
    }
}

/// Maximum number of live temporaries, in halves; treats the program as straight-line code, ignoring that loops extend
/// live ranges.
fn live_halves(program: &Program) -> u32 {
    let mut full = [false; TEMPORARIES];
    if program.version.is_fragment_program() {
        // Unwritten temporaries are zero, and still occupy a register.
        full[..FULL].fill(true);
    }
    for destination in program.instructions.iter().filter_map(|i| i.destination) {
        if let Some(slot) = temporary(destination.register) {
            full[slot] |= !destination.partial_precision && !destination.register.file.is_half();
        }
    }
    // Components that are live after the last instruction: ps_1_x leaves its result in r0.
    let mut live = [0_u8; TEMPORARIES];
    if program.version.is_ps_1_x() && program.version.stage() == Stage::Pixel {
        live[0] = 0b1111;
    }
    let halves = |live: &[u8; TEMPORARIES]| {
        live.iter().zip(&full).filter(|(l, _)| **l != 0).map(|(_, full)| 1 + u32::from(*full)).sum::<u32>()
    };
    let mut most = halves(&live);
    for instruction in program.instructions.iter().rev() {
        let read_back = instruction.opcode.info().destination == crate::isa::DestinationRule::Read;
        let always = instruction.predicate.is_none() && instruction.fragment.condition.is_none();
        if let Some((d, slot)) = instruction.destination.and_then(|d| Some((d, temporary(d.register)?))) {
            if read_back || matches!(instruction.opcode, Opcode::TexDepth) {
                live[slot] |= 0b1111;
            } else if always {
                live[slot] &= !d.mask.0;
            }
        }
        let written = instruction.destination.map_or(Mask::ALL, |d| d.mask);
        let sources = instruction.sources.iter().enumerate();
        for (index, source, slot) in sources.filter_map(|(i, s)| Some((i, s, temporary(s.register)?))) {
            let lanes = match instruction.opcode.info().class {
                // The components read depend on the texture type.
                OpcodeClass::Texture => Mask::ALL,
                _ => instruction.opcode.lanes_read(index, written),
            };
            // Selectors 4 and 5 are the constants of `SWZ`.
            let chosen = lanes.components().map(|lane| source.swizzle.0[lane]).filter(|&c| c < 4);
            live[slot] |= chosen.fold(0, |mask, c| mask | 1 << c);
        }
        most = most.max(halves(&live));
    }
    most
}
