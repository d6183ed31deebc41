//! `crossbar prt`, which was one command for three systems: says which command has a verb now.

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{Arg, ArgMatches, Command, value_parser};

/// The name that the three commands had.
const OLD: &str = "prt";

/// The verbs, and the commands that have them.
const VERBS: [(&str, &[&str]); 12] = [
    ("bicluster", &["bi-scale"]),
    ("card", &["cpca", "all-frequency", "bi-scale"]),
    ("compare", &["bi-scale"]),
    ("compress", &["cpca", "all-frequency"]),
    ("error", &["cpca", "all-frequency"]),
    ("factor", &["all-frequency"]),
    ("lighting", &["all-frequency"]),
    ("multiply", &["bi-scale"]),
    ("precompute", &["cpca", "all-frequency", "bi-scale"]),
    ("render", &["cpca", "all-frequency", "bi-scale"]),
    ("show", &["cpca", "all-frequency", "bi-scale"]),
    ("texture", &["bi-scale"]),
];

/// The program with the old name, which takes any arguments.
pub(super) fn with_old_name(program: Command) -> Command {
    let words = Arg::new("words").num_args(0..).trailing_var_arg(true).allow_hyphen_values(true);
    let words = words.value_parser(value_parser!(OsString));
    program.subcommand(Command::new(OLD).hide(true).disable_help_flag(true).arg(words))
}

/// Refuses the old name: the new command is in the message.
pub(super) fn refuse(program: &mut Command, matches: &ArgMatches) -> Result<(), clap::Error> {
    let Some((OLD, inner)) = matches.subcommand() else { return Ok(()) };
    let words = inner.get_many::<OsString>("words").into_iter().flatten();
    let words: Vec<String> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    Err(program.error(ErrorKind::InvalidSubcommand, message(&words)))
}

fn message(words: &[String]) -> String {
    let found = words.first().and_then(|word| VERBS.iter().find(|(verb, _)| verb == word));
    let Some((verb, commands)) = found else {
        return "`crossbar prt` is now a command for each system: `crossbar cpca`, `crossbar all-frequency` and \
                `crossbar bi-scale`"
            .to_owned();
    };
    let by_kind = kind(words).and_then(|kind| match kind {
        "diffuse" | "glossy" => Some("cpca"),
        "all-frequency" | "bi-scale" => Some(kind),
        _ => None,
    });
    let by_kind = by_kind.filter(|command| commands.contains(command));
    let commands = by_kind.map_or_else(|| commands.to_vec(), |command| vec![command]);
    let new: Vec<String> = commands.iter().map(|command| format!("`crossbar {command} {verb}`")).collect();
    format!("`crossbar prt {verb}` is now {}", new.join(" or "))
}

/// The value of `--kind`.
fn kind(words: &[String]) -> Option<&str> {
    let after = words.iter().position(|word| word == "--kind").and_then(|at| words.get(at + 1));
    after.map(String::as_str).or_else(|| words.iter().find_map(|word| word.strip_prefix("--kind=")))
}
