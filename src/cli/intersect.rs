//! `crossbar intersect`: first hits of the user's rays on the user's mesh.

use std::io::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use miette::IntoDiagnostic as _;
use refsim::device::Profile;
use refsim::machine::Executor;
use serde_json::json;

use super::executor::{Decider, engine_executor};
use super::words::counted;
use super::{Out, Problem, Verdict, given, model_file, study, view};
use crate::case::device_named;
use crate::geom::exact::{ExactT, Sides, Tracer};
use crate::geom::vector::wide;
use crate::geom::{Hit, Mesh, Ray};
use crate::io::rays::{load_rays, write_hits};
use crate::io::write_file;
use crate::options::sides;
use crate::ray_engine::Crossbar;
use crate::ray_engine::paper::intersect as crossing;
use crate::report::Findings;
use crate::study::caster::{CastRecord, CasterChoice, CasterOptions};
use crate::study::leaky_teapot::FormatLimits;
use crate::tracer::Caster as _;

const EXAMPLES: &str = "\
Examples:
  crossbar intersect --mesh docs/examples/teapot.obj --rays docs/examples/rays.csv --executor exact --out hits.csv
      the hits in exact arithmetic on the f32 numbers of the files
  crossbar intersect --mesh docs/examples/teapot.obj --rays docs/examples/rays.csv --device r200 --out hits.csv
      the hits that a Radeon 8500 computes; each ray is tested against the triangles near it
  crossbar intersect --mesh docs/examples/teapot.obj --rays docs/examples/rays.csv --caster host --time --out hits.csv
      by the host's octree in single precision, with the times of building the octree and casting the rays
  crossbar intersect --mesh docs/examples/teapot.obj --rays docs/examples/rays.csv --caster engine --caster-device r300 --time --out hits.csv
      the same by the Ray Engine, on the host and an emulated Radeon 9700 together

Rays: CSV with the header ox,oy,oz,dx,dy,dz; directions are not renormalised. Hits: CSV with the header ray,triangle,t, one line
per ray. Triangles are numbered from 0 in the order of the mesh file; a ray without a hit has triangle -1 and t inf. t \
counts lengths of the ray's direction. It is printed with enough digits to read back the same f32, or the same f64 \
where t exceeds the range of f32.

`crossbar leaks --mesh M.obj --rays R.csv` judges the same rays on any card: which rays leak, hit falsely or hit a wrong triangle.

A warning is printed if the format of a card is too coarse for the triangles or for t.";

/// First hits of the rays of a CSV file on the triangles of an OBJ, PLY, STL or glTF file
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The mesh, a Wavefront OBJ, PLY, STL or glTF file
    #[arg(long, value_name = "M.obj")]
    mesh: PathBuf,

    /// The rays, a CSV file
    #[arg(long, value_name = "R.csv")]
    rays: PathBuf,

    /// Sides of faces that can be hit
    #[arg(long, default_value = "front", value_parser = sides())]
    sides: Sides,

    /// The card that tests the rays if there is no `--caster`; not needed for `exact` arithmetic [default: ideal-fp32]
    #[arg(long, value_name = "D")]
    device: Option<String>,

    /// Arithmetic that decides hits [default: batch if a device is named or with `--caster engine`, otherwise exact]
    #[arg(long, value_enum)]
    executor: Option<Decider>,

    /// Print on standard error the times of building the search structure and of casting, and the rays per second. The
    /// time for files is not counted
    #[arg(long)]
    time: bool,

    /// File for the hits
    #[arg(long, value_name = "H.csv")]
    out: PathBuf,

    #[command(flatten)]
    caster: CasterOptions,
}

enum HitSource {
    Exact,
    Card(Box<Profile>, Executor),
    Caster(CasterChoice),
}

/// Triangle and t of each hit, and the seconds of building and casting.
struct Answer {
    hits: Vec<Option<(u32, f64)>>,
    engine: Option<CastRecord>,
    /// Warning if the card's number format leaves few significant bits of t.
    warning: Option<String>,
    build_s: f64,
    cast_s: f64,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    given::refuse_overwriting("--out", Some(&args.out), [args.mesh.as_path(), &args.rays])?;
    let way = choose(args)?;
    let mesh = model_file::mesh(&args.mesh)?;
    let rays = load_rays(&args.rays)?;
    let answer = way.answer(&mesh, &rays, args.sides)?;
    write_file(&args.out, |out| write_hits(&answer.hits, out)).map_err(Problem::from)?;
    study::show(&findings(args, &answer), out)
}

