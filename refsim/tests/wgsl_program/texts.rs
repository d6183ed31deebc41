//! Texts and words, without any adapter.

use crate::cases::{self, FORMATS, PIXEL, VERTEX, ideal, seeds};
use crate::modules;
use crate::random::Random;
use refsim::device::Profile;
use refsim::exec::wgsl::program::{self, Microcode, PixelShader, Strategy, VertexShader};
use refsim::exec::wgsl::{NativeOperations, NumberMode};
use refsim::exec::{CheckedProgram, Constants, PixelBindings};
use refsim::isa::Stage;

/// The words of a program, traced ones too.
fn words(name: &str, program: &CheckedProgram, profile: &Profile) -> Vec<Microcode> {
    let constants = Constants::default();
    let bindings = PixelBindings::new(&constants);
    let fail = |e| panic!("{name}: {e}");
    match cases::stage(program) {
        Stage::Vertex => {
            let shader = VertexShader::new(program, &profile.rules, &constants).unwrap_or_else(fail);
            vec![shader.microcode().unwrap_or_else(|e| panic!("{name}: {e}"))]
        }
        Stage::Pixel => [PixelShader::new, PixelShader::traced]
            .map(|make| {
                let shader = make(program, &profile.rules, &bindings).unwrap_or_else(|e| panic!("{name}: {e}"));
                shader.microcode().unwrap_or_else(|e| panic!("{name}: {e}"))
            })
            .to_vec(),
    }
}

/// Walks the words as the machine does and says what is wrong with them.
fn fault(code: &Microcode) -> Option<String> {
    let w = |at: usize| code.words.get(at).copied().unwrap_or(u32::MAX) as usize;
    let (end, pool, table) = (w(1), w(2), w(3));
    let mut at = w(0);
    let mut starts = Vec::new();
    let mut targets = if end == 0 { vec![] } else { vec![end] };
    loop {
        if at >= pool {
            return Some(format!("runs into the constants at word {at}"));
        }
        starts.push(at);
        let word = w(at);
        if matches!(word & 0xff, 1..=3 | 6) {
            let to = w(at + 1) & 0xffff;
            if to >= code.slots {
                return Some(format!("word {at}: writes slot {to} of {}", code.slots));
            }
            let operand = w(at + 1) >> 16;
            if operand >= code.slots && operand < 0x8000 || operand >= 0x8000 + table - pool && operand < 0xff00 {
                return Some(format!("word {at}: reads operand {operand:#x}"));
            }
        }
        at += match word & 0xff {
            0 => break,
            1 | 2 | 6 | 12 | 13 => 3,
            3 | 14 => 6,
            8..=11 | 15 => 2,
            7 => 5 + [0, 1, 4][word >> 24],
            35 => 6,
            32..=40 => 3,
            other => return Some(format!("word {at}: operation {other}")),
        };
        let word = *starts.last().unwrap_or(&0);
        if matches!(w(word) & 0xff, 12 | 32 | 33 | 35 | 36 | 38) && w(word + 1) != 0 {
            targets.push(w(word + 1));
        }
    }
    targets.iter().find(|t| !starts.contains(t)).map(|t| format!("a jump to word {t}, where nothing starts"))
}

#[test]
fn the_machine_is_valid_in_both_modules() {
    for mode in [NumberMode::Integer, NumberMode::Native] {
        for make in [modules::pixel, modules::vertex] {
            modules::validate(&make(mode, program::machine())).unwrap_or_else(|e| panic!("{e}"));
        }
    }
}

#[test]
fn the_validator_says_no_to_something() {
    assert!(modules::validate("fn shade() { return 1u; }").is_err());
}

#[test]
fn files_become_sound_words() {
    for format in ["fp32", "s3.12"] {
        let profile = ideal(format);
        for (name, program) in cases::files(&profile) {
            for code in words(&name, &program, &profile) {
                assert_eq!(fault(&code), None, "{name} in {format}");
            }
        }
    }
}

