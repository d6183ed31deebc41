//! Tests filtered texture reads of the batch executor in rows, with and without level of detail, against the scalar
//! executor: every texel format, kind of texture, address mode, number of weight bits and register format, at arbitrary
//! coordinates and derivatives. Also tests reads at coordinates that are constant over a draw or a triangle.

use crate::environment::by_form;
use crate::random::Random;
use crate::sampling::switched;
use proptest::prelude::*;
use proptest::sample::select;
use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::{Profile, SignedTexelMinimum};
use refsim::exec::Constants;
use refsim::exec::batch::SimdLevel;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::num::Format;
use refsim::raster::{PixelCenter, Primitive, Vertex};
use refsim::texture::{AddressMode, Filter, Image, MipFilter, SamplerState, TargetRounding, TexelFormat, TextureKind};

/// Width and height in pixels: a tile and a few more.
const SIDE: u32 = 18;
const ONE: u32 = 0x3f80_0000;
const FORMATS: [&str; 16] = [
    "fp32",
    "fp24",
    "fp16",
    "s3.12",
    "s7.24",
    "fp32:rtz",
    "fp32:rna:ftz",
    "fp24:rdn",
    "fp16:nvovf:nv",
    "fp16:sat",
    "s1.10:rtz",
    "s0.31",
    "s3.12:wrap",
    "n3.8:rna",
    "n0.5:rtz",
    "bf16",
];
const MODES: [AddressMode; 4] = [AddressMode::Wrap, AddressMode::Mirror, AddressMode::Clamp, AddressMode::Border];
const KINDS: [TextureKind; 5] =
    [TextureKind::D1, TextureKind::D2, TextureKind::Rectangle, TextureKind::Cube, TextureKind::Volume];

/// Source of a read's coordinates and of its level of detail.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Lookup {
    /// Coordinates per pixel, level of detail from neighbouring pixels.
    Implicit,
    /// Coordinates and derivatives per pixel.
    Gradients,
    /// The first pixel's coordinates, as a constant of the draw.
    Constant,
    /// Coordinates that are constant over each of two quads, and derivatives as a program's constants.
    PerTriangle,
}

/// A read of a texture at coordinates stored in another texture, one texel per pixel.
#[derive(Clone, Debug)]
struct Read {
    texture: Image,
    state: SamplerState,
    lookup: Lookup,
    /// Single-precision patterns, row by row.
    coordinates: Vec<[u32; 4]>,
    /// The same: x and y of both directions, or those of one, which the other permutes.
    derivatives: Vec<[u32; 4]>,
    register: &'static str,
    weight_bits: u8,
    lod_bits: u8,
    minimum: SignedTexelMinimum,
    /// Further rules, as [`switched`] numbers them.
    switches: u32,
}

/// Coordinates between texels, far outside, and non-finite.
fn coordinate() -> impl Strategy<Value = u32> {
    prop_oneof![
        6 => (-2.5f32..2.5).prop_map(f32::to_bits),
        3 => (-20.0f32..20.0).prop_map(f32::to_bits),
        // Texel centres and edges, and their neighbours.
        4 => (-24i32..24, 1u32..10, -1i32..2).prop_map(|(i, n, ulps)| {
            (i as f32 / (2 * n) as f32).to_bits().wrapping_add_signed(ulps)
        }),
        1 => any::<u32>(),
        1 => select(vec![0, 0x8000_0000, 0x7f80_0000, 0xff80_0000, 0x7fc0_0000, 0xffc0_0001, 1, 0x8000_0001, 0x7f7f_ffff,
            0xff7f_ffff, 0x4b80_0000, 0xcb80_0001, 0x3f7f_ffff]),
    ]
}

