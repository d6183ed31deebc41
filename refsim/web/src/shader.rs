//! A shader in WGSL: its picture by the emulator, and the inputs that a GPU needs to draw the same text.
//!
//! Coordinates are those of [`crate::scene`]; uniforms without a value are [`UNSET`] in every component.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use refsim::check::Checked;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::front::{Refusal, WgslInput, WgslInterface, wgsl_with_interface};
use refsim::isa::{Program, RegisterFile};
use refsim::machine::{DrawCall, ExecutorKind, Machine, MachineError, VertexSource};
use refsim::num::Format;
use refsim::num::ops::convert;
use refsim::raster::{PixelCenter, Primitive};
use refsim::texture::TexelFormat;
use serde::{Deserialize, Serialize};

use crate::examples::{SHADERS, ShaderExample};
use crate::request::{Device, MAX_TEXT, Remark, checked};
use crate::scene::quad;

/// Side of the picture, in pixels.
const SIDE: u32 = 64;
/// Value of components of uniforms that the request leaves out.
const UNSET: f32 = 0.5;
/// Formats to choose from, each with its name on the page.
const FORMATS: [(&str, &str); 8] = [
    ("fp32", "f32, as written"),
    ("fp24", "fp24 (R300)"),
    ("fp16", "fp16, half precision"),
    ("bf16", "bf16"),
    ("e5m2", "fp8 e5m2"),
    ("e4m3fn", "fp8 e4m3"),
    ("s3.12", "fixed point s3.12"),
    ("s1.10", "fixed point s1.10"),
];

/// A shader and how to draw it.
#[derive(Clone, Debug, Deserialize)]
pub struct ShaderRequest {
    /// The text in WGSL, with one fragment entry point.
    pub text: String,
    /// Format of all numbers, such as `fp16`.
    pub format: String,
    /// Values of uniforms by name; missing values are 0.5.
    #[serde(default)]
    pub uniforms: BTreeMap<String, Vec<f32>>,
}

#[derive(Debug, Serialize)]
struct ShaderAnswer {
    side: u32,
    examples: &'static [ShaderExample],
    formats: &'static [(&'static str, &'static str)],
    errors: Vec<Remark>,
    uniforms: Vec<ShownUniform>,
    drawn: Option<ShaderPicture>,
    gpu: Option<GpuDraw>,
}

#[derive(Debug, Serialize)]
struct ShownUniform {
    name: String,
    values: Vec<f32>,
}

/// The emulator's picture.
#[derive(Debug, Serialize)]
struct ShaderPicture {
    format: String,
    /// Red, green, blue and alpha per pixel as IEEE singles.
    bits: Vec<u32>,
}

/// A draw of three vertices that covers the picture.
#[derive(Debug, Serialize)]
struct GpuDraw {
    entry: String,
    /// Text of the vertex shader.
    vertex: String,
    buffers: Vec<GpuBuffer>,
}

#[derive(Debug, Serialize)]
struct GpuBuffer {
    group: u32,
    binding: u32,
    bytes: Vec<u8>,
}

/// Answers a [`ShaderRequest`] in JSON with JSON. Errors in the shader or in the request are part of the answer.
pub fn shader_answer(request: &str) -> String {
    let mut answer = ShaderAnswer {
        side: SIDE,
        examples: &SHADERS,
        formats: &FORMATS,
        errors: Vec::new(),
        uniforms: Vec::new(),
        drawn: None,
        gpu: None,
    };
    let filled = match serde_json::from_str::<ShaderRequest>(request) {
        Ok(request) => answer.fill(&request),
        Err(error) => Err(vec![Remark::about_nothing(error.to_string(), "send a shader as JSON")]),
    };
    answer.errors.extend(filled.err().into_iter().flatten());
    serde_json::to_string(&answer).unwrap_or_default()
}