#[test]
fn random_programs_become_sound_words() {
    for seed in seeds(400) {
        let mut r = Random::new(seed);
        let versions = [&PIXEL[..], &VERTEX[..]].concat();
        let version = versions[seed as usize % versions.len()];
        let profile = ideal(FORMATS[seed as usize / versions.len() % FORMATS.len()]);
        let (text, program) = cases::random(version, 3, &profile, &mut r);
        for code in words(&text, &program, &profile) {
            assert_eq!(fault(&code), None, "seed {seed}:\n{text}");
        }
    }
}

/// Programs written out, in both modes, are valid WGSL.
fn check_text(name: &str, program: &CheckedProgram, profile: &Profile) {
    let constants = Constants::default();
    let bindings = PixelBindings::new(&constants);
    for mode in [NumberMode::Integer, NumberMode::Native] {
        let all = NativeOperations::all();
        let (unrolled, make): (_, fn(NumberMode, &str) -> String) = match cases::stage(program) {
            Stage::Pixel => {
                let shader = PixelShader::new(program, &profile.rules, &bindings).unwrap_or_else(|e| panic!("{e}"));
                (shader.unrolled(mode, all), modules::pixel)
            }
            Stage::Vertex => {
                let shader = VertexShader::new(program, &profile.rules, &constants).unwrap_or_else(|e| panic!("{e}"));
                (shader.unrolled(mode, all), modules::vertex)
            }
        };
        if let Some(unrolled) = unrolled {
            let text = make(mode, &unrolled.text);
            modules::validate(&text).unwrap_or_else(|e| panic!("{name}, {mode:?}: {e}\n{}", unrolled.text));
        }
    }
}

#[test]
fn files_become_valid_texts() {
    for format in ["fp32", "s3.12"] {
        let profile = ideal(format);
        for (name, program) in cases::files(&profile) {
            check_text(&name, &program, &profile);
        }
    }
}

#[test]
fn random_programs_become_valid_texts() {
    for seed in seeds(120) {
        let mut r = Random::new(seed ^ 0x7e87);
        let versions = [&PIXEL[..], &VERTEX[..]].concat();
        let version = versions[seed as usize % versions.len()];
        let profile = ideal(FORMATS[seed as usize / versions.len() % FORMATS.len()]);
        let (text, program) = cases::random(version, 3, &profile, &mut r);
        check_text(&format!("seed {seed}:\n{text}"), &program, &profile);
    }
}

#[test]
fn the_strategy_follows_the_mode() {
    let profile = ideal("fp32");
    let constants = Constants::default();
    let bindings = PixelBindings::new(&constants);
    let strategy = |lines: &str, mode| {
        let program = refsim::asm::assemble(lines).unwrap_or_else(|e| panic!("{e}"));
        let program = refsim::check::check(program, &profile).unwrap_or_else(|e| panic!("{e:?}"));
        let shader = PixelShader::new(&program, &profile.rules, &bindings).unwrap_or_else(|e| panic!("{e}"));
        shader.strategy(mode, NativeOperations::all())
    };
    let short = "ps_2_0\ndcl t0\nmov r0, t0\nmov oC0, r0";
    let long = format!("ps_2_0\ndcl t0\nmov r0, t0\n{}mov oC0, r0", "mad r0, r0, r0, t0\n".repeat(8));
    let flow = "ps_2_a\ndcl t0\nmov r0, t0\nif_lt r0.x, r0.y\nmov r0.z, t0.w\nendif\nmov oC0, r0";
    let (integer, native) = (NumberMode::Integer, NumberMode::Native);
    assert!(matches!(strategy(short, integer), Strategy::Unrolled(_)));
    assert_eq!(strategy(&long, integer), Strategy::Microcode);
    assert!(matches!(strategy(&long, native), Strategy::Unrolled(_)));
    assert_eq!(strategy(flow, native), Strategy::Microcode);
}