fn texture(kind: TextureKind) -> impl Strategy<Value = Image> {
    let side = prop_oneof![1u32..10, Just(1)];
    let formats = TexelFormat::ALL.to_vec();
    (select(formats), [side.clone(), side.clone(), side], any::<bool>(), any::<u64>()).prop_map(
        move |(format, [w, h, d], chain, seed)| {
            let extents = match kind {
                TextureKind::D1 => [w, 1, 1],
                TextureKind::Cube => [w, w, 1],
                TextureKind::Volume => [w, h, d],
                TextureKind::D2 | TextureKind::Rectangle => [w, h, 1],
            };
            let most = Image::most_levels(kind, extents);
            let mut image = Image::new(format, kind, extents, if chain { most } else { 1 }).unwrap();
            let mut random = Random::new(seed);
            // Includes codes at the ends of their range, infinities and NaN.
            image.bytes_mut().fill_with(|| random.code());
            image
        },
    )
}

fn read() -> impl Strategy<Value = Read> {
    select(KINDS.to_vec()).prop_flat_map(|kind| {
        let state = (
            [select(MODES.to_vec()), select(MODES.to_vec()), select(MODES.to_vec())],
            // Includes nearest reads: of cube maps, volumes, and levels other than the first.
            prop_oneof![4 => Just(Filter::Linear), 1 => Just(Filter::Nearest)],
            [coordinate(), coordinate(), coordinate(), coordinate()],
            0u8..4,
        );
        let pixels = (SIDE * SIDE) as usize;
        let place = [coordinate(), coordinate(), coordinate()].prop_map(|[x, y, z]| [x, y, z, ONE]);
        let coordinates = proptest::collection::vec(place, pixels);
        let minimum = select(SignedTexelMinimum::ALL.to_vec());
        let weight_bits = prop_oneof![Just(8), 0u8..=12];
        (texture(kind), state, coordinates, select(FORMATS.to_vec()), weight_bits, minimum, 0u32..32).prop_map(
            |(texture, (modes, filter, border, level), coordinates, register, weight_bits, minimum, switches)| {
                let state = SamplerState {
                    min: filter,
                    mag: filter,
                    mip: MipFilter::None,
                    address_u: modes[0],
                    address_v: modes[1],
                    address_w: modes[2],
                    border,
                    lod_bias: 0,
                    max_mip_level: level,
                };
                let (derivatives, lookup) = (vec![[0; 4]; coordinates.len()], Lookup::Implicit);
                let lod_bits = 8;
                Read {
                    texture,
                    state,
                    lookup,
                    coordinates,
                    derivatives,
                    register,
                    weight_bits,
                    lod_bits,
                    minimum,
                    switches,
                }
            },
        )
    })
}

/// Derivatives of zero, fractions of a texel, whole textures and more.
fn derivative() -> impl Strategy<Value = u32> {
    prop_oneof![
        // 2^-9 to 8, of either sign.
        8 => (118u32..130, 0u32..1 << 23, 0u32..2).prop_map(|(exponent, fraction, sign)| sign << 31 | exponent << 23 | fraction),
        1 => Just(0),
        1 => coordinate(),
    ]
}

/// Reads that may depend on the level of detail.
fn leveled() -> impl Strategy<Value = Read> {
    let filter = || select(vec![Filter::Nearest, Filter::Linear]);
    let mip = select(vec![MipFilter::None, MipFilter::Nearest, MipFilter::Linear, MipFilter::Linear]);
    let lookup =
        select(vec![Lookup::Implicit, Lookup::Gradients, Lookup::Gradients, Lookup::Constant, Lookup::PerTriangle]);
    let bias = prop_oneof![2 => Just(0), 3 => (-3.0f32..3.0).prop_map(f32::to_bits), 1 => coordinate()];
    // Smooth coordinates, so that neighbouring pixels need few levels.
    let slope = (any::<bool>(), [-0.1f32..0.1, -0.1..0.1, -0.1..0.1], [-0.1f32..0.1, -0.1..0.1, -0.1..0.1]);
    let pixels = (SIDE * SIDE) as usize;
    let derivatives = proptest::collection::vec([derivative(), derivative(), derivative(), derivative()], pixels);
    (read(), [filter(), filter()], mip, lookup, bias, slope, derivatives, 0u8..=8).prop_map(
        |(mut read, [min, mag], mip, lookup, lod_bias, (smooth, across, down), derivatives, lod_bits)| {
            if smooth {
                for (pixel, coordinates) in (0..).zip(&mut read.coordinates) {
                    let (x, y) = ((pixel % SIDE) as f32, (pixel / SIDE) as f32);
                    for axis in 0..3 {
                        coordinates[axis] = (x * across[axis] + y * down[axis]).to_bits();
                    }
                }
            }
            let state = SamplerState { min, mag, mip, lod_bias, ..read.state };
            Read { state, lookup, derivatives, lod_bits, ..read }
        },
    )
}

