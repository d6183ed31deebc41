//! Random draws around a program, run by either executor.

use crate::random::Random;
use refsim::check;
use refsim::device::{
    ColorIterator, ConstantStorage, LrpMode, MadMode, Profile, TexcrdOverflow, TexdepthDenominator, TexkillComponents,
};
use refsim::event::DrawEvents;
use refsim::exec::{BumpStage, CheckedProgram, Constants};
use refsim::isa::{Program, Version};
use refsim::machine::{
    AttributeStream, DrawCall, ExecutorKind, FragmentTrace, Machine, MachineError, StepRate, VertexSource,
    VertexStreams,
};
use refsim::num::{DotOrder, Format};
use refsim::output::{
    AlphaTest, BlendEquation, BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState, WriteMask,
};
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{
    AddressMode, Filter, Image, MipFilter, SamplerState, SignedTexelMinimum, TargetRounding, TexelFormat, TextureKind,
};

/// Formats that the proofs go through.
pub(crate) const FORMATS: &[&str] = &[
    "s3.12",
    "s3.12:rna",
    "s3.12:rtz",
    "s3.12:rdn",
    "s3.12:wrap",
    "s3.12:rdn:wrap",
    "s1.10",
    "s0.8",
    "s7.8",
    "s7.16",
    "s15.16:rtz",
    "fp16",
    "fp16:rtz",
    "fp16:ftz:nvovf:nv",
    "fp16:sat",
    "fp24",
    "fp24:ftz",
    "fp24:rtz",
    "fp24:rdn:sat",
    "fp32",
    "fp32:ftz",
    "fp32:rtz",
    "fp32:nv:nvovf",
    "bf16",
    "e3m4",
    "e8m10",
    "e8m10:rna",
    "e5m2",
];

/// Everything about a draw that isn't the program.
pub(crate) struct Scene {
    pub(crate) profile: Profile,
    width: u32,
    height: u32,
    pixel_constants: Constants,
    vertex_constants: Constants,
    textures: Vec<(usize, Image, SamplerState)>,
    bump: [BumpStage; 8],
    vertices: Vec<Vertex>,
    attributes: Vec<Vec<[u32; 4]>>,
    instances: usize,
    primitive: Primitive,
    targets: Vec<TexelFormat>,
    depth: Option<DepthFormat>,
    depth_state: DepthState,
    alpha: Option<AlphaTest>,
    blend: Option<BlendState>,
    masks: [WriteMask; 4],
    center: PixelCenter,
}

/// What a draw left behind.
#[derive(Debug, PartialEq)]
pub(crate) struct Outcome {
    pub(crate) targets: Vec<Vec<u8>>,
    pub(crate) depth: Vec<u32>,
    pub(crate) events: DrawEvents,
}

/// An ideal device in some format, with every rule at random.
pub(crate) fn profile(format: &str, r: &mut Random) -> Profile {
    let mut profile = Profile::named(&format!("ideal-{format}")).unwrap_or_else(|e| panic!("{format}: {e}"));
    let rules = &mut profile.rules;
    let parse = |text: &str| text.parse::<Format>().unwrap_or_else(|e| panic!("{text}: {e}"));
    rules.partial = r.choose(&[None, Some("fp16"), Some("fp16:rtz:nv"), Some("s1.10"), Some("fp32")]).map(parse);
    if r.one_in(4) {
        rules.vertex_format = parse(r.pick(&["fp32:rtz", "fp24", "s7.16", "fp32:ftz"]));
    }
    if r.one_in(6) {
        rules.iterator_format = parse(r.pick(&["fp24", "s7.16", "fp16"]));
    }
    rules.color_iterator =
        r.choose(&[ColorIterator::Full, ColorIterator::Unorm(8), ColorIterator::Unorm(12), ColorIterator::Unorm(1)]);
    rules.constant_storage = r.choose(ConstantStorage::ALL);
    rules.mad = r.choose(MadMode::ALL);
    rules.dot = r.choose(&[DotOrder::Sequential, DotOrder::Tree, DotOrder::Exact]);
    rules.lrp = r.choose(LrpMode::ALL);
    rules.texcrd_overflow = r.choose(TexcrdOverflow::ALL);
    rules.texdepth_denominator = r.choose(TexdepthDenominator::ALL);
    rules.texkill_components = r.choose(TexkillComponents::ALL);
    rules.signed_texel_minimum = r.choose(&[SignedTexelMinimum::Clamp, SignedTexelMinimum::BelowMinusOne]);
    rules.zero_times_anything = r.one_in(3);
    rules.target_rounding = r.choose(&[TargetRounding::Nearest, TargetRounding::Truncate]);
    rules.depth_rounding = r.choose(&[TargetRounding::Nearest, TargetRounding::Truncate]);
    rules.subpixel_bits = r.choose(&[0, 4, 8]);
    rules.filter_fraction_bits = r.choose(&[4, 8]);
    rules.lod_fraction_bits = r.choose(&[4, 8]);
    profile
}

