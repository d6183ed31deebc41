//! Measures the table of docs/performance.md. On a shared machine, the fastest of many short runs is more reliable than
//! a median of long ones. So rays are traced in small parts, by each tracer in turn, repeatedly; the fastest times of
//! each tracer are summed over the parts.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use std::{fs, io};

use crossbar::geom::Ray;

use crate::rooms::Room;
use crate::tracers::{self, Tracer};
use crate::{KINDS, Kind, THREADS, rooms};

const BEGIN: &str = "<!-- host rays: begin -->";
const END: &str = "<!-- host rays: end -->";
/// Rays per timed part: less than a millisecond, because longer runs are more often interrupted, which penalises slower
/// tracers.
const PART: usize = 1024;
/// Number of repetitions per part.
const ROUNDS: usize = 9;

/// Measures, and writes the figures into the document.
pub(crate) fn write() -> io::Result<()> {
    let mut out = String::from(
        "Millions of rays a second.\n\n\
         | scene, rays, threads | octree | best of `bvh` | octree / it | best of `obvhs` | octree / it |\n|---|---|---|---|---|---|\n",
    );
    for room in rooms::all() {
        let tracers = tracers::all(&room.mesh);
        tracers::compare(&tracers, &room);
        for kind in KINDS {
            for threads in THREADS {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(io::Error::other)?;
                let figures = pool.install(|| measure(&tracers, &room, kind));
                let _: Result<(), std::fmt::Error> =
                    writeln!(out, "| {}, {}, {threads} {}", room.name, kind.0, line(&figures));
            }
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/performance.md");
    let text = fs::read_to_string(&path)?;
    let missing = || io::Error::other(format!("{}: expected `{BEGIN}` and `{END}`", path.display()));
    let (before, rest) = text.split_once(BEGIN).ok_or_else(missing)?;
    let (_, after) = rest.split_once(END).ok_or_else(missing)?;
    fs::write(&path, format!("{before}{BEGIN}\n{out}{END}{after}"))
}

/// Millions of rays per second of each tracer.
fn measure(tracers: &[(&'static str, Box<dyn Tracer>)], room: &Room, kind: Kind) -> Vec<(&'static str, f64)> {
    let (_, rays, trace) = kind;
    let rays: &[Ray] = rays(room);
    let mut seconds = vec![0.0; tracers.len()];
    for part in rays.chunks(PART) {
        let mut quickest = vec![f64::INFINITY; tracers.len()];
        for _ in 0..ROUNDS {
            for ((_, tracer), quickest) in tracers.iter().zip(&mut quickest) {
                let start = Instant::now();
                black_box(trace(tracer.as_ref(), black_box(part)));
                *quickest = quickest.min(start.elapsed().as_secs_f64());
            }
        }
        seconds.iter_mut().zip(quickest).for_each(|(sum, time)| *sum += time);
    }
    tracers.iter().zip(seconds).map(|((who, _), seconds)| (*who, rays.len() as f64 / seconds / 1e6)).collect()
}

/// Our figure, and the fastest traversal of each crate.
fn line(figures: &[(&'static str, f64)]) -> String {
    let ours = figures[0].1;
    let mut line = format!("| {ours:.2} |");
    for of in ["bvh: ", "obvhs: "] {
        let ways = figures.iter().filter_map(|(who, figure)| Some((who.strip_prefix(of)?, *figure)));
        if let Some((way, best)) = ways.max_by(|a, b| a.1.total_cmp(&b.1)) {
            let _: Result<(), std::fmt::Error> = write!(line, " {best:.2} ({way}) | {:.2} |", ours / best);
        }
    }
    line
}
