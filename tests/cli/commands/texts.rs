//! Extracts commands from pages and help texts.

use std::fs;
use std::path::{Path, PathBuf};

use crate::crossbar;

/// A command of the program: its standard input, its arguments, the expected exit code, and its location in the text.
pub(crate) struct Command {
    pub(crate) place: String,
    pub(crate) input: String,
    pub(crate) arguments: Vec<String>,
    pub(crate) code: i32,
    /// `true` if the text builds the program with the feature `wgpu`, which the documented release lacks.
    pub(crate) with_wgpu: bool,
}

/// A command of cargo: its arguments, and its location in the text.
pub(crate) struct CargoCommand {
    pub(crate) place: String,
    pub(crate) arguments: Vec<String>,
}

/// A command's output as quoted on a page.
pub(crate) struct Output {
    pub(crate) place: String,
    pub(crate) page: PathBuf,
    /// The comment that names the command, as in the page.
    pub(crate) heading: String,
    pub(crate) arguments: Vec<String>,
    pub(crate) text: String,
}

/// A shell line with its continuations joined, and its trailing comment.
struct Line {
    place: String,
    words: Vec<String>,
    comment: String,
}

impl Line {
    /// `None` for a line without a `crossbar` or `cargo` command, such as printed output.
    fn new(place: String, text: &str) -> Option<Self> {
        if !["crossbar ", "cargo "].iter().any(|program| text.contains(program)) {
            return None;
        }
        let (text, comment) = text.split_once(" #").unwrap_or((text, ""));
        let words = shlex::split(text).unwrap_or_else(|| panic!("{place}: not a line of shell: {text}"));
        Some(Self { place, words, comment: comment.to_owned() })
    }

    /// The command after leading variable assignments.
    fn command(&self) -> &[String] {
        let variables = self.words.iter().take_while(|word| word.contains('=') && !word.starts_with('-')).count();
        &self.words[variables..]
    }

    /// The line as a command of the program, if it is one: possibly after a pipe from `echo`, possibly run by `cargo
    /// run`.
    fn of_the_program(&self) -> Option<Command> {
        let words = self.command();
        let (input, words) = match words.iter().position(|word| word == "|") {
            Some(pipe) if words[0] == "echo" => (format!("{}\n", words[1..pipe].join(" ")), &words[pipe + 1..]),
            Some(pipe) => (String::new(), &words[pipe + 1..]),
            None => (String::new(), words),
        };
        let arguments = match words {
            [program, arguments @ ..] if program == "crossbar" => arguments,
            [cargo, run, ..] if cargo == "cargo" && run == "run" && !words.iter().any(|word| word == "--example") => {
                &words[words.iter().position(|word| word == "--")? + 1..]
            }
            _ => return None,
        };
        // The shell handles the redirection.
        let arguments = arguments.split(|word| word == ">").next().unwrap_or_default().to_vec();
        let code = self.comment.split_once("exit code ").and_then(|(_, code)| code.split(' ').next()?.parse().ok());
        let with_wgpu = words.windows(2).any(|pair| pair == ["--features", "wgpu"]);
        Some(Command { place: self.place.clone(), input, arguments, code: code.unwrap_or(0), with_wgpu })
    }

    fn of_cargo(&self) -> Option<CargoCommand> {
        let (cargo, arguments) = self.command().split_first()?;
        (cargo == "cargo").then(|| CargoCommand { place: self.place.clone(), arguments: arguments.to_vec() })
    }
}

/// README.md, the READMEs of the other crates, and docs, except for the decisions, which are history.
pub(super) fn pages() -> Vec<(String, String)> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() && path.file_name().is_some_and(|name| name != "decisions") {
                walk(&path, found);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path);
            }
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: Vec<PathBuf> =
        ["README.md", "CHANGELOG.md", "fixtures/README.md", "refsim/README.md", "refsim/criterion/README.md"]
            .iter()
            .map(|name| root.join(name))
            .collect();
    walk(&root.join("docs"), &mut found);
    found.sort();
    let text = |path: &PathBuf| {
        let name = path.strip_prefix(root).expect("below the root").display().to_string();
        (name, fs::read_to_string(path).expect("a page"))
    };
    found.iter().map(text).collect()
}

