//! Parsing and printing, arbitrary text, spaces, and error messages.

use crate::asm_laws::survives;
use crate::spacing::has_one_reading;
use proptest::prelude::*;
use refsim::asm::{assemble, print};
use refsim::isa::{ConditionTest, Opcode, OpcodeClass, Spelling, TextureTarget, Version};

/// Choices determined by a list of numbers, so that proptest can shrink it.
pub(crate) struct Choices<'a>(std::slice::Iter<'a, u32>);

impl<'a> Choices<'a> {
    pub(crate) fn new(list: &'a [u32]) -> Self {
        Self(list.iter())
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        *self.0.next().unwrap_or(&0) as usize % n
    }

    fn pick<'t>(&mut self, from: &[&'t str]) -> &'t str {
        from[self.below(from.len())]
    }
}

fn swizzle(c: &mut Choices<'_>, scalar: bool) -> String {
    let letter = |c: &mut Choices<'_>| c.pick(&["x", "y", "z", "w"]).to_owned();
    match c.below(3) {
        0 => format!(".{}", letter(c)),
        1 if !scalar => format!(".{}{}{}{}", letter(c), letter(c), letter(c), letter(c)),
        _ if scalar => ".w".to_owned(),
        _ => String::new(),
    }
}

const STATE: &[&str] = &[
    "material.back.shininess",
    "light[3].spot.direction",
    "lightmodel.scenecolor",
    "lightprod[0].diffuse",
    "fog.params",
    "matrix.mvp.inverse.row[2]",
    "matrix.texture[1].row[0]",
];

fn source(c: &mut Choices<'_>, nv: bool, scalar: bool) -> String {
    let n = c.below(8);
    let register = match (c.below(8), nv) {
        (0, true) => format!("f[TEX{n}]"),
        (1, true) => c.pick(&["f[COL0]", "f[COL1]", "f[FOGC]", "f[WPOS]"]).to_owned(),
        (2, true) => format!("p[{n}]"),
        (3, true) => format!("H{n}"),
        (0, false) => format!("fragment.texcoord[{n}]"),
        (1, false) => c.pick(&["fragment.color", "fragment.color.secondary", "fragment.fogcoord"]).to_owned(),
        (2, false) => format!("program.{}[{n}]", c.pick(&["env", "local"])),
        (5, false) => format!("state.{}", c.pick(STATE)),
        (4, _) => c.pick(&["{1, 2.5, -3e-3, 4}", "{0.5}", "{-1, 0}", "half", "gain"]).to_owned(),
        _ => format!("R{n}"),
    };
    let swizzle = swizzle(c, scalar);
    match c.below(4) {
        0 => format!("-{register}{swizzle}"),
        1 if nv => format!("|{register}{swizzle}|"),
        2 if nv => format!("-|{register}{swizzle}|"),
        _ => format!("{register}{swizzle}"),
    }
}

pub(crate) fn statement(c: &mut Choices<'_>, version: Version) -> String {
    let nv = version == Version::Fp1_0;
    let all: Vec<&Spelling> = Spelling::ALL.iter().filter(|s| s.opcode.info().available(version)).collect();
    let s = all[c.below(all.len())];
    let condition = |c: &mut Choices<'_>| {
        let test = ConditionTest::ALL[c.below(8)].name();
        test.to_owned() + &swizzle(c, false)
    };
    if s.opcode == Opcode::Kil {
        let what = if nv { condition(c) } else { source(c, nv, false) };
        return format!("KIL {what};");
    }
    let (suffix, saturate) =
        (if nv { c.pick(&["", "R", "H", "X", "C", "RC", "HC"]) } else { "" }, c.pick(&["", "_SAT"]));
    let place = match (c.below(4), nv) {
        (0, true) => c.pick(&["RC", "HC", "o[COLR]", "o[COLH]", "o[DEPR].z", "H7"]).to_owned(),
        (0, false) => c.pick(&["result.color", "result.depth.z"]).to_owned(),
        _ => format!("R{}{}", c.below(8), c.pick(&["", ".x", ".xyz", ".w", ".yw"])),
    };
    let guard = if nv && c.below(3) == 0 { format!(" ({})", condition(c)) } else { String::new() };
    let mut line = format!("{}{suffix}{saturate} {place}{guard}", s.name);
    let texture = s.opcode.info().class == OpcodeClass::Texture;
    let count = usize::from(s.opcode.info().source_count(version).unwrap()) - usize::from(texture);
    if s.opcode == Opcode::Swz {
        return format!("{line}, R{}, -x, 0, -1, {};", c.below(8), c.pick(&["w", "1", "-y"]));
    }
    for _ in 0..count {
        line += &format!(", {}", source(c, nv, s.opcode.is_scalar()));
    }
    if texture {
        let unit = c.below(16);
        line += &if nv { format!(", TEX{unit}") } else { format!(", texture[{unit}]") };
        line += &format!(", {}", TextureTarget::ALL[c.below(5)].name());
    }
    line + ";"
}

fn program(version: Version, choices: &[u32]) -> String {
    let mut c = Choices(choices.iter());
    let mut text = format!("{version}\n");
    text += match version {
        Version::Fp1_0 => "DEFINE half = 0.5; # a comment\nDECLARE gain = {1, 2};\nDECLARE none;\n",
        _ => c.pick(&["", "OPTION ARB_fog_exp;\n", "OPTION ARB_fog_linear;\n"]),
    };
    if version == Version::ArbFp1_0 {
        text += "TEMP R0, R1, R2, R3, R4, R5, R6, R7;\nPARAM half = 0.5; # a comment\nPARAM gain = {1, 2};\n";
    }
    for _ in 0..c.below(12) {
        text += &statement(&mut c, version);
        text += c.pick(&["\n", " ", "\r\n", "\t# more\n"]);
    }
    text + "END\n"
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1024))]

    #[test]
    fn programs_read_back_as_printed(nv in any::<bool>(), choices in prop::collection::vec(any::<u32>(), 0..200)) {
        let version = if nv { Version::Fp1_0 } else { Version::ArbFp1_0 };
        let text = program(version, &choices);
        let read = assemble(&text).map_err(|e| TestCaseError::fail(format!("{text}\n{e:?}")))?;
        let printed = print(&read);
        let again = assemble(&printed);
        prop_assert_eq!(again.as_ref(), Ok(&read), "{}", printed);
        prop_assert_eq!(print(&again.unwrap()), printed);
    }

    #[test]
    fn no_text_has_two_readings(
        nv in any::<bool>(),
        choices in prop::collection::vec(any::<u32>(), 0..120),
        spaces in prop::collection::vec(any::<u32>(), 0..300),
    ) {
        let program = assemble(&program(if nv { Version::Fp1_0 } else { Version::ArbFp1_0 }, &choices));
        let program = program.map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
        let mut spaces = Choices(spaces.iter());
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
        choices in prop::collection::vec(any::<u32>(), 0..120),
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0u8..3, any::<u8>()), 1..6),
    ) {
        let mut bytes = program(if nv { Version::Fp1_0 } else { Version::ArbFp1_0 }, &choices).into_bytes();
        for (at, kind, byte) in edits {
            let at = at.index(bytes.len());
            match kind {
                0 => drop(bytes.remove(at)),
                1 => bytes.insert(at, bytes[at]),
                _ => bytes[at] = byte & 0x7f,
            }
        }
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
