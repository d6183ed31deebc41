//! Section 3.4: 4.1 M ray-triangle tests a second in a vertex program.

use refsim::device::Profile;
use refsim::machine::{ExecutorKind, Machine};

use super::equation_11::MEGA;
use super::pipeline::{failed, model, timed};
use super::{Findings, Modelled, Printed, ReproduceError, Row};
use crate::geom::teapot::teapot;
use crate::ray_engine::{RayBatch, VertexCrossbar};
use crate::report::Table;
use crate::scene::Camera;

/// The cards of the day with vertex programs.
const DEVICES: [&str; 3] = ["nv20", "nv25", "r200"];
const NOTE: &str = "The paper names neither the card nor the program, nor whether a test is one vertex (a point) or three (a triangle). \
    At three a test our program is 24 % slower than printed on a GeForce3, and more than twice as fast on cards with two vertex units. To know \
    more one would need the card and the length of the program: 4.1 M/s are 49 clocks of a GeForce3 a test.";

pub(super) fn findings() -> Result<Findings, ReproduceError> {
    let mut rows = Vec::new();
    let mut table = Table::new(
        "A test in the vertex units",
        &[
            "device",
            "instructions_per_vertex",
            "vertices_per_test",
            "clocks_per_vertex_and_unit",
            "vertex_units",
            "bound_by",
        ],
    );
    for device in DEVICES {
        let fail = failed(device);
        let profile = Profile::named(device)?;
        let units = profile.rates.vertex_units;
        let mesh = teapot(4).map_err(|e| fail(&e))?;
        let camera = Camera::teapot(2, 2).map_err(|e| fail(&e))?;
        let rays = RayBatch::new(2, 2, camera.rays()).map_err(|e| fail(&e))?;
        let mut machine = Machine::new(profile.clone(), ExecutorKind::Batch);
        machine.record(true);
        VertexCrossbar::new(profile, ExecutorKind::Batch).intersect_on(&mut machine, &mesh, &rays)?;
        let drawn = timed(device, machine.take_log())?;
        let tests = mesh.len() as f64;
        let counts = &drawn.record.counts;
        let clocks =
            drawn.record.vertex.as_ref().map(|program| model(device).map(|m| m.vertex(program).0)).transpose()?;
        table.push([
            device.into(),
            (counts.vertex_instructions / counts.vertices.max(1)).into(),
            (counts.vertices / mesh.len() as u64).into(),
            clocks.into(),
            units.into(),
            format!("{:?}", drawn.cost.bottleneck).to_lowercase().into(),
        ]);
        rows.push(Row {
            what: "tests in the vertex units".to_owned(),
            device,
            printed: Printed { value: 4.1, decimals: 1, unit: "M/s", place: "section 3.4" },
            rates: None,
            pipeline: Modelled::predicted(tests / drawn.cost.total.seconds() / MEGA),
            note: NOTE.to_owned(),
        });
    }
    Ok(Findings {
        text: vec![
            "The road not taken: a ray as constants, a triangle as three vertices that cover the ray's pixel where it is hit. Our \
             program for it (vertex_test.vsa) runs, finds what the pixel pipelines find, and has 20 instructions."
                .to_owned(),
        ],
        rows,
        tables: vec![table],
        charts: Vec::new(),
    })
}
