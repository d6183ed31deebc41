//! Expressions: compared bit for bit with mpmath, compared with results that Herbie publishes, and known answers.

use std::fmt::Write as _;
use std::path::Path;

use crossbar_studies::report::Verdict;
use crossbar_studies::study::precision::ExpressionStudy;
use proptest::prelude::*;
use refsim::num::Format;

use super::super::findings;

/// The study of a file from `fixtures/fpbench`.
fn fixture(name: &str) -> (ExpressionStudy, String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/fpbench").join(name);
    let text = std::fs::read_to_string(&path).expect("a fixture");
    (ExpressionStudy::of_file(&path, &[]).expect("FPCore"), text)
}

fn formula(text: &str, ranges: &[&str]) -> ExpressionStudy {
    let ranges: Vec<String> = ranges.iter().map(|range| (*range).to_owned()).collect();
    ExpressionStudy::of_formula(text, &ranges).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn hexadecimal(word: &str) -> u64 {
    u64::from_str_radix(word, 16).expect("a pattern")
}

#[test]
fn exact_and_computed_results_are_those_of_mpmath() {
    let (study, _) = fixture("hamming.fpcore");
    let table =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/fpbench/binary32.csv"))
            .expect("a table");
    // mpmath has only one zero.
    let unsigned_zero = |bits: u64| if bits == 0x8000_0000 { 0 } else { bits };
    let mut compared = 0;
    for line in table.lines().skip(1) {
        let (name, rest) = line.trim_start_matches('"').split_once("\",").expect("a quoted name");
        let [inputs, exact, computed] = rest.split(',').collect::<Vec<_>>()[..] else { panic!("{line}") };
        let inputs: Vec<u64> = inputs.split(' ').map(hexadecimal).collect();
        let found = study.results(name, Some(Format::FP32), &inputs).map(|pair| pair.map(unsigned_zero));
        assert_eq!(found, Some([exact, computed].map(|word| unsigned_zero(hexadecimal(word)))), "{line}");
        compared += 1;
    }
    assert_eq!(compared, 1080);
}

/// The means of two samples differ by less than four standard errors plus a tenth of a bit: Herbie uses 8,000 points.
#[test]
fn herbies_published_errors_are_reproduced() {
    let (mut study, text) = fixture("hamming.fpcore");
    study.samples = if std::env::var_os("CROSSBAR_FULL").is_some() { 8000 } else { 500 };
    let share = study.samples as f64 / 8000.0;
    let published = text.split("(FPCore").skip(1).map(|core| {
        let value = core.split(":published ").nth(1)?.split_whitespace().next()?;
        Some(value.parse::<f64>().expect("a number"))
    });
    let (mut faults, mut compared) = (String::new(), 0);
    for ((name, [mean, error]), published) in study.taken().0.into_iter().zip(study.mean_bits(None)).zip(published) {
        let Some(published) = published else { continue };
        compared += 1;
        if (mean - published).abs() > 4.0 * error * (1.0 + share).sqrt() + 0.1 {
            writeln!(faults, "{name}: {mean:.2} +- {error:.2}, published {published:.2}").expect("a string");
        }
    }
    assert!(faults.is_empty() && compared == 25, "{compared} compared\n{faults}");
}

#[test]
fn the_suite_runs_but_for_its_loop() {
    let (mut study, _) = fixture("suite.fpcore");
    study.samples = 50;
    let (taken, refused) = study.taken();
    assert_eq!((taken.len(), refused.len()), (32, 1));
    assert_eq!(refused[0].to_string(), "`while`: loops are not supported: expressions are straight-line");
    for (name, [mean, _]) in taken.iter().zip(study.mean_bits(Some(Format::FP32))) {
        // Rump's example has no correct digit; the others lose few bits within their ranges.
        let most = if *name == "rump" { 30.0 } else { 4.0 };
        assert!((0.0..most).contains(&mean), "{name}: {mean}");
    }
}

#[test]
fn an_exact_expression_meets_every_goal_and_blames_nothing() {
    let mut study = formula("2*x", &["x=1..2"]);
    study.goal = Some("worst_bits<=0".parse().expect("a goal"));
    let found = findings(&study);
    assert_eq!(found.verdict(), Verdict::Done);
    let document = found.plain_document();
    assert_eq!(document["operations"], serde_json::json!([]), "{document}");
    assert!(document["formats"].as_array().expect("rows").iter().all(|row| row["mean_bits"] == 0.0), "{document}");
}

#[test]
fn cancellation_is_blamed_on_the_rounding_before_it() {
    let mut study = formula("sqrt(x + 1) - sqrt(x)", &["x=1..100"]);
    study.samples = 100;
    let found = findings(&study);
    assert_eq!(found.verdict(), Verdict::Done, "{:?}", found.conclusions());
    let rows = found.plain_document()["operations"].clone();
    let of =
        |text: &str| rows.as_array().expect("rows").iter().find(|row| row["operation"] == text).expect(text).clone();
    // The difference is exact (Sterbenz); the roots are not, and each alone loses the bits.
    assert!(of("sqrt(x + 1)")["alone_bits"].as_f64() > Some(2.0) && of("sqrt(x)")["alone_bits"].as_f64() > Some(2.0));
    assert!(of("sqrt(x)")["local_bits"] == 0.0 && of("sqrt(x + 1) - sqrt(x)")["local_bits"].as_f64() > Some(2.0));
}

/// Results of one operation on numbers in double precision.
#[test]
fn operations_have_the_results_of_c_at_zeros_infinities_and_ties() {
    let bits = f64::to_bits;
    let inf = f64::INFINITY;
    let cases: [(&str, &[f64], f64); 21] = [
        ("(pow x y)", &[9.0, 1.5], 27.0),
        ("(pow x y)", &[-8.0, 3.0], -512.0),
        ("(pow x y)", &[-0.0, -3.0], -inf),
        ("(pow x y)", &[0.5, inf], 0.0),
        ("(pow x y)", &[f64::NAN, 0.0], 1.0),
        ("(exp2 x)", &[-1075.0], 0.0),
        ("(exp2 x)", &[-1074.0], 5e-324),
        ("(log2 x)", &[0.125], -3.0),
        ("(log x)", &[-0.0], -inf),
        ("(log1p x)", &[-1.0], -inf),
        ("(atanh x)", &[1.0], inf),
        ("(exp x)", &[-inf], 0.0),
        ("(tanh x)", &[inf], 1.0),
        ("(cbrt x)", &[-27.0], -3.0),
        ("(hypot x y)", &[3.0, 4.0], 5.0),
        ("(fma x y y)", &[0.1, 10.0], 11.0),
        ("(sin x)", &[-0.0], -0.0),
        ("(atan2 x y)", &[-0.0, -1.0], -std::f64::consts::PI),
        ("(atan2 x y)", &[inf, -inf], 3.0 * std::f64::consts::FRAC_PI_4),
        ("(fmin x y)", &[f64::NAN, 2.0], 2.0),
        ("(if (< x y) x y)", &[f64::NAN, 2.0], 2.0),
    ];
    for (text, inputs, expected) in cases {
        let study = formula(&format!("(FPCore (x y) :spec 0 {text})"), &[]);
        let inputs: Vec<u64> = inputs.iter().chain(&[0.0; 2]).take(2).map(|x| bits(*x)).collect();
        // A constant is the intended result, so that inputs may be infinite.
        let [_, computed] = study.results("line 1", None, &inputs).expect("a result");
        assert_eq!(f64::from_bits(computed).to_string(), expected.to_string(), "{text} of {inputs:x?}");
    }
}

#[test]
fn refusals_have_a_place_and_a_reason() {
    let reason = |text: &str| {
        ExpressionStudy::of_formula(text, &[]).map_err(|error| (error.to_string(), error.line_and_column()))
    };
    let mut said = String::new();
    for text in [
        "sqrt(x",
        "x +",
        "sqr(x)",
        "sqrt(x, y)",
        "x < 1",
        "1 +\n erf(x)",
        "(FPCore (x) (! :precision binary32 x))",
        "(FPCore (x) (tensor ([i 3]) x))",
        "(FPCore (x) :pre (+ x 1) x)",
        "(FPCore (x) (let ([y 1] [z y]) z))",
        "(FPCore (x y)\n  (if (< x y) x (< x y)))",
        "(FPCore ((! :precision binary32 x)) x)",
        "(FPCore (x) INFINITY)",
        "(FPCore (x) (+ x 1]",
        "(FPCore (x) x))",
        "(FPCore (x) 1/0)",
    ] {
        let error = reason(text).expect_err(text);
        writeln!(said, "{text:?}: {}:{}: {}", error.1.0, error.1.1, error.0).expect("a string");
    }
    for ranges in ["x", "y=0..1", "x=1..0", "x=a..b", "x=0"] {
        let error = ExpressionStudy::of_formula("x*x", &[ranges.to_owned()]).expect_err(ranges);
        writeln!(said, "--range {ranges}: {error}").expect("a string");
    }
    insta::assert_snapshot!(said);
}

#[test]
fn deep_and_long_texts_are_refused_or_taken() {
    for text in [
        "(".repeat(100_000),
        "-".repeat(100_000),
        "sqrt(".repeat(5000),
        "x+".repeat(100_000) + "x",
        "1e999999999".into(),
    ] {
        assert!(ExpressionStudy::of_formula(&text, &[]).is_err());
    }
    let nested = |n: usize| format!("(FPCore (x) {}x{})", "(sqrt ".repeat(n), ")".repeat(n));
    assert!(ExpressionStudy::of_formula(&nested(150), &[]).is_ok());
    assert!(ExpressionStudy::of_formula(&nested(100_000), &[]).is_err());
}

proptest! {
    #[test]
    fn no_text_panics(text in r#"[-+*/^()\[\]<>=!&|?:,;." a-z0-9]{0,60}"#, any in ".{0,40}") {
        let core = format!("(FPCore (x) {text})");
        for text in [text, core, any] {
            // The text may be a formula or not.
            drop(ExpressionStudy::of_formula(&text, &[]));
        }
    }

    /// A formula and its FPCore form give the same expression.
    #[test]
    fn infix_and_fpcore_agree(a in 1u32..1000, b in 1u32..1000, x in 0u64..0x7f80_0000) {
        let infix = formula(&format!("-x^2 - {a}/{b} + x*{b}"), &[]);
        let core = formula(&format!("(FPCore (x) (+ (- (- (pow x 2)) (/ {a} {b})) (* x {b})))"), &[]);
        let of = |study: &ExpressionStudy| study.results(study.taken().0[0], Some(Format::FP32), &[x]);
        prop_assert_eq!(of(&infix), of(&core));
    }
}
