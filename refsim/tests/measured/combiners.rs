//! Arithmetic of the combiners: the unit of registers, and the rounding of results.

use super::draws::{COLUMNS, cell, codes, quads, rows};
use super::rule::{Hypotheses, Rule};
use super::running::{bits, checked, constants};
use super::table::{Row, table};
use super::values::Values;
use refsim::device::Profile;
use refsim::machine::{Executor, VertexSource};
use refsim::raster::Vertex;
use refsim::texture::TexelFormat;

const LERPS: &str = "nv2a/b_lerp.csv";
const OPERATIONS: &str = "nv2a/b_combiner_ops.csv";

pub(crate) fn rules() -> Vec<Rule> {
    let rule = Rule {
        name: "Unit of registers: products are the nearest of a*b/255",
        data: LERPS,
        unit: "color",
        hypotheses: Hypotheses::Switch("registers"),
        redraw: lerps,
        unexplained: 0,
        settled: true,
        open: "Products of the general combiners, which these pictures have by 0 and 1 only: the final combiner's are taken \
               for theirs. Signs: nothing negative reaches a picture. Dot products, and operands expanded, halved or negated.",
    };
    vec![
        rule.clone(),
        Rule {
            name: "Rounding: output scale and bias, sums, products",
            data: "nv2a/b_{combiner_ops,lerp}.csv",
            unit: "color",
            hypotheses: Hypotheses::Switch("rounding"),
            redraw: |device, executor| {
                let mut values = operations(device, executor);
                values.0.extend(lerps(device, executor).0);
                values
            },
            open: "Halves below zero. Those above go up, which only a division by 2 and the bias of one half tell.",
            ..rule.clone()
        },
        Rule {
            name: "Steps of a lerp",
            hypotheses: Hypotheses::Switch("lrp"),
            settled: false,
            open: "Whether a*b + c*d is rounded once or twice: in every picture one of the products is a whole code, so that \
                   all ways agree.",
            ..rule
        },
    ]
}

/// The corners of cell `index` with two grey colors, as codes.
fn grey(index: usize, [first, second]: [u8; 2]) -> [Vertex; 4] {
    let colors = [first, second].map(|code| bits([f32::from(code) / 255.0; 4]));
    cell(index).map(|corner| Vertex { colors, ..corner })
}

/// Draws one cell per entry of `cells`: a program body, grey colors v0 and v1, and a grey constant c0; returns the
/// colors of the cells.
fn shown(device: &Profile, executor: &Executor, cells: &[(String, [u8; 2], u8)]) -> Vec<u8> {
    let mut machine = executor.machine(device.clone()).expect("a machine");
    let target = machine.create_target(TexelFormat::Bgra8, COLUMNS, rows(cells.len())).expect("a target");
    let mut order: Vec<usize> = (0..cells.len()).collect();
    order.sort_by_key(|&i| (&cells[i].0, cells[i].2));
    for alike in order.chunk_by(|&i, &j| (&cells[i].0, cells[i].2) == (&cells[j].0, cells[j].2)) {
        let (text, _, constant) = &cells[alike[0]];
        let (program, constants) = (checked(text, device), constants(&[[f32::from(*constant) / 255.0; 4]]));
        let corners: Vec<Vertex> = alike.iter().flat_map(|&i| grey(i, cells[i].1)).collect();
        machine.draw(&quads(VertexSource::Transformed(&corners), &program, &constants, target)).expect("drawn");
    }
    let image = machine.read_back(target).expect("read back");
    (0..cells.len())
        .map(|i| {
            let [r, g, b, _] = codes(image, i);
            assert_eq!((r, g), (b, b), "grey");
            r
        })
        .collect()
}

/// `a*b + (1 - a)*c`. A row lists all factors within one code of the picture's factor; one of them must give the
/// measured color.
fn lerps(device: &Profile, executor: &Executor) -> Values {
    let rows = table(LERPS);
    let factors = |row: &Row| -> Vec<u8> { row.text("a").split(';').map(|a| a.parse().expect("a code")).collect() };
    let lerp = "ps_1_1\nlrp r0, v0, v1, c0".to_owned();
    let cells: Vec<(String, [u8; 2], u8)> = rows
        .iter()
        .flat_map(|row| factors(row).into_iter().map(|a| (lerp.clone(), [a, row.number("b")], row.number("c"))))
        .collect();
    let mut found = shown(device, executor, &cells).into_iter();
    let mut values = Values::default();
    for row in &rows {
        let measured: u8 = row.number("out8");
        let codes = found.by_ref().take(factors(row).len());
        values.add_code(measured, codes.min_by_key(|code| code.abs_diff(measured)).expect("a factor"));
    }
    values
}

/// Single operations of a combiner, each as an assembly instruction.
fn operations(device: &Profile, executor: &Executor) -> Values {
    let rows = table(OPERATIONS);
    let body = |row: &Row| match row.text("operation") {
        "identity" => "mov r0, v0",
        "bias" => "mov r0, v0_bias",
        "bias_x2" => "mov r0, v0_bx2",
        "x2" => "mov_x2 r0, v0",
        "x4" => "mov_x4 r0, v0",
        "d2" => "mov_d2 r0, v0",
        "a*b" => "mul r0, v0, v1",
        "a+b" => "add r0, v0, v1",
        "a+(1-b)" => "add r0, v0, 1-v1",
        "(1-a)+b" => "add r0, 1-v0, v1",
        "(a+b)*c clamped sum" => "add r0, v0, v1\nmul r0, r0, c0",
        other => panic!("operation `{other}`"),
    };
    let code = |row: &Row, column| if row.text(column).is_empty() { 0 } else { row.number(column) };
    let cells: Vec<(String, [u8; 2], u8)> = rows
        .iter()
        .map(|row| (format!("ps_1_1\n{}", body(row)), [code(row, "a"), code(row, "b")], code(row, "c")))
        .collect();
    let mut values = Values::default();
    for (row, found) in rows.iter().zip(shown(device, executor, &cells)) {
        values.add_code(row.number("out8"), found);
    }
    values
}
