//! Laws of the checker, on random programs.

mod common {
    pub(crate) mod programs;
}

use common::programs;
use proptest::prelude::*;
use refsim::{
    check,
    device::Profile,
    isa::{DestinationRule, Opcode, OpcodeClass, Program, RegisterFile, Relative, Version},
};

const DEVICES: [&str; 6] = ["r200", "nv20", "nv25", "r300", "nv35", "ideal-fp32"];

/// What an executor would stumble over.
fn is_safe(program: &Program, facts: &check::Facts) -> Result<(), String> {
    let version = program.version;
    for (index, instruction) in program.instructions.iter().enumerate() {
        let info = instruction.opcode.info();
        let say = |what: &str| Err(format!("instruction {index}, {instruction:?}: {what}"));
        if info.source_count(version) != Some(instruction.sources.len() as u8) {
            return say("operands");
        }
        if instruction.destination.is_some() != (info.destination != DestinationRule::None) {
            return say("destination");
        }
        if instruction.comparison.is_some() != info.comparison {
            return say("comparison");
        }
        let rows = check::matrix_rows(instruction.opcode).unwrap_or(1) - 1;
        if let Some(matrix) = instruction.sources.get(1).filter(|_| rows > 0).map(|s| s.register) {
            let limit = if matrix.file == RegisterFile::Temp { facts.temporaries } else { facts.constants };
            if matrix.index + rows >= limit {
                return say("matrix rows");
            }
        }
        let registers =
            instruction.sources.iter().map(|s| s.register).chain(instruction.destination.map(|d| d.register));
        for register in registers {
            let limit = match register.file {
                RegisterFile::Temp => facts.temporaries,
                RegisterFile::Constant => facts.constants,
                RegisterFile::Sampler | RegisterFile::Input | RegisterFile::Label => 16,
                RegisterFile::ConstantInt | RegisterFile::ConstantBool => 16,
                RegisterFile::Texture | RegisterFile::TexCoordOut => 8,
                RegisterFile::ColorOut => 4,
                RegisterFile::DiffuseOut => 2,
                _ => 1,
            };
            if register.index >= limit {
                return say("register number");
            }
            match register.relative {
                Some(Relative::Address(0..=3)) | None => {}
                Some(Relative::Loop) if version == Version::Vs2_0 => {}
                _ => return say("address"),
            }
        }
        if instruction.sources.iter().any(|s| s.swizzle.0.iter().any(|c| *c > 3)) {
            return say("swizzle");
        }
        if instruction.destination.is_some_and(|d| d.mask.0 == 0 || d.mask.0 > 15) {
            return say("mask");
        }
        let jumps = info.class == OpcodeClass::Flow
            && !matches!(instruction.opcode, Opcode::EndIf | Opcode::Label | Opcode::Ret);
        if jumps != facts.jump[index].is_some() {
            return say("jump");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    /// No program of any shape makes the checker panic, and what it lets through is fit to run.
    #[test]
    fn any_program_gets_a_verdict(program in programs::program(), device in 0..DEVICES.len()) {
        let profile = Profile::named(DEVICES[device]).unwrap();
        match check::check(program, &profile) {
            Ok(checked) => prop_assert_eq!(is_safe(&checked, checked.facts()), Ok(())),
            Err(report) => prop_assert!(!report.violations.is_empty()),
        }
    }

    /// A version or a limit that a device has, an ideal device has too: what runs on a card runs on an ideal device.
    #[test]
    fn ideal_devices_allow_whatever_a_card_allows(program in programs::program(), device in 0..DEVICES.len() - 1) {
        let card = Profile::named(DEVICES[device]).unwrap();
        if check::check(program.clone(), &card).is_ok() {
            prop_assert!(check::check(program, &Profile::named("ideal-fp32").unwrap()).is_ok());
        }
    }

    /// Programs built from a few legal lines in random order: many of them pass, so the first law bites.
    #[test]
    fn lines_in_any_order_are_judged(lines in prop::collection::vec(0..LINES.len(), 0..14), version in 0..2_usize) {
        let text = format!("{}\n{}", HEADS[version], lines.iter().map(|l| LINES[*l]).collect::<String>());
        let program = refsim::asm::assemble(&text).map_err(|e| TestCaseError::reject(format!("{e:?}")));
        let Ok(program) = program else { return Ok(()) };
        for device in ["nv30", "ideal-fp16"] {
            let profile = Profile::named(device).unwrap();
            if let Ok(checked) = check::check(program.clone(), &profile) {
                prop_assert_eq!(is_safe(&checked, checked.facts()), Ok(()));
            }
        }
    }
}

const HEADS: [&str; 2] =
    ["ps_2_a\ndcl t0\ndcl_2d s0\nmov r0, t0\nmov oC0, t0", "vs_2_0\ndcl_position v0\nmov r0, v0\nmov oPos, v0"];
const LINES: [&str; 17] = [
    "mov r0, c0\n",
    "if b0\n",
    "if_gt r0.x, c0.x\n",
    "else\n",
    "endif\n",
    "rep i0\n",
    "endrep\n",
    "loop aL, i0\n",
    "endloop\n",
    "break_lt r0.x, c0.x\n",
    "call l0\n",
    "ret\n",
    "label l0\n",
    "add r1, r0, c1\n",
    "texld r2, t0, s0\n",
    "mul r0, r0, c[aL + 2]\n",
    "m3x3 r3.xyz, r0, c4\n",
];
