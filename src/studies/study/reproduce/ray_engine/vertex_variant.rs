//! Section 3.4: 4.1 M ray-triangle tests per second in a vertex program.

use refsim::device::Profile;
use refsim::machine::{ExecutorKind, Machine};

use super::equation_11::MEGA;
use super::pipeline::{model, timed};
use super::{
    Dependence, EntryFindings, Method, RunResult, Shared, StudyError, figure, number, paper_row, paragraph,
    printed_value,
};
use crate::geom::teapot::teapot;
use crate::ray_engine::{RayBatch, VertexCrossbar};
use crate::report::{Cell, Table};
use crate::scene::Camera;

/// Cards of that time with vertex programs. The row uses the first, which dates from the year of the paper's text about
/// vertex programs; the others are readings.
const DEVICES: [&str; 3] = ["nv20", "nv25", "r200"];
/// Printed tests per second, in millions.
const PRINTED: &str = "ray-engine/vertex-tests";

const HOW: &str = "The paper's rejected alternative: constants hold a ray, and a triangle is three vertices that cover the ray's pixel if it is hit. \
    Our program (vertex_test.vsa) gives the results of the pixel pipelines with {} instructions and {} vertices per test. The paper names no card: \
    on {}, the printed figure would be {} clocks per test.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (mut rates, mut seen) = (Vec::new(), None);
    let mut table = Table::of(
        "Tests in the vertex units",
        "device M_tests_per_s instructions_per_vertex vertices_per_test clocks_per_vertex_and_unit vertex_units bound_by",
    );
    for device in DEVICES {
        let profile = Profile::named(device)?;
        let units = profile.rates.vertex_units;
        let mesh = teapot(4).on(device)?;
        let camera = Camera::teapot(2, 2).on(device)?;
        let rays = RayBatch::new(2, 2, camera.rays()).on(device)?;
        let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
        machine.record(true);
        VertexCrossbar::new(profile.clone(), ExecutorKind::Batch).intersect_on(&mut machine, &mesh, &rays)?;
        let drawn = timed(device, machine.take_log())?;
        let tests = mesh.len() as f64;
        let counts = &drawn.record.counts;
        let clocks =
            drawn.record.vertex.as_ref().map(|program| model(device).map(|m| m.vertex(program).0)).transpose()?;
        let rate = tests / drawn.cost.total.seconds() / MEGA;
        table.push([
            device.into(),
            Cell::measured(rate),
            (counts.vertex_instructions / counts.vertices.max(1)).into(),
            (counts.vertices / mesh.len() as u64).into(),
            clocks.into(),
            units.into(),
            drawn.cost.bottleneck.to_string().into(),
        ]);
        let printed_clocks =
            figure(&profile, "rates.core_clock_hz", profile.rates.core_clock_hz)? / (printed_value(PRINTED)? * MEGA);
        seen.get_or_insert([
            (counts.vertex_instructions / counts.vertices.max(1)).to_string(),
            (counts.vertices / mesh.len() as u64).to_string(),
            device.to_owned(),
            number(printed_clocks, 0),
        ]);
        rates.push(rate);
    }
    let [first, others @ ..] = &rates[..] else { return Ok(EntryFindings::default()) };
    let ours = (*first, Dependence::Predicted { from: "" });
    let row = paper_row(PRINTED, (DEVICES[0], Method::Pipeline), ours)?.with_readings(others.iter().copied());
    Ok(EntryFindings::new(
        [paragraph(HOW, seen.into_iter().flatten())],
        [row],
        ["the card, the length of the program, and whether a test was one vertex (a point) or three (a triangle)."],
        [table],
    ))
}
