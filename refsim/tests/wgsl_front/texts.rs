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
        (main("var x = 0.0; while (x < uv.x) { x += 0.1; }"), "while (x < uv.x)", "this loop has no known end"),
        (main("").replace("@location(0) uv", "@location(0) @interpolate(flat) uv"), "uv", "perspective interpolation"),
        (main("if (uv.x > 0.5) { return vec4f(dpdx(uv.y)); }"), "dpdx", "expected uniform control flow"),
        (
            "fn f(a: ptr<function, f32>, b: ptr<function, f32>) { *a = *b + 1.0; }\n".to_owned()
                + &main("var x = uv.x; f(&x, &x);"),
            "f(&x, &x)",
            "expected pointers to different variables",
        ),
        (
            "var<private> x: f32;\nfn f(a: ptr<private, f32>) { *a = x; }\n".to_owned() + &main("f(&x);"),
            "f(&x)",
            "expected pointers to different variables",
        ),
        (main("var list = array<f32, 5000>(); list[3] = uv.x;"), "", "at most 4096 numbers"),
        (main("var i = -1; var list = array<f32, 3>(); let x = list[i];"), "list[i]", "index -1 is out of range"),
        (main("let x = 3000000000;"), "3000000000", "3000000000"),
        ("override n: f32;\n".to_owned() + &main("let x = uv.x * n;"), "", "`override n` has no value in the text"),
        (
            "@group(0) @binding(0) var data: texture_2d<f32>;\n".to_owned()
                + &main("let x = textureLoad(data, vec2i(1, 2), 0);"),
            "textureLoad",
            "`textureLoad` is not translated",
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
        let quoted = refusal.place().map_or("", |span| &text[span.start as usize..span.end as usize]);
        assert!(quoted.contains(place), "{quoted:?} of {text}");
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
