//! The example shaders on an adapter: translated and run by each executor, and run by its driver.

use std::sync::Arc;

use refsim::exec::gpu::Gpu;
use refsim::machine::Executor;

use super::drawn::{SIDE, Uniforms, drawn, drawn_by};
use super::texts::EXAMPLES;

/// Tolerance per component. WGSL's bounds differ by function and argument; among these shaders GGX, whose quotient of
/// small numbers is bright, has the largest difference on lavapipe: 2e-5.
const TOLERANCE: f64 = 1e-4;

/// A shader, its uniforms, and their replacements in the native text.
struct Row {
    name: &'static str,
    uniforms: Uniforms<'static>,
    native: &'static [(&'static str, &'static str)],
}

/// Shaders without textures, and without the chaos of a hash by a sine.
const ROWS: &[Row] = &[
    Row {
        name: "ggx",
        uniforms: &[("roughness", [0.3, 0.0, 0.0, 0.0])],
        native: &[("@group(0) @binding(0) var<uniform> roughness: f32", "const roughness = 0.3f")],
    },
    Row {
        name: "fresnel",
        uniforms: &[("f0", [0.04, 0.3, 0.9, 0.0])],
        native: &[("@group(0) @binding(0) var<uniform> f0: vec3f", "const f0 = vec3f(0.04, 0.3, 0.9)")],
    },
    Row {
        name: "tone_map",
        uniforms: &[("exposure", [1.5, 0.0, 0.0, 0.0])],
        native: &[("@group(0) @binding(0) var<uniform> exposure: f32", "const exposure = 1.5f")],
    },
    Row {
        name: "rounded_box",
        uniforms: &[("box.half_size", [24.0, 16.0, 0.0, 0.0]), ("box.radius", [6.0, 0.0, 0.0, 0.0])],
        native: &[("@group(0) @binding(0) var<uniform> box: Box", "const box = Box(vec2f(24.0, 16.0), 6.0)")],
    },
    Row {
        name: "shadow",
        uniforms: &[("bias", [0.3, 0.0, 0.0, 0.0]), ("texels", [4.0, 0.0, 0.0, 0.0])],
        native: &[
            ("@group(0) @binding(0) var<uniform> bias: f32", "const bias = 0.3f"),
            ("@group(0) @binding(1) var<uniform> texels: f32", "const texels = 4.0f"),
            // Compute shaders have no derivatives: that of a plane over 16 pixels.
            ("fwidth(depth)", "0.4 / 16.0"),
        ],
    },
    Row { name: "gamma", uniforms: &[], native: &[] },
    Row {
        name: "dither",
        uniforms: &[("levels", [255.0, 0.0, 0.0, 0.0])],
        native: &[("@group(0) @binding(0) var<uniform> levels: f32", "const levels = 255.0f")],
    },
    Row {
        name: "skin",
        uniforms: &[
            ("bones.first[0]", [1.0, 0.0, 0.0, 0.0]),
            ("bones.first[1]", [0.0, 1.0, 0.0, 0.0]),
            ("bones.first[2]", [0.0, 0.0, 1.0, 0.0]),
            ("bones.second[0]", [0.8, 0.6, 0.0, 0.0]),
            ("bones.second[1]", [-0.6, 0.8, 0.0, 0.0]),
            ("bones.second[2]", [0.0, 0.0, 1.0, 0.0]),
        ],
        native: &[(
            "@group(0) @binding(0) var<uniform> bones: Bones",
            "const bones = Bones(mat3x3f(1, 0, 0, 0, 1, 0, 0, 0, 1), mat3x3f(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1))",
        )],
    },
    Row {
        name: "parallax",
        uniforms: &[("view", [0.3, 0.2, 0.9, 0.0]), ("depth", [0.2, 0.0, 0.0, 0.0])],
        native: &[
            ("@group(0) @binding(0) var<uniform> view: vec3f", "const view = vec3f(0.3, 0.2, 0.9)"),
            ("@group(0) @binding(1) var<uniform> depth: f32", "const depth = 0.2f"),
        ],
    },
];

/// The shader as a compute shader, whose entry point calls what was the fragment's.
fn native_text(row: &Row, text: &str) -> String {
    let mut text =
        text.replace("@fragment\nfn main(", "fn shade(").replace(") -> @location(0) vec4f {", ") -> vec4f {");
    for (from, to) in row.native {
        assert!(text.contains(from), "{}: {from}", row.name);
        text = text.replace(from, to);
    }
    let position = text.contains("@builtin(position)");
    let call = if position { "vec4f(vec2f(id.xy) + vec2f(0.5), 0.0, 1.0), uv" } else { "uv" };
    text.replace("@builtin(position) ", "").replace("@location(0) ", "")
        + &format!(
            "\n@group(0) @binding(0) var<storage, read_write> made: array<vec4f>;\n\
             @compute @workgroup_size(16, 16) fn run(@builtin(global_invocation_id) id: vec3u) {{\n\
             let uv = (vec2f(id.xy) + vec2f(0.5)) / 16.0;\n made[id.y * 16 + id.x] = shade({call});\n}}"
        )
}

pub(crate) fn shaders_compute_what_a_driver_computes(gpu: &Arc<Gpu>) {
    for row in ROWS {
        let (_, text) = EXAMPLES.iter().find(|(name, _)| *name == row.name).expect("an example");
        let emulated = drawn(text, row.uniforms);
        assert_eq!(emulated, drawn_by(Executor::Gpu { gpu: gpu.clone() }, text, row.uniforms), "{}", row.name);
        let words = (SIDE * SIDE * 4) as usize;
        let made = gpu.compute(&native_text(row, text), "run", &[], words, [1, 1, 1]);
        let made = made.unwrap_or_else(|error| panic!("{}: {error}", row.name));
        let mut largest = 0_f64;
        for (ours, native) in emulated.iter().zip(made.chunks(4)) {
            for (ours, native) in ours.iter().zip(native) {
                largest = largest.max((ours - f64::from(f32::from_bits(*native))).abs());
            }
        }
        assert!(largest <= TOLERANCE, "{}: off by {largest}", row.name);
    }
}
