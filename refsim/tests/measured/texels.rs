//! Values of texels: narrow channels, signed bytes, border colors.

use super::draws::{COLUMNS, cell, codes, quads, rows};
use super::rule::{Hypotheses, Rule};
use super::running::{bits, checked};
use super::table::{Row, table};
use super::values::Values;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{Executor, VertexSource};
use refsim::raster::Vertex;
use refsim::texture::{AddressMode, Image, SamplerState, TexelFormat, TexelValues};

pub(crate) fn rules() -> Vec<Rule> {
    let bytes = Rule {
        name: "Channels of 5 and 6 bits: bits repeated to a byte",
        data: "nv2a/b_texel_codes.csv",
        unit: "code",
        hypotheses: Hypotheses::Switch("texel-values"),
        redraw: narrow_channels,
        unexplained: 0,
        settled: true,
        open: "Channels of 10 and 11 bits, of which the registers see 8 bits at least. That of 16 bits they see the upper byte \
               was read from pictures that are not in these files.",
    };
    let signed = Rule {
        name: "Signed bytes k: 2k / 255",
        data: "nv2a/b_signed_texel.csv",
        hypotheses: Hypotheses::Options(&[
            ("2k / 255", |_| {}),
            ("k / 127", |rules| rules.texel_values = TexelValues::Fractions),
        ]),
        redraw: signed_bytes,
        open: "Whether a register gets -1 or -256/255 from the code -128 (`signed-texel-minimum`); narrower signed \
               channels that are not filtered.",
        ..bytes.clone()
    };
    let border = Rule {
        name: "Border color kept in four bytes",
        data: "nv2a/b_border.csv",
        unit: "format",
        hypotheses: Hypotheses::Switch("border-storage"),
        redraw: borders,
        open: "Formats with signed channels.",
        ..bytes.clone()
    };
    vec![bytes, signed, border]
}

/// A cell whose corners have the same texture coordinates, so that interpolation does not change them.
pub(crate) fn reading(index: usize, place: [f32; 2]) -> [Vertex; 4] {
    cell(index).map(|mut corner| {
        corner.texcoords[0] = bits([place[0], place[1], 0.0, 1.0]);
        corner
    })
}

/// Draws the texels unfiltered, one cell per texel: red, green, blue and alpha in 8 bits.
fn drawn(profile: &Profile, executor: &Executor, format: TexelFormat, texels: &[u32]) -> Vec<[u8; 4]> {
    let height = rows(texels.len());
    let mut image = Image::new_2d(format, COLUMNS, height).expect("an image");
    let mut corners = Vec::new();
    for (i, &texel) in texels.iter().enumerate() {
        let [x, y] = [i as u32 % COLUMNS, i as u32 / COLUMNS];
        image.set_raw(0, 0, y, x, texel.into());
        corners.extend(reading(i, [(x as f32 + 0.5) / COLUMNS as f32, (y as f32 + 0.5) / height as f32]));
    }
    sampled(profile, executor, (image, SamplerState::NEAREST_CLAMP), &corners)
}

/// The codes of the cells that read a texture.
fn sampled(
    profile: &Profile,
    executor: &Executor,
    (image, state): (Image, SamplerState),
    corners: &[Vertex],
) -> Vec<[u8; 4]> {
    let (program, constants) = (checked("ps_1_1\ntex t0\nmov r0, t0", profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let cells = corners.len() / 4;
    let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(cells)).expect("a target");
    let texture = machine.create_texture(image).expect("a texture");
    let call = quads(VertexSource::Transformed(corners), &program, &constants, target);
    machine.draw(&call.with_texture(0, texture, state)).expect("drawn");
    let image = machine.read_back(target).expect("read back");
    (0..cells).map(|i| codes(image, i)).collect()
}

/// Index of a row's channel in the order red, green, blue, alpha.
fn channel(row: &Row) -> usize {
    "rgba".find(row.text("channel")).expect("a channel")
}

/// Draws a texel per row; the blue of R6G5B5 is read as the blue of bgra5551.
fn narrow_channels(profile: &Profile, executor: &Executor) -> Values {
    let all = table("nv2a/b_texel_codes.csv");
    let mut values = Values::default();
    for alike in all.chunk_by(|a, b| a.text("format") == b.text("format")) {
        let (format, shifts) = match alike[0].text("format") {
            "R5G6B5" => (TexelFormat::Bgr565, [11, 5, 0]),
            "X1R5G5B5" | "R6G5B5" => (TexelFormat::Bgra5551, [10, 5, 0]),
            "X8R8G8B8_L" => (TexelFormat::Bgrx8, [16, 8, 0]),
            other => panic!("format `{other}`"),
        };
        let texels: Vec<u32> = alike.iter().map(|row| row.number::<u32>("code") << shifts[channel(row)]).collect();
        for (row, found) in alike.iter().zip(drawn(profile, executor, format, &texels)) {
            values.add_code(row.number("out8"), found[channel(row)]);
        }
    }
    values
}

/// Draws a texel per row, with its code in every channel.
fn signed_bytes(profile: &Profile, executor: &Executor) -> Values {
    let all = table("nv2a/b_signed_texel.csv");
    let mut values = Values::default();
    for alike in all.chunk_by(|a, b| a.text("kind") == b.text("kind")) {
        let format = if alike[0].text("kind") == "signed" { TexelFormat::Rgba8Snorm } else { TexelFormat::Rgba8 };
        let texels: Vec<u32> = alike.iter().map(|row| 0x0101_0101 * row.number::<u32>("code")).collect();
        for (row, found) in alike.iter().zip(drawn(profile, executor, format, &texels)) {
            values.add_code(row.number("out8"), found[channel(row)]);
        }
    }
    values
}

/// Reads the border color outside a texture, in each format that the emulator supports.
fn borders(profile: &Profile, executor: &Executor) -> Values {
    let mut values = Values::default();
    for row in table("nv2a/b_border.csv").iter().filter(|row| !row.text("ours").is_empty()) {
        assert_eq!(row.text("pixels_right"), row.text("pixels"), "all pixels show the color");
        let image = Image::new_2d(row.text("ours").parse().expect("a format"), 8, 8).expect("an image");
        let state = SamplerState {
            address_u: AddressMode::Border,
            address_v: AddressMode::Border,
            border: bits([255.0, 34.0, 204.0, 51.0].map(|code| code / 255.0)),
            ..SamplerState::NEAREST_CLAMP
        };
        let found = sampled(profile, executor, (image, state), &reading(0, [1.5, 0.5]));
        let [r, g, b, _] = found[0];
        values.add([255, 34, 204], [r, g, b], found[0] == [255, 34, 204, 51]);
    }
    values
}
