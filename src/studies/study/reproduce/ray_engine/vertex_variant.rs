//! Section 3.4: 4.1 M ray-triangle tests per second in a vertex program.

use refsim::device::Profile;
use refsim::machine::{ExecutorKind, Machine};

use super::equation_11::MEGA;
use super::pipeline::{model, timed};
use super::{EntryFindings, RunResult, Shared, StudyError, drawn, figure, paragraph, printed_value};
use crate::geom::teapot::teapot;
use crate::ray_engine::{RayBatch, intersect_in_vertices};
use crate::report::{Cell, Table};
use crate::scene::Camera;

/// Cards of that time with vertex programs. The row uses the first, which dates from the year of the paper's text about
/// vertex programs; the others are readings.
const DEVICES: [&str; 3] = ["nv20", "nv25", "r200"];
/// Printed tests per second, in millions.
const PRINTED: &str = "ray-engine/vertex-tests";
const HOW: &str = "The paper describes this alternative, but rejects it: constants hold a ray, and a triangle is three vertices, which cover the \
    ray's pixel if the ray hits. Our program (vertex_test.vsa) gives the results of the pixel programs with {} instructions per vertex and {} \
    vertices per test. The paper does not say which card it means: on {}, the printed figure would be {} clocks per test.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (mut rates, mut how) = (Vec::new(), String::new());
    let mut table = Table::of(
        "Tests in the vertex units",
        "device M_tests_per_s instructions_per_vertex vertices_per_test clocks_per_vertex_and_unit vertex_units bound_by",
    );
    for device in DEVICES {
        let profile = Profile::named(device)?;
        let mesh = teapot(4).on(device)?;
        let rays = RayBatch::new(2, 2, Camera::teapot(2, 2).on(device)?.rays()).on(device)?;
        let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
        machine.record(true);
        intersect_in_vertices(&mut machine, &mesh, &rays)?;
        let drawn = timed(device, machine.take_log())?;
        let counts = &drawn.record.counts;
        let instructions = counts.vertex_instructions / counts.vertices.max(1);
        let vertices = counts.vertices / mesh.len() as u64;
        let program = drawn.record.vertex.as_ref();
        let clocks = program.map(|program| model(device).map(|model| model.vertex(program).0)).transpose()?;
        let rate = mesh.len() as f64 / drawn.cost.total.seconds() / MEGA;
        table.push([
            device.into(),
            Cell::measured(rate),
            instructions.into(),
            vertices.into(),
            clocks.into(),
            profile.rates.vertex_units.into(),
            drawn.cost.bottleneck.to_string().into(),
        ]);
        if device == DEVICES[0] {
            let hz = figure(&profile, "rates.core_clock_hz", profile.rates.core_clock_hz)?;
            let clocks = hz / (printed_value(PRINTED)? * MEGA);
            how = paragraph(HOW, &[&instructions, &vertices, &device, &clocks]);
        }
        rates.push(rate);
    }
    let row = drawn(PRINTED, DEVICES[0], rates[0])?.with_readings(rates[1..].iter().copied());
    Ok(EntryFindings::new(
        [how],
        [row],
        ["the card, the length of the program, and whether a test was one vertex (a point) or three (a triangle)."],
        [table],
    ))
}
