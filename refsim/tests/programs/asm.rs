//! Tests the assembler on the fixtures and on selected texts: results, spans and error messages.

use refsim::asm::{AssembleErrors, ErrorKind, assemble, print};
use refsim::isa::{
    Comparison, ConstantValue, Modifier, Opcode, Program, ProgramText, Register, RegisterFile, Relative, Span, Swizzle,
    Usage, Version,
};
use std::{collections::BTreeSet, fmt::Write as _, fs, path::PathBuf};

/// The texts of a folder of shaders, with their names.
pub(crate) fn texts(folder: &str) -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fixtures/shaders").join(folder);
    let paths =
        fs::read_dir(folder).expect("the fixtures are there").map(|entry| entry.expect("a readable folder").path());
    let read = |path: PathBuf| {
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        (name, fs::read_to_string(&path).expect("a readable text"))
    };
    let mut texts: Vec<_> = paths.filter(|path| path.is_file()).map(read).collect();
    texts.sort();
    texts
}

fn slice(text: &str, span: Span) -> &str {
    &text[span.start as usize..span.end as usize]
}

fn good(text: &str) -> Program {
    assemble(text).unwrap_or_else(|e| panic!("{text}\n{:#?}", e.errors))
}

fn bad(text: &str) -> AssembleErrors {
    assemble(text).expect_err(text)
}

fn kinds(text: &str) -> Vec<ErrorKind> {
    bad(text).errors.iter().map(|e| e.kind).collect()
}

// ---- fixtures ----

#[test]
fn good_fixtures_assemble_under_their_names() {
    for (name, text) in texts("asm") {
        let program = assemble(&text).unwrap_or_else(|e| panic!("{name}: {:#?}", e.errors));
        assert!(name.starts_with(program.version.token()), "{name} is a {}", program.version);
        let extension = match program.version.token().starts_with("vs") {
            true => ".vsa",
            false => ".psa",
        };
        assert!(name.ends_with(extension), "{name}");
    }
}

#[test]
fn every_opcode_of_every_version_occurs() {
    let mut seen = BTreeSet::new();
    for (_, text) in texts("asm") {
        let program = good(&text);
        seen.extend(program.instructions.iter().map(|i| (program.version, i.opcode)));
    }
    let missing: Vec<_> = Version::ALL
        .into_iter()
        .flat_map(|version| Opcode::ALL.iter().map(move |&opcode| (version, opcode)))
        .filter(|(version, opcode)| opcode.info().available(*version))
        .filter(|pair| !seen.contains(pair))
        .collect();
    assert!(missing.is_empty(), "no fixture has {missing:?}");
    for (version, opcode) in seen {
        assert!(opcode.info().available(version), "{opcode:?} in a good {version} fixture");
    }
}

#[test]
fn spans_of_the_fixtures_hold_what_they_name() {
    for (name, text) in texts("asm") {
        let program = good(&text);
        for i in &program.instructions {
            let whole = slice(&text, i.span).to_ascii_lowercase();
            assert!(whole.contains(i.opcode.info().mnemonic), "{name}: {whole}");
            for span in i.sources.iter().map(|s| s.span).chain(i.destination.map(|d| d.span)) {
                assert!(span.start >= i.span.start && span.end <= i.span.end, "{name}: {whole}");
                // The text of an operand's span must assemble alone.
                let alone = format!("ps_1_4\nmov r0, {}", slice(&text, span));
                good(&alone);
            }
        }
    }
}

#[test]
fn error_messages() {
    let mut out = String::new();
    let mut met = BTreeSet::new();
    for (name, text) in texts("asm/bad") {
        let errors = assemble(&text).expect_err(&name);
        writeln!(out, "== {name}: {errors}\n").expect("a string takes all");
        met.extend(errors.errors.iter().map(|e| e.kind.code()));
    }
    assert!(met.len() >= 25, "only {met:?}");
    insta::assert_snapshot!(out);
}

#[test]
fn displayed_errors_quote_their_lines() {
    let errors = bad("ps_1_4\n\tmov r0.zz, r1 // \u{7}\nad r0, r1, r2\n");
    assert_eq!(format!("{errors}"), format!("{errors:?}"), "a `main` that returns them prints them so");
    let many = bad(&format!("ps_1_4\n{}", "mull r0, r1\n".repeat(22)));
    let long = bad(&format!("ps_1_4\nmov r0, {}\n", "-".repeat(200)));
    let unknown = bad("!!FP9.0\nEND");
    let huge = bad(&" ".repeat((1 << 20) + 1));
    insta::assert_snapshot!([errors, many, long, unknown, huge].map(|errors| errors.to_string()).join("\n\n"));
}

