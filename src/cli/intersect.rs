//! `crossbar intersect`: first hits of your own rays on your own mesh.

use std::path::PathBuf;

use refsim::device::Profile;
use refsim::machine::Executor;

use super::executor::{Decider, GpuArgs};
use super::{Out, Problem, Verdict, view};
use crate::geom::Ray;
use crate::geom::classify::Candidate;
use crate::geom::exact::{Sides, nearest_all};
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
#[command(after_help = EXAMPLES)]
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
    let mesh = load_obj(&args.mesh)?;
    let rays = load_rays(&args.rays)?;
    let sides = Sides::from(args.sides);
    let hits: Vec<Candidate> = match Decider::choose(args.executor, args.device.as_deref()).open(&args.gpu)? {
        None => {
            let candidate = |h: crate::geom::NearestHit| Candidate { triangle: Some(h.triangle), t: h.t.to_f32() };
            nearest_all(&mesh, &rays, sides).into_iter().map(|h| h.map_or(NONE, candidate)).collect()
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
