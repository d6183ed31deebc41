//! Tests f16: text with operations in f16 against the program with instruction formats, and programs against a plain
//! evaluation.

use refsim::front::{WgslOperation, wgsl_operations};
use refsim::isa::{Opcode, Program};
use rustc_apfloat::ieee::{Half, Single};
use rustc_apfloat::{Float, FloatConvert, Round};

use super::drawn::{Inputs, draw, drawn_of, texels};
use super::rows::rows;
use super::texts::EXAMPLES;

/// Indices of the operations' instructions, without moves, which compute nothing.
fn instructions(program: &Program, operations: &[&WgslOperation]) -> Vec<usize> {
    let is_move = |at: usize| {
        let instruction = &program.instructions[at];
        instruction.opcode == Opcode::Mov && instruction.fragment.precision.is_none()
    };
    let is_of = |at: usize| {
        let own = program.instructions[at].span;
        operations.iter().any(|operation| (operation.span.start, operation.span.end) == (own.start, own.end))
    };
    (0..program.instructions.len()).filter(|at| !is_move(*at) && is_of(*at)).collect()
}

/// The rewritten text computes what the program computes with the same operations in a format with 5 exponent and 10
/// fraction bits.
pub(crate) fn rewritten_texts_have_the_bits_of_formats() {
    let texels = texels(1, 24, |texel| texel);
    for (seed, row) in (0..).zip(rows()) {
        let text = row.text();
        let operations = wgsl_operations(&text).expect("a translation");
        assert!(operations.len() > 3, "{}: {operations:?}", row.name);
        let mut number = draw(seed, 24);
        // The first round takes all operations except derivatives: `fwidth` rounds internally, and WGSL has it only in
        // f32.
        for share in [1.0, 0.4] {
            let is_chosen = |operation: &&WgslOperation| {
                !text[operation.span.start as usize..].starts_with("fwidth") && number() < share
            };
            let some: Vec<&WgslOperation> = operations.iter().filter(is_chosen).collect();
            let inputs = Inputs { uniforms: row.uniforms, texels: &texels, half: &|_| Vec::new() };
            let formats = drawn_of(&text, &Inputs { half: &|program| instructions(program, &some), ..inputs });
            let rewritten = WgslOperation::in_half(&text, some);
            let half = drawn_of(&rewritten, &inputs);
            let differ = formats.iter().zip(&half).position(|(a, b)| a.map(f64::to_bits) != b.map(f64::to_bits));
            assert_eq!(differ.map(|at| (formats[at], half[at])), None, "{}:\n{rewritten}", row.name);
        }
    }
}

pub(crate) fn rewritten_texts_as_they_are() {
    for name in ["fresnel", "parallax", "normal_map"] {
        let (_, text) = EXAMPLES.iter().find(|(known, _)| *known == name).expect("an example");
        let operations = wgsl_operations(text).expect("a translation");
        insta::assert_snapshot!(format!("half_{name}"), WgslOperation::in_half(text, &operations));
    }
}

/// Some operations stay f32, because the text cannot state the same in f16: operations with a constant beyond f16,
/// assignments whose target calls a function, and all operations of a text that redefines a name of f16.
pub(crate) fn some_operations_stay_single() {
    let found = |before: &str, inside: &str| {
        let text = format!(
            "{before}\n@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{ {inside} return vec4f(x); }}"
        );
        let operations = wgsl_operations(&text).unwrap_or_else(|refusal| panic!("{text}: {refusal}"));
        let span =
            |operation: &WgslOperation| text[operation.span.start as usize..operation.span.end as usize].to_owned();
        operations.iter().map(span).collect::<Vec<_>>()
    };
    assert_eq!(found("", "let x = min(uv.x + 1.0, 1e6);"), ["uv.x + 1.0"]);
    assert_eq!(found("const FAR = vec2f(1, 70000);", "let x = dot(uv * FAR, uv);"), ["dot(uv * FAR, uv)"]);
    assert_eq!(found("", "let x = clamp(uv.x, -65504.0, 65504.0);"), ["clamp(uv.x, -65504.0, 65504.0)"]);
    let counts = "var<private> k: i32;\nfn next() -> i32 { k++; return k; }";
    assert_eq!(found(counts, "var a = array<f32, 3>(); a[next()] += uv.x; let x = a[1];"), [""; 0]);
    assert_eq!(found("alias f16 = f32;", "let x = uv.x * 2.0;"), [""; 0]);
    assert_eq!(found("", "let vec2h = uv; let x = vec2h.x * 2.0;"), [""; 0]);
    assert_eq!(found("fn vec3h(x: f32) -> f32 { return x; }", "let x = vec3h(uv.x) * 2.0;"), [""; 0]);
    assert_eq!(found("enable f16;", "let h: f16 = f16(uv.x); let x = f32(h) * 2.0;"), ["f32(h) * 2.0"]);
}

