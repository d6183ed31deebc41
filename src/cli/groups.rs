//! The list of commands in `crossbar --help`, by purpose.

use clap::Command;

use crate::report::layout::wrapped;

/// Each group's heading and its commands.
const GROUPS: [(&str, &str); 5] = [
    ("Start here", "leaky-teapot tour render reproduce scene"),
    ("Systems", "intersect radiosity subsurface cpca all-frequency bi-scale atlas materials"),
    ("Cards and shaders", "devices check run compare timeline measure page"),
    ("Numbers", "alu precision matmul units"),
    ("Tools", "diff completions man help"),
];
const WIDTH: usize = 100;
const COLUMN: usize = 17;

/// The program with its commands grouped in the help.
pub(super) fn grouped(program: Command) -> Command {
    let about = |name: &str| match program.find_subcommand(name) {
        Some(command) => command.get_about().map(ToString::to_string).unwrap_or_default(),
        None => "Print this message or the help of the given commands".to_owned(),
    };
    let mut list = String::new();
    for (heading, names) in GROUPS {
        list.push_str(heading);
        list.push_str(":\n");
        for name in names.split(' ') {
            for (index, line) in wrapped(&about(name), WIDTH - COLUMN, "").iter().enumerate() {
                let name = if index == 0 { name } else { "" };
                list.push_str(&format!("  {name:<width$}{line}\n", width = COLUMN - 2));
            }
        }
        list.push('\n');
    }
    program.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}Options:\n{{options}}{{after-help}}"
    ))
}