impl ShaderAnswer {
    fn fill(&mut self, request: &ShaderRequest) -> Result<(), Vec<Remark>> {
        let text = request.text.as_str();
        if text.len() > MAX_TEXT {
            let message = format!("expected a shader of at most {MAX_TEXT} bytes, found {}", text.len());
            return Err(vec![Remark::about_nothing(message, "use `crossbar run` for longer shaders")]);
        }
        let profile = Device { device: "ideal-fp32".to_owned(), format: Some(request.format.clone()) }.profile()?;
        let (program, interface) = wgsl_with_interface(text).map_err(|refusal| vec![refused(text, &refusal)])?;
        let program = checked(text, program, &profile)?;
        without_textures(text, &program)?;
        let value = |name: &str, width: usize| {
            let given = request.uniforms.get(name);
            (0..width).map(|c| given.and_then(|list| list.get(c)).copied().unwrap_or(UNSET)).collect()
        };
        let named = program.parameters.iter();
        self.uniforms = named.map(|p| ShownUniform { name: p.name.clone(), values: value(&p.name, p.width) }).collect();
        let bits = self
            .picture(&program, &profile)
            .map_err(|error| vec![Remark::about_nothing(error.to_string(), "change the shader or the format")])?;
        self.drawn = Some(ShaderPicture { format: profile.rules.format.to_string(), bits });
        self.gpu = Some(GpuDraw {
            vertex: vertex_shader(&interface.inputs),
            buffers: buffers(&interface, &self.uniforms),
            entry: interface.entry,
        });
        Ok(())
    }

    fn picture(&self, program: &Checked<Program>, profile: &Profile) -> Result<Vec<u32>, MachineError> {
        let mut constants = Constants::default();
        for ShownUniform { name, values } in &self.uniforms {
            let vector = [0, 1, 2, 3].map(|c| values.get(c).copied().unwrap_or_default().to_bits());
            constants.named.insert(name.clone(), vector);
        }
        let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
        let target = machine.create_target(TexelFormat::Rgba32f, SIDE, SIDE)?;
        let quad = quad(SIDE);
        let vertices = VertexSource::Transformed(&quad);
        let call = DrawCall::new(vertices, Primitive::QuadList, program, &constants, target);
        machine.draw(&DrawCall { center: PixelCenter::OpenGl, ..call })?;
        let image = machine.read_back(target)?;
        let pixels = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        Ok(pixels.flat_map(|(x, y)| [0, 32, 64, 96].map(|shift| (image.raw(0, 0, y, x) >> shift) as u32)).collect())
    }
}

fn refused(text: &str, refusal: &Refusal) -> Remark {
    match refusal.place() {
        Some(span) => Remark::new(text, span, refusal.to_string(), refusal.help().to_owned()),
        None => Remark::about_nothing(refusal.to_string(), refusal.help()),
    }
}

/// Returns an error for shaders that read textures.
fn without_textures(text: &str, program: &Checked<Program>) -> Result<(), Vec<Remark>> {
    let reads = program
        .instructions
        .iter()
        .find(|instruction| instruction.sources.iter().any(|source| source.register.file == RegisterFile::Sampler));
    reads.map_or(Ok(()), |instruction| {
        let message = "the page has no textures, and this shader reads one".to_owned();
        let help = "`crossbar run` draws it, with a case that gives a picture (docs/wgsl.md)".to_owned();
        Err(vec![Remark::new(text, instruction.span, message, help)])
    })
}