fn vertex(x: f32, y: f32, s: f32, t: f32) -> Vertex {
    let mut vertex = Vertex { position: [x.to_bits(), y.to_bits(), 0x3f00_0000, ONE], ..Vertex::default() };
    vertex.texcoords[0] = [s.to_bits(), t.to_bits(), 0, ONE];
    vertex
}

/// The program, which computes coordinates in the register format.
fn text(read: &Read) -> String {
    let side = match read.texture.kind() {
        TextureKind::D1 => "1D",
        TextureKind::D2 => "2D",
        TextureKind::Rectangle => "RECT",
        TextureKind::Cube => "CUBE",
        TextureKind::Volume => "3D",
    };
    let lookup = match read.lookup {
        Lookup::Implicit => format!("TEX R1, R0, TEX1, {side};"),
        Lookup::Gradients => {
            format!("TEX R2, f[TEX0], TEX2, 2D;\nTXD R1, R0, R2, R2.zwxy, TEX1, {side};")
        }
        Lookup::Constant => format!("TEX R1, p[0], TEX1, {side};\nMADR R1, R1, R0, R1;"),
        Lookup::PerTriangle => format!("TXD R1, f[TEX1], p[1], p[1].zwxy, TEX1, {side};\nMADR R1, R1, R0, R1;"),
    };
    format!("!!FP1.0\nTEX R0, f[TEX0], TEX0, 2D;\n{lookup}\nMOVR o[COLR], R1;\nEND")
}

/// Two adjacent quads; TEX1 is constant over each.
fn quads(read: &Read) -> Vec<Vertex> {
    let half = |left: f32, place: [u32; 4]| {
        let corners = [(left, 1.0), (left + 1.0, 1.0), (left + 1.0, -1.0), (left, -1.0)];
        corners.map(|(x, y)| {
            let mut corner = vertex(x, y, (x + 1.0) / 2.0, (1.0 - y) / 2.0);
            corner.texcoords[1] = place;
            corner
        })
    };
    [half(-1.0, read.coordinates[0]), half(0.0, read.coordinates[1])].concat()
}

/// The colours of all pixels.
fn drawn(read: &Read, (kind, level): (ExecutorKind, Option<SimdLevel>)) -> Vec<u8> {
    let mut profile = Profile::named("ideal-fp32").unwrap();
    // Coordinates are computed in single precision whatever the register format is.
    profile.set_format(read.register.parse::<Format>().unwrap()).unwrap();
    profile.rules.filter_fraction_bits = read.weight_bits;
    profile.rules.lod_fraction_bits = read.lod_bits;
    profile.rules.signed_texel_minimum = read.minimum;
    let rules = &mut profile.rules;
    (
        rules.filter_weight_rounding,
        rules.filter_arithmetic,
        rules.texel_values,
        rules.missing_channels,
        rules.border_storage,
    ) = switched(read.switches);
    let program = check(assemble(&text(read)).unwrap(), &profile).unwrap();
    let mut machine = Machine::new(profile, kind);
    machine.set_simd_level(level);
    let target = machine.create_target(TexelFormat::Rgba32f, SIDE, SIDE).unwrap();
    let mut table = |values: &[[u32; 4]]| {
        let (format, extents) = (TexelFormat::Rgba32f, [SIDE, SIDE, 1]);
        let image = Image::from_values(format, TextureKind::D2, extents, Format::FP32, values, TargetRounding::Nearest);
        machine.create_texture(image.unwrap()).unwrap()
    };
    let [coordinates, derivatives] = [table(&read.coordinates), table(&read.derivatives)];
    let texture = machine.create_texture(read.texture.clone()).unwrap();
    let vertices = quads(read);
    let constants = Constants { float: vec![read.coordinates[0], read.derivatives[0]], ..Constants::default() };
    let source = VertexSource::Transformed(&vertices);
    let mut call = DrawCall::new(source, Primitive::QuadList, &program, &constants, target)
        .with_texture(0, coordinates, SamplerState::NEAREST_CLAMP)
        .with_texture(1, texture, read.state)
        .with_texture(2, derivatives, SamplerState::NEAREST_CLAMP);
    call.center = PixelCenter::OpenGl;
    machine.draw(&call).unwrap();
    machine.read_back(target).unwrap().bytes().to_vec()
}

