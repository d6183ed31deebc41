//! `crossbar intersect`: first hits of your own rays on your own mesh.

use std::path::PathBuf;

use clap::ValueEnum;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::{Out, Verdict, view};
use crate::geom::Ray;
use crate::geom::exact::{Sides, nearest_all};
use crate::io::rays::{Hit, read_rays, write_hits};
use crate::io::obj::load_obj;
use crate::ray_engine::Crossbar;

const EXAMPLES: &str = "\
Examples:
  crossbar intersect --mesh teapot.obj --rays rays.csv --executor exact --out hits.csv
      decided in exact arithmetic on the f32 numbers of the files
  crossbar intersect --mesh teapot.obj --rays rays.csv --device r200 --executor batch --out hits.csv
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

    /// The card; `exact` arithmetic needs none
    #[arg(long, value_name = "D", default_value = "ideal-fp32")]
    device: String,

    /// Who decides
    #[arg(long, value_enum, default_value = "exact")]
    executor: Executor,

    /// Where the hits go
    #[arg(long, value_name = "H.csv")]
    out: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Executor {
    /// Exact arithmetic: the truth
    Exact,
    /// The emulated card, a fragment at a time
    Scalar,
    /// The emulated card, many fragments at once; the bits are those of scalar
    Batch,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    // The device is looked up even where exact arithmetic needs none, so that a wrong name is never passed over.
    let profile = Profile::named(&args.device)?;
    let mesh = load_obj(&args.mesh)?;
    let rays = read_rays(&args.rays)?;
    let sides = Sides::from(args.sides);
    let hits: Vec<Option<Hit>> = match args.executor {
        Executor::Exact => {
            let hit = |h: crate::geom::NearestHit| Hit { triangle: h.triangle, t: h.t.to_f32() };
            nearest_all(&mesh, &rays, sides).into_iter().map(|h| h.map(hit)).collect()
        }
        Executor::Scalar => on_card(profile, ExecutorKind::Scalar, &mesh, &rays, sides)?,
        Executor::Batch => on_card(profile, ExecutorKind::Batch, &mesh, &rays, sides)?,
    };
    write_hits(&args.out, &hits)?;
    let found = hits.iter().flatten().count();
    if out.json() {
        out.document(&serde_json::json!({ "rays": rays.len(), "hits": found, "out": args.out }))?;
    } else {
        out.line(format_args!("{found} of {} rays hit; written to {}", rays.len(), args.out.display()))?;
    }
    Ok(Verdict::Done)
}

fn on_card(
    profile: Profile,
    executor: ExecutorKind,
    mesh: &crate::geom::Mesh,
    rays: &[Ray],
    sides: Sides,
) -> miette::Result<Vec<Option<Hit>>> {
    let hits = Crossbar::new(profile, executor).intersect_list(mesh, rays, sides)?;
    Ok(hits.into_iter().map(|h| h.map(|h| Hit { triangle: h.triangle, t: h.t })).collect())
}
