//! Formats of single instructions: laws over random programs, examples, and device files.

use crate::quads::{WITHIN_FP32, cases, results};
use crate::running;
use crate::running::run_with_coordinates;
use proptest::{collection::vec, prelude::*, sample::select};
use refsim::asm::assemble;
use refsim::device::{MAX_INSTRUCTION_FORMATS, Profile, takes_format};
use refsim::isa::{Opcode, Program};
use refsim::num::{Format, ops};

/// Sets the format of every instruction that accepts one.
fn assign(profile: &mut Profile, program: &Program, format: Format) {
    for (index, instruction) in program.instructions.iter().enumerate() {
        assert_eq!(profile.set_instruction_format(program, index, Some(format)), takes_format(instruction), "{index}");
    }
}

/// Replaces a texture read by a move and removes a kill; returns other lines unchanged.
fn without_texture(line: &str) -> String {
    match line.split_once(' ') {
        Some((mnemonic, _)) if mnemonic.starts_with("texkill") => String::new(),
        Some((mnemonic, operands)) if mnemonic.starts_with("tex") => {
            format!("mov {}, t0\n", operands.split(',').next().unwrap_or_default())
        }
        _ => format!("{line}\n"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, ..ProptestConfig::default() })]

    /// `_pp` on every instruction equals setting the format of `_pp` for every instruction.
    #[test]
    fn a_format_of_its_own_is_that_of_the_hint(
        (text, inputs, host) in cases(),
        [main, own] in [select(vec!["fp32", "fp24", "s3.12", "n3.8:rna"]), select(WITHIN_FP32.to_vec())],
    ) {
        let program = assemble(&text).expect("a legal program");
        let mut mixed = running::ideal(main);
        assign(&mut mixed, &program, own.parse().unwrap());
        let mut hinted = running::ideal(main);
        hinted.rules.partial = Some(own.parse().unwrap());
        let mut hints = program.clone();
        for instruction in &mut hints.instructions {
            if takes_format(instruction) && let Some(destination) = &mut instruction.destination {
                destination.partial_precision = true;
            }
        }
        if let Some(expected) = results(hints, &hinted, &inputs, &host) {
            prop_assert_eq!(Some(expected), results(program, &mixed, &inputs, &host));
        }
    }

    /// If all instructions have one format, and the registers hold all its numbers, the results equal a device of that
    /// format.
    #[test]
    fn one_format_for_all_is_the_device_of_that_format(
        (text, inputs, host) in cases(),
        own in select(WITHIN_FP32.to_vec()),
    ) {
        // Texture results are rounded twice; kills and flow-control comparisons read unrounded inputs.
        let text: String = text.lines().map(without_texture).collect();
        let program = assemble(&text).map_err(|e| TestCaseError::fail(format!("{text}\n{e}")))?;
        prop_assume!(!program.instructions.iter().any(|i| matches!(i.opcode, Opcode::IfC | Opcode::BreakC)));
        let format: Format = own.parse().unwrap();
        let mut mixed = running::ideal("fp32");
        assign(&mut mixed, &program, format);
        let uniform = results(program.clone(), &running::ideal(own), &inputs, &host);
        let uniform = uniform.unwrap_or_else(|| panic!("it runs on ideal devices:\n{text}"));
        let mixed = results(program, &mixed, &inputs, &host).expect("it runs on ideal devices");
        let wide = |x: u32| ops::convert(&format, Format::FP32, x).bits;
        for (a, b) in uniform.iter().zip(&mixed) {
            prop_assert_eq!(a.colors.map(|c| c.map(wide)), b.colors);
            prop_assert_eq!(a.killed, b.killed);
            prop_assert_eq!(a.depth.map(|d| wide(d.bits)), b.depth.map(|d| d.bits));
        }
    }

    /// A device file records all settings.
    #[test]
    fn device_files_read_back(
        name in select(vec!["ideal-fp32", "ideal-s3.12:rtz", "r200", "nv30", "nv35", "nv25"]),
        switches in vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 0..4),
        formats in vec((0usize..3, select(WITHIN_FP32.to_vec())), 0..4),
        registers in prop::option::of(select(WITHIN_FP32.to_vec())),
    ) {
        let mut profile = Profile::named(name).unwrap();
        for (switch, value) in switches {
            let all = profile.switches().to_vec();
            if !all.is_empty() {
                let switch = switch.get(&all);
                profile.set_switch(&switch.name, value.get(&switch.values).as_str()).unwrap();
            }
        }
        if let Some(format) = registers {
            profile.set_format(format.parse().unwrap()).unwrap();
        }
        let program = assemble("ps_2_0\ndcl t0\nmul r0, t0, t0 ; a comment\nadd r0,  r0, t0\nmov oC0, r0").unwrap();
        for (index, format) in formats {
            prop_assert!(profile.set_instruction_format(&program, index, Some(format.parse().unwrap())));
        }
        let text = profile.to_device_file(&[&program]);
        let read = Profile::from_device_file(&text).map_err(|e| TestCaseError::fail(format!("{e}\n{text}")))?;
        prop_assert_eq!(&read.rules, &profile.rules, "{}", text);
        prop_assert_eq!(read.instruction_formats(), profile.instruction_formats());
        prop_assert_eq!(read.to_device_file(&[&program]), text);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "(device|format|programs|switches|[a-z0-9.=\"\\[\\]\n ]){0,40}") {
        if let Err(error) = Profile::from_device_file(&text) {
            prop_assert!(!error.to_string().is_empty());
        }
    }
}

