//! Shaders with values for their uniforms: those of docs/examples/wgsl, and small ones.

use super::drawn::Uniforms;
use super::texts::EXAMPLES;

/// A shader with its uniforms.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) uniforms: Uniforms<'static>,
    /// What stands for structures of uniforms, and for derivatives, in the native text.
    pub(crate) native: &'static [(&'static str, &'static str)],
    /// The body of a small shader of `uv`; of an example the text is in its file.
    body: &'static str,
}

impl Row {
    pub(crate) fn text(&self) -> String {
        match EXAMPLES.iter().find(|(name, _)| *name == self.name) {
            Some((_, text)) => (*text).to_owned(),
            None => format!("@fragment\nfn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n{}\n}}", self.body),
        }
    }
}

const fn example(name: &'static str, uniforms: Uniforms<'static>) -> Row {
    Row { name, uniforms, native: &[], body: "" }
}

const fn small(name: &'static str, body: &'static str) -> Row {
    Row { name, uniforms: &[], native: &[], body }
}

/// The examples.
pub(crate) const ROWS: &[Row] = &[
    example("bloom", &[("threshold", [1.0, 0.0, 0.0, 0.0]), ("knee", [0.5, 0.0, 0.0, 0.0])]),
    example("dither", &[("levels", [255.0, 0.0, 0.0, 0.0])]),
    example("fresnel", &[("f0", [0.04, 0.3, 0.9, 0.0])]),
    example("gamma", &[]),
    example("ggx", &[("roughness", [0.3, 0.0, 0.0, 0.0])]),
    example("noise", &[("scale", [5.0, 0.0, 0.0, 0.0])]),
    example("normal_map", &[("light", [0.4, 0.3, 0.8, 0.0])]),
    example("parallax", &[("view", [0.3, 0.2, 0.9, 0.0]), ("depth", [0.2, 0.0, 0.0, 0.0])]),
    Row {
        native: &[("@group(0) @binding(0) var<uniform> box: Box", "const box = Box(vec2f(24.0, 16.0), 6.0)")],
        ..example("rounded_box", &[("box.half_size", [24.0, 16.0, 0.0, 0.0]), ("box.radius", [6.0, 0.0, 0.0, 0.0])])
    },
    Row {
        // Compute shaders have no derivatives: that of a plane over 16 pixels.
        native: &[("fwidth(depth)", "0.4 / 16.0")],
        ..example("shadow", &[("bias", [0.3, 0.0, 0.0, 0.0]), ("texels", [4.0, 0.0, 0.0, 0.0])])
    },
    Row {
        native: &[(
            "@group(0) @binding(0) var<uniform> bones: Bones",
            "const bones = Bones(mat3x3f(1, 0, 0, 0, 1, 0, 0, 0, 1), mat3x3f(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1))",
        )],
        ..example(
            "skin",
            &[
                ("bones.first[0]", [1.0, 0.0, 0.0, 0.0]),
                ("bones.first[1]", [0.0, 1.0, 0.0, 0.0]),
                ("bones.first[2]", [0.0, 0.0, 1.0, 0.0]),
                ("bones.second[0]", [0.8, 0.6, 0.0, 0.0]),
                ("bones.second[1]", [-0.6, 0.8, 0.0, 0.0]),
                ("bones.second[2]", [0.0, 0.0, 1.0, 0.0]),
            ],
        )
    },
    example("tone_map", &[("exposure", [1.5, 0.0, 0.0, 0.0])]),
];

/// Techniques of a few lines.
pub(crate) const SMALL: &[Row] = &[
    small("vignette", "let d = length(uv - vec2f(0.5)); return vec4f(vec3f(1.0 - smoothstep(0.3, 0.8, d)), 1.0);"),
    small("checker", "let c = floor(uv * 4.0); return vec4f(vec3f((c.x + c.y) % 2.0 * 0.8 + 0.1), 1.0);"),
    small(
        "hue",
        "let k = abs(fract(vec3f(uv.x) + vec3f(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - vec3f(3.0)) - vec3f(1.0);\n\
         return vec4f(mix(vec3f(1.0), saturate(k), uv.y), 1.0);",
    ),
    small(
        "turned_box",
        "let turn = mat2x2f(cos(0.5), sin(0.5), -sin(0.5), cos(0.5)); let p = turn * (uv - vec2f(0.5));\n\
         let q = abs(p) - vec2f(0.2, 0.1); return vec4f(vec3f(saturate(max(q.x, q.y) * 8.0)), 1.0);",
    ),
    small(
        "julia",
        "var z = uv * 2.0 - vec2f(1.0); var n = 0.0;\nfor (var i = 0; i < 6; i++) {\n\
         if (dot(z, z) > 4.0) { break; }\nz = vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + vec2f(-0.4, 0.6);\n\
         n += 1.0;\n}\nreturn vec4f(vec3f(n / 6.0), 1.0);",
    ),
    small("gaussian", "let d = uv * 6.0 - vec2f(3.0); return vec4f(vec3f(exp(-0.5 * dot(d, d))), 1.0);"),
    small(
        "octahedron",
        "var n = vec3f(uv * 2.0 - vec2f(1.0), 0.0); n.z = 1.0 - abs(n.x) - abs(n.y); let t = max(-n.z, 0.0);\n\
         n.x += select(t, -t, n.x >= 0.0); n.y += select(t, -t, n.y >= 0.0);\n\
         return vec4f(normalize(n) * 0.5 + vec3f(0.5), 1.0);",
    ),
    small(
        "fog",
        "let far = 1.0 - exp2(-uv.y * uv.y * 4.0);\n\
         return vec4f(mix(vec3f(uv.x, 0.3, 0.1), vec3f(0.6, 0.7, 0.8), far), 1.0);",
    ),
    small(
        "hard_light",
        "let a = vec3f(uv.x, 0.5, uv.y); let b = vec3f(uv.y, uv.x, 0.3);\n\
         return vec4f(select(1.0 - 2.0 * (1.0 - a) * (1.0 - b), 2.0 * a * b, b < vec3f(0.45)), 1.0);",
    ),
    small(
        "glass",
        "let xy = uv * 1.4 - vec2f(0.7); let n = vec3f(xy, sqrt(1.0 - dot(xy, xy)));\n\
         return vec4f(refract(vec3f(0.0, 0.0, -1.0), n, 1.0 / 1.5) * 0.5 + vec3f(0.5), 1.0);",
    ),
    small(
        "luma",
        "let c = vec3f(uv, 0.4); let y = dot(c, vec3f(0.2126, 0.7152, 0.0722));\n\
         return vec4f(vec3f(y) + (c - vec3f(y)) * 1.5, 1.0);",
    ),
    small(
        "contour",
        "let h = sin(uv.x * 5.0) * cos(uv.y * 4.0); let line = abs(fract(h * 4.0 + 0.3) - 0.5);\n\
         return vec4f(vec3f(smoothstep(0.02, 0.1, line)), 1.0);",
    ),
];
