//! Blending into 8-bit targets.

use super::draws::{COLUMNS, codes, color_program, colored, quads, rows};
use super::rule::{Hypotheses, Rule};
use super::table::{Row, table};
use super::values::Values;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{Executor, VertexSource};
use refsim::output::{BlendEquation, BlendFactor, BlendOp, BlendState};
use refsim::raster::Vertex;
use refsim::texture::TexelFormat;

pub(crate) fn rules() -> Vec<Rule> {
    vec![Rule {
        name: "Blending into 8 bits: the exact equation, rounded once",
        data: "nv2a/a_blend.csv",
        unit: "swatch",
        hypotheses: Hypotheses::Switch("target-rounding"),
        redraw,
        unexplained: 0,
        settled: true,
        open: "Signed sums and differences, which neither Direct3D nor OpenGL names; whether the factor zero removes its \
               term, which no 8-bit value shows.",
    }]
}

/// The state of a row: color blended in both areas, alpha only in the area "full".
fn state(row: &Row) -> BlendState {
    let op = match row.text("equation") {
        "ADD" => BlendOp::Add,
        "SUB" => BlendOp::Subtract,
        "REVSUB" => BlendOp::ReverseSubtract,
        "MIN" => BlendOp::Min,
        "MAX" => BlendOp::Max,
        other => panic!("equation `{other}`"),
    };
    let factor = |column: &str| match row.text(column) {
        "0" => BlendFactor::Zero,
        "1" => BlendFactor::One,
        "srcRGB" => BlendFactor::SrcColor,
        "1-srcRGB" => BlendFactor::InvSrcColor,
        "srcA" => BlendFactor::SrcAlpha,
        "1-srcA" => BlendFactor::InvSrcAlpha,
        "dstA" => BlendFactor::DestAlpha,
        "1-dstA" => BlendFactor::InvDestAlpha,
        "dstRGB" => BlendFactor::DestColor,
        "1-dstRGB" => BlendFactor::InvDestColor,
        "srcAsat" => BlendFactor::SrcAlphaSat,
        other => panic!("factor `{other}`"),
    };
    let color = BlendEquation { source: factor("source_factor"), destination: factor("destination_factor"), op };
    let replace = BlendState::both(BlendFactor::One, BlendFactor::Zero, BlendOp::Add).alpha;
    BlendState { color, alpha: if row.text("area") == "full" { color } else { replace } }
}

fn corners<'a>(rows: impl Iterator<Item = (usize, &'a Row)>, column: &str) -> Vec<Vertex> {
    rows.flat_map(|(i, row)| colored(i, row.hex(column).to_be_bytes())).collect()
}

/// Draws a cell per row: its background color, then its source blended over it.
fn redraw(profile: &Profile, executor: &Executor) -> Values {
    let rows_of_file = table("nv2a/a_blend.csv");
    let (program, constants) = (color_program(profile), Constants::default());
    let mut machine = executor.machine(profile.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(rows_of_file.len())).expect("a target");
    let ground = corners(rows_of_file.iter().enumerate(), "destination_rgba");
    machine.draw(&quads(VertexSource::Transformed(&ground), &program, &constants, target)).expect("drawn");
    let numbered: Vec<(usize, &Row)> = rows_of_file.iter().enumerate().collect();
    for alike in numbered.chunk_by(|(_, a), (_, b)| state(a) == state(b)) {
        let sources = corners(alike.iter().copied(), "source_rgba");
        let mut call = quads(VertexSource::Transformed(&sources), &program, &constants, target);
        call.blend = Some(state(alike[0].1));
        machine.draw(&call).expect("drawn");
    }
    let image = machine.read_back(target).expect("read back");
    let mut values = Values::default();
    for (i, row) in numbered {
        let drawn = codes(image, i);
        // The code within the measured bounds that is nearest to the drawn one.
        let nearest: [u8; 4] = std::array::from_fn(|channel| {
            let [low, high] = ["lo", "hi"].map(|end| format!("{}_{end}", ["r", "g", "b", "a"][channel]));
            let known = !row.text(&low).is_empty();
            if known { drawn[channel].clamp(row.number(&low), row.number(&high)) } else { drawn[channel] }
        });
        let [color, measured] = [drawn, nearest].map(|[r, g, b, _]| [r, g, b]);
        values.add(measured, color, drawn == nearest);
    }
    values
}
