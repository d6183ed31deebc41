//! Expressions: compared bit for bit with mpmath, compared with results that Herbie publishes, and known answers.

use std::fmt::Write as _;
use std::path::Path;

use crossbar_studies::report::Verdict;
use crossbar_studies::study::precision::{ExpressionStudy, InputDraw};
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
    study.goal = Some("largest_relative<=0".parse().expect("a goal"));
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

/// Rounds to the nearest number with `e` exponent bits and `m` mantissa bits, to even at ties. The sums, products and
/// quotients of doubles here have more than twice as many bits as these formats, so that rounding twice is harmless.
fn nearest(x: f64, [e, m]: [i32; 2]) -> f64 {
    let power_of_two = |n: i32| f64::from_bits(u64::from((n + 1023).cast_unsigned()) << 52);
    let bias = (1 << (e - 1)) - 1;
    let top = (x.to_bits() >> 52 & 0x7ff) as i32 - 1023;
    let unit = power_of_two(top.max(1 - bias) - m);
    let rounded = (x / unit).round_ties_even() * unit;
    let largest = (2.0 - power_of_two(-m)) * power_of_two(bias);
    if rounded.abs() > largest { f64::INFINITY.copysign(x) } else { rounded }
}

/// The definition, tried over all formats: the fewest bits, then the smallest error, then the fewest exponent bits.
#[test]
fn the_smallest_format_is_the_smallest_of_all_that_meet_the_goal() {
    type Computed = fn(&dyn Fn(f64) -> f64) -> f64;
    let cases: [(&str, f64, Computed); 6] = [
        ("((2.301 - 1.930) - 2.961) / 0.581", 0.01, |r| r(r(r(r(2.301) - r(1.930)) - r(2.961)) / r(0.581))),
        ("((2.512 - 1.207) - 0.592) * 2.285", 0.001, |r| r(r(r(r(2.512) - r(1.207)) - r(0.592)) * r(2.285))),
        ("((0.514 * 2.116) / (1.660 * 1.799)) * 0.298", 0.01, |r| {
            r(r(r(r(0.514) * r(2.116)) / r(r(1.660) * r(1.799))) * r(0.298))
        }),
        ("((1.682 / 1.404) / 1.656) * (2.879 * 2.070)", 0.1, |r| {
            r(r(r(r(1.682) / r(1.404)) / r(1.656)) * r(r(2.879) * r(2.070)))
        }),
        ("1e5 * 1e-5 + 0.7", 1e-4, |r| r(r(r(1e5) * r(1e-5)) + r(0.7))),
        ("(1.0001 - 1) * 3", 1e-6, |r| r(r(r(1.0001) - 1.0) * 3.0)),
    ];
    for (text, bound, computed) in cases {
        let exact = computed(&|x| x);
        let error = |format: [i32; 2]| (computed(&|x| nearest(x, format)) / exact - 1.0).abs();
        let all = (2..=8).flat_map(|e| (1..=23).map(move |m| [e, m]));
        let met = all.map(|format| (format, error(format))).filter(|(_, error)| *error <= bound);
        let smallest = met.min_by(|([e, m], a), ([f, n], b)| (e + m).cmp(&(f + n)).then(a.total_cmp(b)));
        let expected = smallest.map_or(
            format!("No float format of up to 32 bits meets mean_relative<={bound}."),
            |([e, m], _)| {
                format!("Smallest float format that meets mean_relative<={bound}: e{e}m{m}, {} bits.", 1 + e + m)
            },
        );
        let mut study = formula(text, &[]);
        study.goal = Some(format!("mean_relative<={bound}").parse().expect("a goal"));
        assert_eq!(findings(&study).conclusions()[0], expected, "{text}");
    }
}

/// By hand: e2m1 has the numbers 0, 0.5, 1, 1.5, 2 and 3, so the squares of sine and cosine of 1, 1.5 and 2 round to 1
/// and 0. The polynomial is also 0 everywhere, but `1 - x` errs in all formats. No format that the table lists as
/// sufficient may have fewer bits than the smallest format.
#[test]
fn the_table_and_the_smallest_format_agree() {
    let said = |text: &str, range: &str, draw| {
        let mut study = formula(text, &[range]);
        (study.samples, study.draw) = (20, draw);
        let found = findings(&study);
        (found.conclusions()[0].clone(), found.plain_document())
    };
    let (smallest, _) = said("sin(x)^2 + cos(x)^2 - 1", "x=1..2", InputDraw::Floats);
    assert_eq!(smallest, "Smallest float format that meets mean_relative<=0.01: e2m1, 4 bits.");
    let (smallest, document) = said("(1 - x)*(1 + x) + x*x - 1", "x=0..1", InputDraw::Reals);
    let rows = document["formats"].as_array().expect("rows");
    let is_met = |row: &&serde_json::Value| row["met"] == true && row["format"] != "fp64";
    let least = rows.iter().filter(is_met).filter_map(|row| row["bits"].as_u64()).min();
    let named = smallest.rsplit_once(", ").and_then(|(_, bits)| bits.trim_end_matches(" bits.").parse().ok());
    assert!(named.unwrap_or(33) <= least.unwrap_or(33), "{smallest} {document}");
}