// ---- chosen texts ----

#[test]
fn spans_point_at_operands() {
    let text = "ps_1_4\n  +add_sat r0.rgb, 1-r1, -r2_bx2.a // c\n";
    let p = good(text);
    let i = &p.instructions[0];
    assert_eq!(slice(text, p.version_span), "ps_1_4");
    assert_eq!(slice(text, i.span), "+add_sat r0.rgb, 1-r1, -r2_bx2.a");
    assert_eq!(slice(text, i.destination.unwrap().span), "r0.rgb");
    assert_eq!(slice(text, i.sources[0].span), "1-r1");
    assert_eq!(slice(text, i.sources[1].span), "-r2_bx2.a");
    let text = "vs_2_0\ndcl_texcoord1 v3.xy\ndef c0, 1, 2, 3, -4\n(!p0.x) mov r0, c[a0.x + 3].x";
    let p = good(text);
    assert_eq!(slice(text, p.declarations[0].span), "dcl_texcoord1 v3.xy");
    assert_eq!(slice(text, p.constants[0].span), "def c0, 1, 2, 3, -4");
    let i = &p.instructions[0];
    assert_eq!(slice(text, i.span), "(!p0.x) mov r0, c[a0.x + 3].x");
    assert_eq!(slice(text, i.predicate.unwrap().span), "(!p0.x)");
    assert_eq!(slice(text, i.sources[0].span), "c[a0.x + 3].x");
}

#[test]
fn source_modifiers_and_selectors() {
    let read = |operand: &str| {
        let p = good(&format!("ps_1_4\nmov r0, {operand}"));
        let s = p.instructions[0].sources[0];
        (s.modifier, s.swizzle.0)
    };
    let cases = [
        ("r1", Modifier::None, [0, 1, 2, 3]),
        ("- r1", Modifier::Negate, [0, 1, 2, 3]),
        ("1 - r1.a", Modifier::Invert, [3, 3, 3, 3]),
        ("!b1", Modifier::Not, [0, 1, 2, 3]),
        ("r1_bias", Modifier::Bias, [0, 1, 2, 3]),
        ("-r1.rgb_bias", Modifier::BiasNegate, [0, 1, 2, 2]),
        ("r1_BX2.x", Modifier::Bx2, [0, 0, 0, 0]),
        ("-r1_bx2", Modifier::Bx2Negate, [0, 1, 2, 3]),
        ("r1_x2.zy", Modifier::X2, [2, 1, 1, 1]),
        ("-r1.b_x2", Modifier::X2Negate, [2, 2, 2, 2]),
        ("t0_dw.xyw", Modifier::Dw, [0, 1, 3, 3]),
        ("t0.xyw_da", Modifier::Dw, [0, 1, 3, 3]),
        ("r0_dz.xyz", Modifier::Dz, [0, 1, 2, 2]),
        ("r0_db", Modifier::Dz, [0, 1, 2, 3]),
    ];
    for (text, modifier, swizzle) in cases {
        assert_eq!(read(text), (modifier, swizzle), "{text}");
    }
    assert_eq!(kinds("ps_1_4\nmov r0, 1-r1_bx2"), [ErrorKind::SourceModifierClash]);
}

#[test]
fn relative_addresses() {
    let read = |operand: &str| good(&format!("vs_2_0\nmov r0, {operand}")).instructions[0].sources[0].register;
    let address = |index, component| Register {
        file: RegisterFile::Constant,
        index,
        relative: Some(Relative::Address(component)),
    };
    for text in ["c[a0.x + 3]", "c[3 + a0.x]", "c3[a0.x]", "c2[A0.X+1]", "C[ 1 + a0.r + 2 ]"] {
        assert_eq!(read(text), address(3, 0), "{text}");
    }
    assert_eq!(read("c[a0.w].x"), address(0, 3));
    assert_eq!(read("c[aL + 2]").relative, Some(Relative::Loop));
    assert_eq!(read("c[7]"), Register::new(RegisterFile::Constant, 7));
    assert_eq!(read("c65535").index, u16::MAX);
}