/// The vertex shader for the inputs of a fragment shader: one triangle over the picture.
fn vertex_shader(inputs: &[WgslInput]) -> String {
    let half = if inputs.iter().any(|input| input.half) { "enable f16;\n" } else { "" };
    let (mut members, mut values) = (String::new(), String::new());
    for &WgslInput { location, width, half } in inputs {
        let scalar = if half { "f16" } else { "f32" };
        let name = if width == 1 { scalar.to_owned() } else { format!("vec{width}<{scalar}>") };
        let four = match location {
            0 => "vec4f(s, t, 0.0, 1.0)".to_owned(),
            1 => "vec4f(2.0 * s - 1.0, 1.0 - 2.0 * t, 1.0, 1.0)".to_owned(),
            _ => format!("vec4f({SIDE}.0 * s, {SIDE}.0 * t, 0.0, 1.0)"),
        };
        let _ = writeln!(members, "    @location({location}) at{location}: {name},");
        let _ = write!(values, ", {name}({four}.{})", &"xyzw"[..width]);
    }
    format!(
        "{half}struct Corner {{\n    @builtin(position) position: vec4f,\n{members}}}\n\
         @vertex\nfn corner(@builtin(vertex_index) index: u32) -> Corner {{\n\
         \x20   let s = f32(index & 1u) * 2.0;\n    let t = f32(index >> 1u) * 2.0;\n\
         \x20   return Corner(vec4f(2.0 * s - 1.0, 1.0 - 2.0 * t, 0.0, 1.0){values});\n}}\n"
    )
}