fn image(kind: TextureKind, r: &mut Random) -> Image {
    let size = |r: &mut Random| 1 + r.below(9) as u32;
    let (w, h) = (size(r), size(r));
    let extents = match kind {
        TextureKind::D1 => [w, 1, 1],
        TextureKind::Cube => [w, w, 1],
        TextureKind::Volume => [w, h, size(r)],
        TextureKind::D2 | TextureKind::Rectangle => [w, h, 1],
    };
    let most = if kind == TextureKind::Rectangle { 1 } else { extents.iter().copied().max().unwrap_or(1).ilog2() + 1 };
    let levels = if r.one_in(2) { 1 } else { most };
    let format = r.choose(TexelFormat::ALL);
    let mut image = Image::new(format, kind, extents, levels).unwrap_or_else(|e| panic!("{e}"));
    let values: Vec<u32> = (0..image.bytes().len()).map(|_| r.next() as u32).collect();
    for (byte, value) in image.bytes_mut().iter_mut().zip(values) {
        *byte = value as u8;
    }
    image
}

fn sampler(r: &mut Random) -> SamplerState {
    let mode =
        |r: &mut Random| r.choose(&[AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border]);
    let filter = |r: &mut Random| r.choose(&[Filter::Nearest, Filter::Nearest, Filter::Nearest, Filter::Linear]);
    SamplerState {
        min: filter(r),
        mag: filter(r),
        mip: r.choose(&[MipFilter::None, MipFilter::None, MipFilter::Nearest, MipFilter::Linear]),
        address_u: mode(r),
        address_v: mode(r),
        address_w: mode(r),
        border: r.vector(),
        lod_bias: if r.one_in(3) { r.number() } else { 0 },
        max_mip_level: r.below(3) as u8,
    }
}

fn constants(r: &mut Random) -> Constants {
    Constants {
        float: (0..8).map(|_| r.vector()).collect(),
        int: (0..3).map(|_| [r.choose(&[0, 1, 2, 3]), r.choose(&[0, 1, 2]), r.choose(&[-1, 0, 1]), 0]).collect(),
        boolean: (0..3).map(|_| r.one_in(2)).collect(),
    }
}

/// A vertex; `flat` ones share everything but the position, `plane` puts it at w = 1.
fn vertex(r: &mut Random, shared: &Vertex, flat: bool, plane: bool) -> Vertex {
    let mut v = *shared;
    let coordinate = |r: &mut Random| ((r.below(3000) as f32 - 1500.0) / 1000.0).to_bits();
    let w = if plane { 1.0f32 } else { 0.5 + r.below(100) as f32 / 50.0 };
    let scaled = |bits: u32| (f32::from_bits(bits) * w).to_bits();
    let z = (r.below(1000) as f32 / 1000.0 * w).to_bits();
    v.position = [scaled(coordinate(r)), scaled(coordinate(r)), z, w.to_bits()];
    for set in 0..8 {
        if !flat && !r.one_in(3) {
            v.texcoords[set] = r.vector();
        }
    }
    if !flat {
        v.colors = [r.vector(), r.vector()];
    }
    v
}

