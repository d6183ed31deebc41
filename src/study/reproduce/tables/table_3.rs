//! Table 3: the teapot room with and without card, asynchronous read-back, an infinitely fast card.

use super::super::pipeline::failed;
use super::super::{Findings, ReproduceError};
use super::engine_run::{TIMES, rays_per_s};
use super::{HOW, Line, TeapotRoom, commands, host_work, lines, parameters, rows, sensitivity};
use crate::ray_engine::engine::{EngineParameters, Readback};

/// Passes in flight in the asynchronous run.
const IN_FLIGHT: usize = 4;

pub(in super::super) fn findings() -> Result<Findings, ReproduceError> {
    let room = TeapotRoom::new()?;
    let line =
        |what: &str, printed, readback| (what.to_owned(), printed, EngineParameters { readback, ..parameters() });
    let wanted = vec![
        line("plus card", 165_098.0, Readback::Synchronous),
        line("asynchronous read-back", 183_273.0, Readback::Asynchronous { passes: IN_FLIGHT }),
        line("infinitely fast card", 234_102.0, Readback::InfinitelyFast),
    ];
    let lines: [Line; 3] = lines(&room, wanted)?.try_into().map_err(|_| failed(TIMES)(&"three lines"))?;
    let (rows, table) = rows(&room, &lines, "Table 3")?;
    let guesses = sensitivity::table(&room.work.alone, &lines)?;
    Ok(Findings {
        text: vec![HOW.to_owned(), passes(&lines, &room)?],
        rows,
        tables: vec![table, host_work::table(&room, &lines), guesses],
        charts: Vec::new(),
    })
}

/// What the printed figures and ours leave for a pass.
fn passes(lines: &[Line; 3], room: &TeapotRoom) -> Result<String, ReproduceError> {
    let us = |rays_per_s: f64| 1e6 / rays_per_s;
    let ours: Vec<f64> = lines
        .iter()
        .map(|line| Ok(us(rays_per_s(&line.run, &room.host, commands())?)))
        .collect::<Result<_, ReproduceError>>()?;
    let printed: Vec<f64> = lines.iter().map(|line| us(line.printed)).collect();
    let counts = &lines[0].run.counts;
    let a_pass = counts.rays as f64 / counts.passes as f64;
    let of = |t: &[f64]| [(t[0] - t[2]) * a_pass, (t[0] - t[1]) * a_pass];
    let ([printed_all, printed_wait], [our_all, our_wait]) = (of(&printed), of(&ours));
    Ok(format!(
        "A pass takes {:.1} of our rays, each of which meets the card {:.1} times. By this count the printed figures leave {printed_all:.0} us for a \
         pass, {printed_wait:.0} us of which asynchronous read-back saves; ours are {our_all:.0} us and {our_wait:.0} us.",
        counts.pass_rays as f64 / counts.passes as f64,
        counts.pass_rays as f64 / counts.rays as f64,
    ))
}
