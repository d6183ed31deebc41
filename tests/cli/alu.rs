//! Tests `crossbar alu`: streams of operands, and verification of results.

use crate::{ProgramOutput, crossbar};

fn alu(arguments: &str, input: &str) -> ProgramOutput {
    let mut all = vec!["alu"];
    all.extend(arguments.split_whitespace());
    crossbar(&all, input)
}

/// Expects success, with one line of output per line of input.
fn results(arguments: &str, input: &str) -> Vec<String> {
    let ran = alu(arguments, input);
    assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""), "alu {arguments}");
    ran.stdout.lines().map(str::to_owned).collect()
}

#[test]
fn results_have_the_width_of_the_format() {
    assert_eq!(results("add --format fp16", "3C00 4000\n3c00 bc00\n"), ["4200", "0000"]);
    assert_eq!(results("mul --format e3m2", "0C 0C"), ["0C"]);
    assert_eq!(results("add --format fp24 --flags", "3F0000 3F0000\n"), ["400000 00"]);
    assert_eq!(results("lt --format fp32 --flags", "3F800000 40000000\n40000000 7FC00000"), ["1 00", "0 10"]);
    assert_eq!(results("convert --format fp32 --to s3.12 --flags", "3F800000\n42C80000"), ["1000 00", "7FFF 05"]);
    assert_eq!(results("mulAdd --format fp16", "3C00 3C00 3C00"), ["4000"]);
    assert_eq!(results("add --format s8.8", "00100 00100\n  0A\t2B \r"), ["00200", "00035"]);
    let widest = alu("sqrt --format fp32 --verify --flags", "FFFFFFFF 80000000 1F\n");
    assert_eq!((widest.code, widest.stdout.ends_with("0 passed, 1 failed\n")), (Some(1), true), "{}", widest.stdout);
}

#[test]
fn chance_is_by_seed_and_line() {
    let halves = "3F808000\n".repeat(1000);
    let run = |options: &str| results(&format!("convert --format fp32 --to bf16:rst {options}"), &halves);
    let made = run("--seed 1");
    let ups = made.iter().filter(|bits| *bits == "3F81").count();
    assert!((450..550).contains(&ups) && made.iter().all(|bits| bits == "3F81" || bits == "3F80"), "{ups} of 1000");
    assert_eq!(made, run("--seed 1 --threads 3"));
    assert_ne!(made, run("--seed 2"));
    // The first word from 0 is 0xe220a839, which carries half a unit; the second is 0x6e789e6a, which does not.
    assert_eq!(run("")[..2], ["3F81", "3F80"]);
}

