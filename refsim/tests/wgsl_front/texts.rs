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
    let main = |inside: &str| {
        format!("@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{ {inside} return vec4f(1.0); }}")
    };
    let rows = [
        ("".to_owned(), "", "expected one function with @fragment, found 0"),
        ("@fragment fn".to_owned(), "", "expected"),
        (main("let x = uv.x + 1;").replace("+ 1", "+ true"), "uv.x + true", "Operation Add can't work with"),
        (main("var list = array<f32, 3>(); let x = list[i32(uv.x)];"), "list[i32(uv.x)]", "index that is known"),
        (main("var x = 0.0; while (x < uv.x) { x += 0.1; }"), "x", "a loop has no end that is known"),
        (
            main("").replace("@location(0) uv", "@location(0) @interpolate(flat) uv"),
            "",
            "interpolated with perspective",
        ),
        (main("let x = bitcast<u32>(uv.x);"), "bitcast<u32>", "bitcast is not translated"),
        (main("let x = atan2(uv.x, uv.y);"), "atan2", "`atan2` is not translated"),
        (
            "@group(0) @binding(0) var<storage> data: array<f32>;\n".to_owned() + &main("let x = data[0];"),
            "data",
            "address space",
        ),
        (
            "@group(0) @binding(0) var cube: texture_cube<f32>;\n".to_owned() + &main(""),
            "cube",
            "only `texture_2d<f32>`",
        ),
        (
            "@group(0) @binding(0) var<uniform> n: i32;\n".to_owned() + &main("let x = f32(n);"),
            "f32(n)",
            "a whole number that is known",
        ),
    ];
    for (text, place, reason) in rows {
        let refusal = translate_wgsl(&text).expect_err(&text);
        assert!(refusal.to_string().contains(reason), "{refusal}: {text}");
        let (start, length) = refusal.place();
        let quoted = &text[start..start + length];
        assert!(quoted.contains(place), "{quoted:?} of {text}");
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
