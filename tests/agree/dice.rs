//! Random scenes: textures, state, constants. The geometry is in `shapes`.

use crate::generate::Layout;
use crate::random::Random;
use crate::scene::Scene;
use crate::shapes::{self, Shape};
use refsim::device::Profile;
use refsim::exec::{BumpStage, Constants, FixedFunctionState, Projection};
use refsim::isa::{Stage, Version};
use refsim::output::{
    AlphaTest, BlendEquation, BlendFactor, BlendOp, BlendState, CompareFunction, DepthFormat, DepthState, WriteMask,
};
use refsim::raster::{ClipSpace, Cull, PixelCenter, Provoking, Viewport};
use refsim::texture::{AddressMode, Filter, Image, MipFilter, Region, SamplerState, TexelFormat, TextureKind};

/// Properties that a suite fixes (`Some`); all others are random.
#[derive(Clone, Debug)]
pub(crate) struct Options {
    pub(crate) version: Version,
    pub(crate) shape: Option<Shape>,
    pub(crate) texture: Option<TexelFormat>,
    pub(crate) kind: Option<TextureKind>,
    pub(crate) address: Option<AddressMode>,
    pub(crate) target: Option<TexelFormat>,
    pub(crate) depth: Option<DepthFormat>,
    pub(crate) compare: Option<CompareFunction>,
    pub(crate) blend: Option<BlendOp>,
    /// Most instructions of the program read textures.
    pub(crate) sampling: bool,
}

impl Options {
    pub(crate) fn new(version: Version) -> Self {
        Self {
            version,
            shape: None,
            texture: None,
            kind: None,
            address: None,
            target: None,
            depth: None,
            compare: None,
            blend: None,
            sampling: false,
        }
    }

    fn is_ps_1(&self) -> bool {
        self.version.is_ps_1_x()
    }
}

/// A texture of random bytes, or of codes at the limits of their range.
fn image(format: TexelFormat, kind: TextureKind, profile: &Profile, r: &mut Random) -> Image {
    let size = |r: &mut Random| 1 + r.below(9) as u32;
    let (w, h) = (size(r), size(r));
    let extents = match kind {
        TextureKind::D1 => [w, 1, 1],
        TextureKind::Cube => [w, w, 1],
        TextureKind::Volume => [w, h, size(r)],
        TextureKind::D2 | TextureKind::Rectangle => [w, h, 1],
    };
    let most = extents.iter().copied().max().unwrap_or(1).ilog2() + 1;
    let flat = kind == TextureKind::Rectangle || format.record().is_float() && !profile.limits.float_mipmaps;
    let levels = if flat || r.one_in(2) { 1 } else { most };
    let mut image = Image::new(format, kind, extents, levels).unwrap_or_else(|e| panic!("{e}"));
    let edges = r.one_in(4);
    let values: Vec<u8> = (0..image.bytes().len())
        .map(|_| if edges { r.of(&[0, 0, 0xff, 0xff, 0x7f, 0x80, 0x7c]) } else { r.next() as u8 })
        .collect();
    image.bytes_mut().copy_from_slice(&values);
    image
}

fn sampler(image: &Image, options: &Options, profile: &Profile, r: &mut Random) -> SamplerState {
    let modes = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];
    let mode = |r: &mut Random| options.address.unwrap_or_else(|| r.of(&modes));
    let filtered = profile.limits.float_filtering || !image.format().record().is_float();
    let filter = |r: &mut Random| {
        let linear = filtered && r.one_in(if options.sampling { 2 } else { 4 });
        if linear { Filter::Linear } else { Filter::Nearest }
    };
    if options.address.is_none() && r.one_in(3) {
        return SamplerState::NEAREST_CLAMP;
    }
    let mip = r.of(&[MipFilter::None, MipFilter::None, MipFilter::Nearest, MipFilter::Linear]);
    let (min, mag) = (filter(r), filter(r));
    let [address_u, address_v, address_w] = [mode(r), mode(r), mode(r)];
    let border = r.vector();
    let lod_bias = if r.one_in(3) { r.number() } else { 0 };
    let max_mip_level = r.below(3) as u8;
    SamplerState {
        min,
        // At least one in three uses the same filter for minification and magnification.
        mag: if max_mip_level == 1 { min } else { mag },
        mip: if filtered || mip != MipFilter::Linear { mip } else { MipFilter::Nearest },
        address_u,
        address_v,
        address_w,
        border,
        lod_bias,
        max_mip_level,
    }
}