#[test]
fn lines_of_many_numbers() {
    let block = "83 0 8 7 4";
    let numbers = "3f800000 becccccd 42c00000 42200000";
    assert_eq!(results("quantize --format fp32 --block mxfp4", numbers), [block]);
    assert_eq!(results("quantize --format fp32 --block mxfp4 --flags", numbers), [format!("{block} 03")]);
    assert_eq!(results("quantize --format fp32 --block mxint8 --flags", "7f800000 0"), ["FF 00 00 10"]);
    let back = results("dequantize --format fp32 --block mxfp4 --json --flags", block);
    assert_eq!(back, [r#"{"flags":"00","results":["00000000","80000000","42C00000","42000000"]}"#]);
    let terms = "6800 3C00 3C00 3C00 3C00 3C00\n\n3C00 3C00";
    // 2048 + 1 + 1: fp16 loses each 1, which is half a step; single precision loses neither.
    assert_eq!(results("dot --format fp16 --flags", terms), ["6800 01", "3C00 00"]);
    assert_eq!(results("dot --format fp16 --accumulator fp32 --flags", terms), ["6801 00", "3C00 00"]);
    assert_eq!(results("dot --format fp16 --summation exact", terms), ["6801", "3C00"]);
    // With ten bits the last bit below 2048 is 2, with eleven it is 1.
    assert_eq!(results("dot --format fp16 --summation aligned:10 --flags", terms), ["6800 01", "3C00 00"]);
    assert_eq!(results("dot --format fp16 --summation aligned:11 --flags", terms), ["6801 00", "3C00 00"]);
}

#[test]
fn devices_without_a_measured_unit_compute_by_their_rules() {
    assert_eq!(results("mul --device ideal-fp16", "3C01 3C01"), results("mul --format fp16", "3C01 3C01"));
    assert_eq!(results("sge --format fp16", "3C00 3C00\n7E00 3C00"), ["3C00", "0000"]);
    assert_eq!(results("sne --format fp16", "3C00 3C00\n7E00 3C00"), ["0000", "3C00"]);
    assert_eq!(results("dph --format fp16", "3C00 0 0 7C00 3C00 0 0 3C00"), ["4000"]);
    assert_eq!(results("mul --device nv30 --state legacy --flags", "80000000, 7f800000"), ["00000000 00"]);
    assert_eq!(
        results("dst --device nv20", "0 40000000 7f800001 2 3 40400000 4 5"),
        ["3F800000 40C00000 7F800001 00000005"]
    );
    // NV20's pixel stage is in fixed point.
    assert_eq!(results("mov --device nv20 --stage pixel", "0FF"), ["0FF"]);
}

#[test]
fn mismatches_are_printed_and_counted() {
    let lines = "3C00 3C00 4000 00\n3C00 3C00 4001 00\n\n3C00 3C00 4000 01\n7E00 3C00 FDFF 00\n";
    let ran = alu("add --format fp16 --verify --flags", lines);
    insta::assert_snapshot!(ran.transcript());
    // Without --flags the third line passes, and flags may be missing.
    let ran = alu("add --format fp16 --verify", "3C00 3C00 4000 01\n3C00 3C00 4000\n3C00 3C00 7E00\n");
    assert!(ran.stdout.ends_with("2 passed, 1 failed\n"), "{}", ran.stdout);
    assert_eq!(ran.code, Some(1));
}

#[test]
fn mismatches_for_machines() {
    let lines = "3C00 3C00 4001 00\n3C00 3C00 4000 00\n3C00 3C00 4002 00\n";
    let ran = alu("add --format fp16 --verify --json", lines);
    let report = ran.json();
    assert_eq!(report["passed"], 1);
    assert_eq!(report["failed"], 2);
    assert_eq!(report["mismatches"][1]["line"], 3);
    assert_eq!(report["mismatches"][1]["found"], "4000");
    assert_eq!(ran.code, Some(1));
    let ran = alu("add --format fp16 --verify --json", "3C00 3C00 4001 00\nbad\n");
    assert_eq!((ran.code, ran.stdout.as_str()), (Some(2), ""), "no half a document");
}

#[test]
fn a_long_line_is_not_echoed_whole() {
    let long = alu("add --format e3m2", &"F".repeat(4000)).refusal("a long line");
    assert!(long.len() < 400, "{long}");
}

#[test]
fn a_bad_line_comes_after_the_results_before_it() {
    let mut input = "3C00\n".repeat(10_000);
    input.push_str("bad!\n");
    let ran = alu("sqrt --format fp16", &input);
    assert_eq!(ran.code, Some(2));
    assert_eq!(ran.stdout.lines().count(), 10_000);
    assert!(ran.stderr.contains("line 10001"), "{}", ran.stderr);
}

/// A reader that closes the pipe early ends the program quietly; a command that checks still reports its verdict.
#[test]
#[cfg(unix)]
fn a_closed_pipe_is_no_error() {
    use std::process::{Command, Stdio};

    let run = |arguments: &[&str], line: &str| {
        let mut child = Command::new(crate::program::path())
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program that this test was built with");
        drop(child.stdout.take());
        let mut stdin = child.stdin.take().expect("a pipe was asked for");
        let input = line.repeat(100_000);
        // The program may end before it has read everything, or read nothing.
        std::io::Write::write_all(&mut stdin, input.as_bytes()).ok();
        drop(stdin);
        let output = child.wait_with_output().expect("the program runs to its end");
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        output.status.code()
    };
    assert_eq!(run(&["alu", "sqrt", "--format", "fp16"], "4400\n"), Some(0));
    assert_eq!(run(&["alu", "sqrt", "--format", "fp16", "--verify"], "4400 4001\n"), Some(1));
    let folder = tempfile::tempdir().expect("a folder for the test");
    let out = crate::answers::place(folder.path(), "out");
    let failing = ["x/3", "--goal", "mean_relative<=0", "--samples", "9", "--quiet", "--out", &out];
    assert_eq!(run(&[&["precision", "--expr"], &failing[..]].concat(), ""), Some(1));
    assert_eq!(run(&["diff", "docs/examples/exact.png", "docs/examples/leaky.png"], ""), Some(1));
}

#[test]
fn matrix_units_take_the_vectors_as_they_are() {
    let dot = |unit: &str, input: &str| results(&format!("dot --unit {unit}"), input);
    assert_eq!(dot("hopper-f16", "3C008C00 3C000C00 00000000\n3c00,3c00,3f800000"), ["3f7fffff", "40000000"]);
    assert_eq!(dot("volta_f16_f32", "3C008C00,3C000C00,00000000"), ["3f800000"]);
    for unit in ["blackwell_nvf4", "volta_f16_f32_c16"] {
        let path = format!("refsim/lanes/tests/matrix_vectors/{unit}.csv");
        let vectors = std::fs::read_to_string(path).expect("vectors");
        let ran = alu(&format!("dot --unit {unit} --verify"), &vectors);
        assert_eq!(ran.code, Some(0), "{unit}: {}", ran.stdout);
        assert_eq!(ran.stdout, format!("{} passed, 0 failed\n", vectors.lines().count() - 1), "{unit}");
    }
    let wrong = alu("dot --unit volta-f16 --verify", "3C00 3C00 00000000 3f800001\n");
    assert_eq!((wrong.code, wrong.stdout.lines().count()), (Some(1), 2), "{}", wrong.stdout);
    let short = alu("dot --unit hopper-f16 --verify", "3C00 3C00 00000000 3F8000");
    assert_eq!(short.code, Some(2), "{}", short.stdout);
}
