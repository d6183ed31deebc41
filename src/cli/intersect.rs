//! `crossbar intersect`: first hits of your own rays on your own mesh.

use std::fs::File;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};

use refsim::device::Profile;
use refsim::machine::Executor;

use super::executor::{Decider, GpuArgs};
use super::{Out, Problem, Verdict, memory, view};
use crate::geom::Ray;
use crate::geom::classify::Candidate;
use crate::geom::exact::Sides;
use crate::io::atomic::write_file;
use crate::io::obj::load_obj;
use crate::io::rays::{load_rays, write_hits};
use crate::ray_engine::Crossbar;

const EXAMPLES: &str = "\
Examples:
  crossbar intersect --mesh teapot.obj --rays rays.csv --executor exact --out hits.csv
      decided in exact arithmetic on the f32 numbers of the files
  crossbar intersect --mesh teapot.obj --rays rays.csv --device r200 --out hits.csv
      what a Radeon 8500 would have said

Rays: CSV with the header ox,oy,oz,dx,dy,dz; directions are not renormalised. Hits: CSV with the header ray,triangle,t, a line
a ray; triangle counts from 0 in the order of the mesh file, -1 where nothing is hit (t is then inf); t is in multiples of
the ray's direction, written so that it reads back to the same f32.";

/// First hits of the rays of a CSV file on the triangles of an OBJ file
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The mesh, a Wavefront OBJ file
    #[arg(long, value_name = "M.obj")]
    mesh: PathBuf,

    /// The rays, a CSV file
    #[arg(long, value_name = "R.csv")]
    rays: PathBuf,

    /// Which faces can be hit
    #[arg(long, value_enum, default_value = "front")]
    sides: view::SidesArg,

    /// The card; `exact` arithmetic needs none [default: ideal-fp32]
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// Who decides [default: batch where a device is named, else exact]
    #[arg(long, value_enum)]
    executor: Option<Decider>,

    #[command(flatten)]
    gpu: GpuArgs,

    /// Where the hits go
    #[arg(long, value_name = "H.csv")]
    out: PathBuf,
}

/// No hit.
const NONE: Candidate = Candidate { triangle: None, t: f32::INFINITY };

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    // The device is looked up even where exact arithmetic needs none, so that a wrong name is never passed over.
    let profile = Profile::named(args.device.as_deref().unwrap_or(view::DEFAULT_DEVICE))?;
    view::require_mesh(&args.mesh)?;
    let mesh = load_obj(&args.mesh)?;
    require_rays(&args.rays)?;
    let rays = load_rays(&args.rays)?;
    let sides = Sides::from(args.sides);
    let hits: Vec<Candidate> = match Decider::choose(args.executor, args.device.as_deref()).open(&args.gpu)? {
        None => {
            let candidate = |(triangle, t)| Candidate { triangle: Some(triangle), t };
            view::exact_hits(&mesh, &rays, sides).into_iter().map(|h| h.map_or(NONE, candidate)).collect()
        }
        Some(executor) => on_card(profile, executor, &mesh, &rays, sides)?,
    };
    write_file(&args.out, |out| write_hits(&hits, out)).map_err(Problem::from)?;
    let found = hits.iter().filter(|h| h.triangle.is_some()).count();
    if out.json() {
        out.document(&serde_json::json!({ "rays": rays.len(), "hits": found, "out": args.out }))?;
    } else {
        out.line(format_args!("{found} of {} rays hit; written to {}", rays.len(), args.out.display()))?;
    }
    Ok(Verdict::Done)
}

/// What the rays of a file and their hits take. A pipe cannot be asked how many it holds.
fn require_rays(path: &Path) -> Result<(), Problem> {
    const PER_RAY: u64 = 90;
    let Ok(file) = File::open(path) else { return Ok(()) };
    if !file.metadata().is_ok_and(|kind| kind.is_file()) {
        return Ok(());
    }
    let mut lines = 0_u64;
    let mut text = BufReader::with_capacity(1 << 16, file);
    while let Ok(some) = text.fill_buf()
        && !some.is_empty()
    {
        let length = some.len();
        lines += some.iter().filter(|&&byte| byte == b'\n').count() as u64;
        text.consume(length);
    }
    memory::require(format_args!("{lines} rays"), lines.saturating_mul(PER_RAY), "share the rays out to several files")
}

fn on_card(
    profile: Profile,
    executor: Executor,
    mesh: &crate::geom::Mesh,
    rays: &[Ray],
    sides: Sides,
) -> miette::Result<Vec<Candidate>> {
    let hits = Crossbar::new(profile, executor).intersect_list(mesh, rays, sides)?;
    Ok(hits.into_iter().map(|h| h.map_or(NONE, |h| Candidate { triangle: Some(h.triangle), t: h.t })).collect())
}
