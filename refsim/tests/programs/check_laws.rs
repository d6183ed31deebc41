//! Properties of the checker on random programs.

use crate::generate::anything;
use proptest::prelude::*;
use refsim::{
    check,
    device::Profile,
    isa::{DestinationRule, Opcode, OpcodeClass, Program, RegisterFile, Relative, Version},
};

const DEVICES: [&str; 6] = ["r200", "nv20", "nv25", "r300", "nv35", "ideal-fp32"];

/// Checks all properties that executors rely on.
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

    /// No program of valid shape makes the checker panic, and accepted programs are safe to run.
    #[test]
    fn any_program_gets_a_verdict(seed in any::<u64>(), device in 0..DEVICES.len()) {
        let profile = Profile::named(DEVICES[device]).unwrap();
        match check::check(anything(seed), &profile) {
            Ok(checked) => prop_assert_eq!(is_safe(&checked, checked.facts()), Ok(())),
            Err(report) => prop_assert!(!report.violations.is_empty()),
        }
    }

    #[test]
    fn ideal_devices_allow_whatever_a_card_allows(seed in any::<u64>(), device in 0..DEVICES.len() - 1) {
        let (program, card) = (anything(seed), Profile::named(DEVICES[device]).unwrap());
        if check::check(program.clone(), &card).is_ok() {
            prop_assert!(check::check(program, &Profile::named("ideal-fp32").unwrap()).is_ok());
        }
    }

    /// Well-nested flow control is legal and safe on a device without limits.
    #[test]
    fn nested_blocks_are_legal(body in block()) {
        let text = format!("{HEAD}{}{TAIL}", body.concat());
        let program = refsim::asm::assemble(&text).unwrap();
        let checked = check::check(program, &Profile::named("ideal-fp16").unwrap());
        let checked = checked.map_err(|r| TestCaseError::fail(format!("{text}\n{:?}", r.violations)))?;
        prop_assert_eq!(is_safe(&checked, checked.facts()), Ok(()));
    }

    /// A program with one line removed or duplicated is accepted or rejected without a panic, and accepted programs are
    /// safe.
    #[test]
    fn broken_blocks_are_judged(body in block(), at in any::<prop::sample::Index>(), double in any::<bool>()) {
        let mut lines: Vec<&str> = body.iter().flat_map(|b| b.split_inclusive('\n')).collect();
        let at = at.index(lines.len());
        let line = lines.remove(at);
        if double {
            lines.insert(at, line);
            lines.insert(at, line);
        }
        let program = refsim::asm::assemble(&format!("{HEAD}{}{TAIL}", lines.concat())).unwrap();
        let opens = |l: &str| ["if", "rep", "end", "els"].iter().any(|w| l.starts_with(w));
        match check::check(program, &Profile::named("ideal-fp16").unwrap()) {
            Ok(checked) => {
                prop_assert!(!opens(line) || line == "else\n", "{line} is missed by nobody");
                prop_assert_eq!(is_safe(&checked, checked.facts()), Ok(()));
            }
            Err(report) => prop_assert!(!report.violations.is_empty()),
        }
    }
}

const HEAD: &str = "ps_2_a\ndcl t0\ndcl_2d s0\nmov r0, t0\nsetp_gt p0, r0, c0\n";
const TAIL: &str = "call l3\nmov oC0, r0\nret\nlabel l3\nmul r0, r0, c5\nret\n";

/// Well-nested statements, one or more lines per entry.
fn block() -> impl Strategy<Value = Vec<String>> {
    let line = prop::sample::select(vec![
        "mul r0, r0, c1\n",
        "(p0.x) mov r0, c2\n",
        "texld r2, t0, s0\n",
        "m3x3 r3.xyz, r0, c4\n",
        "setp_lt p0, r0, c3\n",
    ]);
    let leaf = line.prop_map(|l| vec![l.to_owned()]);
    leaf.prop_recursive(4, 40, 4, |inner| {
        let many = prop::collection::vec(inner, 1..4).prop_map(|v| v.concat());
        let condition = prop::sample::select(vec!["if b0\n", "if !p0.x\n", "if_ge r0.x, c0.y\n"]);
        prop_oneof![
            many.clone(),
            (condition.clone(), many.clone()).prop_map(|(c, b)| wrap(c, b, "endif\n")),
            (condition, many.clone(), many.clone()).prop_map(|(c, mut a, b)| {
                a.push("else\n".to_owned());
                a.extend(b);
                wrap(c, a, "endif\n")
            }),
            (many.clone(), many).prop_map(|(mut a, b)| {
                a.push("break_gt r0.x, c0.z\n".to_owned());
                a.extend(b);
                wrap("rep i0\n", a, "endrep\n")
            }),
        ]
    })
}

fn wrap(open: &str, mut body: Vec<String>, close: &str) -> Vec<String> {
    body.insert(0, open.to_owned());
    body.push(close.to_owned());
    body
}
