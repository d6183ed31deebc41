//! Section 4.4: 114 M ray-triangle tests per second on a Radeon 8500.

use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::equation_11::MEGA;
use super::pipeline::{TimedDraw, model, timed};
use super::{
    Dependence, EntryFindings, Method, PaperRow, RunResult, Shared, StudyError, figure, number, paper_row, paragraph,
    printed_value,
};
use crate::geom::exact::Sides;
use crate::geom::teapot::teapot;
use crate::geom::{Mesh, Ray};
use crate::ray_engine::{Crossbar, RayBatch};
use crate::report::{Cell, Table};
use crate::scene::Camera;

const DEVICE: &str = "r200";
/// Side of the batch, in rays.
const SIDE: u32 = 256;
/// "Thousands of triangles" (section 6.1).
const TRIANGLES: usize = 2048;
/// Printed tests per second, in millions.
const PRINTED: &str = "ray-engine/radeon-8500";

const PAIRS: &str = "Thousands of triangles against {} x {} rays: read-back and vertices do not show, so the figure is the pixel \
    program's. R200 is taken to issue one pair of a colour and an alpha instruction a clock in each of its {} pipelines, and two texture \
    instructions beside it. No source gives the first rate; it was chosen because with it, and not with two a clock, our program comes near the printed \
    figure. So this row is a calibration, by a whole number; it has our program for rays of any origin, and the one for rays of one origin as \
    another reading. The printed figure is {} clocks of a pipeline a test.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (row, slots) = kernels()?;
    let profile = Profile::named(DEVICE)?;
    let rates = &profile.rates;
    let pipes = figure(&profile, "rates.pixel_pipes", rates.pixel_pipes)?;
    let clocks =
        pipes * figure(&profile, "rates.core_clock_hz", rates.core_clock_hz)? / (printed_value(PRINTED)? * MEGA);
    let side = || SIDE.to_string();
    Ok(EntryFindings::new(
        [paragraph(PAIRS, [side(), side(), number(pipes, 0), number(clocks, 2)])],
        [row],
        [
            "how long the authors' program was, and whether its rays shared an origin: it is not printed.",
            "at which rate the card issues pairs: no document that we found states it.",
        ],
        [slots],
    ))
}

fn kernels() -> Result<(PaperRow, Table), StudyError> {
    let mesh = mesh()?;
    let camera = Camera::teapot(SIDE, SIDE).on(DEVICE)?;
    let eye = camera.rays();
    // The same rays, each started a little further on, have no common origin any more.
    let moved = eye.iter().enumerate().map(|(i, ray)| moved(ray, 1e-3 * i as f32)).collect::<Result<Vec<_>, _>>()?;
    let mut rates = Vec::new();
    let mut slots = Table::of(
        "Slots and clocks of a test in one pipeline of four",
        "program phase pairs texture_slots M_tests_per_s bound_by",
    );
    for rays in [eye, moved] {
        let (kernel, drawn) = run(&mesh, rays)?;
        let rate = drawn.pixels_per_s() / MEGA;
        for (i, phase) in drawn.record.pixel.phases.iter().enumerate() {
            let pairs: u64 = phase.arithmetic.iter().map(|slot| u64::from(slot.slots) * slot.times).sum();
            let textures: u64 = phase.textures.iter().map(|slot| slot.times).sum();
            slots.push([kernel.into(), (i + 1).into(), pairs.into(), textures.into()]);
        }
        let clocks = model(DEVICE)?.fragment(&drawn.record.pixel);
        slots.push([
            kernel.into(),
            "clocks".into(),
            clocks.arithmetic.0.into(),
            clocks.textures.0.into(),
            Cell::measured(rate),
            drawn.cost.bottleneck.to_string().into(),
        ]);
        rates.push(rate);
    }
    let dependence = Dependence::Calibrated { on: "this figure, which chose one pair a clock for r200, not two" };
    let any_origin = rates.pop().unwrap_or(f64::NAN);
    let row = paper_row(PRINTED, (DEVICE, Method::Pipeline), (any_origin, dependence))?.with_readings(rates);
    Ok((row, slots))
}

fn run(mesh: &Mesh, rays: Vec<Ray>) -> Result<(&'static str, TimedDraw), StudyError> {
    let rays = RayBatch::new(SIDE, SIDE, rays).on(DEVICE)?;
    let card = Crossbar::new(Profile::named(DEVICE)?, ExecutorKind::Batch).all_pairs(true);
    let answer = card.intersect_recorded(mesh, &rays, Sides::Front)?;
    Ok((answer.kernel, timed(DEVICE, answer.log)?))
}

/// Builds a part of the teapot.
fn mesh() -> Result<Mesh, StudyError> {
    let whole = teapot(8).on(DEVICE)?;
    let triangles = whole.triangles().iter().take(TRIANGLES).copied().collect();
    Mesh::new(whole.positions().to_vec(), triangles).on(DEVICE)
}

fn moved(ray: &Ray, by: f32) -> Result<Ray, StudyError> {
    let (o, d) = (ray.origin(), ray.direction());
    Ray::new([o[0] + by * d[0], o[1] + by * d[1], o[2] + by * d[2]], d).on(DEVICE)
}
