//! Parsing and printing, arbitrary text, spaces, and error messages.

use crate::asm_laws::{mutated, survives};
use crate::generate::{self, Layout};
use crate::random::Random;
use crate::spacing::has_one_reading;
use proptest::prelude::*;
use refsim::asm::{assemble, print};
use refsim::isa::Version;
use refsim::texture::TextureKind;

/// Text of a random program, with comments and random white space between statements.
fn program(nv: bool, seed: u64) -> String {
    let mut random = Random::new(seed);
    let kinds = [TextureKind::D2, TextureKind::D1, TextureKind::Volume, TextureKind::Cube, TextureKind::Rectangle];
    let samplers = kinds.into_iter().enumerate().collect();
    let layout = Layout { samplers, targets: 1, sampling: false };
    let (version, size) = (if nv { Version::Fp1_0 } else { Version::ArbFp1_0 }, random.below(4));
    let lines = generate::fragment(version, &layout, size, &mut random);
    let gaps = ["\n", "\r\n", " # a comment\n", "\t\n\n"];
    lines.iter().map(|line| line.clone() + random.of(&gaps)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn programs_read_back_as_printed(nv in any::<bool>(), seed in any::<u64>()) {
        let text = program(nv, seed);
        let read = assemble(&text).map_err(|e| TestCaseError::fail(format!("{text}\n{e:?}")))?;
        let printed = print(&read);
        let again = assemble(&printed);
        prop_assert_eq!(again.as_ref(), Ok(&read), "{}", printed);
        prop_assert_eq!(print(&again.unwrap()), printed);
    }

    #[test]
    fn no_text_has_two_readings(
        nv in any::<bool>(),
        seed in any::<u64>(),
    ) {
        let program = assemble(&program(nv, seed));
        let program = program.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
        let mut spaces = Random::new(!seed);
        has_one_reading(&print(&program), &[" ", "\n", "\t", "\r\n", " # 1.5; END\n"], |n| spaces.below(n));
    }

    #[test]
    fn any_bytes_are_survived(nv in any::<bool>(), bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let header = if nv { "!!FP1.0\n" } else { "!!ARBfp1.0\n" };
        survives(&(header.to_owned() + &String::from_utf8_lossy(&bytes)));
        survives(&("!!".to_owned() + &String::from_utf8_lossy(&bytes)));
    }

    #[test]
    fn any_words_are_survived(
        text in "!!(FP1.0|ARBfp1.0)\n(\\PC|[ \n,.;+|_()\\[\\]{}=-]|R0|H1|MOV|TEX|KIL|f\\[TEX0\\]|o\\[|p\\[|GT|DEFINE|PARAM|program\\.|fragment\\.|END|1\\.5|\\.\\.){0,60}",
    ) {
        survives(&text);
    }

    #[test]
    fn mutated_programs_are_survived(
        nv in any::<bool>(),
        seed in any::<u64>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0u8..4, any::<u8>()), 1..6),
    ) {
        let bytes = mutated(program(nv, seed).into_bytes(), edits);
        survives(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn messages_say_what_would_have_been_right() {
    let text = "!!FP1.0
MOVQ R0, R1;
MOVR R0.zx, R1;
MOVR R0, R1.xy;
MOVR R0 (XX.x), R1;
MOVR 5, R1;
MOVR R0, f[TEX9];
TEX R0, f[TEX0], TEX0, 4D;
DEFINE R3 = 1;
DEFINE one;
ADDR R0, R1
MULR R0, R1, {1, 2, 3, 4, 5};
MOVR R0, unknown;
MOVR R99999, R1;
";
    let errors = assemble(text).unwrap_err().errors;
    let lines: Vec<String> =
        errors.iter().map(|e| format!("{}..{} {e}\n  help: {}", e.span.start, e.span.end, e.help)).collect();
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn programs_of_the_time_read() {
    let text = "!!FP1.0
# a lamp
DECLARE C0={0.1, 0.2, 0.3, 0.4};
TEX R2, f[TEX2], TEX2, 2D;
DP3R_SAT R3.x, R2, f[TEX4];
MOVR R3.z, C0.x;
MULR R0.w, R2, {0.4, 0.000000, 0.000000, 0.000000}.x;
RCPR H0.w, R0.w;
MOVR R2.yzw, f[TEX2].wxyz;
ADDR R0.x, {1, 1, 1, 1}, -R0;
MOVR o[COLR], R0; 
END

# Passes = 4
";
    let program = assemble(text).unwrap();
    assert_eq!(program.instructions.len(), 8);
    survives(text);
    insta::assert_snapshot!(print(&program));
}