/// By hand: formats with up to five exponent bits end below 65,536, so that `x - x` is inf - inf; six end above 1e6.
#[test]
fn nan_in_place_of_zero_is_an_infinite_relative_error() {
    let mut study = formula("x - x", &["x=1e5..1e6"]);
    study.goal = Some("largest_relative<=1".parse().expect("a goal"));
    let found = findings(&study);
    assert_eq!(found.conclusions()[0], "Smallest float format that meets largest_relative<=1: e6m1, 8 bits.");
    for row in found.plain_document()["formats"].as_array().expect("rows") {
        let ends_below = ["e4m3", "e5m2", "fp16"].contains(&row["format"].as_str().expect("a name"));
        let expected = if ends_below { "inf".into() } else { serde_json::json!(0.0) };
        assert!(row["largest_relative"] == expected && row["met"] == !ends_below, "{row}");
        assert_eq!(row["mean_bits"].is_null(), ends_below, "there are no inputs: {row}");
    }
}

/// A range with few numbers or none is recognised without drawing any. For 100,000 inputs, a rejection sampler would
/// draw a hundred million.
#[test]
fn inputs_are_drawn_among_the_numbers_of_the_format_in_the_range() {
    let means = |text: &str, range: &str, format| {
        let mut study = formula(text, &[range]);
        study.samples = 100_000;
        study.mean_bits(format)[0]
    };
    for (range, format) in [
        ("x=1e5..1e6", Some(Format::FP16)),
        ("x=0.1..0.1", Some(Format::FP32)),
        ("x=1e300..1e305", Some(Format::FP32)),
        ("x=-1e-49..-1e-50", Some(Format::FP32)),
        ("x=1.00000000000000000000000000000000000001..1.0001", Some(Format::FP16)),
    ] {
        assert!(means("x + 1", range, format)[0].is_nan(), "{range}");
    }
    // The error of x in place of 1 tells which number was drawn: 0 bits for 1, and 1 bit for the next, 1 + 2^-10.
    let drawn = |bounds: &str| {
        let mut study = formula(&format!("(FPCore (x) :spec 1 :pre {bounds} x)"), &[]);
        study.samples = 1000;
        study.mean_bits(Some(Format::FP16))[0][0]
    };
    assert_eq!(drawn("(<= 1 x 1.0005)"), 0.0);
    assert_eq!(drawn("(and (< 1 x) (> 1.0015 x))"), 1.0);
    assert!((0.44..0.56).contains(&drawn("(<= 1 x 1.001)")));
    assert!(drawn("(< 1 x 1)").is_nan());
    assert!(drawn("(== x 1.0005)").is_nan());
}

#[test]
fn operations_are_named_in_full_and_inputs_can_be_read_back() {
    let mut study = formula("(x*x - y*y)/(x - y) * π", &["x=1000..1e6", "y=1e-12..1e-9"]);
    study.samples = 50;
    let document = findings(&study).plain_document();
    let texts: Vec<&str> =
        document["operations"].as_array().expect("rows").iter().filter_map(|row| row["operation"].as_str()).collect();
    assert!(texts.contains(&"(x*x - y*y)/(x - y)") && texts.contains(&"π"), "{texts:?}");
    for row in document["inputs"].as_array().expect("rows") {
        let Some(worst) = row["worst_input"].as_str() else { continue };
        let value = |word: &str| word.split_once('=').and_then(|(_, value)| value.parse::<f64>().ok());
        let values: Vec<f64> = worst.split(' ').filter_map(value).collect();
        assert!(matches!(values[..], [x, y] if x >= 1000.0 && y <= 1e-9), "{worst}");
    }
    // The result is `y`; `z` is not part of it.
    let mut study = formula("(FPCore (x) (let* ([y (+ x 1/3)] [z (* y y)]) y))", &["x=0..1"]);
    study.samples = 40;
    let document = findings(&study).plain_document();
    let rows = document["operations"].as_array().expect("rows").iter();
    assert_eq!(rows.map(|row| row["operation"].clone()).collect::<Vec<_>>(), ["1/3", "(+ x 1/3)"]);
    let known = formula("(true && !false ? π : 0) + x", &[]);
    let [exact, _] = known.results(known.taken().0[0], None, &[0]).expect("a result");
    assert_eq!(f64::from_bits(exact), std::f64::consts::PI);
}

/// Results of one operation on numbers of double precision.
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
        "(FPCore (x y x) x)",
        "1e999999999",
        "x + 1.2.3",
        "x + nan",
        "-INFINITY",
        "Inf",
        "e^x",
        "2*Pi",
    ] {
        let error = reason(text).expect_err(text);
        writeln!(said, "{text:?}: {}:{}: {}", error.1.0, error.1.1, error.0).expect("a string");
    }
    for ranges in ["x", "y=0..1", "x=1..0", "x=a..b", "x=0"] {
        let error = ExpressionStudy::of_formula("x*x", &[ranges.to_owned()]).expect_err(ranges);
        writeln!(said, "--range {ranges}: {error}").expect("a string");
    }
    let twice = ["x=1..2", "x=3..4"].map(str::to_owned);
    let error = ExpressionStudy::of_formula("x*x", &twice).expect_err("two ranges");
    writeln!(said, "--range x=1..2 --range x=3..4: {error}").expect("a string");
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