/// OpenGL's state, from a separate random stream: the caller's stream must not depend on it.
fn state(mut r: Random) -> FixedFunctionState {
    let mut state = FixedFunctionState::default();
    let matrix = |r: &mut Random| std::array::from_fn(|_| r.vector());
    for material in &mut state.materials {
        material.colors = std::array::from_fn(|_| r.vector());
        (material.emission, material.shininess) = (r.vector(), r.number());
    }
    for light in &mut state.lights {
        light.colors = std::array::from_fn(|_| r.vector());
        (light.position, light.spot_exponent) = (r.vector(), r.number());
        light.spot_cutoff = (r.below(91) as f32).to_bits();
        [light.attenuation, light.spot_direction] = std::array::from_fn(|_| std::array::from_fn(|_| r.number()));
    }
    state.texture_environment = std::array::from_fn(|_| r.vector());
    (state.ambient, state.fog.color, state.fog.density) = (r.vector(), r.vector(), r.number());
    (state.fog.start, state.fog.end, state.depth_range) = (r.number(), r.number(), [r.number(), r.number()]);
    (state.modelview, state.projection) = (matrix(&mut r), matrix(&mut r));
    (state.texture, state.program) = (std::array::from_fn(|_| matrix(&mut r)), std::array::from_fn(|_| matrix(&mut r)));
    state
}

pub(crate) fn constants(r: &mut Random) -> Constants {
    let mut float: Vec<[u32; 4]> = (0..12).map(|_| r.vector()).collect();
    // `mad oPos, r0, c5, v0`: a small c5 keeps triangles in view; so does the near-identity matrix in c8 to c11.
    float[5] = [0x3a00_0000, 0x3a80_0000, 0, 0];
    let one = 0x3f80_0000;
    for (row, place) in (0..4).zip(8..) {
        float[place] = [0; 4];
        float[place][row] = one;
    }
    float[8][1] = 0x3e00_0000;
    Constants {
        float,
        int: (0..3).map(|_| [r.of(&[0, 1, 2, 3]), r.of(&[0, 1, 2]), r.of(&[-1, 0, 1]), 0]).collect(),
        boolean: (0..3).map(|_| r.one_in(2)).collect(),
        state: Some(Box::new(state(r.clone()))),
        ..Constants::default()
    }
}

fn kinds(options: &Options, r: &mut Random) -> Vec<(usize, TextureKind)> {
    use TextureKind::{Cube, D1, D2, Rectangle, Volume};
    let mut all = if options.is_ps_1() {
        vec![(0, D2), (1, D2), (2, Cube), (3, D2), (4, Rectangle), (5, D1)]
    } else {
        let flat = r.of(&[D2, D2, D1, Rectangle]);
        let step = r.of(&[1, 1, 1, 2, 3]);
        [D2, flat, D2, Cube, Volume].into_iter().enumerate().map(|(i, kind)| (i * step, kind)).collect()
    };
    if options.is_ps_1() && r.one_in(3) {
        for (_, kind) in &mut all {
            *kind = r.of(&[D1, D2, Rectangle, Cube, Volume]);
        }
    }
    if let Some(kind) = options.kind {
        for (_, entry) in &mut all {
            *entry = kind;
        }
    }
    all
}

pub(crate) fn textures(
    kinds: &[(usize, TextureKind)],
    options: &Options,
    profile: &Profile,
    r: &mut Random,
) -> Vec<(usize, Image, SamplerState)> {
    let formats = &profile.limits.texture_formats;
    let mut out = Vec::new();
    for &(slot, kind) in kinds {
        if options.texture.is_none() && r.one_in(8) {
            continue;
        }
        let format = options.texture.unwrap_or_else(|| r.of(formats));
        let image = image(format, kind, profile, r);
        let state = sampler(&image, options, profile, r);
        out.push((slot, image, state));
    }
    out
}

fn targets(options: &Options, profile: &Profile, r: &mut Random) -> Vec<TexelFormat> {
    let formats = &profile.limits.target_formats;
    let most = profile.limits.render_targets.unwrap_or(4).clamp(1, 4) as usize;
    let count = if options.is_ps_1() || options.version.is_fragment_program() { 1 } else { 1 + r.below(most) };
    let wide = [TexelFormat::Rgba32f, TexelFormat::Rgba16f];
    (0..count)
        .map(|i| match options.target {
            Some(format) => format,
            // The first target shows the program's results with enough range, if it can.
            None if i == 0 && !r.one_in(4) => wide.into_iter().find(|f| formats.contains(f)).unwrap_or(formats[0]),
            None => r.of(formats),
        })
        .collect()
}

fn blend(options: &Options, r: &mut Random) -> BlendState {
    let all = [BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max];
    let equation = |r: &mut Random| BlendEquation {
        source: r.of(BlendFactor::ALL),
        destination: r.of(BlendFactor::ALL),
        op: options.blend.unwrap_or_else(|| r.of(&all)),
    };
    BlendState { color: equation(r), alpha: equation(r) }
}

fn viewport([width, height]: [u32; 2], r: &mut Random) -> Viewport {
    let offset = |r: &mut Random| (r.below(9) as u32).cast_signed() - 4;
    let mut viewport = Viewport::new(1 + r.below(2 * width as usize) as u32, 1 + r.below(2 * height as usize) as u32);
    (viewport.x, viewport.y) = (offset(r), offset(r));
    if r.one_in(2) {
        viewport.min_depth = (r.below(65) as f32 / 64.0).to_bits();
        viewport.max_depth = (r.below(65) as f32 / 64.0).to_bits();
    }
    viewport
}

