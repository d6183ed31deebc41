//! Colors from the vertex to the pixel, and the alpha test.

use super::draws::{COLUMNS, at, cell, codes, color_program, colored, quads, rows};
use super::iterated;
use super::rule::{Hypotheses, Rule};
use super::running::checked;
use super::table::{Row, table};
use super::values::Values;
use refsim::device::{ColorIterator, Profile};
use refsim::exec::Constants;
use refsim::machine::{AttributeStream, Executor, StepRate, VertexSource, VertexStreams};
use refsim::output::{AlphaTest, CompareFunction};
use refsim::raster::Vertex;
use refsim::texture::{Image, Region, TexelFormat};

const ENDS: &str = "nv2a/a_vertex_colour.csv";
pub(crate) const GRADIENTS: &str = "nv2a/a_colour.csv";
const ALPHA: &str = "nv2a/a_alpha_test.csv";
const ONE: u32 = 0x3f80_0000;

/// End values of gradients that the chip draws as a gradient from 0 to 1: with infinities, the largest numbers, and 8.
const BEYOND: [[u32; 2]; 5] =
    [[0xbf80_0000, ONE], [0xc100_0000, ONE], [0, 0x4100_0000], [0xff7f_ffff, 0x7f7f_ffff], [0xff80_0000, 0x7f80_0000]];

pub(crate) fn rules() -> Vec<Rule> {
    let unit = Rule {
        name: "Vertex programs: 0 times anything is 0, there are no subnormal numbers, a moved NaN keeps its sign",
        data: ENDS,
        unit: "color",
        hypotheses: Hypotheses::Switch("vertex-format"),
        redraw: ends,
        unexplained: 0,
        settled: true,
        open: "Nothing: these pictures show products and moves. Sums, dot products and all other instructions are settled by \
               vectors of the unit (numbers.md).",
    };
    let clamp = Rule {
        name: "Vertex colors are clamped at the vertex; NaN is 1",
        data: "nv2a/a_vertex_colour.csv`, `nv2a/a_colour.csv",
        hypotheses: Hypotheses::Switch("color-clamp"),
        redraw: |profile, executor| {
            let mut values = ends(profile, executor);
            values.0.extend(gradients_beyond(profile, executor).0);
            values
        },
        open: "nothing",
        ..unit.clone()
    };
    let iterated = Rule {
        name: "Iterated colors to the code",
        data: GRADIENTS,
        unit: "pixel",
        hypotheses: Hypotheses::Switch("color-iterator"),
        redraw: |profile, executor| gradients(profile, executor, 0),
        unexplained: 0,
        settled: false,
        open: "The rounding: the row after the next one. The card's codes and ours differ by one at most (next row).",
    };
    let near = Rule {
        name: "Iterated colors within one code",
        hypotheses: Hypotheses::Options(&[
            ("8", |_| ()),
            ("7", |rules| rules.color_iterator = ColorIterator::Unorm(7)),
            ("6", |rules| rules.color_iterator = ColorIterator::Unorm(6)),
        ]),
        redraw: |profile, executor| gradients(profile, executor, 1),
        settled: true,
        open: "As above.",
        ..iterated.clone()
    };
    let rounding = Rule {
        name: "Iterated colors: roundings of the exact plane",
        hypotheses: Hypotheses::Computed("ours", iterated::WAYS),
        open: "Not obeyed. v0 to v2 are a triangle's vertices in order, of a quad 0, 1, 2 and 0, 2, 3. What the best answer \
               misses are whole 256ths where two weights lie between 1/4 and 1/2: there the error of the card's plane \
               decides, and no order of sums in floats of 8 to 25 bits that was tried predicts it. And v1 has 0 or 1 in every \
               picture: whether 1 - v1 is taken off between them, or 1 below one half, is not seen, nor which vertex is v1 \
               in a strip, a fan or a clipped triangle. A gradient with 0.25 at v1 would tell.",
        ..iterated.clone()
    };
    let alpha = Rule {
        name: "The alpha test compares 8-bit codes",
        data: ALPHA,
        unit: "comparison",
        hypotheses: Hypotheses::Options(&[
            ("8 bits", |_| ()),
            ("7 bits", |rules| rules.color_iterator = ColorIterator::Unorm(7)),
        ]),
        redraw: alpha_test,
        unexplained: 0,
        settled: false,
        open: "These are codes of one parity beside a reference of the other, which 7 bits tell apart as well; pictures \
               with all codes were read too, in which \"equal\" draws one step of 8 bits.",
    };
    let dither = Rule {
        name: "Nothing is dithered: pixels of a row with the same exact color have the same code",
        hypotheses: Hypotheses::Options(&[("none", |_| ())]),
        redraw: undithered,
        unexplained: 11,
        settled: true,
        open: "Dithering as a state of Direct3D, which the pictures do not set. The values that differ are whole numbers of \
               256ths, where the error of the plane decides.",
        ..iterated.clone()
    };
    vec![unit, clamp, iterated, near, rounding, dither, alpha]
}

