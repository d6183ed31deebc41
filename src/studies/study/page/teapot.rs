//! The teapot under the Ray Engine's intersection programs: shaders, programs in the machine's code for any format, and
//! fixed views with the hits of the batch executor and the exact hits.

use refsim::device::Profile;
use refsim::exec::wgsl::INTERFACE;
use refsim::exec::wgsl::number::{format_words, library};
use refsim::exec::wgsl::parts::Parts;
use refsim::exec::wgsl::program::{Microcode, NO_TRACE, PixelShader, machine};
use refsim::exec::{Constants, PixelBindings, SamplerBinding};
use refsim::machine::ExecutorKind;
use refsim::num::NumberOperation;
use refsim::texture::{Image, SamplerState, TexelFormat};
use serde::Serialize;
use serde_json::{Value, json};
use strum::VariantArray as _;

use super::encode::{base64, base64_words};
use crate::geom::classify::HitVerdict;
use crate::geom::exact::{Sides, Tracer};
use crate::geom::teapot::teapot;
use crate::geom::{Hit, Mesh};
use crate::picture::{png, rgb8};
use crate::ray_engine::{Crossbar, Kernel, RayBatch};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::leaky_teapot::{JudgedRays, PixelVerdict};
use crate::study::shade::TeapotShader;

/// Quads along each side of each patch.
const TESSELLATION: u32 = 2;
const SIDE: u32 = 128;
const FORMATS: [&str; 3] = ["s3.12", "e5m10", "e7m16"];
const VIEWS: [(&str, [f32; 3], [f32; 3]); 2] = [
    ("from the front", [2.125, -5.625, 3.875], [0.625, 0.0, 1.3125]),
    ("from above", [-2.5, -2.25, 6.25], [0.375, 0.0, 1.0]),
];
/// Tangent of half the field of view of the fixed views.
const TAN_HALF_HEIGHT: f32 = 0.5625;
const SAMPLERS: usize = 3;

#[derive(Debug, Serialize)]
pub(super) struct Teapot {
    side: u32,
    tan_half_height: f32,
    /// WGSL that traces, and WGSL that fills ray textures.
    shaders: [String; 2],
    positions: String,
    triangles: String,
    /// Programs for any format of a kind ([`machine_program`]).
    fixed: Value,
    float: Value,
    pub(super) views: Vec<FixedView>,
    /// Words and color of every verdict.
    verdicts: Vec<Value>,
}

#[derive(Debug, Serialize)]
pub(super) struct FixedView {
    pub(super) name: &'static str,
    eye: [f32; 3],
    target: [f32; 3],
    /// Exact first triangle per pixel, as words; `u32::MAX` if there is none.
    exact: String,
    /// Pixels with several exact first triangles, and their triangles.
    ties: Vec<(usize, Vec<u32>)>,
    pub(super) pictures: Vec<FixedPicture>,
}

#[derive(Debug, Serialize)]
pub(super) struct FixedPicture {
    pub(super) format: &'static str,
    words: [u32; 8],
    /// Triangle per pixel that the batch executor found, then bits of t, as words; `u32::MAX` and infinity for a miss.
    hits: String,
    /// FNV-1a of these words' bytes, 64 bits.
    pub(super) digest: String,
    pub(super) leaks: usize,
    #[serde(skip)]
    pub(super) png: String,
}

impl Teapot {
    pub(super) fn compute() -> Result<Self, StudyError> {
        let mesh = teapot(TESSELLATION)
            .map_err(|error| StudyError::new("page::teapot", "cannot tessellate the teapot").with_source(error))?;
        let tracer = Tracer::new(&mesh);
        let views = VIEWS.map(|(name, eye, target)| FixedView::trace(name, eye, target, &mesh, &tracer));
        let [(fixed, fixed_parts), (float, float_parts)] =
            [machine_program("s3.12", "s3.13")?, machine_program("e7m16", "e7m16")?];
        Ok(Self {
            side: SIDE,
            tan_half_height: TAN_HALF_HEIGHT,
            shaders: shaders(&[fixed_parts, float_parts]),
            positions: base64_words(mesh.positions().iter().flatten().map(|x| x.to_bits())),
            triangles: base64_words(mesh.triangles().iter().flatten().copied()),
            fixed,
            float,
            views: views.into_iter().collect::<Result<_, _>>()?,
            verdicts: PixelVerdict::VARIANTS
                .iter()
                .map(|v| json!({ "words": v.words(), "color": v.color() }))
                .collect(),
        })
    }
}

/// The intersection program of a format in the machine's code. `ones` are the words that hold 1 in the register format:
/// they differ in `other`, a format in which 1 has another pattern. `depth_scales` are the words that hold 1 / `t_max`.
fn machine_program(format: &str, other: &str) -> Result<(Value, Parts), StudyError> {
    let (name, code) = microcode(format, 0.5)?;
    let differing = |other: &Microcode| {
        let words = code.words.iter().zip(&other.words).enumerate();
        words.filter(|(_, (a, b))| a != b).map(|(at, _)| at).collect::<Vec<_>>()
    };
    let ones = differing(&microcode(other, 0.5)?.1);
    let depth_scales = differing(&microcode(format, 0.25)?.1);
    let (words, slots) = (&code.words, code.slots);
    let made = json!({ "name": name, "words": words, "slots": slots, "ones": ones, "depth_scales": depth_scales });
    Ok((made, code.parts))
}

