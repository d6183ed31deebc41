//! Section 4.4: 114 M ray-triangle tests per second on a Radeon 8500.

use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::equation_11::MEGA;
use super::pipeline::timed;
use super::{
    Dependence, EntryFindings, Method, PaperRow, RunResult, Shared, StudyError, TimedWork, figure, paper_row,
    paragraph, printed_value,
};
use crate::geom::exact::{Sides, Tracer};
use crate::geom::teapot::teapot;
use crate::geom::{Mesh, Ray};
use crate::ray_engine::{Crossbar, RayBatch, Recording};
use crate::report::{Cell, Table};
use crate::scene::Camera;
use crate::study::leaky_teapot::JudgedRays;

const DEVICE: &str = "r200";
/// Side of the batch in rays, and side of the batch whose leaks are counted.
const SIDE: u32 = 128;
const LEAK_SIDE: u32 = 96;
/// "Thousands of triangles" (section 6.1).
const TRIANGLES: usize = 2048;
/// Printed tests per second, in millions.
const PRINTED: &str = "ray-engine/radeon-8500";
const PAIRS: &str = "Thousands of triangles are tested against {} x {} rays, so the pixel program determines the rate. We assume that R200 issues \
    one pair of a colour and an alpha instruction per clock in each of its {} pipelines; no source states this rate. With it, and not with two pairs \
    per clock, our program comes near the printed figure, which is {} pipeline clocks per test. The row uses our program for rays of any origin in \
    the two textures of section 4.1; the program for rays of one origin is another reading. Rays stored as bytes are coarser, but the cracks between \
    triangles do not grow: the programs for bytes and for 16 bits lose about equally many of the same {} rays, rounded to bytes.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (rows, tables) = kernels()?;
    let profile = Profile::named(DEVICE)?;
    let rates = &profile.rates;
    let pipes = figure(&profile, "rates.pixel_pipes", rates.pixel_pipes)?;
    let clocks =
        pipes * figure(&profile, "rates.core_clock_hz", rates.core_clock_hz)? / (printed_value(PRINTED)? * MEGA);
    Ok(EntryFindings::new(
        [paragraph(PAIRS, &[&SIDE, &SIDE, &pipes, &(clocks, 2), &LEAK_SIDE.pow(2)])],
        rows,
        [
            "the length of the authors' program, and whether its rays shared an origin.",
            "the rate at which the card issues pairs: we found no document that states it.",
        ],
        tables,
    ))
}

fn kernels() -> Result<([PaperRow; 2], [Table; 1]), StudyError> {
    let mesh = mesh(TRIANGLES)?;
    let card = Crossbar::new(Profile::named(DEVICE)?, ExecutorKind::Batch).all_pairs(true);
    let rate = |card: &Crossbar, rays: &RayBatch| {
        let drawn = timed(DEVICE, card.intersect_recorded(&mesh, rays, Sides::Front, Recording::default())?.log)?;
        Ok::<_, StudyError>(drawn.pixels_per_s() / MEGA)
    };
    let (in_bytes, one_origin) = (rate(&card.clone().byte_rays(), &moved_rays(SIDE)?)?, rate(&card, &eye_rays(SIDE)?)?);
    let on = "this figure, which determined that r200 issues one pair per clock, not two";
    let row = |id, over| {
        let ours = (in_bytes / over, Dependence::Calibrated { on });
        Ok::<_, StudyError>(paper_row(id, (DEVICE, Method::Pipeline), ours)?.with_readings([one_origin / over]))
    };
    let rows = [row(PRINTED, 1.0)?, row("ray-engine/over-doubled-host", 2.0 * printed_value("ray-engine/host-most")?)?];
    Ok((rows, [leaks(&mesh)?]))
}

/// Table of leaks by the precision of the ray textures and the card's rounding, for rays that bytes represent exactly.
fn leaks(mesh: &Mesh) -> Result<Table, StudyError> {
    let mut table = Table::of("Leaks of 8-bit rays", "rounding rays_that_hit leaks_from_bytes leaks_from_16_bits");
    for rounding in ["rdn", "rne"] {
        let mut profile = Profile::named(DEVICE)?;
        profile.set_switch("rounding", rounding).on(DEVICE)?;
        let card = Crossbar::new(profile, ExecutorKind::Batch);
        let rays = card.rays_in_bytes(mesh, &moved_rays(LEAK_SIDE)?)?;
        let judged = JudgedRays::new(&Tracer::new(mesh), rays.rays().to_vec(), Sides::Front);
        let mut tallies = Vec::new();
        for card in [card.clone().byte_rays(), card] {
            tallies.push(judged.judge(mesh, &card.intersect(mesh, &rays, Sides::Front)?.hits).1);
        }
        let leaks = tallies.iter().map(|tally| Cell::from(tally.leaks));
        table.push([rounding.into(), tallies[0].surface.into()].into_iter().chain(leaks));
    }
    Ok(table)
}

/// Times of intersections by each card's program for rays of any origin: the first card has two byte textures, the
/// others have float textures.
pub(in crate::study::reproduce) fn timed_tests() -> Result<Vec<TimedWork>, StudyError> {
    let (mesh, rays) = (mesh(TRIANGLES)?, moved_rays(SIDE)?);
    let on = |device| {
        let card = Crossbar::new(Profile::named(device)?, ExecutorKind::Batch).all_pairs(true);
        let card = if device == DEVICE { card.byte_rays() } else { card };
        let drawn = timed(device, card.intersect_recorded(&mesh, &rays, Sides::Front, Recording::default())?.log)?;
        let items = drawn.record.counts.fragments.generated;
        Ok(TimedWork { items, ..TimedWork::new(PRINTED, device, drawn.cost.total)? })
    };
    [DEVICE, "r300", "nv35"].into_iter().map(on).collect()
}

fn eye_rays(side: u32) -> Result<RayBatch, StudyError> {
    RayBatch::new(side, side, Camera::teapot(side, side).on(DEVICE)?.rays()).on(DEVICE)
}

/// Eye rays with origins moved along them by different amounts, so that they have no common origin.
pub(super) fn moved_rays(side: u32) -> Result<RayBatch, StudyError> {
    let eye = eye_rays(side)?;
    let moved = eye.rays().iter().enumerate().map(|(i, ray)| moved(ray, 1e-3 * (i % 64) as f32));
    RayBatch::new(side, side, moved.collect::<Result<_, _>>()?).on(DEVICE)
}

/// Builds a part of the teapot.
pub(super) fn mesh(triangles: usize) -> Result<Mesh, StudyError> {
    let whole = teapot(8).on(DEVICE)?;
    let triangles = whole.triangles().iter().take(triangles).copied().collect();
    Mesh::new(whole.positions().to_vec(), triangles).on(DEVICE)
}

fn moved(ray: &Ray, by: f32) -> Result<Ray, StudyError> {
    let (o, d) = (ray.origin(), ray.direction());
    Ray::new([o[0] + by * d[0], o[1] + by * d[1], o[2] + by * d[2]], d).on(DEVICE)
}