/// Looks up the device even if exact arithmetic does not need it, so that a wrong name is always reported.
fn choose(args: &Args) -> miette::Result<HitSource> {
    let device = args.device.as_deref();
    let caster = args.caster.choose(engine_executor(&args.caster, args.executor)?)?;
    if args.caster.is_named() {
        let help = "remove `--device`; choose the engine's card with `--caster-device`";
        given::refuse([("--device", device.is_some())], "rays without a `--caster`", help)?;
        return Ok(HitSource::Caster(caster));
    }
    let profile = Box::new(device_named(device.unwrap_or(view::DEFAULT_DEVICE))?);
    let executor = Decider::choose(args.executor, device)?;
    Ok(executor.map_or(HitSource::Exact, |executor| HitSource::Card(profile, executor)))
}

impl HitSource {
    fn answer(self, mesh: &Mesh, rays: &[Ray], sides: Sides) -> miette::Result<Answer> {
        let start = Instant::now();
        let of_hit = |(ray, hit): (&Ray, Option<Hit>)| hit.map(|hit| (hit.triangle, beyond_single(mesh, ray, hit)));
        let (hits, engine, warning, built): (Vec<Option<(u32, f64)>>, _, _, _) = match self {
            Self::Exact => {
                let tracer = Tracer::new(mesh);
                let built = Instant::now();
                (view::exact_hits(&tracer, rays, sides, written), None, None, built)
            }
            Self::Card(profile, executor) => {
                let crossbar = Crossbar::new(*profile, executor);
                let built = Instant::now();
                let hits = crossbar.intersect_list(mesh, rays, sides)?;
                let warning = FormatLimits::new(crossbar.bits_left(mesh, rays, sides)?, &hits).warning();
                (rays.iter().zip(hits).map(of_hit).collect(), None, warning, built)
            }
            Self::Caster(choice) => {
                let mut caster = choice.open(mesh, sides)?;
                let built = Instant::now();
                let hits = caster.cast(rays).into_diagnostic()?;
                (rays.iter().zip(hits).map(of_hit).collect(), caster.record(), None, built)
            }
        };
        let (build_s, cast_s) = ((built - start).as_secs_f64(), built.elapsed().as_secs_f64());
        Ok(Answer { hits, engine, warning, build_s, cast_s })
    }
}

/// An exact t as written to tables: rounded once to f32, or to f64 if it exceeds f32.
fn written(t: &ExactT) -> f64 {
    let single = t.to_f32();
    if single.is_finite() { f64::from(single) } else { t.to_f64() }
}

/// The t of a caster's hit. Casters answer in f32; if t exceeds f32, it is computed by equation (3) of the Ray Engine
/// in f64. An infinity that comes from overflow in the card's format is kept.
fn beyond_single(mesh: &Mesh, ray: &Ray, hit: Hit) -> f64 {
    let t = mesh
        .corners(hit.triangle)
        .filter(|_| hit.t.is_infinite())
        .map(|corners| crossing(wide(ray.origin()), wide(ray.direction()), corners.map(wide)).t);
    t.filter(|t| t.is_finite() && (*t as f32).is_infinite()).unwrap_or(f64::from(hit.t))
}

fn findings(args: &Args, answer: &Answer) -> Findings {
    let Answer { hits, engine, warning, build_s, cast_s } = answer;
    let (rays, hits) = (hits.len(), hits.iter().flatten().count());
    let mut found = Findings::new("First hits");
    found.fields(json!({ "rays": rays, "hits": hits, "out": args.out }));
    // Failed writes to standard error are ignored.
    if args.time {
        let rate = rays as f64 / cast_s.max(1e-9);
        found.field("time", json!({ "build_s": build_s, "cast_s": cast_s, "rays_per_s": rate }));
        let rate = rate / 1e6;
        writeln!(std::io::stderr().lock(), "time: {cast_s:.4} s to cast, {rate:.3} M rays/s; {build_s:.4} s to build")
            .ok();
    }
    if let Some(warning) = warning {
        found.field("warning", json!(warning));
        writeln!(std::io::stderr().lock(), "warning: {warning}").ok();
    }
    if let Some(engine) = engine {
        engine.report(&mut found);
    }
    let [hits, rays] = [hits, rays].map(counted);
    found.print(format!("{hits} of {rays} rays hit; written to {}", args.out.display()));
    found
}
