//! Window positions and the fill rule: shapes whose edges step by 1/16 of a pixel about pixel centers.

use super::draws::{at, color_program, quads};
use super::rule::{Hypotheses, Rule};
use super::table::{Row, table};
use super::values::Values;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{Executor, VertexSource};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::{Region, TexelFormat};

const FILE: &str = "nv2a/a_coverage.csv";

/// Width and height of the target, which holds all shapes.
const SIZE: u32 = 640;

pub(crate) fn rules() -> Vec<Rule> {
    let rule = Rule {
        name: "Window positions are cut to the grid, toward the window's corner; edges are top-left",
        data: FILE,
        unit: "shape",
        hypotheses: Hypotheses::Switch("subpixel-rounding"),
        redraw,
        unexplained: 0,
        settled: true,
        open: "Whether Direct3D's drivers for PCs add 1/32 to the viewport, as the Xbox's does: `nearest` is what such a \
               driver makes of `cut`.",
    };
    let bits = Rule {
        name: "Window positions have 4 fraction bits",
        hypotheses: Hypotheses::Switch("subpixel-bits"),
        open: "",
        ..rule.clone()
    };
    vec![rule, bits]
}

fn corners(row: &Row) -> Vec<Vertex> {
    let corner = |text: &str| {
        let (x, y) = text.split_once(' ').expect("two numbers");
        at([x, y].map(|number| number.parse().expect("a number")), 0.5)
    };
    row.text("vertices_x_y").split(';').map(corner).collect()
}

/// Draws each shape alone; all pixels of its rows and columns must equal the pixels in the file.
fn redraw(profile: &Profile, executor: &Executor) -> Values {
    let (program, constants) = (color_program(profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, SIZE, SIZE).expect("a target");
    let mut values = Values::default();
    for shape in table(FILE).chunk_by(|a, b| a.text("shape") == b.text("shape")) {
        let white = |corner| Vertex { colors: [[0x3f80_0000; 4]; 2], ..corner };
        let vertices: Vec<Vertex> = corners(&shape[0]).into_iter().map(white).collect();
        let mut call = quads(VertexSource::Transformed(&vertices), &program, &constants, target);
        call.primitive = match shape[0].text("primitive") {
            "quads" => Primitive::QuadList,
            "triangles" => Primitive::TriangleList,
            other => panic!("primitive `{other}`"),
        };
        let columns: std::ops::RangeInclusive<u32> = shape[0].number("region_first")..=shape[0].number("region_last");
        call.scissor =
            Some(Region { x: *columns.start(), y: 0, width: columns.end() - columns.start() + 1, height: SIZE });
        machine.clear_target(target, [0; 4]).expect("cleared");
        machine.draw(&call).expect("drawn");
        let image = machine.read_back(target).expect("read back");
        let (mut expected, mut drawn) = (Vec::new(), Vec::new());
        for row in shape {
            let covered: std::ops::RangeInclusive<i64> = row.number("column_first")..=row.number("column_last");
            for y in row.number("row_first")..=row.number("row_last") {
                expected.extend(columns.clone().map(|x| *covered.start() >= 0 && covered.contains(&i64::from(x))));
                drawn.extend(columns.clone().map(|x| image.raw(0, 0, y, x) != 0));
            }
        }
        // The page shows a shape as the number of its pixels, in grey.
        let pixels = |covered: &[bool]| covered.iter().filter(|covered| **covered).count() as u8;
        values.add_grey(pixels(&expected), pixels(&drawn), expected == drawn);
    }
    values
}
