//! Formats of storages and of sums. Laws over random programs express them as formats of instructions and rounded
//! inputs; further tests compare the executors' dot products with `num`, and check refusals.

use crate::quads::{WITHIN_FP32, cases, inputs, results, vectors};
use crate::random::Random;
use crate::running;
use crate::sums::pixels;
use proptest::{prelude::*, sample::select};
use refsim::asm::assemble;
use refsim::device::{ColorIterator, Profile, Storage};
use refsim::exec::Constants;
use refsim::isa::{ConstantValue, RegisterFile};
use refsim::machine::{ExecutorKind, Machine};
use refsim::num::{DotOrder, Format, ops};

fn format(text: &str) -> Format {
    text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn rounded(format: Format, bits: u32) -> u32 {
    let narrowed = ops::convert(&Format::FP32, format, bits).bits;
    ops::convert(&format, Format::FP32, narrowed).bits
}

/// An ideal single-precision device whose `storage` has its own format.
fn storing(storage: Storage, format: Format) -> Profile {
    let mut profile = running::ideal("fp32");
    profile.rules.color_iterator = ColorIterator::Full;
    profile.set_storage_format(storage, Some(format)).unwrap_or_else(|e| panic!("{e}"));
    profile
}

/// Returns a move that rounds the register which the line writes; `None` if the line writes no temporary.
fn rounding_move(line: &str) -> Option<String> {
    let (_, rest) = line.split_once(") ").filter(|_| line.starts_with('(')).unwrap_or(("", line));
    let (mnemonic, operands) = rest.split_once(' ')?;
    let target = operands.split(',').next()?;
    let writes = target.starts_with('r') && mnemonic != "texkill";
    let is_flow = ["if", "break", "rep", "loop", "call"].iter().any(|flow| mnemonic.starts_with(flow));
    (writes && !is_flow).then(|| format!("mov {target}, {}", target.split('.').next().unwrap_or(target)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    /// A format for temporaries equals a move in that format after every instruction that writes a temporary.
    #[test]
    fn temporaries_are_rounded_when_they_are_written(
        (text, inputs, host) in cases(), own in select(WITHIN_FP32.to_vec()),
    ) {
        let mut moves = Vec::new();
        let (mut moved, mut count) = (String::new(), 0);
        for line in text.lines() {
            moved += &format!("{line}\n");
            count += usize::from(!(line.starts_with("ps") || line.starts_with("d") && !line.starts_with("dp")
                && !line.starts_with("dsx") && !line.starts_with("dsy")));
            if let Some(rounding) = rounding_move(line) {
                moved += &format!("{rounding}\n");
                moves.push(count);
                count += 1;
            }
        }
        let program = assemble(&moved).map_err(|e| TestCaseError::fail(format!("{moved}\n{e}")))?;
        let mut mixed = running::ideal("fp32");
        mixed.rules.color_iterator = ColorIterator::Full;
        for index in moves {
            prop_assert!(program.instruction_text(index).is_some_and(|text| text.starts_with("mov r")), "{}", moved);
            prop_assert!(mixed.set_instruction_format(&program, index, Some(format(own))));
        }
        if let Some(expected) = results(program, &mixed, &inputs, &host) {
            let program = assemble(&text).expect("a legal program");
            let found = results(program, &storing(Storage::Temporaries, format(own)), &inputs, &host);
            prop_assert_eq!(Some(expected), found, "{}", moved);
        }
    }

    /// Formats of outputs and texels equal the same formats for the instructions that write a color or read a texture.
    #[test]
    fn outputs_and_texels_are_rounded_by_their_instructions(
        (text, inputs, host) in cases(),
        own in select(WITHIN_FP32.to_vec()),
        storage in select(vec![Storage::Outputs, Storage::Texels]),
    ) {
        let program = assemble(&text).expect("a legal program");
        let mut mixed = running::ideal("fp32");
        mixed.rules.color_iterator = ColorIterator::Full;
        for (index, instruction) in program.instructions.iter().enumerate() {
            let is_output = instruction.destination.is_some_and(|d| d.register.file == RegisterFile::ColorOut);
            let is_read = program.instruction_text(index).is_some_and(|text| text.starts_with("texld"));
            if if storage == Storage::Outputs { is_output } else { is_read } {
                mixed.set_instruction_format(&program, index, Some(format(own)));
            }
        }
        let expected = results(program.clone(), &mixed, &inputs, &host);
        prop_assert_eq!(expected, results(program, &storing(storage, format(own)), &inputs, &host));
    }

    /// Formats of constants, coordinates and colors equal rounded inputs.
    #[test]
    fn inputs_are_rounded_on_their_way_in(
        (text, inputs, host) in cases(),
        own in select(WITHIN_FP32.to_vec()),
        storage in select(vec![Storage::Constants, Storage::Coordinates, Storage::Colors]),
    ) {
        // Colors beyond the format's own range of [0, 1] are not clamped again.
        let round = |bits: u32| rounded(format(own), bits);
        let program = assemble(&text).expect("a legal program");
        let (mut host, mut inputs) = (host, inputs);
        let stored = results(program.clone(), &storing(storage, format(own)), &inputs, &host);
        let mut rounded_program = program;
        for input in &mut inputs {
            match storage {
                Storage::Coordinates => input.t = input.t.map(|set| set.map(round)),
                Storage::Colors => {
                    let one = |bits: u32| ops::saturate01(Format::FP32, bits).bits;
                    input.v = input.v.map(|color| color.map(|bits| round(one(bits))));
                }
                _ => {}
            }
        }
        // -1 would wrap, but no color is negative.
        prop_assume!(storage != Storage::Colors || !own.ends_with(":wrap"));
        if storage == Storage::Constants {
            host.float.iter_mut().for_each(|constant| *constant = constant.map(round));
            for definition in &mut rounded_program.constants {
                if let ConstantValue::Float(value) = &mut definition.value {
                    *value = value.map(round);
                }
            }
        }
        let mut plain = running::ideal("fp32");
        plain.rules.color_iterator = ColorIterator::Full;
        prop_assert_eq!(stored, results(rounded_program, &plain, &inputs, &host));
    }

    /// If the accumulator can represent every number of the registers, a dot product with it equals a dot product in
    /// the accumulator's format.
    #[test]
    fn wide_accumulators_are_formats_of_dot_products(
        data in vectors(24),
        [main, own] in select(vec![["fp16", "fp32"], ["s3.12", "fp24:rtz"], ["e5m2", "fp16:rup"], ["s3.12", "s7.14"]]),
        order in select(vec![DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact]),
    ) {
        let text = "ps_2_0\ndcl t0\ndcl t1\nmov r0, t0\ndp4 r1, r0, t1\ndp3 r1.xy, r0, t1\nmov oC0, r1";
        let program = assemble(text).unwrap();
        let mut wide = running::ideal(main);
        wide.rules.dot = order;
        let mut mixed = wide.clone();
        wide.set_accumulator(Some(format(own))).unwrap_or_else(|e| panic!("{e}"));
        for index in [1, 2] {
            prop_assert!(mixed.set_instruction_format(&program, index, Some(format(own))));
        }
        let (inputs, host) = (inputs(&data), Constants::default());
        prop_assert_eq!(results(program.clone(), &mixed, &inputs, &host), results(program, &wide, &inputs, &host));
    }
}

/// Width and height of the target, in pixels.
const SIDE: u32 = 32;

/// Numbers in single precision whose products lie near the midpoint of two numbers of an accumulator, or near the
/// limits of the ranges.
fn factors(seed: u64) -> Vec<[u32; 4]> {
    let mut random = Random::new(seed);
    let mut number = || {
        let (kind, bits) = (random.below(8), random.bits());
        let few = bits & 0x8000_0000 | (120 + bits % 14) << 23 | ((bits >> 4) % 32) << 18;
        match kind {
            0..3 => few,
            3..5 => few | bits & 0x7f,
            5 => bits & 0x8000_0000 | (60 + bits % 8) << 23 | bits >> 9,
            6 => bits,
            _ => {
                [0, 0x8000_0000, 1, 0x7f7f_ffff, 0x7f80_0000, 0xff80_0000, 0x7fc0_0000, 0x3f80_0000][bits as usize % 8]
            }
        }
    };
    (0..SIDE * SIDE).map(|_| [0; 4].map(|_: u32| number())).collect()
}

/// Dot products of corresponding texels of two single-precision textures.
fn dots(profile: &Profile, kind: ExecutorKind, textures: &[Vec<[u32; 4]>; 2]) -> Vec<u8> {
    let text = "ps_2_0\ndcl t0\ndcl_2d s0\ndcl_2d s1\ntexld r0, t0, s0\ntexld r1, t0, s1\ndp4 r2.x, r0, r1\n\
                dp3 r2.y, r0, r1\ndp2add r2.z, r0, r1, r0.z\ndp4 r2.w, r0, -r1\nmov oC0, r2";
    pixels(&mut Machine::new(profile.clone(), kind), profile, text, textures)
}

/// Accumulators that cannot hold all numbers of the registers: every executor rounds each product once.
#[test]
fn narrow_accumulators_round_products_once() {
    let accumulators = ["e8m13", "e5m10", "fp24:rtz", "e8m21:rna", "e6m9:ftz:sat", "e5m2:rup", "s7.12", "s3.8:rdn"];
    let textures = [factors(1), factors(2)];
    for (accumulator, order) in accumulators
        .iter()
        .flat_map(|text| [DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact].map(|order| (*text, order)))
    {
        let mut profile = running::ideal("fp32");
        profile.rules.dot = order;
        let without = dots(&profile, ExecutorKind::Scalar, &textures);
        profile.set_accumulator(Some(format(accumulator))).unwrap_or_else(|e| panic!("{accumulator}: {e}"));
        let scalar = dots(&profile, ExecutorKind::Scalar, &textures);
        assert_ne!(scalar, without, "{accumulator}: it does nothing");
        assert!(dots(&profile, ExecutorKind::Batch, &textures) == scalar, "{accumulator} {order:?}: batch");
        for (pixel, texel) in scalar.chunks_exact(16).enumerate() {
            let clean = |x: u32| ops::convert(&Format::FP32, Format::FP32, x).bits;
            let terms = |count: usize| -> Vec<(u32, u32)> {
                (0..count).map(|i| (clean(textures[0][pixel][i]), clean(textures[1][pixel][i]))).collect()
            };
            let dot = |count| ops::dot_accumulated(Format::FP32, format(accumulator), order, &terms(count)).bits;
            let found = [0, 4].map(|at: usize| u32::from_le_bytes(texel[at..at + 4].try_into().unwrap()));
            assert_eq!(found, [dot(4), dot(3)], "{accumulator} {order:?}, pixel {pixel}: {:x?}", terms(4));
        }
    }
}

#[test]
fn formats_that_do_not_fit_are_refused() {
    for (registers, storage, own) in [
        ("fp24", Some(Storage::Temporaries), "s15.16"),
        ("s3.12", Some(Storage::Outputs), "fp16"),
        ("fp32", Some(Storage::Colors), "e8m0"),
        ("s3.12", Some(Storage::Coordinates), "s3.28"),
        // Registers refuse formats that executors cannot compute with.
        ("fp32", None, "e8m0"),
        ("fp32", None, "fp16:rst"),
    ] {
        let mut profile = running::ideal(registers);
        let before = profile.clone();
        let is_refused = match storage {
            Some(storage) => profile.set_storage_format(storage, Some(format(own))).is_err(),
            None => profile.set_format(format(own)).is_err(),
        };
        assert!(is_refused && profile == before, "{registers} {own}");
    }
    let mut profile = running::ideal("s3.12");
    profile.set_storage_format(Storage::Coordinates, Some(Format::FP16)).expect("a format of single precision");
    let accumulator = |registers: &str, own: &str| running::ideal(registers).set_accumulator(Some(format(own)));
    for (registers, own) in [
        ("fp32", "e8m22"),
        ("fp32", "e5m10:nvovf"),
        ("fp32", "e5m10:rdn"),
        ("fp32", "s7.8:wrap"),
        ("fp32", "s3.20"),
        ("n3.8", "s7.12"),
        ("s15.16", "fp24"),
        ("fp16", "e8m0"),
        ("fp16", "fp24:rst"),
    ] {
        assert!(accumulator(registers, own).is_err(), "{registers} {own}");
    }
    for (registers, own) in [("fp32", "fp32:rdn"), ("n3.8", "n7.8"), ("s15.16", "s15.16:rdn"), ("fp16", "fp24:nvovf")] {
        accumulator(registers, own).unwrap_or_else(|e| panic!("{registers} {own}: {e}"));
    }
}

/// Among formats of at most 8 bits, one holds another exactly if the round trip through it changes none of the other's
/// numbers.
#[test]
fn a_format_holds_what_conversion_there_and_back_keeps() {
    let texts = [
        "e4m3", "e5m2", "e3m2", "e2m5", "e4m3:ftz", "e5m2:ftz", "e3m2:ftz", "e4m3fn", "e2m1fn", "e2m3fn", "e3m2fn",
        "e4m3fnuz", "e5m2fnuz", "s1.6", "s3.2", "s0.7", "s2.1", "n1.3", "n2.3", "n1.5", "e4m2fn", "e5m1", "e4m1fnuz",
        "e2m4", "s4.0",
    ];
    for wide in texts.iter().map(|text| format(text)) {
        for narrow in texts.iter().map(|text| format(text)) {
            let keeps = (0..=narrow.mask()).all(|bits| {
                // Patterns that read as zero do not count as numbers, and all NaNs count as one.
                let number = ops::convert(&narrow, narrow, bits).bits;
                let there = ops::convert(&narrow, wide, number);
                there.flags.is_empty() && ops::convert(&wide, narrow, there.bits).bits == number
            });
            assert_eq!(wide.holds(narrow), keeps, "{wide} holds {narrow}");
        }
    }
}

/// A device file records all settings, and replaced registers keep the formats that were chosen for them.
#[test]
fn device_files_have_formats_of_storages_and_sums() {
    let text = "device = \"ideal-fp32\"\naccumulator = \"e8m13\"\n\n[storage]\ntemporaries = \"e5m10\"\n\
                coordinates = \"s3.12:rtz\"\n";
    let mut profile = Profile::from_device_file(text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(profile.to_device_file(&[]), text);
    assert_eq!(profile.rules.storage.of(Storage::Temporaries), Some(Format::FP16));
    assert_eq!(profile.rules.accumulator, Some(format("e8m13")));
    profile.set_format(Format::FP32).expect("a format of registers");
    assert_eq!(profile.to_device_file(&[]), "device = \"ideal-fp32\"\n");
}

#[test]
fn storages_that_a_program_does_not_use_are_found() {
    let unused = |text: &str| {
        let mut profile = running::ideal("fp32");
        for storage in Storage::ALL {
            profile.set_storage_format(storage, Some(Format::FP16)).expect("it fits");
        }
        let program = assemble(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        profile.rules.storage.unused(&program).into_iter().map(Storage::name).collect::<Vec<_>>()
    };
    assert_eq!(unused("ps_2_0\ndef c0, 1, 1, 1, 1\nmov oC0, c0"), ["temporaries", "texels", "colors", "coordinates"]);
    assert_eq!(unused("ps_2_0\ndcl v0\nmov r0, v0\nmov oC0, r0"), ["constants", "texels", "coordinates"]);
    assert_eq!(unused("ps_1_3\ntexcoord t0\nmov r0, t0"), ["constants", "texels", "colors"]);
    assert_eq!(unused("ps_1_3\ntex t0\nmov r0, t0"), ["constants", "colors"]);
    assert_eq!(unused("!!FP1.0\nTEX o[COLR], f[TEX0], TEX0, 2D;\nEND"), ["temporaries", "constants", "colors"]);
}