/// Constant colors of `mov oD0, v1` and `mul oD0, v1, c0`, one cell each.
fn ends(profile: &Profile, executor: &Executor) -> Values {
    by_program(profile, executor, &table(ENDS))
}

/// Pairs each row's measured code with the red channel of the row's cell.
fn compared(table: &[Row], image: &Image) -> Values {
    let mut values = Values::default();
    for (i, row) in table.iter().enumerate() {
        values.add_code(row.number("code"), codes(image, i)[0]);
    }
    values
}

fn by_program(profile: &Profile, executor: &Executor, table: &[Row]) -> Values {
    let (pixel, pixel_constants) = (color_program(profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(table.len())).expect("a target");
    for (i, row) in table.iter().enumerate() {
        let (step, constant) = match row.text("constant_bits") {
            "mov" => ("mov oD0, v1", 0),
            _ => ("mul oD0, v1, c0", row.hex("constant_bits")),
        };
        let vertex = checked(&format!("vs_1_1\ndcl_position v0\ndcl_color v1\nmov oPos, v0\n{step}"), profile);
        let constants = Constants { float: vec![[constant; 4]], ..Constants::default() };
        let colors = [[row.hex("attribute_bits"); 4]; 4];
        let positions = cell(i).map(|corner| corner.position);
        let source =
            VertexSource::Program { program: &vertex, constants: &constants, streams: streams(&positions, &colors) };
        machine.draw(&quads(source, &pixel, &pixel_constants, target)).expect("drawn");
    }
    compared(table, machine.read_back(target).expect("read back"))
}

fn streams<'a>(positions: &'a [[u32; 4]], colors: &'a [[u32; 4]]) -> VertexStreams<'a> {
    let stream = |register, data| AttributeStream { register, step: StepRate::Vertex, data };
    VertexStreams {
        vertex_count: positions.len(),
        instance_count: 1,
        streams: vec![stream(0, positions), stream(1, colors)],
    }
}

/// The quad of a gradient: its left, top, right and bottom edges, and whether the gradient runs to the right.
pub(crate) fn gradient_quad(picture: &str) -> ([f32; 4], bool) {
    match picture {
        "0_1" => ([128.0, 144.0, 179.2, 432.0], false),
        "AlphaFuncAlways_Disabled" => ([64.0, 0.0, 576.0, 480.0], true),
        other => panic!("picture `{other}`"),
    }
}

/// Draws the gradients of the file; codes at its pixels are correct within `slop`.
fn gradients(profile: &Profile, executor: &Executor, slop: u8) -> Values {
    let mut values = Values::default();
    let same = |a: &Row, b: &Row| a.text("picture") == b.text("picture") && is_falling(a) == is_falling(b);
    for rows in table(GRADIENTS).chunk_by(same) {
        let ends = if is_falling(&rows[0]) { [ONE, 0] } else { [0, ONE] };
        for (found, row) in drawn(profile, executor, ends, rows).into_iter().zip(rows) {
            let measured: u8 = row.number("code");
            values.add_grey(measured, found, found.abs_diff(measured) <= slop);
        }
    }
    values
}

/// Pixels of the vertical gradient: equal within a row, both measured and drawn.
fn undithered(profile: &Profile, executor: &Executor) -> Values {
    let rows: Vec<Row> = table(GRADIENTS).into_iter().filter(|row| row.text("picture") == "0_1").collect();
    let found = drawn(profile, executor, [0, ONE], &rows);
    let numbered: Vec<(&Row, u8)> = rows.iter().zip(found).collect();
    let mut values = Values::default();
    let same = |(a, _): &(&Row, u8), (b, _): &(&Row, u8)| {
        ["triangle", "row", "exact_256ths"].into_iter().all(|column| a.text(column) == b.text(column))
    };
    for alike in numbered.chunk_by(same) {
        let (first, code) = alike[0];
        for (row, found) in alike {
            let alike = row.text("code") == first.text("code") && *found == code;
            values.add_grey(row.number("code"), *found, alike);
        }
    }
    values
}

fn row_number(row: &Row) -> u32 {
    row.number("row")
}

pub(crate) fn is_falling(row: &Row) -> bool {
    row.text("triangle") == "alpha falling"
}

/// Gradients between ends beyond 0 and 1, by a vertex program: their codes equal the codes of the gradient from 0 to 1.
fn gradients_beyond(profile: &Profile, executor: &Executor) -> Values {
    let table = table(GRADIENTS);
    let rows: Vec<Row> = table.into_iter().filter(|row| row.text("picture") == "0_1").collect();
    let expected = drawn(profile, executor, [0, ONE], &rows);
    let mut values = Values::default();
    for ends in BEYOND {
        for (found, expected) in drawn(profile, executor, ends, &rows).into_iter().zip(&expected) {
            values.add_code(*expected, found);
        }
    }
    values
}

/// Draws the gradient of a picture between two values and reads the codes at the rows' pixels.
fn drawn(profile: &Profile, executor: &Executor, [from, to]: [u32; 2], rows: &[Row]) -> Vec<u8> {
    let ([left, top, right, bottom], across) = gradient_quad(rows[0].text("picture"));
    let places = [[left, top], [right, top], [right, bottom], [left, bottom]];
    let values = if across { [from, to, to, from] } else { [from, from, to, to] };
    let (positions, colors) = (places.map(|place| at(place, 0.5).position), values.map(|value| [value; 4]));
    let vertex = checked("vs_1_1\ndcl_position v0\ndcl_color v1\nmov oPos, v0\nmov oD0, v1", profile);
    let (program, constants) = (color_program(profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, 640, 480).expect("a target");
    let source =
        VertexSource::Program { program: &vertex, constants: &constants, streams: streams(&positions, &colors) };
    let mut call = quads(source, &program, &constants, target);
    let (first, last) = (rows.iter().map(row_number).min(), rows.iter().map(row_number).max());
    let y = first.expect("a row");
    call.scissor = Some(Region { x: 0, y, width: 640, height: last.expect("a row") - y + 1 });
    machine.draw(&call).expect("drawn");
    let image = machine.read_back(target).expect("read back");
    rows.iter().map(|row| image.raw(0, 0, row_number(row), row.number("column")) as u8).collect()
}

/// Draws a cell per row, with the alpha test on.
fn alpha_test(profile: &Profile, executor: &Executor) -> Values {
    let table = table(ALPHA);
    let (program, constants) = (color_program(profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(table.len())).expect("a target");
    machine.clear_target(target, [0; 4]).expect("cleared");
    let numbered: Vec<(usize, &Row)> = table.iter().enumerate().collect();
    let state = |row: &Row| (row.text("test").to_owned(), row.number::<u8>("reference_code"));
    for alike in numbered.chunk_by(|(_, a), (_, b)| state(a) == state(b)) {
        let white = |&(i, row): &(usize, &Row)| colored(i, [255, 255, 255, row.number("alpha_code")]);
        let vertices: Vec<Vertex> = alike.iter().flat_map(white).collect();
        let mut call = quads(VertexSource::Transformed(&vertices), &program, &constants, target);
        let (test, reference) = state(alike[0].1);
        let function = match test.as_str() {
            "never" => CompareFunction::Never,
            "less" => CompareFunction::Less,
            "equal" => CompareFunction::Equal,
            "less-equal" => CompareFunction::LessEqual,
            "greater" => CompareFunction::Greater,
            "not-equal" => CompareFunction::NotEqual,
            "greater-equal" => CompareFunction::GreaterEqual,
            "always" => CompareFunction::Always,
            other => panic!("test `{other}`"),
        };
        call.alpha_test = Some(AlphaTest { function, reference: (f32::from(reference) / 255.0).to_bits() });
        machine.draw(&call).expect("drawn");
    }
    let image = machine.read_back(target).expect("read back");
    let mut values = Values::default();
    for (i, row) in numbered {
        values.add_verdict(row.text("passes") == "1", codes(image, i)[0] != 0);
    }
    values
}
