//! `crossbar render`: an OBJ, PLY, STL or glTF file by eye rays on a card, and scenes by the host renderers.

mod args;
mod light;

use miette::IntoDiagnostic as _;
use refsim::machine::ExecutorKind;
use serde_json::json;

use super::executor::Decider;
use super::{CommandLine, Out, Problem, model_file, scene_name, study, view};
use crate::case::device_named;
use crate::geom::exact::{ExactT, Sides, Tracer};
use crate::io::{require_writable, write_files};
use crate::options::Size;
use crate::picture::{ChannelUnit, Picture, Samples};
use crate::ray_engine::{Crossbar, RayBatch};
use crate::report::{Provenance, Verdict};
use crate::study::shade::TeapotShader;
use light::{hits_line, page};

pub(super) use args::Args;

pub(super) fn run(args: &Args, command_line: &CommandLine, out: &mut Out) -> miette::Result<Verdict> {
    if let Some(scene) = scene_name::by_name(&args.scene)? {
        return light::run(args, &scene, true, command_line, out);
    }
    // A model file is shown by its eye rays, unless it is to be lit.
    let is_scene_file = args.scene.extension().is_some_and(|ending| ending == "toml");
    if is_scene_file || args.light.asked() || args.caster.is_named() {
        return light::run(args, &model_file::scene(&args.scene)?, is_scene_file, command_line, out);
    }
    args.light.refuse_others(None)?;
    args.caster.choose(ExecutorKind::Batch.into())?;
    let profile = device_named(args.device.as_deref().unwrap_or(view::DEFAULT_DEVICE))?;
    let executor = Decider::choose(args.executor, args.device.as_deref())?;
    let mesh = model_file::mesh(&args.scene)?;
    let camera = args.eye.framing(&mesh, args.size)?;
    let Size { width, height } = args.size;
    require_writable(&args.out).map_err(Problem::from)?;
    let mut provenance = study::with_inputs(Provenance::new(&command_line.text), &scene_name::named_file(&args.scene));
    let rays = RayBatch::new(width, height, camera.rays()).into_diagnostic()?;
    let hits: Vec<Option<(u32, f32)>> = match executor {
        None => view::exact_hits(&Tracer::new(&mesh), rays.rays(), Sides::Both, ExactT::to_f32),
        Some(kind) => {
            provenance.profiles.push(profile.name.clone());
            let answer = Crossbar::new(profile, kind).intersect(&mesh, &rays, Sides::Both)?;
            answer.hits.into_iter().map(|h| h.map(|h| (h.triangle, h.t))).collect()
        }
    };
    let triangles: Vec<Option<u32>> = hits.iter().map(|h| h.map(|h| h.0)).collect();
    let picture = TeapotShader::new(&mesh).picture(&rays, &triangles);
    let t = hits.iter().map(|h| h.map_or(f32::INFINITY, |h| h.1)).collect();
    let ids = triangles.iter().map(|t| t.unwrap_or(u32::MAX)).collect();
    let layers = Picture::new(width, height).with("Z", ChannelUnit::RayLength, Samples::Float(t))?.with(
        "triangle",
        ChannelUnit::Id,
        Samples::Uint(ids),
    )?;
    let found = hits.iter().flatten().count();
    let mut findings = page(args, &camera, picture, layers, "shaded by a lamp at the eye");
    findings.paragraph(format!("{found} of {} pixels hit.", hits.len()));
    findings.fields(json!({ "pixels": hits.len(), "hits": found, "out": args.out }));
    findings.print(hits_line(found, hits.len(), args));
    write_files(&args.out, &findings.take_files(&provenance)?).map_err(Problem::from)?;
    study::show(&findings, out)
}
