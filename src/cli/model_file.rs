//! Model files, for all commands that read them: options, reading, and the notes about a model.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Mutex, OnceLock, PoisonError};

use clap::{Arg, ArgAction, ArgMatches, Command};

use super::{Problem, error, given, outputs};
use crate::geom::Mesh;
use crate::io::{ModelNote, ModelOptions, UpAxis, load_mesh_with, scene_file};
use crate::scene::Scene;

/// Names of arguments that take a model; only the first one that a command has counts.
const NAMED_BY: [&str; 3] = ["mesh", "scene", "model"];
const UP: &str = "model_up";
const STRICT: &str = "strict";

static OPTIONS: OnceLock<ModelOptions> = OnceLock::new();

/// Adds the options of models to every command that takes a model.
pub(super) fn with_options(program: Command) -> Command {
    let names: Vec<String> = program.get_subcommands().map(|command| command.get_name().to_owned()).collect();
    let program = names.into_iter().fold(program, |program, name| program.mut_subcommand(name, with_options));
    let Some(named_by) = named_by(&program) else { return program };
    let up = Arg::new(UP)
        .long("model-up")
        .value_name("AXIS")
        .value_parser(["y", "z"])
        .requires(named_by)
        .help("The up axis of the model's file; models are rotated so that z is up [default: y for glTF, otherwise z]")
        .help_heading("Model");
    let strict = Arg::new(STRICT)
        .long("strict")
        .action(ArgAction::SetTrue)
        .requires(named_by)
        .help("Refuse model files that need repair, and do not flip triangles")
        .help_heading("Model");
    program.arg(up).arg(strict)
}

fn named_by(command: &Command) -> Option<&'static str> {
    NAMED_BY.into_iter().find(|name| command.get_arguments().any(|arg| arg.get_id() == *name))
}

/// Reads the options from a command line. Fails with [`Problem::Usage`] if no model is named; the parser does not
/// report that if the given option excludes the model.
pub(super) fn choose(program: &Command, matches: &ArgMatches) -> Result<(), Problem> {
    let (command, matches) = outputs::obeyed(program, matches);
    // clap keeps the list of a command's arguments only with debug assertions.
    let Some(named_by) = named_by(command) else { return Ok(()) };
    let up = matches.get_one::<String>(UP).map(|axis| if axis == "y" { UpAxis::Y } else { UpAxis::Z });
    let strict = matches.get_flag(STRICT);
    if !matches.contains_id(named_by) {
        let options = [("--model-up", up.is_some()), ("--strict", strict)];
        given::refuse(options, "model files, but no model is given", "remove the option, or give a model file")?;
    }
    OPTIONS.set(ModelOptions { up, strict }).ok();
    Ok(())
}

fn options() -> ModelOptions {
    OPTIONS.get().copied().unwrap_or_default()
}

/// Rejects these options for files that are not models. Fails with a [`Problem`] if any was given.
pub(super) fn refuse_options(name: &str) -> Result<(), Problem> {
    let ModelOptions { up, strict } = options();
    let asked = if up.is_some() { "`--model-up`" } else { "`--strict`" };
    if up.is_none() && !strict {
        return Ok(());
    }
    Err(Problem::usage(
        format!("{asked} is for model files, but `{name}` is built in"),
        "remove the option, or give a model file",
    ))
}

pub(super) fn mesh(path: &Path) -> miette::Result<Mesh> {
    let (mesh, notes) = load_mesh_with(path, options())?;
    tell(path, &notes);
    Ok(mesh)
}

/// A scene from a model file, or from a scene file that names one.
pub(super) fn scene(path: &Path) -> miette::Result<Scene> {
    scene_with(path, options())
}

/// A scene, read by options of its own.
pub(super) fn scene_with(path: &Path, options: ModelOptions) -> miette::Result<Scene> {
    let (scene, notes) = scene_file::load_with(path, options)?;
    tell(path, &notes);
    Ok(scene)
}

/// Reports the repairs and defects of a model on standard error, each once.
fn tell(path: &Path, notes: &[ModelNote]) {
    static TOLD: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let mut told = TOLD.lock().unwrap_or_else(PoisonError::into_inner);
    for note in notes {
        let (path, mut note) = (path.display().to_string(), note.to_string());
        // Some notes begin with their own location, which may be in another file.
        if !note.starts_with(&format!("{path}:")) {
            note = format!("{path}: {note}");
        }
        if told.insert(note.clone()) {
            error::warn_line(&note);
        }
    }
}
