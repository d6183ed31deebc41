//! External text as shown on a terminal: no control sequences, no endless lines, no endless lists.

use std::fs;
use std::path::Path;

use wait4::Wait4 as _;

use crossbar::report::visible::is_hidden;

use crate::answers::folder_with;
use crate::{ProgramOutput, crossbar, crossbar_in};

fn check(text: &str, more: &[&str]) -> ProgramOutput {
    let folder = folder_with(&[("shader.psa", text.as_bytes())]);
    crossbar_in(folder.path(), &[&["check", "shader.psa", "--device", "r200"], more].concat(), "")
}

#[test]
fn an_error_far_to_the_right_is_shown_with_its_column() {
    for blanks in [65_534, 65_535, 65_536, 900_000] {
        let ran = check(&format!("ps_1_4\n{}frobnicate r0\n", " ".repeat(blanks)), &[]);
        assert_eq!(ran.code, Some(2), "{}", ran.stderr);
        assert!(ran.stderr.contains(&format!("shader.psa:2:{}]", blanks + 1)), "{}", ran.stderr);
        assert!(ran.stderr.len() < 2000, "{blanks}: {} bytes of message", ran.stderr.len());
    }
    let ran = check(&format!("ps_1_4\nmov r0, c9 ;{}\n", "é".repeat(400_000)), &[]);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.len() < 2000, "a finding of {} bytes", ran.stdout.len());
}

/// Escape sequences, a carriage return, and characters that reverse the text's direction.
const HOSTILE: &str = "\x1b]0;title\x07\x1b[2J\r\u{202e}\u{9b}31m\u{200b}";

fn nothing_hidden(ran: &ProgramOutput, what: &str) {
    for text in [&ran.stdout, &ran.stderr] {
        assert!(!text.contains(|c| c != '\n' && is_hidden(c)), "{what}: {text:?}");
    }
}

#[test]
fn nothing_from_outside_acts_on_the_terminal() {
    let escaped: String = HOSTILE.chars().map(|c| format!("\\u{:04x}", u32::from(c))).collect();
    let case = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/cases/modulate.toml"));
    let case = case.expect("a fixture").lines().filter(|l| !l.starts_with("title")).collect::<Vec<_>>().join("\n");
    let good = format!("title = \"a{escaped}\\nb\"\n{case}");
    let bad = format!("title = \"a{escaped}\"\ndevice = \"{escaped}\"\n{case}");
    let shader = format!("ps_1_4\nmov r0, c9 ; {HOSTILE}\nfrobnicate{HOSTILE} r0\n");
    let illegal = format!("ps_1_4\nmov r0, c9 // {HOSTILE}\n");
    let rays = format!("ox,oy,oz,dx,dy,dz\n0,0,0,0,0,{HOSTILE}\n");
    let files: [(&str, &[u8]); 7] = [
        ("good.toml", good.as_bytes()),
        ("bad.toml", bad.as_bytes()),
        ("shader.psa", shader.as_bytes()),
        ("illegal.psa", illegal.as_bytes()),
        ("rays.csv", rays.as_bytes()),
        ("\u{1b}[1m.psa", b"ps_1_4\nfrobnicate\n"),
        ("m.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ];
    let folder = folder_with(&files);
    let runs: [&[&str]; 12] = [
        &["run", "good.toml", "--out", "out"],
        &["compare", "good.toml"],
        &["timeline", "good.toml", "--device", "r300"],
        &["run", "bad.toml"],
        &["check", "shader.psa", "--device", "r200"],
        &["check", "illegal.psa", "--device", "r200"],
        &["check", "\u{1b}[1m.psa", "--device", "r200"],
        &["check", "illegal.psa", "--device", HOSTILE],
        &["intersect", "--mesh", "m.obj", "--rays", "rays.csv", "--out", "h.csv"],
        &["render", "m.obj", "--view", HOSTILE, "--renderer", "eye"],
        &["alu", HOSTILE, "--format", "fp16"],
        &["alu", "add", "--format", HOSTILE],
    ];
    for arguments in runs {
        nothing_hidden(&crossbar_in(folder.path(), arguments, ""), &arguments.join(" "));
        let ran = crossbar_in(folder.path(), &[arguments, &["--json"]].concat(), "");
        nothing_hidden(&ran, &arguments.join(" "));
    }
    let ran = crossbar_in(folder.path(), &["run", "good.toml", "--out", "out"], "");
    assert!(ran.stdout.starts_with("a\\u{1b}]0;title"), "a title is one line, escaped: {}", ran.stdout);
    let ran = crossbar_in(folder.path(), &["run", "good.toml", "--out", "out", "--json"], "");
    let document = ran.json();
    assert_eq!(document["title"], format!("a{HOSTILE}\nb"), "machines get the very text");
    nothing_hidden(&crossbar(&["alu", "sqrt", "--format", "fp16"], &format!("{HOSTILE}\n")), "standard input");
}

/// A program of `count` lines, each of which breaks a rule.
fn bad_lines(count: usize) -> String {
    format!("ps_1_4\n{}", "mov r0, c9\n".repeat(count))
}

#[test]
fn lists_of_errors_are_cut_but_for_machines() {
    let shown = |text: &str| text.matches("shader.psa:").count();
    let ran = check(&bad_lines(50), &[]);
    let total: usize = 20
        + ran
            .stdout
            .split("... and ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next()?.parse::<usize>().ok())
            .expect("a count");
    assert_eq!((ran.code, shown(&ran.stdout)), (Some(1), 20), "{}", ran.stdout);
    assert!(ran.stdout.ends_with(" more: `--json` lists all\n"), "{}", ran.stdout);
    let document = check(&bad_lines(50), &["--json"]).json();
    assert_eq!(document["violations"].as_array().map(Vec::len), Some(total));
    let ran = check(&format!("ps_1_4\n{}", "frobnicate\n".repeat(30)), &[]);
    assert!(ran.stderr.ends_with("... and 10 more: `--json` lists all\n"), "{}", ran.stderr);
}

/// Measures the program's processor time, which does not depend on other load. Eight times the errors may take eight
/// times as long; a renderer that scans the text for each error would take 64 times as long.
#[test]
fn a_report_costs_as_much_as_its_errors() {
    let seconds = |count: usize, more: &[&str]| {
        let folder = folder_with(&[("shader.psa", bad_lines(count).as_bytes())]);
        let arguments = [&["check", "shader.psa", "--device", "r200"], more].concat();
        let used = crate::start(folder.path(), &arguments).wait4().expect("a child");
        assert_eq!(used.status.code(), Some(1));
        used.rusage.utime.as_secs_f64()
    };
    let [few, many] = [2500, 20_000].map(|count| seconds(count, &["--json"]));
    assert!(many < 24.0 * few + 0.1, "{few} s and {many} s for eight times the errors");
    let cut = seconds(20_000, &[]);
    assert!(cut < many + 0.5, "{cut} s for a report that is cut, {many} s for all of it");
}