fn buffers(interface: &WgslInterface, values: &[ShownUniform]) -> Vec<GpuBuffer> {
    let mut contents: BTreeMap<[u32; 2], Vec<u8>> = BTreeMap::new();
    for (uniform, ShownUniform { values, .. }) in interface.uniforms.iter().zip(values) {
        // Buffers are multiples of 16 bytes long.
        let size = uniform.size.next_multiple_of(16) as usize;
        let bytes = contents.entry(uniform.binding).or_insert_with(|| vec![0; size]);
        let packed = values.iter().flat_map(|value| {
            let bits = value.to_bits();
            let half = uniform.half.then(|| convert(&Format::FP32, Format::FP16, bits).bits);
            half.map_or_else(|| bits.to_le_bytes().to_vec(), |half| (half as u16).to_le_bytes().to_vec())
        });
        bytes.iter_mut().skip(uniform.offset as usize).zip(packed).for_each(|(byte, new)| *byte = new);
    }
    contents.into_iter().map(|([group, binding], bytes)| GpuBuffer { group, binding, bytes }).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    fn asked(request: &Value) -> Value {
        serde_json::from_str(&shader_answer(&request.to_string())).expect("JSON")
    }

    fn colors(found: &Value) -> Vec<[f32; 4]> {
        let bits: Vec<u32> = serde_json::from_value(found["drawn"]["bits"].clone()).expect("bits");
        bits.chunks(4).map(|texel| [0, 1, 2, 3].map(|c| f32::from_bits(texel[c]))).collect()
    }

    #[test]
    fn every_example_is_drawn_in_every_format() {
        for ShaderExample { title, text, uniforms } in &SHADERS {
            let uniforms: BTreeMap<_, _> = uniforms.iter().copied().collect();
            for (format, _) in FORMATS {
                let found = asked(&json!({ "text": text, "format": format, "uniforms": uniforms }));
                assert_eq!(found["errors"], json!([]), "{title} in {format}");
                // In the short formats, a hash in `noise` is 0 everywhere, and a distance in pixels saturates.
                let (is_wide, colors) = (["fp32", "fp24", "fp16"].contains(&format), colors(&found));
                assert!(!is_wide || colors.iter().any(|color| *color != colors[0]), "{title} in {format}");
            }
            // Every uniform of the shader has a stated value.
            let names: Vec<&str> = uniforms.keys().copied().collect();
            let found = asked(&json!({ "text": text, "format": "fp32" }));
            let mut asks: Vec<&str> =
                found["uniforms"].as_array().expect("a list").iter().filter_map(|u| u["name"].as_str()).collect();
            asks.sort_unstable();
            assert_eq!(asks, names, "{title}");
        }
    }

    #[test]
    fn inputs_and_uniforms_have_their_places() {
        let text = "enable f16;\nstruct U { a: f32, m: mat2x2f, v: array<vec4f, 2>, h: vec2h }\n\
                    @group(1) @binding(3) var<uniform> u: U;\n@group(0) @binding(0) var<uniform> w: vec3f;\n\
                    @fragment fn main(@location(0) uv: vec2f, @location(3) st: vec3h) -> @location(0) vec4f {\n\
                    return vec4f(u.a + uv.x, u.m[1].y, u.v[1].z + w.x, f32(st.y + u.h.y)); }";
        let uniforms =
            json!({ "u.a": [1], "u.m[1]": [2, 3], "u.v[1]": [4, 5, 6, 7], "u.h": [8, 9], "w": [0.25, 0, 0] });
        let found = asked(&json!({ "text": text, "format": "fp32", "uniforms": uniforms }));
        assert_eq!(found["errors"], json!([]), "{found}");
        let last = colors(&found)[64 * 64 - 1];
        assert_eq!(last, [1.0 + 63.5 / 64.0, 3.0, 6.25, 72.5]);
        let vertex = found["gpu"]["vertex"].as_str().expect("a text");
        assert!(vertex.starts_with("enable f16;") && vertex.contains("@location(3) at3: vec3<f16>,"), "{vertex}");
        let buffers = found["gpu"]["buffers"].as_array().expect("buffers");
        let bytes: Vec<u8> = serde_json::from_value(buffers[1]["bytes"].clone()).expect("bytes");
        // By the layout rules of WGSL: f32 at 0, the matrix from 8, the array from 32, the vector of halves at 64.
        let single = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().expect("four"));
        assert_eq!((single(0), single(16), single(20), single(48), single(60)), (1.0, 2.0, 3.0, 4.0, 7.0));
        assert_eq!((bytes.len(), &bytes[64..68]), (80, &[0x00, 0x48, 0x80, 0x48][..]));
        assert_eq!((&buffers[0]["group"], &buffers[1]["binding"]), (&json!(0), &json!(3)));
        // Missing values.
        assert_eq!(found["uniforms"][1], json!({ "name": "u.m[0]", "values": [0.5, 0.5] }));
    }

    /// The answer that `tests/page` shows without a module. After an intended change, replace it by this one.
    #[test]
    fn the_stored_answer_is_given() {
        let stored: Value = serde_json::from_str(include_str!("../shader.json")).expect("JSON");
        let mut found = asked(&stored["request"]);
        let at = |texel: usize| (texel as f32 + 0.5) / SIDE as f32 * 0.5;
        let expected = |p: usize| [at(p % SIDE as usize), at(p / SIDE as usize), 0.25, 1.0];
        assert!(colors(&found).iter().enumerate().all(|(p, color)| *color == expected(p)));
        (found["drawn"]["bits"], found["examples"]) = (json!([]), json!([]));
        assert_eq!(found, stored["answer"], "{found}");
    }

    #[test]
    fn mistakes_have_their_place() {
        let main =
            |inside: &str| format!("@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n{inside}\n}}");
        let texture =
            "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;\n".to_owned();
        let rows = [
            (main("return vec4f(1.0, 2.0)"), "fp16", 3, "expected"),
            (main("return vec4f(cosh(uv.x));"), "fp16", 2, "is not translated"),
            (texture + &main("return textureSample(t, s, vec2f(0.5));"), "fp16", 4, "no textures"),
            (main("return vec4f(1.0);"), "s99.99", 0, "s99.99"),
            (String::new(), "fp16", 0, "@fragment"),
            (" ".repeat(MAX_TEXT + 1), "fp16", 0, "at most"),
        ];
        for (text, format, line, words) in rows {
            let found = asked(&json!({ "text": text, "format": format }));
            let error = &found["errors"][0];
            assert_eq!(error["line"], line, "{error}");
            assert!(error["message"].as_str().is_some_and(|message| message.contains(words)), "{error}");
            assert!(found["drawn"].is_null() && found["gpu"].is_null());
        }
        assert!(shader_answer("no JSON").contains("\"errors\":[{"));
    }
}