#[test]
fn comparisons_choose_the_operation() {
    let p = good("ps_2_a\nif b0\nif_gt r0.x, r1.x\nbreak\nbreak_ne r0, r1\nsetp_le_pp p0, r0, r1\ncallnz l0, !b1");
    let got: Vec<_> = p.instructions.iter().map(|i| (i.opcode, i.comparison)).collect();
    let want = [
        (Opcode::If, None),
        (Opcode::IfC, Some(Comparison::Gt)),
        (Opcode::Break, None),
        (Opcode::BreakC, Some(Comparison::Ne)),
        (Opcode::Setp, Some(Comparison::Le)),
        (Opcode::CallNz, None),
    ];
    assert_eq!(got, want);
    assert_eq!(p.instructions[5].sources[1].modifier, Modifier::Not);
}

#[test]
fn definitions_and_declarations_keep_their_places() {
    let p = good(
        "ps_2_0\ndcl_pp_centroid t0.xy\nmov r0, t0\ndef c1, 0, 0, 0, 0\ndcl_2d s0\ndefi i1, -1, 2, 3, 2147483647\ndefb b2, 1",
    );
    let places: Vec<_> = p.constants.iter().map(|d| d.position).collect();
    assert_eq!(places, [1, 1, 1]);
    assert_eq!(p.constants[1].value, ConstantValue::Int([-1, 2, 3, i32::MAX]));
    assert_eq!(p.constants[2].value, ConstantValue::Bool(true));
    let d = p.declarations[0];
    assert!(d.destination.partial_precision && d.destination.centroid);
    assert_eq!((d.usage, d.destination.mask.0, d.position), (Usage::Plain, 3, 0));
    assert_eq!((p.declarations[1].usage, p.declarations[1].position), (Usage::Sampler2d, 1));
}

#[test]
fn decimals_round_to_nearest_even() {
    let bits = |text: &str| match good(&format!("ps_2_0\ndef c0, {text}, 0, 0, 0")).constants[0].value {
        ConstantValue::Float(v) => v[0],
        other => panic!("{other:?}"),
    };
    for (text, want) in [
        ("1", 0x3f80_0000),
        ("-0", 0x8000_0000),
        ("0.1", 0x3dcc_cccd),
        ("16777217", 0x4b80_0000),
        ("16777219", 0x4b80_0002),
        ("1.00000005960464477539062500", 0x3f80_0000),
        ("1.00000005960464477539062501", 0x3f80_0001),
        ("1e-45", 1),
        ("0.7e-45", 0),
        ("1.17549435e-38", 0x0080_0000),
        ("3.4028235e38", 0x7f7f_ffff),
        ("3.4028235677973367e38", 0x7f80_0000),
        ("0x7fc00001", 0x7fc0_0001),
        ("1e-99999999999", 0),
    ] {
        if want == 0x7f80_0000 {
            assert_eq!(kinds(&format!("ps_2_0\ndef c0, {text}, 0, 0, 0")), [ErrorKind::ValueRange]);
        } else {
            assert_eq!(bits(text), want, "{text}");
        }
    }
}

#[test]
fn one_call_finds_the_errors_of_all_lines_and_operands() {
    use ErrorKind::{Mask, Swizzle, UnknownInstructionModifier, UnknownOpcode, UnknownRegister};
    let text = "ps_2_0\nmov r0.xx, q1\nmov r0, r1\nfoo r0\nmov_no r0, r1.q\n";
    let want = [Mask, UnknownRegister, UnknownOpcode, UnknownInstructionModifier, Swizzle];
    assert_eq!(kinds(text), want);
}

#[test]
fn canonical_text() {
    let text = "ps_1_4\nDEF c0 1.0 -.5 1e10 0.000001\ntexcrd r0.rg t0.xyw_dw\nPHASE\nmad_sat_x2 r0.rgba 1-r0 -c0_bias.aaaa r1.xyyy +mov r0.a, v0";
    let want = "ps_1_4\ndef c0, 1, -0.5, 1e10, 1e-6\ntexcrd r0.xy, t0_dw.xyw\nphase\nmad_x2_sat r0, 1-r0, -c0_bias.w, r1.xy\n+mov r0.w, v0\n";
    assert_eq!(print(&good(text)), want);
    assert_eq!(good(want).instructions[2].sources[1].swizzle, Swizzle::replicate(3));
}

#[test]
fn positions_count_lines_and_characters() {
    let text = ProgramText::new("\u{feff}ps_1_4\r\nmov r0, µ\n");
    assert_eq!(text.position(3), Some((1, 1)));
    assert_eq!(text.position(11), Some((2, 1)));
    let end = text.as_str().len() as u32;
    assert_eq!(text.position(end - 1), Some((2, 10)));
    assert_eq!(text.position(end), Some((3, 1)));
    assert_eq!(text.position(end + 1), None);
}
