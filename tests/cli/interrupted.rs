//! A program that receives a signal leaves nothing half-written.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead as _, BufReader, Read as _};
use std::os::unix::process::ExitStatusExt as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A command that ignores no signal. If the tests themselves run with a signal ignored (by `nohup`, or by a script in
/// the background), the program would inherit that, and minutes of work would run to their end.
fn unignoring(program: &str) -> Command {
    if cfg!(target_os = "linux") {
        let mut command = Command::new("env");
        command.args(["--default-signal=INT,TERM,HUP", program]);
        return command;
    }
    Command::new(program)
}

fn begin(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = unignoring(crate::program::path());
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the program that this test was built with")
}

fn staging(folder: &Path) -> usize {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    entries.filter(|entry| entry.file_name().to_string_lossy().starts_with(".crossbar-")).count()
}

/// Waits until the long work has begun, which is after its staging folder exists.
fn begun(child: &mut Child, folder: &Path) {
    let start = Instant::now();
    while staging(folder) == 0 {
        assert!(child.try_wait().expect("a child").is_none(), "the work is long enough to be interrupted");
        assert!(start.elapsed() < Duration::from_secs(120), "the work begins");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args(["-s", name, &child.id().to_string()]).status().expect("kill, of any system");
    assert!(sent.success());
}

/// Work of minutes, which every test here interrupts early.
const LONG: &[&str] = &["render", "white-box", "--renderer", "path", "--samples", "100000", "--size", "64x64"];

#[test]
fn signals_leave_nothing_behind() {
    for (name, number) in [("INT", 2), ("TERM", 15), ("HUP", 1)] {
        for (out, staged) in [("new", "."), ("there", "there")] {
            let folder = tempfile::tempdir().expect("a folder for the test");
            fs::create_dir(folder.path().join("there")).expect("a folder");
            fs::write(folder.path().join("there/mine"), "mine").expect("a file");
            let mut child = begin(folder.path(), &[LONG, &["--out", out]].concat());
            begun(&mut child, &folder.path().join(staged));
            signal(&child, name);
            let status = child.wait().expect("a child");
            // Shells report death by signal n as 128 + n: 130, 143 and 129.
            assert_eq!(status.signal(), Some(number), "{name}");
            assert_eq!(staging(folder.path()) + staging(&folder.path().join("there")), 0, "{name}");
            assert!(!folder.path().join("new").exists(), "{name}: no folder either");
            assert_eq!(fs::read_dir(folder.path().join("there")).expect("a folder").count(), 1, "{name}");
        }
    }
}

/// The last message says that nothing was written and that work starts from the beginning, as text or as JSON.
#[test]
fn what_is_lost_is_said() {
    for (more, expected) in [(None, "Error: crossbar::interrupted"), (Some("--json"), "{\"")] {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let mut command = unignoring(crate::program::path());
        command.args(LONG).args(more).current_dir(folder.path()).stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = command.stderr(Stdio::piped()).spawn().expect("the program that this test was built with");
        begun(&mut child, folder.path());
        signal(&child, "INT");
        let output = child.wait_with_output().expect("a child");
        assert_eq!(output.status.signal(), Some(2));
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(said.starts_with(expected) && said.contains("starts from the beginning"), "{said}");
    }
}

/// Long work announces once how long it will take and which options make it quicker, and if standard error is not a
/// terminal, its progress in plain lines; with `--quiet` it writes nothing.
#[test]
fn long_work_is_announced() {
    let [loud, quiet] = [None, Some("--quiet")].map(|more| {
        let folder = tempfile::tempdir().expect("a folder for the test");
        let mut command = unignoring(crate::program::path());
        command.args(LONG).args(more).current_dir(folder.path()).stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = command.stderr(Stdio::piped()).spawn().expect("the program that this test was built with");
        begun(&mut child, folder.path());
        (child, folder)
    });
    let (mut child, _folder) = loud;
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines().map(|line| line.expect("text"));
    let is_announced = |line: &String| line.contains(" will take about ");
    let is_counted = |line: &String| line.contains(" of ") && line.contains(" done, about ") && line.ends_with(" left");
    let mut said = Vec::new();
    while !(said.iter().any(is_announced) && said.iter().any(is_counted)) {
        said.push(lines.next().expect("the work is long enough to be announced"));
    }
    let (mut silent, _folder) = quiet;
    for child in [&child, &silent] {
        signal(child, "INT");
    }
    said.extend(lines.filter(|line| line.starts_with("progress: ")));
    let announced: Vec<&String> = said.iter().filter(|line| is_announced(line)).collect();
    let quicker = " at this pace; quicker with fewer `--samples` or a smaller `--size`";
    assert!(announced.len() == 1 && announced[0].ends_with(quicker), "{said:?}");
    assert!(said.iter().all(|line| line.starts_with("progress: ") && !line.contains(['\x1b', '\r'])), "{said:?}");
    let mut text = String::new();
    silent.stderr.take().expect("a pipe").read_to_string(&mut text).expect("text");
    assert!(!text.contains("progress"), "{text}");
    for mut child in [child, silent] {
        assert_eq!(child.wait().expect("a child").signal(), Some(2));
    }
}

#[test]
fn a_full_pipe_does_not_keep_the_program() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    // The shell fills its pipe, which has no reader, and passes it on as standard error.
    let script = "(head -c 65536 /dev/zero >&2) & wait; exec \"$0\" \"$@\"";
    let mut command = unignoring("sh");
    command.args(["-c", script, crate::program::path()]).args(LONG).current_dir(folder.path());
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("a shell");
    begun(&mut child, folder.path());
    let start = Instant::now();
    signal(&child, "TERM");
    assert_eq!(child.wait().expect("a child").signal(), Some(15));
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn shells_see_130_and_143() {
    for (name, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let folder = tempfile::tempdir().expect("a folder for the test");
        // A shell without job control starts background jobs with SIGINT ignored, so the program runs in the
        // foreground.
        let script = format!(
            "(until ls -d .crossbar-* > /dev/null 2>&1; do sleep 0.02; done; kill -s {name} $(cat pid)) & \
             sh -c 'echo $$ > pid; exec \"$0\" \"$@\"' \"$@\"; echo $?"
        );
        let mut command = unignoring("sh");
        command.args(["-c", &script, "sh", crate::program::path()]).args(LONG).current_dir(folder.path());
        let output = command.stdin(Stdio::null()).output().expect("a shell");
        assert_eq!(String::from_utf8_lossy(&output.stdout).lines().last(), Some(code.to_string().as_str()), "{name}");
        assert_eq!(staging(folder.path()), 0, "{name}");
    }
}

/// `nohup` ignores SIGHUP on behalf of its program.
#[test]
#[cfg(target_os = "linux")]
fn what_is_ignored_stays_ignored() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut command = unignoring("sh");
    command.args(["-c", "trap '' HUP; exec \"$0\" \"$@\"", crate::program::path()]).args(LONG);
    command.current_dir(folder.path()).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().expect("a shell");
    begun(&mut child, folder.path());
    signal(&child, "HUP");
    std::thread::sleep(Duration::from_millis(100));
    assert!(child.try_wait().expect("a child").is_none(), "it goes on");
    signal(&child, "TERM");
    assert_eq!(child.wait().expect("a child").signal(), Some(15));
    assert_eq!(staging(folder.path()), 0);
}