/// Converts a program's value to f16.
fn to_half(x: f32) -> Half {
    Single::from_bits(x.to_bits().into()).convert(&mut false).value
}

fn to_f64(x: Half) -> f64 {
    let single: Single = x.convert(&mut false).value;
    f64::from(f32::from_bits(single.to_bits() as u32))
}

/// Random programs without branches: each instruction rounds once, to nearest even.
pub(crate) fn straight_programs_compute_what_ieee_half_computes() {
    type Operation = (&'static str, fn(Half, Half) -> Half);
    let operations: [Operation; 8] = [
        ("A + B", |a, b| (a + b).value),
        ("A - B", |a, b| (a - b).value),
        ("A * B", |a, b| (a * b).value),
        ("A / B", |a, b| (a * (Half::from_u128(1).value / b).value).value),
        ("min(A, B)", |a, b| if b < a { b } else { a }),
        ("max(A, B)", |a, b| if b > a { b } else { a }),
        ("A * 0.25h - floor(B)", |a, b| {
            let quarter = (a * to_half(0.25)).value;
            (quarter - b.round_to_integral(Round::TowardNegative).value).value
        }),
        ("fma(A, B, 0.3h)", |a, b| ((a * b).value + to_half(0.3)).value),
    ];
    let mut compared = 0;
    for seed in 0..20 {
        let mut number = draw(seed, 20);
        let mut below = |count: usize| (number() * count as f32) as usize;
        let (mut lines, mut steps) = (String::new(), Vec::new());
        for line in 4..16 {
            let (at, a, b) = (below(operations.len()), below(line), below(line));
            let own = operations[at].0.replace('A', &format!("x{a}")).replace('B', &format!("x{b}"));
            lines += &format!("let x{line} = {own};\n");
            steps.push((operations[at].1, a, b));
        }
        let text = format!(
            "enable f16;\n@group(0) @binding(0) var data: texture_2d<f32>;\n@group(0) @binding(1) var near: sampler;\n\
             @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n\
             let t = vec4h(textureSample(data, near, uv));\nlet x0 = t.x; let x1 = t.y; let x2 = t.z; let x3 = t.w;\n\
             {lines}return vec4f(vec4h(x15, x14, x13, x12));\n}}"
        );
        let texels = texels(seed, 24, |texel| texel.map(|x| x * 6.0 - 3.0));
        let pixels = drawn_of(&text, &Inputs { uniforms: &[], texels: &texels, half: &|_| Vec::new() });
        for (pixel, texel) in pixels.iter().zip(&texels) {
            let mut values = texel.map(to_half).to_vec();
            steps.iter().for_each(|(of, a, b)| values.push(of(values[*a], values[*b])));
            // Beyond 60,000, cards and IEEE 754 differ in what overflows; subnormal numbers may be flushed.
            if values.iter().any(|x| to_f64(*x).is_nan() || to_f64(*x).abs() >= 60_000.0) {
                continue;
            }
            let expected = [15, 14, 13, 12].map(|at: usize| to_f64(values[at]));
            assert_eq!(*pixel, expected, "{texel:?}\n{text}");
            compared += 1;
        }
    }
    assert!(compared > 2_500, "{compared} pixels are too few");
}
