//! `crossbar scene`: the scenes that the project builds, and their files.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::words::counted;
use super::{Out, Problem, study};
use crate::io::{scene_files, scenes, write_files};
use crate::names::did_you_mean;
use crate::report::{Findings, Table, Verdict};
use crate::scene::Scene;

const EXAMPLES: &str = "\
Examples:
  crossbar scene
      all scenes
  crossbar scene office
      the contents of one scene: triangles, materials, emitters, views
  crossbar scene teapot-room --out out/scenes
      out/scenes/teapot_room.toml (views and point lights), teapot_room.obj and teapot_room.mtl, from which the same \
bits are read back";

/// List the built-in scenes, show the contents of one scene, or write its files
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES, allow_negative_numbers = true)]
pub(super) struct Args {
    /// The scene [default: list all scenes]
    #[arg(value_name = "NAME")]
    name: Option<String>,

    /// Folder for the scene's files
    #[arg(long, value_name = "DIR", requires = "name")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    match &args.name {
        None => all(out),
        Some(name) => study::show(&one(name, args.out.as_ref())?, out),
    }
}

fn all(out: &mut Out) -> miette::Result<Verdict> {
    let mut table = Table::new("Scenes", &["scene", "triangles", "views", "what"]);
    for name in scenes::names() {
        let (Some(what), Some(scene)) = (scenes::description(name), scenes::named(name)) else { continue };
        table.push([name.into(), scene.mesh().len().into(), views(&scene).into(), what.into()]);
    }
    out.listing(&table, &[])?;
    Ok(Verdict::Done)
}

/// Findings of one scene; writes its files if a folder is named.
fn one(name: &str, folder: Option<&PathBuf>) -> miette::Result<Findings> {
    let (Some(scene), Some(what)) = (scenes::named(name), scenes::description(name)) else {
        let names: Vec<&str> = scenes::names().collect();
        let what = format!("expected the name of a scene, found `{name}`");
        let meant = did_you_mean(name, names.iter().copied());
        return Err(Problem::usage(what, format!("{meant}the scenes are {}", names.join(", "))).into());
    };
    let mut written = Vec::new();
    if let Some(folder) = folder {
        let files = scene_files(&scene, &name.replace('-', "_")).map_err(miette::Report::msg)?;
        written = write_files(folder, &files).map_err(Problem::from)?;
    }
    let mut found = Findings::new(format!("{name}: {what}"));
    found.fields(summary(name, what, &scene));
    found.field("files", json!(written));
    let [vertices, triangles] = [scene.mesh().positions().len(), scene.mesh().len()].map(counted);
    found.print(format!("{name}: {what}"));
    found.print(format!("triangles     {triangles}, on {vertices} vertices"));
    found.print(format!("materials     {}: {}", scene.materials().len(), materials(&scene)));
    found.print(format!("emitters      {} triangles", counted(scene.emitters().len())));
    found.print(format!("point lights  {}", scene.point_lights.len()));
    found.print(format!("views         {}: {}", scene.views.len(), views(&scene)));
    for file in written {
        found.print(format!("written       {}", file.display()));
    }
    Ok(found)
}

fn views(scene: &Scene) -> String {
    scene.views.iter().map(|view| view.name.as_str()).collect::<Vec<_>>().join(", ")
}

fn materials(scene: &Scene) -> String {
    scene.materials().iter().map(|material| material.name.as_str()).collect::<Vec<_>>().join(", ")
}

fn summary(name: &str, what: &str, scene: &Scene) -> Value {
    json!({
        "name": name,
        "what": what,
        "triangles": scene.mesh().len(),
        "vertices": scene.mesh().positions().len(),
        "materials": scene.materials().iter().map(|material| &material.name).collect::<Vec<_>>(),
        "emitters": scene.emitters().len(),
        "point_lights": scene.point_lights.len(),
        "views": scene.views.iter().map(|view| &view.name).collect::<Vec<_>>(),
    })
}