fn vertices(r: &mut Random) -> (Vec<Vertex>, Primitive) {
    let primitive = r.choose(&[Primitive::TriangleList, Primitive::QuadList, Primitive::TriangleStrip]);
    let mut out = Vec::new();
    for _ in 0..1 + r.below(3) {
        let shared = Vertex {
            texcoords: std::array::from_fn(|_| r.vector()),
            colors: [r.vector(), r.vector()],
            ..Vertex::default()
        };
        let (flat, plane, full) = (r.one_in(3), r.one_in(2), r.one_in(2));
        let corners = [(-1.0f32, 1.0f32), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
        for corner in corners.into_iter().take(if primitive == Primitive::QuadList { 4 } else { 3 }) {
            let mut v = vertex(r, &shared, flat, plane);
            if full && plane {
                v.position[0] = corner.0.to_bits();
                v.position[1] = corner.1.to_bits();
            }
            out.push(v);
        }
    }
    (out, primitive)
}

fn blend(r: &mut Random) -> BlendState {
    let equation = |r: &mut Random| BlendEquation {
        source: r.choose(BlendFactor::ALL),
        destination: r.choose(BlendFactor::ALL),
        op: r.choose(&[BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max]),
    };
    BlendState { color: equation(r), alpha: equation(r) }
}

impl Scene {
    /// A scene for pixel programs of a version.
    pub(crate) fn new(profile: Profile, version: Version, r: &mut Random) -> Self {
        // Two scenes in three show what the program computes: nothing special goes in, nothing is tested away.
        r.tame = !r.one_in(3);
        r.wide = r.one_in(3);
        let plain = !r.one_in(3);
        let (vertices, primitive) = vertices(r);
        let kinds: &[(usize, TextureKind)] = match version {
            v if v.is_ps_2() => &[
                (0, TextureKind::D2),
                (1, TextureKind::D2),
                (2, TextureKind::D2),
                (3, TextureKind::Cube),
                (4, TextureKind::Volume),
            ],
            _ => &[
                (0, TextureKind::D2),
                (1, TextureKind::D2),
                (2, TextureKind::Cube),
                (3, TextureKind::D2),
                (4, TextureKind::Rectangle),
                (5, TextureKind::D1),
            ],
        };
        let mut textures = Vec::new();
        for &(slot, kind) in kinds {
            if !r.one_in(6) {
                textures.push((
                    slot,
                    image(kind, r),
                    if r.one_in(3) { SamplerState::NEAREST_CLAMP } else { sampler(r) },
                ));
            }
        }
        let targets = [TexelFormat::Rgba32f, TexelFormat::Rgba32f, r.choose(TexelFormat::ALL), TexelFormat::Rgba16f];
        let count = if version.is_ps_1_x() { 1 } else { 1 + r.below(4) };
        Self {
            profile,
            width: 1 + r.below(40) as u32,
            height: 1 + r.below(36) as u32,
            pixel_constants: constants(r),
            vertex_constants: constants(r),
            textures,
            bump: std::array::from_fn(|_| BumpStage {
                matrix: r.vector(),
                luminance_scale: r.number(),
                luminance_offset: r.number(),
            }),
            attributes: Vec::new(),
            instances: 1,
            vertices,
            primitive,
            targets: targets[..count].to_vec(),
            depth: (!r.one_in(3)).then(|| r.choose(DepthFormat::ALL)),
            depth_state: DepthState {
                test: if plain {
                    Some(CompareFunction::Always)
                } else {
                    (!r.one_in(4)).then(|| r.choose(CompareFunction::ALL))
                },
                write: plain || r.one_in(2),
            },
            alpha: (!plain && r.one_in(2))
                .then(|| AlphaTest { function: r.choose(CompareFunction::ALL), reference: r.number() }),
            blend: (!plain && r.one_in(2)).then(|| blend(r)),
            masks: std::array::from_fn(|_| {
                if !plain && r.one_in(3) { WriteMask(r.below(16) as u8) } else { WriteMask::ALL }
            }),
            center: r.choose(&[PixelCenter::Direct3d, PixelCenter::OpenGl]),
        }
    }

    /// Attributes `v0` to `v3` for a vertex program, and some instances.
    pub(crate) fn with_attributes(mut self, r: &mut Random) -> Self {
        let count = self.vertices.len();
        self.instances = 1 + r.below(100);
        self.attributes = (0..4).map(|_| (0..count.max(self.instances)).map(|_| r.vector()).collect()).collect();
        self.attributes[0] = self.vertices.iter().map(|v| v.position).collect();
        // `mad oPos, r0, c5, v0`: a small c5 keeps triangles in view.
        self.vertex_constants.float[5] = [0x3a00_0000, 0x3a80_0000, 0, 0];
        self
    }

    /// Draws.
    pub(crate) fn draw(
        &self,
        kind: ExecutorKind,
        threads: usize,
        pixel: &CheckedProgram,
        vertex: Option<&CheckedProgram>,
    ) -> Result<Outcome, MachineError> {
        self.with_call(kind, threads, pixel, vertex, |machine, call| {
            let events = machine.draw(call)?;
            let mut outcome = Outcome { targets: Vec::new(), depth: Vec::new(), events };
            for &target in &call.targets {
                outcome.targets.push(machine.read_back(target)?.bytes().to_vec());
            }
            if let Some(id) = call.depth_buffer {
                outcome.depth = machine.read_depth(id)?.data().to_vec();
            }
            Ok(outcome)
        })
    }

    /// Follows every pixel, row by row, through the draw.
    pub(crate) fn traces(
        &self,
        kind: ExecutorKind,
        pixel: &CheckedProgram,
        vertex: Option<&CheckedProgram>,
    ) -> Result<Vec<Vec<FragmentTrace>>, MachineError> {
        let pixels: Vec<_> = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y))).collect();
        self.with_call(kind, 1, pixel, vertex, |machine, call| machine.trace_pixels(call, &pixels))
    }

    /// Does something with a machine that holds the scene, and the draw call.
    fn with_call<T>(
        &self,
        kind: ExecutorKind,
        threads: usize,
        pixel: &CheckedProgram,
        vertex: Option<&CheckedProgram>,
        act: impl FnOnce(&mut Machine, &DrawCall<'_>) -> Result<T, MachineError>,
    ) -> Result<T, MachineError> {
        let mut machine = Machine::with_threads(self.profile.clone(), kind, threads)?;
        let mut targets = Vec::new();
        for &format in &self.targets {
            targets.push(machine.create_target(format, self.width, self.height)?);
        }
        for &target in &targets {
            machine.clear_target(target, [0x3e80_0000, 0x3f00_0000, 0x3f40_0000, 0x3f80_0000])?;
        }
        let source = match vertex {
            None => VertexSource::Transformed(&self.vertices),
            Some(program) => VertexSource::Program {
                program,
                constants: &self.vertex_constants,
                streams: VertexStreams {
                    vertex_count: self.vertices.len(),
                    instance_count: self.instances,
                    streams: (0..4)
                        .map(|register| AttributeStream {
                            register,
                            step: if register == 2 { StepRate::Instance } else { StepRate::Vertex },
                            data: &self.attributes[register],
                        })
                        .collect(),
                },
            },
        };
        let mut call = DrawCall::new(source, self.primitive, pixel, &self.pixel_constants, targets[0]);
        call.targets.clone_from(&targets);
        for (slot, image, state) in &self.textures {
            let texture = machine.create_texture(image.clone())?;
            call = call.with_texture(*slot, texture, *state);
        }
        call.depth_buffer = match self.depth {
            Some(format) => {
                let id = machine.create_depth(format, self.width, self.height)?;
                machine.clear_depth(id, 0x3f40_0000)?;
                Some(id)
            }
            None => None,
        };
        call.depth = if call.depth_buffer.is_some() { self.depth_state } else { DepthState::default() };
        (call.bump, call.alpha_test, call.blend, call.masks, call.center) =
            (self.bump, self.alpha, self.blend, self.masks, self.center);
        act(&mut machine, &call)
    }

    /// Where two outcomes differ first, in words.
    pub(crate) fn difference(&self, scalar: &Outcome, batch: &Outcome) -> String {
        for (i, (a, b)) in scalar.targets.iter().zip(&batch.targets).enumerate() {
            let size = self.targets[i].bytes();
            if let Some(at) = a.chunks(size).zip(b.chunks(size)).position(|(a, b)| a != b) {
                let (x, y) = (at as u32 % self.width, at as u32 / self.width);
                let range = at * size..(at + 1) * size;
                return format!(
                    "target {i} ({}) at ({x}, {y}) of {}x{}: scalar {:02x?}, batch {:02x?}",
                    self.targets[i],
                    self.width,
                    self.height,
                    &a[range.clone()],
                    &b[range]
                );
            }
        }
        if let Some(at) = scalar.depth.iter().zip(&batch.depth).position(|(a, b)| a != b) {
            let (x, y) = (at as u32 % self.width, at as u32 / self.width);
            return format!("depth at ({x}, {y}): scalar {:#x}, batch {:#x}", scalar.depth[at], batch.depth[at]);
        }
        format!("events: scalar {:?}, batch {:?}", scalar.events, batch.events)
    }
}

/// The program checked, if the checker accepts it for the device.
pub(crate) fn accepted(program: &Program, profile: &Profile) -> Option<CheckedProgram> {
    check::check(program.clone(), profile).ok()
}