#[test]
fn each_instruction_rounds_to_its_own_format() {
    let text = "ps_2_0\ndcl t0\nmul r0, t0, t0\nadd r1, r0, t0\nmov oC0, r1";
    let program = assemble(text).unwrap();
    let mut profile = running::ideal("fp32");
    let x = 1.1f32;
    let run = |profile: &Profile| run_with_coordinates(text, profile, &[[x; 4]]).value(1)[0];
    assert_eq!(run(&profile), (x * x + x).to_bits());
    // Operands and result are rounded to e8m2: 1.1 becomes 1, so the product is 1 and the sum, in fp32, is 2.1.
    assert!(profile.set_instruction_format(&program, 0, Some("e8m2".parse().unwrap())));
    assert_eq!(run(&profile), (1.0 + x).to_bits());
    // The sum of 1 and 1.1 in s3.2: both operands are 1.
    assert!(profile.set_instruction_format(&program, 1, Some("s3.2".parse().unwrap())));
    assert_eq!(run(&profile), 2f32.to_bits());
    assert!(profile.set_instruction_format(&program, 0, None));
    assert_eq!(run(&profile), 2.25f32.to_bits(), "1.21 and 1.1 are 1.25 and 1");
    // The settings do not apply to other programs; comments and layout do not matter.
    assert_eq!(program.digest(), assemble(&text.replace("r0, t0", "r0,  t0")).unwrap().digest());
    assert_eq!(program.digest(), assemble(&text.replace("\nadd", " ; a comment\nadd")).unwrap().digest());
    assert_ne!(program.digest(), assemble(&text.replace("r0, t0, t0", "r0, t0, -t0")).unwrap().digest());
}

#[test]
fn instructions_without_a_number_take_no_format() {
    let takes = |text: &str| {
        let program = assemble(text).unwrap();
        let mut profile = running::ideal("fp32");
        let count = program.instructions.len();
        let taken = (0..=count).map(|i| profile.set_instruction_format(&program, i, Some(Format::FP16)));
        taken.map(|t| if t { '+' } else { '-' }).collect::<String>()
    };
    assert_eq!(takes("vs_2_0\ndcl_position v0\nmova a0.x, v0.x\nmov r0, c[a0.x]\nmov oPos, r0"), "-++-");
    assert_eq!(takes("ps_1_4\ntexcrd r0.rgb, t0\ntexld r1, t1\nphase\ntexkill r1\nmov r0, r1"), "++--+-");
    assert_eq!(takes("ps_1_3\ntex t0\ntexm3x2pad t1, t0\ntexm3x2tex t2, t0\nmov r0, t2"), "+-++-");
    assert_eq!(takes("!!FP1.0\nPK2H R0.x, f[COL0];\nUP2H R1, R0.x;\nKIL GT.x;\nMOVX o[COLR], R1;\nEND"), "---+-");
    assert_eq!(takes("ps_2_a\ndcl t0\nif_gt t0.x, t0.y\nsetp_gt p0, t0, t0\nendif\nmov oC0, t0"), "-+-+-");
}