/// The intersection program of a device without limits, for eye rays and front faces.
fn microcode(format: &str, depth_scale: f32) -> Result<(&'static str, Microcode), StudyError> {
    let refused = |error: &dyn std::fmt::Display| StudyError::new("page::program", error.to_string());
    let profile = Profile::named(&format!("ideal-{format}"))?;
    let kernel = Kernel::choose(&profile, true, Sides::Front)?;
    let constants = Constants { float: vec![[depth_scale.to_bits(), 0, 0, 0]], ..Constants::default() };
    // Any texture will do: the code addresses it by the number of its sampler.
    let image = Image::new_2d(TexelFormat::Rg16Snorm, 1, 1).map_err(|error| refused(&error))?;
    let mut bindings = PixelBindings::new(&constants);
    bindings.samplers[..SAMPLERS].fill(Some(SamplerBinding { image: &image, state: SamplerState::NEAREST_CLAMP }));
    let shader = PixelShader::new(&kernel.pixel, &profile.rules, &bindings, false).map_err(|error| refused(&error))?;
    let code = shader.microcode(None).map_err(|error| refused(&error))?;
    Ok((kernel.name, code))
}

fn shaders(programs: &[Parts]) -> [String; 2] {
    let mut parts = Parts::default();
    programs.iter().for_each(|program| parts.extend(program));
    parts.add("HAS_FIXED");
    parts.add("HAS_FORMATS");
    parts.add_operation(NumberOperation::Convert);
    let text = [&library(), INTERFACE, &machine(), NO_TRACE, include_str!("assets/teapot.wgsl")].concat();
    ["trace_main", "rays_main"].map(|entry| parts.of(&text, entry))
}

impl FixedView {
    fn trace(
        name: &'static str,
        eye: [f32; 3],
        target: [f32; 3],
        mesh: &Mesh,
        tracer: &Tracer<'_>,
    ) -> Result<Self, StudyError> {
        let camera = Camera::new(eye, target, [0.0, 0.0, 1.0], TAN_HALF_HEIGHT, SIDE, SIDE)
            .map_err(|error| StudyError::new("page::view", error.to_string()))?;
        let rays = RayBatch::new(SIDE, SIDE, camera.rays()).map_err(crate::ray_engine::EngineError::from)?;
        let judged = JudgedRays::new(tracer, rays.rays().to_vec(), Sides::Front);
        let nearest = &judged.nearest;
        let ties = nearest.iter().enumerate().filter_map(|(at, hit)| Some((at, hit.as_ref()?.ties.clone())));
        let pictures = FORMATS.map(|format| FixedPicture::draw(format, mesh, &rays, &judged));
        Ok(Self {
            name,
            eye,
            target,
            exact: base64_words(nearest.iter().map(|hit| hit.as_ref().map_or(u32::MAX, |hit| hit.triangle))),
            ties: ties.filter(|(_, ties)| ties.len() > 1).collect(),
            pictures: pictures.into_iter().collect::<Result<_, _>>()?,
        })
    }
}

impl FixedPicture {
    fn draw(format: &'static str, mesh: &Mesh, rays: &RayBatch, judged: &JudgedRays) -> Result<Self, StudyError> {
        let profile = Profile::named(&format!("ideal-{format}"))?;
        let number_format = profile.rules.format;
        let hits = Crossbar::new(profile, ExecutorKind::Batch).intersect(mesh, rays, Sides::Front)?.hits;
        let words = hit_words(&hits);
        let (verdicts, _) = judged.judge(mesh, &hits);
        let triangles: Vec<Option<u32>> = hits.iter().map(|hit| hit.map(|hit| hit.triangle)).collect();
        let shaded = TeapotShader::new(mesh).picture(rays, &triangles);
        let color = |(verdict, pixel): (&HitVerdict, [u8; 3])| match verdict {
            HitVerdict::Right => pixel,
            wrong => PixelVerdict::of(*wrong, false).color(),
        };
        let colors = verdicts.iter().zip(shaded.pixels().map(|pixel| pixel.0)).map(color);
        Ok(Self {
            format,
            words: format_words(&number_format),
            digest: format!("{:016x}", fnv(&words)),
            hits: base64_words(words),
            leaks: verdicts.iter().filter(|verdict| **verdict == HitVerdict::Leak).count(),
            png: base64(png(&rgb8(rays.width(), rays.height(), colors))?),
        })
    }
}

/// Triangles, then bits of t; `u32::MAX` and infinity for a miss.
fn hit_words(hits: &[Option<Hit>]) -> Vec<u32> {
    let triangles = hits.iter().map(|hit| hit.map_or(u32::MAX, |hit| hit.triangle));
    triangles.chain(hits.iter().map(|hit| hit.map_or(f32::INFINITY, |hit| hit.t).to_bits())).collect()
}

fn fnv(words: &[u32]) -> u64 {
    words
        .iter()
        .flat_map(|word| word.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
