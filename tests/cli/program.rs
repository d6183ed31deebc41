//! Runs the program.

use std::io::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::LazyLock;

/// Path of the program under test: `CROSSBAR_PROGRAM`, for example a release, or the program that was built with this
/// test.
pub(crate) fn path() -> &'static str {
    static PATH: LazyLock<String> = LazyLock::new(|| match std::env::var("CROSSBAR_PROGRAM") {
        Ok(program) => std::path::absolute(&program).expect("a path").display().to_string(),
        Err(_) => env!("CARGO_BIN_EXE_crossbar").to_owned(),
    });
    &PATH
}

/// Exit code and output of a run.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct ProgramOutput {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl ProgramOutput {
    /// Exit code and both output streams as one text, for snapshots.
    pub(crate) fn transcript(&self) -> String {
        let code = self.code.map_or_else(|| "none".to_owned(), |code| code.to_string());
        format!("exit code: {code}\n--- stdout\n{}--- stderr\n{}", self.stdout, self.stderr)
    }
}

/// Runs the program in `folder` with `input` on standard input; environment variables cannot affect the style of its
/// output.
pub(crate) fn crossbar_in(folder: &Path, arguments: &[&str], input: &str) -> ProgramOutput {
    let mut child = Command::new(path())
        .args(arguments)
        .current_dir(folder)
        .env_remove("COLUMNS")
        .env_remove("NO_GRAPHICS")
        .env_remove("CLICOLOR_FORCE")
        .env_remove("FORCE_COLOR")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program under test");
    let mut stdin = child.stdin.take().expect("a pipe was asked for");
    let input = input.to_owned();
    // The program may write before it has read everything, or may never read; neither must block the test or make it
    // fail.
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()).ok());
    let output = child.wait_with_output().expect("the program runs to its end");
    writer.join().expect("writing does not panic");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes text");
    // Lines of progress depend on the computer's speed.
    let stderr = text(output.stderr);
    let stderr = stderr.split_inclusive('\n').filter(|line| !line.starts_with("progress: ")).collect();
    ProgramOutput { code: output.status.code(), stdout: text(output.stdout), stderr }
}

/// Starts the program with its output discarded.
#[allow(dead_code, reason = "not every binary leaves the program running")]
pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(path());
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the program under test")
}

/// Runs the program in the project's folder.
pub(crate) fn crossbar(arguments: &[&str], input: &str) -> ProgramOutput {
    crossbar_in(Path::new(env!("CARGO_MANIFEST_DIR")), arguments, input)
}