#[test]
fn a_program_has_a_limited_number_of_formats() {
    let mut text = "ps_2_0\ndcl t0\n".to_owned();
    for _ in 0..MAX_INSTRUCTION_FORMATS + 8 {
        text += "add r0, t0, t0\n";
    }
    let program = assemble(&(text + "mov oC0, r0")).unwrap();
    let mut profile = running::ideal("fp32");
    let format = |fraction: usize| format!("s{}.{}", fraction % 2, fraction / 2).parse().unwrap();
    for index in 0..MAX_INSTRUCTION_FORMATS {
        assert!(profile.set_instruction_format(&program, index, Some(format(index + 2))));
    }
    let before = profile.clone();
    assert!(!profile.set_instruction_format(&program, MAX_INSTRUCTION_FORMATS, Some(Format::FP16)));
    assert!(!profile.set_instruction_format(&program, MAX_INSTRUCTION_FORMATS + 1, Some(Format::FP16)));
    assert_eq!(profile, before);
    assert!(profile.set_instruction_format(&program, MAX_INSTRUCTION_FORMATS, Some(format(7))));
    assert!(profile.set_instruction_format(&program, 0, Some(Format::FP16)), "in place of another");
}

/// Setting all formats at once equals setting them one by one; a refused format changes nothing.
#[test]
fn formats_of_a_program_are_replaced_together() {
    let program = assemble("ps_2_0\ndcl t0\ntexkill t0\nadd r0, t0, t0\nmul r0, r0, t0\nmov oC0, r0").unwrap();
    let [first, second]: [Format; 2] = ["fp16", "s3.12"].map(|format| format.parse().unwrap());
    let mut together = running::ideal("fp32");
    assert!(together.set_instruction_formats(&program, [(1, first), (2, second)].into()));
    let mut single = running::ideal("fp32");
    assert!(single.set_instruction_format(&program, 1, Some(first)));
    assert!(single.set_instruction_format(&program, 2, Some(second)));
    assert_eq!(together, single);
    assert!(together.set_instruction_formats(&program, [(3, first)].into()));
    let formats: Vec<_> = together.instruction_formats().iter().map(|(_, formats)| formats.clone()).collect();
    assert_eq!(formats, [[(3, first)].into()], "the others went");
    let before = together.clone();
    for index in [0, 4] {
        assert!(!together.set_instruction_formats(&program, [(1, first), (index, second)].into()));
    }
    assert!(!together.set_instruction_formats(&program, [(1, "e8m0".parse().unwrap())].into()), "no registers' format");
    assert_eq!(together, before);
    assert!(together.set_instruction_formats(&program, [].into()));
    assert_eq!(together, running::ideal("fp32"));
}

/// Formats in a device file that apply to no program of the case are reported.
#[test]
fn formats_that_change_nothing_are_found() {
    let program = assemble("ps_2_0\ndcl t0\ntexkill t0\nmov oC0, t0").unwrap();
    let digest = program.digest();
    let text = format!(
        "device = \"ideal-fp32\"\n[programs.{digest:016x}]\n0 = \"fp16\"\n1 = \"fp16\"\n7 = \"fp16\"\n\
         [programs.0123456789abcdef]\n0 = \"fp16\"\n"
    );
    let profile = Profile::from_device_file(&text).unwrap();
    let mut unused = profile.instruction_formats().unused(&[&program]);
    unused.sort();
    let mut expected = vec![(0x0123_4567_89ab_cdef, None), (digest, Some(0)), (digest, Some(7))];
    expected.sort();
    assert_eq!(unused, expected);
}

#[test]
fn wrong_device_files_are_refused() {
    for text in [
        "device = \"r9\"",
        "device = \"r200\"\n[switches]\nmad = \"x\"",
        "device = \"r200\"\n[programs.12]\n0 = \"fp16\"",
        "device = \"r200\"\n[programs.0123456789abcdef]\nx = \"fp16\"",
        "device = \"r200\"\nspeed = 1",
        "device = \"r200\"\n[storage]\ntexels = \"fp16\"",
        "device = \"r200\"\n[storage]\nsamples = \"fp16\"",
        "device = \"r200\"\n[programs.0123456789abcdef]\n0 = \"fp99\"",
    ] {
        assert!(Profile::from_device_file(text).is_err(), "{text}");
    }
}

#[test]
fn fogged_programs_keep_their_formats() {
    let text = "!!ARBfp1.0\nOPTION ARB_fog_linear;\nMUL result.color, fragment.color, fragment.color;\nEND";
    let mut profile = running::ideal("fp32");
    let checked = running::checked(text, &profile);
    assert!(profile.set_instruction_format(&checked, 0, Some("e8m2".parse().unwrap())));
    let formats: Vec<_> = running::checked(text, &profile).instructions.iter().map(|i| i.format).collect();
    assert_eq!(formats[0], Some("e8m2".parse().unwrap()));
    assert!(formats[1..].iter().all(Option::is_none));
}
