//! Words, without an adapter.

use crate::cases::{self, FORMATS, PIXEL, ideal};
use crate::environment::seeds;
use crate::random::Random;
use refsim::device::Profile;
use refsim::exec::wgsl::program::{Interpolation, Microcode, PixelShader};
use refsim::exec::{CheckedProgram, Constants, PixelBindings};
use refsim::isa::Stage;
use refsim::num::Format;

/// The words of a pixel program, with and without traces and interpolation.
fn words(name: &str, program: &CheckedProgram, profile: &Profile) -> Vec<Microcode> {
    let constants = Constants::default();
    let bindings = PixelBindings::new(&constants);
    let interpolation = |iterator| Interpolation { components: vec![0, 3, 33, 44], iterator };
    let interpolations = [None, Some(interpolation(Format::FP32)), Some(interpolation(Format::FP16))];
    let mut all = Vec::new();
    for traced in [false, true] {
        // Shaders have no flow control.
        let Ok(shader) = PixelShader::new(program, &profile.rules, &bindings, traced) else { return Vec::new() };
        for interpolation in &interpolations {
            all.push(shader.microcode(interpolation.as_ref()).unwrap_or_else(|e| panic!("{name}: {e}")));
        }
    }
    all
}

/// Length of an operation in words, by name.
fn length(name: &str, word: usize) -> Option<usize> {
    Some(match name {
        "END" | "ENTER" => 1,
        "UNLESS" | "FETCHED" => 2,
        "SUM" | "TRACE" => 4,
        "DOT" => 6,
        "FETCH" => 5 + [0, 1, 4].get(word >> 24)?,
        _ => 3,
    })
}

/// Walks the words as the machine does; returns a description of the first error.
fn fault(code: &Microcode) -> Option<String> {
    let names = operation_names();
    let w = |at: usize| code.words.get(at).copied().unwrap_or(u32::MAX) as usize;
    let pool = w(1);
    let mut at = w(0);
    let (mut starts, mut targets) = (Vec::new(), Vec::new());
    while at < pool {
        let word = w(at);
        let Some(name) = names.get(word & 0xff) else { return Some(format!("word {at}: operation {}", word & 0xff)) };
        starts.push(at);
        if matches!(name.as_str(), "ALU" | "DOT" | "COPY" | "AND" | "OR" | "AND_NOT" | "SELECT") {
            let to = w(at + 1) & 0xffff;
            if to >= code.slots && !(0xff00..0xff42).contains(&to) {
                return Some(format!("word {at}: writes slot {to} of {}", code.slots));
            }
            let operand = w(at + 1) >> 16;
            if operand >= code.slots && operand < 0x8000
                || operand >= 0x8000 + code.words.len() - pool && operand < 0xfe00
            {
                return Some(format!("word {at}: reads operand {operand:#x}"));
            }
        }
        if name == "UNLESS" {
            targets.push(w(at + 1));
        }
        let Some(length) = length(name, word) else { return Some(format!("word {at}: detail of {name}")) };
        at += length;
    }
    if at != pool || !starts.contains(&w(2)) {
        return Some(format!("ends at word {at} of {pool}"));
    }
    targets.iter().find(|t| !starts.contains(t)).map(|t| format!("a jump to word {t}, where nothing starts"))
}

/// The machine's operations in numerical order, parsed from its text.
fn operation_names() -> Vec<String> {
    let text = refsim::exec::wgsl::program::machine();
    let names = text.lines().map_while(|line| line.strip_prefix("const VM_")?.split(':').next().map(str::to_owned));
    names.collect()
}

#[test]
fn files_become_sound_words() {
    for format in ["fp32", "s3.12"] {
        let profile = ideal(format);
        for (name, program) in cases::files(&profile).into_iter().filter(|(_, p)| p.version.stage() == Stage::Pixel) {
            for code in words(&name, &program, &profile) {
                assert_eq!(fault(&code), None, "{name} in {format}");
            }
        }
    }
}

#[test]
fn random_programs_become_sound_words() {
    let formats: Vec<&str> = FORMATS.split(' ').collect();
    for seed in seeds(400, 30) {
        let mut r = Random::new(seed);
        let version = PIXEL[seed as usize % PIXEL.len()];
        let profile = ideal(formats[seed as usize / PIXEL.len() % formats.len()]);
        let (text, program) = cases::random(version, 3, &profile, &mut r);
        for code in words(&text, &program, &profile) {
            assert_eq!(fault(&code), None, "seed {seed}:\n{text}");
        }
    }
}
