//! Translations as text, and refusals.

use refsim::asm::print;
use refsim::front::translate_wgsl;

macro_rules! example {
    ($name:literal) => {
        include_str!(concat!("../../../docs/examples/wgsl/", $name, ".wgsl"))
    };
}

/// The shaders of docs/examples/wgsl.
pub(crate) const EXAMPLES: [(&str, &str); 12] = [
    ("bloom", example!("bloom")),
    ("dither", example!("dither")),
    ("fresnel", example!("fresnel")),
    ("gamma", example!("gamma")),
    ("ggx", example!("ggx")),
    ("noise", example!("noise")),
    ("normal_map", example!("normal_map")),
    ("parallax", example!("parallax")),
    ("rounded_box", example!("rounded_box")),
    ("shadow", example!("shadow")),
    ("skin", example!("skin")),
    ("tone_map", example!("tone_map")),
];

pub(crate) fn translations_as_they_are() {
    for name in ["fresnel", "shadow"] {
        let (_, text) = EXAMPLES.iter().find(|(known, _)| *known == name).expect("an example");
        insta::assert_snapshot!(name, print(&translate_wgsl(text).expect("a translation")));
    }
}

pub(crate) fn what_is_refused_says_where_and_why() {
    let main = "@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f";
    for row in include_str!("refused.txt").lines().filter(|row| !row.starts_with('#')) {
        let columns: Vec<&str> = row.split('|').map(str::trim).collect();
        let text = match columns[2..] {
            [before, inside] => format!("{before} {main} {{ {inside} return vec4f(1.0); }}"),
            _ => columns[2].to_owned(),
        };
        let refusal = translate_wgsl(&text).expect_err(&text);
        assert!(refusal.to_string().contains(columns[0]), "{refusal}: {text}");
        let quoted = refusal.place().map_or("", |span| &text[span.start as usize..span.end as usize]);
        assert!(quoted.contains(columns[1]), "{quoted:?} of {text}");
    }
}

/// Derivatives next to a condition, which WGSL accepts.
pub(crate) fn derivatives_in_uniform_control_flow_are_translated() {
    let text = |before: &str, inside: &str| {
        format!("{before} @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{ {inside} }}")
    };
    for text in [
        text(
            "@group(0) @binding(0) var<uniform> t: f32;",
            "if (t > 0.5) { return vec4f(dpdx(uv.y)); } return vec4f();",
        ),
        text("", "if (uv.x > 0.5) { discard; } return vec4f(fwidth(uv.y));"),
        text("", "for (var i = 0; i < 3; i++) { if (uv.x > f32(i)) { break; } } return vec4f(dpdy(uv.y));"),
        text(
            "diagnostic(off, derivative_uniformity);",
            "var x = 0.0; if (uv.x > 0.5) { x = dpdx(uv.y); } return vec4f(x);",
        ),
    ] {
        assert!(translate_wgsl(&text).is_ok(), "{text}");
    }
}

pub(crate) fn places_are_those_of_the_text() {
    for (name, text) in EXAMPLES {
        let program = translate_wgsl(text).unwrap_or_else(|refusal| panic!("{name}: {refusal:?}"));
        for index in 0..program.instructions.len() {
            let quoted = program.instruction_text(index);
            assert!(quoted.is_some_and(|quoted| quoted.len() < 120), "{name}, instruction {index}");
        }
    }
}
