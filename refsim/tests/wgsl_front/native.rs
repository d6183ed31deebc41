//! Example shaders: translated and run by each executor, and run natively by an adapter's driver.

use std::sync::Arc;

use refsim::exec::gpu::Gpu;
use refsim::machine::Executor;

use super::drawn::{Inputs, SIDE, drawn_of, drawn_with, texels};
use super::rows::{Row, rows};

/// Maximum difference of a component. The errors that WGSL allows depend on function and argument; of these shaders,
/// GGX, which divides small numbers, has the largest difference on lavapipe: 2e-5. Noise multiplies a sine, whose unit
/// in the last place is 2^-24, by 43,758.
fn tolerance(name: &str) -> f64 {
    if name == "noise" { 43_758.547 / f64::from(1 << 24) } else { 1e-4 }
}

/// The type of a uniform that is not a structure, and the line that declares it.
fn declaration<'t>(text: &'t str, name: &str) -> Option<(&'t str, &'t str)> {
    let line = text.lines().find(|line| line.contains(&format!("var<uniform> {name}: ")))?;
    Some((line.rsplit_once(": ")?.1.strip_suffix(';')?, line))
}

/// Rewrites the shader as a compute shader whose entry point calls the former fragment entry point; texels are read
/// from a buffer.
fn native_text(row: &Row) -> String {
    let mut text =
        row.text().replace("@fragment\nfn main(", "fn shade(").replace(") -> @location(0) vec4f {", ") -> vec4f {");
    for (from, to) in row.native {
        assert!(text.contains(from), "{}: {from}", row.name);
        text = text.replace(from, to);
    }
    for (name, value) in row.uniforms {
        let Some((kind, line)) = declaration(&text, name) else { continue };
        let [x, y, z, w] = value;
        let all = if kind == "f32" { format!("{x}") } else { format!("vec4f({x}, {y}, {z}, {w})") };
        let part = match kind {
            "vec2f" => ".xy",
            "vec3f" => ".xyz",
            _ => "",
        };
        text = text.replace(line, &format!("const {name}: {kind} = {all}{part};"));
    }
    let without = |line: &&str| !(line.contains("texture_2d") || line.contains(": sampler"));
    let mut text = text.lines().filter(without).collect::<Vec<_>>().join("\n");
    for name in ["scene, linear_clamp, ", "normals, linear_repeat, "] {
        text = text.replace(&format!("textureSample({name}"), "texel(");
    }
    let position = text.contains("@builtin(position)");
    let call = if position { "vec4f(vec2f(id.xy) + vec2f(0.5), 0.0, 1.0), uv" } else { "uv" };
    text.replace("@builtin(position) ", "").replace("@location(0) ", "")
        + &format!(
            "\n@group(0) @binding(0) var<storage, read> data: array<vec4f>;\n\
             @group(0) @binding(1) var<storage, read_write> made: array<vec4f>;\n\
             fn texel(at: vec2f) -> vec4f {{ let t = vec2i(floor(at * 16.0)) & vec2i(15); return data[t.y * 16 + t.x]; }}\n\
             @compute @workgroup_size(16, 16) fn run(@builtin(global_invocation_id) id: vec3u) {{\n\
             let uv = (vec2f(id.xy) + vec2f(0.5)) / 16.0;\n\
             made[id.y * 16 + id.x] = shade({call}) + data[0] * 0.0;\n}}"
        )
}

pub(crate) fn shaders_compute_what_a_driver_computes(gpu: &Arc<Gpu>) {
    let texels = texels(2, 24, |texel| texel);
    let words: Vec<u32> = texels.iter().flatten().map(|x| x.to_bits()).collect();
    for row in rows() {
        let text = row.text();
        let inputs = Inputs { uniforms: row.uniforms, texels: &texels, half: &|_| Vec::new() };
        let emulated = drawn_of(&text, &inputs);
        assert_eq!(emulated, drawn_with(Executor::Gpu { gpu: gpu.clone() }, &text, &inputs), "{}", row.name);
        let made = gpu.compute(&native_text(&row), "run", &[&words], (SIDE * SIDE * 4) as usize, [1, 1, 1]);
        let made = made.unwrap_or_else(|error| panic!("{}: {error}", row.name));
        let mut largest = 0_f64;
        for (ours, native) in emulated.iter().zip(made.chunks(4)) {
            for (ours, native) in ours.iter().zip(native) {
                largest = largest.max((ours - f64::from(f32::from_bits(*native))).abs());
            }
        }
        assert!(largest <= tolerance(row.name), "{}: off by {largest}", row.name);
    }
}