fn agrees(read: &Read) {
    let expected = drawn(read, (ExecutorKind::Scalar, None));
    for level in SimdLevel::available() {
        let found = drawn(read, (ExecutorKind::Batch, Some(level)));
        let differing = found.chunks_exact(16).zip(expected.chunks_exact(16)).position(|(a, b)| a != b);
        let Some(pixel) = differing else { continue };
        let at = 16 * pixel..16 * pixel + 16;
        panic!(
            "{}, pixel {pixel}, coordinates {:x?}: {:x?} instead of {:x?}",
            level.name(),
            read.coordinates[pixel],
            &found[at.clone()],
            &expected[at]
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(by_form(1000, 30_000)))]

    #[test]
    fn filtered_reads_agree(read in read()) {
        agrees(&read);
    }

    #[test]
    fn leveled_reads_agree(read in leveled()) {
        agrees(&read);
    }
}

/// The same for a texture that is too large for a table, and for one with more texels than a byte has codes.
#[test]
fn large_textures_are_filtered_alike() {
    let mut random = Random::new(1);
    let cases = TexelFormat::ALL.iter().zip(MODES.into_iter().cycle());
    let cases = cases.flat_map(|(&format, mode)| [[601, 600], [43, 42]].map(|size| (format, mode, size)));
    // Exact fractions, then bytes.
    for ((format, mode, [width, height]), switches) in cases.flat_map(|case| [(case, 0), (case, 31)]) {
        let mut texture = Image::new_2d(format, width, height).unwrap();
        texture.bytes_mut().fill_with(|| random.next() as u8);
        let filter = Filter::Linear;
        let border = [0x3e80_0000, 0x3f00_0000, 0x3f40_0000, ONE];
        let modes = SamplerState { address_u: mode, address_v: mode, border, ..SamplerState::NEAREST_CLAMP };
        let state = SamplerState { min: filter, mag: filter, ..modes };
        let mut coordinate = || random.between(-1.5, 2.5).to_bits();
        let coordinates: Vec<_> = (0..SIDE * SIDE).map(|_| [coordinate(), coordinate(), 0, ONE]).collect();
        let (minimum, lookup) = (SignedTexelMinimum::Clamp, Lookup::Implicit);
        let derivatives = vec![[0; 4]; coordinates.len()];
        let register = "fp32";
        let read = Read {
            texture,
            state,
            lookup,
            coordinates,
            derivatives,
            register,
            weight_bits: 8,
            lod_bits: 8,
            minimum,
            switches,
        };
        agrees(&read);
        // Nearest texels, which have their own decoding in rows.
        let nearest = SamplerState { min: Filter::Nearest, mag: Filter::Nearest, ..read.state };
        for register in ["fp32", "fp16", "fp24:rdn", "fp32:rna:ftz", "s3.12"] {
            agrees(&Read { state: nearest, register, ..read.clone() });
        }
    }
}