/// The lines of fenced blocks without a language, which are shell.
fn lines_of_page(name: &str, text: &str) -> Vec<Line> {
    let (mut lines, mut language, mut joined) = (Vec::new(), None, String::new());
    for (number, line) in (1..).zip(text.lines()) {
        let place = format!("{name}:{number}");
        match (line.strip_prefix("```"), language) {
            (Some(opened), None) => language = Some(opened),
            (Some(_), Some(_)) => language = None,
            (None, Some("")) => match line.strip_suffix('\\') {
                Some(part) => joined.push_str(part),
                None => lines.extend(Line::new(place, &(std::mem::take(&mut joined) + line))),
            },
            (None, Some(_)) => {}
            (None, None) => {
                let indented = line.strip_prefix("    ").unwrap_or_default();
                let command = ["crossbar ", "cargo "].iter().any(|start| indented.starts_with(start));
                assert!(!command, "{place}: commands stand between fences");
            }
        }
    }
    lines
}

/// The commands under `Examples:` in a help text: indented by two; wrapped lines are joined.
fn lines_of_help(name: &str, help: &str) -> Vec<Line> {
    let mut commands: Vec<String> = Vec::new();
    let examples = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    for line in examples.take_while(|line| line.is_empty() || line.starts_with("  ")) {
        match line.strip_prefix("  ") {
            Some(text) if !text.starts_with(' ') && text.contains("crossbar ") => commands.push(text.to_owned()),
            Some(text) if !text.starts_with(' ') => {
                let command = commands.last_mut().unwrap_or_else(|| panic!("{name}: {text}"));
                command.push(' ');
                command.push_str(text);
            }
            _ => {}
        }
    }
    commands.iter().filter_map(|text| Line::new(format!("crossbar {name} --help"), text)).collect()
}

fn lines_of_pages() -> Vec<Line> {
    pages().iter().flat_map(|(name, text)| lines_of_page(name, text)).collect()
}

pub(crate) fn of_the_program() -> Vec<Command> {
    let mut lines = lines_of_pages();
    for name in std::iter::once(String::new()).chain(crate::help::names()) {
        let arguments: Vec<&str> = name.split(' ').filter(|name| !name.is_empty()).chain(["--help"]).collect();
        let found = lines_of_help(&name, &crossbar(&arguments, "").stdout);
        assert!(!found.is_empty(), "{name} has examples");
        lines.extend(found);
    }
    lines.iter().filter_map(Line::of_the_program).collect()
}

/// All commands of cargo.
pub(crate) fn of_cargo() -> Vec<CargoCommand> {
    lines_of_pages().iter().filter_map(Line::of_cargo).collect()
}

/// All outputs that pages quote: a comment `<!-- output of: COMMAND -->` followed by a block of text.
pub(crate) fn outputs() -> Vec<Output> {
    let mut found = Vec::new();
    for (name, text) in pages() {
        let lines: Vec<&str> = text.lines().collect();
        for (number, line) in lines.iter().enumerate() {
            let Some(command) = line.strip_prefix("<!-- output of: ").and_then(|rest| rest.strip_suffix(" -->")) else {
                continue;
            };
            let place = format!("{name}:{}", number + 1);
            let Some(Command { arguments, .. }) = Line::new(place.clone(), command).and_then(|l| l.of_the_program())
            else {
                panic!("{place}: no command of the program");
            };
            assert_eq!(lines.get(number + 1), Some(&"```text"), "{place}");
            let shown: Vec<&str> = lines[number + 2..].iter().take_while(|line| **line != "```").copied().collect();
            let page = Path::new(env!("CARGO_MANIFEST_DIR")).join(&name);
            found.push(Output { place, page, heading: (*line).to_owned(), arguments, text: shown.join("\n") });
        }
    }
    found
}
