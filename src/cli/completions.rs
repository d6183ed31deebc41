//! `crossbar completions`: what a shell completes after `crossbar`.
//!
//! The script that a shell reads asks the program for completions at each tab, by an environment variable. So commands,
//! options and names are those of the program that runs: cards, scenes, models, media, entries.

use std::ffi::OsStr;
use std::io::Write as _;

use clap::builder::{Resettable, Str};
use clap_complete::Shell;
use clap_complete::engine::{ArgValueCompleter, CompletionCandidate, PathCompleter, ValueCompleter as _};
use clap_complete::env::{CompleteEnv, Shells};
use serde_json::json;

use refsim::device::Profile;

use super::{Out, OutputError, Problem, Verdict};
use crate::scene::built::{self, meshes};
use crate::study::reproduce::ENTRIES;
use crate::subsurface::materials::MATERIALS;

/// The variable that holds the shell when the script asks.
const VARIABLE: &str = "CROSSBAR_COMPLETE";

const EXAMPLES: &str = "\
Examples:
  source <(crossbar completions bash)
      in ~/.bashrc
  source <(crossbar completions zsh)
      in ~/.zshrc, after compinit
  crossbar completions fish | source
      in ~/.config/fish/config.fish

The script asks the program at each tab, so that it knows the names of cards, scenes, models, media
and entries too, and need not be made anew for another version.";

/// Print the script by which a shell completes commands, options, and names of cards, scenes and more
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

pub(super) fn run(args: &Args, out: &mut Out) -> miette::Result<Verdict> {
    let (shells, name) = (Shells::builtins(), args.shell.to_string());
    let shell = shells.completer(&name);
    let shell = shell.ok_or_else(|| Problem::usage(format!("no script for {name}"), "name another shell"))?;
    let mut script = Vec::new();
    shell.write_registration(VARIABLE, "crossbar", "crossbar", "crossbar", &mut script).map_err(OutputError::from)?;
    if out.json() {
        let script = String::from_utf8_lossy(&script);
        out.document(&json!({ "shell": name, "script": script }))?;
    } else {
        out.write_all(&script).map_err(OutputError::from)?;
    }
    Ok(Verdict::Done)
}

/// Answers the script, if it is the one that asks; returns `false` on any other run.
pub(super) fn answer(program: fn() -> clap::Command) -> Result<bool, clap::Error> {
    let program = CompleteEnv::with_factory(|| with_names(program(), "")).var(VARIABLE).bin("crossbar");
    program.try_complete(std::env::args_os(), std::env::current_dir().ok().as_deref())
}

/// The command named `path`, its verbs and their options with completions of the names that values have.
fn with_names(command: clap::Command, path: &str) -> clap::Command {
    let command = command.mut_args(|arg| match completer(path, arg.get_id().as_str()) {
        Some(completer) => arg.add(completer),
        None => arg,
    });
    command.mut_subcommands(|verb| {
        let path = format!("{path} {}", verb.get_name()).trim_start().to_owned();
        with_names(without_visible_aliases(verb), &path)
    })
}

/// The same command, whose aliases are understood and not offered in place of its name.
fn without_visible_aliases(command: clap::Command) -> clap::Command {
    // Clap takes names that live as long as the program, which ends after its answer.
    let aliases: Vec<&'static str> = command.get_all_aliases().map(|alias| &*alias.to_owned().leak()).collect();
    command.visible_alias(Resettable::<Str>::Reset).aliases(aliases)
}

/// Completions of a value of the option or argument `id` of a command.
fn completer(command: &str, id: &str) -> Option<ArgValueCompleter> {
    match (command, id) {
        (_, "device" | "left_device" | "right_device") | ("devices", "name") => Some(named_or_file(devices)),
        (_, "format" | "left_format" | "right_format") => Some(named(formats)),
        (_, "switch" | "left_switch" | "right_switch") => Some(named(switches)),
        ("subsurface" | "cpca precompute", "material") | ("materials", "name") => Some(named(media)),
        ("scene", "name") => Some(named(scenes)),
        ("radiosity" | "render", "scene") => Some(named_or_file(scenes)),
        // Of a reflectance, which clap completes.
        ("all-frequency factor", "model") => None,
        ("leaky-teapot", "mesh") | (_, "model") => Some(named_or_file(models)),
        ("reproduce", "entries") => Some(named(entries)),
        _ => None,
    }
}

type Named = fn() -> Vec<CompletionCandidate>;

/// Completes names alone.
fn named(names: Named) -> ArgValueCompleter {
    ArgValueCompleter::new(move |current: &OsStr| beginning_with(names(), current))
}

/// Completes names, and paths of files.
fn named_or_file(names: Named) -> ArgValueCompleter {
    ArgValueCompleter::new(move |current: &OsStr| {
        let mut found = beginning_with(names(), current);
        found.extend(PathCompleter::file().complete(current));
        found
    })
}

fn beginning_with(names: Vec<CompletionCandidate>, current: &OsStr) -> Vec<CompletionCandidate> {
    let current = current.to_string_lossy();
    names.into_iter().filter(|name| name.get_value().to_string_lossy().starts_with(&*current)).collect()
}

fn candidate(name: impl Into<String>, help: Option<&str>) -> CompletionCandidate {
    CompletionCandidate::new(name.into()).help(help.map(|help| help.to_owned().into()))
}

fn devices() -> Vec<CompletionCandidate> {
    let cards = Profile::card_names().into_iter().chain(Profile::variant_names()).map(str::to_owned);
    let ideal = FORMATS.iter().map(|format| format!("ideal-{format}"));
    cards.chain(ideal).map(|name| candidate(name, None)).collect()
}

/// Formats that have names, and those of cards; any other is written in the same way.
const FORMATS: [&str; 6] = ["s3.12", "s1.10", "fp16", "fp24", "fp32", "bf16"];

fn formats() -> Vec<CompletionCandidate> {
    FORMATS.iter().map(|name| candidate(*name, None)).collect()
}

/// Each switch of any card with each of its values.
fn switches() -> Vec<CompletionCandidate> {
    let profiles = Profile::card_names().into_iter().filter_map(|name| Profile::named(name).ok());
    let mut all: Vec<String> = profiles
        .flat_map(|profile| profile.switches().to_vec())
        .flat_map(|switch| switch.values.iter().map(|value| format!("{}={value}", switch.name)).collect::<Vec<_>>())
        .collect();
    all.sort();
    all.dedup();
    all.into_iter().map(|name| candidate(name, None)).collect()
}

fn media() -> Vec<CompletionCandidate> {
    MATERIALS.iter().map(|medium| candidate(medium.name.to_lowercase(), None)).collect()
}

fn scenes() -> Vec<CompletionCandidate> {
    built::names().map(|name| candidate(name, built::description(name))).collect()
}

/// Meshes and scenes: either is a model.
fn models() -> Vec<CompletionCandidate> {
    meshes::names().map(|name| candidate(name, meshes::description(name))).chain(scenes()).collect()
}

fn entries() -> Vec<CompletionCandidate> {
    ENTRIES.iter().map(|entry| candidate(entry.id, Some(entry.title))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_offered_is_one_that_is_taken() {
        for name in devices() {
            let name = name.get_value().to_string_lossy().into_owned();
            assert!(Profile::named(&name).is_ok(), "{name}");
        }
        assert!(switches().len() > 20);
        for names in [media(), scenes(), models(), entries(), formats()] {
            assert!(names.len() > 5);
        }
    }
}
