//! Interpolated depths in integer buffers.

use super::draws::{at, color_program, quads};
use super::rule::{Hypotheses, Rule};
use super::table::{Row, table};
use super::values::Values;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{Executor, VertexSource};
use refsim::output::{CompareFunction, DepthFormat, DepthState};
use refsim::raster::{Primitive, Vertex};
use refsim::texture::TexelFormat;

const FILE: &str = "nv2a/a_depth.csv";

pub(crate) fn rules() -> Vec<Rule> {
    let truncation = Rule {
        name: "Interpolated depths are truncated into 16 and 24 bits",
        data: FILE,
        unit: "pixel",
        hypotheses: Hypotheses::Switch("depth-rounding"),
        redraw: |profile, executor| redraw(profile, executor, |row| is_flat(row) && is_between_codes(row)),
        unexplained: 0,
        settled: true,
        open: "",
    };
    let plane = Rule {
        name: "The plane of a depth: within 1/50 of a whole code, and on quads whose depths exceed 24-bit floats",
        redraw: |profile, executor| redraw(profile, executor, |row| !(is_flat(row) && is_between_codes(row))),
        settled: false,
        open: "How the card computes the plane. It truncates one that is up to 0.13 of a code too high at 1.6e7, and \
               stores some whole codes one lower; ours is computed in single precision.",
        ..truncation.clone()
    };
    vec![truncation, plane]
}

/// `true` for shapes whose depths are small enough for single precision to be accurate.
fn is_flat(row: &Row) -> bool {
    row.text("shape").starts_with("Tri")
}

/// `true` if the exact depth is far enough from a code that the error of the plane cannot change the result.
fn is_between_codes(row: &Row) -> bool {
    let exact: f64 = row.number("exact_plane");
    (0.02..=0.98).contains(&exact.fract())
}

/// Draws the triangles of each shape into each buffer and compares the rows for which `choose` returns `true`.
fn redraw(profile: &Profile, executor: &Executor, choose: fn(&Row) -> bool) -> Values {
    let (program, constants) = (color_program(profile), Constants::default());
    let shapes = table("nv2a/a_depth_shapes.csv");
    let mut values = Values::default();
    let same = |a: &Row, b: &Row| a.text("buffer") == b.text("buffer") && a.text("shape") == b.text("shape");
    for rows in table(FILE).chunk_by(same) {
        let (format, steps) = match rows[0].text("buffer") {
            "ZBuf16D" => (DepthFormat::Unorm16, 65_535.0),
            "ZBuf24D" => (DepthFormat::Unorm24, 16_777_215.0),
            other => panic!("buffer `{other}`"),
        };
        let corner = |row: &Row, i: usize| {
            let number = |name: &str| row.number::<f64>(&format!("{name}{i}"));
            at([number("x") as f32, number("y") as f32], (number("z") / steps) as f32)
        };
        let shape = shapes.iter().filter(|shape| shape.text("shape") == rows[0].text("shape"));
        let vertices: Vec<Vertex> = shape.flat_map(|row| [0, 1, 2].map(|i| corner(row, i))).collect();
        let mut machine = executor.machine(profile.clone()).expect("a machine");
        let target = machine.create_target(TexelFormat::Bgra8, 640, 512).expect("a target");
        let buffer = machine.create_depth(format, 640, 512).expect("a depth buffer");
        machine.clear_depth(buffer, 0x3f80_0000).expect("cleared");
        let mut call = quads(VertexSource::Transformed(&vertices), &program, &constants, target);
        call.primitive = Primitive::TriangleList;
        call.depth = DepthState { test: Some(CompareFunction::LessEqual), write: true };
        call.depth_buffer = Some(buffer);
        machine.draw(&call).expect("drawn");
        let depths = machine.read_depth(buffer).expect("read back").data();
        for row in rows.iter().filter(|row| choose(row)) {
            let [x, y] = ["column", "row"].map(|name| row.number::<usize>(name));
            let (measured, drawn): (u32, u32) = (row.number("stored_code"), depths[y * 640 + x]);
            // The page shows the low byte of each code.
            values.add_grey(measured as u8, drawn as u8, measured == drawn);
        }
    }
    values
}
