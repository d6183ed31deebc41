//! Filters of textures: weights, arithmetic, level of detail.

use super::draws::{COLUMNS, at, codes, quads, rows};
use super::rule::{Hypotheses, Rule};
use super::running::{bits, checked};
use super::table::{Row, table};
use super::texels::reading;
use super::values::Values;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{Executor, VertexSource};
use refsim::texture::{AddressMode, Filter, Image, MipFilter, SamplerState, TexelFormat, TextureKind};

/// Width of the quad of `b_filter.csv` in pixels, and of level 0 of its texture in texels.
const SIDE: u32 = 64;
const TEXELS: u32 = 128;

pub(crate) fn rules() -> Vec<Rule> {
    let arithmetic = Rule {
        name: "Filter of bytes: x, then y, then levels, each step rounded to a byte",
        data: "nv2a/b_filter.csv",
        unit: "pixel",
        hypotheses: Hypotheses::Switch("filter-arithmetic"),
        redraw: |profile, executor| checks(profile, executor, |_| true),
        unexplained: 0,
        settled: true,
        open: "The third axis of volumes; texels of 16 bits.",
    };
    let levels = Rule {
        name: "Fraction bits of a level of detail",
        hypotheses: Hypotheses::Switch("lod-fraction-bits"),
        redraw: |profile, executor| checks(profile, executor, |bias| bias % 256 != 0),
        open: "The level itself, which is a whole number in every picture.",
        ..arithmetic.clone()
    };
    let bits = Rule {
        name: "Fraction bits of a filter weight",
        data: "nv2a/b_filter_fraction.csv",
        unit: "column",
        hypotheses: Hypotheses::Switch("filter-fraction-bits"),
        redraw: fractions,
        unexplained: 2,
        open: "Two columns of texels of 4 bits, whose red is off by one; weights along y.",
        ..arithmetic.clone()
    };
    let rounding = Rule {
        name: "Rounding of a filter weight",
        hypotheses: Hypotheses::Switch("filter-weight-rounding"),
        open: "Weights that are rounded to nearest, of coordinates that are low by 1/512 texel, are the same; the two \
               columns, and y, as above.",
        ..bits.clone()
    };
    vec![arithmetic, levels, bits, rounding]
}

const LINEAR: SamplerState =
    SamplerState { min: Filter::Linear, mag: Filter::Linear, mip: MipFilter::Linear, ..SamplerState::NEAREST_CLAMP };

/// Checkerboards of 4 texels; each level has its own color, next to dark texels.
fn checked_levels() -> Image {
    const COLORS: [u32; 6] = [0xff_0000, 0xff_ffff, 0x00_ffff, 0xff_00ff, 0xff_ff00, 0x80_8080];
    let extents = [TEXELS, TEXELS, 1];
    let mut image = Image::new(TexelFormat::Bgrx8, TextureKind::D2, extents, COLORS.len() as u32).expect("an image");
    for (level, color) in (0..).zip(COLORS) {
        let side = TEXELS >> level;
        for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
            let texel = if (x / 4 + y / 4) % 2 == 0 { color } else { 0x05_0505 };
            image.set_raw(level, 0, y, x, texel.into());
        }
    }
    image
}

/// Draws the checkerboards with each bias that `wanted` accepts, and compares the measured pixels.
fn checks(profile: &Profile, executor: &Executor, wanted: impl Fn(i32) -> bool) -> Values {
    let all = table("nv2a/b_filter.csv");
    let (program, constants) = (checked("ps_1_1\ntex t0\nmov r0, t0", profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let texture = machine.create_texture(checked_levels()).expect("a texture");
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]: [f32; 2]| {
        let mut corner = at([u * SIDE as f32, v * SIDE as f32], 0.5);
        corner.texcoords[0] = bits([u, v, 0.0, 1.0]);
        corner
    });
    let mut values = Values::default();
    let bias = |row: &Row| row.number::<i32>("bias256");
    for alike in all.chunk_by(|a, b| bias(a) == bias(b)).filter(|rows| wanted(bias(&rows[0]))) {
        let target = machine.create_target(TexelFormat::Bgra8, SIDE, SIDE).expect("a target");
        let state = SamplerState { lod_bias: (bias(&alike[0]) as f32 / 256.0).to_bits(), ..LINEAR };
        let call = quads(VertexSource::Transformed(&corners), &program, &constants, target);
        machine.draw(&call.with_texture(0, texture, state)).expect("drawn");
        let image = machine.read_back(target).expect("read back");
        for row in alike {
            let [b, g, r, _] = (image.raw(0, 0, row.number("y"), row.number("x")) as u32).to_le_bytes();
            let measured = ["r", "g", "b"].map(|name| row.number::<u8>(name));
            values.add(measured, [r, g, b], measured == [r, g, b]);
        }
    }
    values
}

/// Red of a pixel that is dimmed by a byte and blended over the background.
fn dimmed(byte: i32) -> i32 {
    let shade = 254 * (7 * byte.rem_euclid(256) + 3 * 255) / 2550;
    (2 * (127 * shade + 128 * 32) + 255) / 510
}

/// Draws a cell per row that reads between two texels. A signed byte k reads as 2k / 255; -128 negated reads as 1.
fn fractions(profile: &Profile, executor: &Executor) -> Values {
    let all = table("nv2a/b_filter_fraction.csv");
    let programs = ["t0", "-t0"].map(|value| checked(&format!("ps_1_1\ntex t0\nmov r0, {value}"), profile));
    let constants = Constants::default();
    let state = SamplerState { mip: MipFilter::None, address_u: AddressMode::Clamp, ..LINEAR };
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let mut values = Values::default();
    let texels = |row: &Row| ["texel1", "texel2"].map(|name| row.number::<i32>(name) as u8);
    for alike in all.chunk_by(|a, b| (a.text("kind"), texels(a)) == (b.text("kind"), texels(b))) {
        let signed = alike[0].text("kind") == "signed";
        let format = if signed { TexelFormat::Rgba8Snorm } else { TexelFormat::Rgba8 };
        let mut image = Image::new_2d(format, 4, 1).expect("an image");
        for (x, texel) in (0..).zip(texels(&alike[0]).into_iter().flat_map(|texel| [texel; 2])) {
            image.set_raw(0, 0, 0, x, (0x0101_0101 * u32::from(texel)).into());
        }
        let texture = machine.create_texture(image).expect("a texture");
        let place = |row: &Row| (168 + 2 * row.number::<u32>("column") + 1) as f32 / 672.0;
        let corners: Vec<_> = alike.iter().enumerate().flat_map(|(i, row)| reading(i, [place(row), 0.5])).collect();
        let [above, below] = [0, 1].map(|sign: usize| {
            let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(alike.len())).expect("a target");
            let call = quads(VertexSource::Transformed(&corners), &programs[sign], &constants, target);
            machine.draw(&call.with_texture(0, texture, state)).expect("drawn");
            let image = machine.read_back(target).expect("read back");
            (0..alike.len()).map(|i| i32::from(codes(image, i)[0])).collect::<Vec<_>>()
        });
        for (row, (above, below)) in alike.iter().zip(above.into_iter().zip(below)) {
            // Half of the register's code; the code of -128 is -255.
            let byte = if signed { (above - below).div_euclid(2) } else { above };
            let (measured, drawn): (i32, i32) = (row.number("red8"), dimmed(byte));
            values.add_grey(measured as u8, drawn as u8, measured == drawn);
        }
    }
    values
}
