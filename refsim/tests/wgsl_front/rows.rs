//! Shaders with values for their uniforms: the shaders of docs/examples/wgsl, and small ones.

use super::drawn::Uniforms;
use super::texts::EXAMPLES;

/// A shader with its uniforms.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) uniforms: Uniforms<'static>,
    /// Replacements, as old and new text, for uniform structures and derivatives in the native text.
    pub(crate) native: &'static [(&'static str, &'static str)],
    /// Body of a small shader of `uv`; empty for an example, whose text is in its file.
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

fn examples() -> [Row; 12] {
    [
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
            // Compute shaders have no derivatives; the replacement is the derivative of a plane over 16 pixels.
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
    ]
}

/// Short techniques: bodies of functions of `uv`, each after a comment with its name.
fn small() -> impl Iterator<Item = Row> {
    let parts = include_str!("small.wgsl").split("// ").skip(1);
    parts.filter_map(|part| part.split_once('\n')).map(|(name, body)| Row { body, ..example(name, &[]) })
}

/// All of them.
pub(crate) fn rows() -> impl Iterator<Item = Row> {
    examples().into_iter().chain(small())
}