/// A random scene for a device, and the layout that its pixel program may rely on.
pub(crate) fn scene(profile: Profile, options: &Options, r: &mut Random) -> (Scene, Layout) {
    // Two scenes in three show the program's results: no special numbers, and no tests that discard fragments.
    r.tame = !r.one_in(3);
    r.wide = r.one_in(3);
    let plain = !r.one_in(3);
    let kinds = kinds(options, r);
    let textures = textures(&kinds, options, &profile, r);
    let targets = targets(options, &profile, r);
    let layout = Layout { samplers: kinds, targets: targets.len(), sampling: options.sampling };
    let blends = profile.limits.float_blending || targets.iter().all(|t| !t.record().is_float());
    let shape = options.shape.unwrap_or_else(|| shapes::ordinary(r));
    let size = shapes::size(shape, r);
    let geometry = shapes::geometry(shape, size, r);
    let depths = &profile.limits.depth_formats;
    let depth = options.depth.or_else(|| (options.compare.is_some() || !r.one_in(3)).then(|| r.of(depths)));
    let second = targets[0].record();
    let readable =
        profile.limits.texture_formats.contains(&targets[0]) && (profile.limits.float_mipmaps || !second.is_float());
    let vertex_stage = options.version.stage() == Stage::Vertex;
    let mut scene =
        Scene {
            size,
            pixel_constants: constants(r),
            vertex_constants: constants(r),
            textures,
            generated: Vec::new(),
            levels: None,
            bump: std::array::from_fn(|_| BumpStage {
                matrix: r.vector(),
                luminance_scale: r.number(),
                luminance_offset: r.number(),
            }),
            vertex_count: geometry.vertices.len(),
            vertices: geometry.vertices,
            streams: Vec::new(),
            instances: 1,
            indices: geometry.indices,
            primitive: geometry.primitive,
            targets,
            clear: if r.one_in(4) { r.vector() } else { [0x3e80_0000, 0x3f00_0000, 0x3f40_0000, 0x3f80_0000] },
            depth: depth.map(|format| (format, r.of(&[0x3f40_0000, 0x3f80_0000, 0, 0x3f00_0000]))),
            depth_state: depth_state(options, plain, r),
            alpha: (!plain && r.one_in(2))
                .then(|| AlphaTest { function: r.of(CompareFunction::ALL), reference: r.number() }),
            blend: (blends && (options.blend.is_some() || !plain && r.one_in(2))).then(|| blend(options, r)),
            masks: std::array::from_fn(|_| {
                if !plain && r.one_in(3) { WriteMask(r.below(16) as u8) } else { WriteMask::ALL }
            }),
            center: r.of(&[PixelCenter::Direct3d, PixelCenter::OpenGl]),
            clip_space: r.of(&[ClipSpace::Direct3d, ClipSpace::Direct3d, ClipSpace::OpenGl]),
            cull: r.of(&[Cull::None, Cull::None, Cull::None, Cull::Clockwise, Cull::CounterClockwise]),
            viewport: r.one_in(6).then(|| viewport(size, r)),
            scissor: r.one_in(6).then(|| {
                let (x, y) = (r.below(size[0] as usize) as u32, r.below(size[1] as usize) as u32);
                Region { x, y, width: 1 + r.below(40) as u32, height: 1 + r.below(40) as u32 }
            }),
            draws: if r.one_in(8) { 2 } else { 1 },
            projections: std::array::from_fn(|_| {
                r.of(&[Projection::None, Projection::None, Projection::None, Projection::Z, Projection::W])
            }),
            flat: r.one_in(5).then(|| r.of(&[Provoking::First, Provoking::Last])),
            second_pass: readable && !vertex_stage && r.one_in(10),
            profile,
        };
    if vertex_stage {
        shapes::streams(&mut scene, r);
    }
    mipmaps(&mut scene, options, r);
    (scene, layout)
}

/// Returns `true` if the device can generate mip levels in this format.
fn generates(profile: &Profile, format: TexelFormat) -> bool {
    !format.record().is_float() || profile.limits.float_mipmaps && profile.limits.float_filtering
}

/// Adds mip levels that the card generates, for textures and for a target that is read.
pub(crate) fn mipmaps(scene: &mut Scene, options: &Options, r: &mut Random) {
    (scene.generated, scene.levels) = (Vec::new(), None);
    for (slot, image, _) in &scene.textures {
        if image.levels().len() > 1 && generates(&scene.profile, image.format()) && r.one_in(2) {
            scene.generated.push(*slot);
        }
    }
    if scene.second_pass && generates(&scene.profile, scene.targets[0]) && r.one_in(2) {
        let like = Image::new_2d(scene.targets[0], 1, 1).unwrap_or_else(|e| panic!("{e}"));
        scene.levels = Some(sampler(&like, options, &scene.profile, r));
    }
}

fn depth_state(options: &Options, plain: bool, r: &mut Random) -> DepthState {
    let test = match options.compare {
        Some(compare) => Some(compare),
        None if plain => Some(CompareFunction::Always),
        None => (!r.one_in(4)).then(|| r.of(CompareFunction::ALL)),
    };
    DepthState { test, write: plain || r.one_in(2) }
}
