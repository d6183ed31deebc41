//! Programs with known answers.

mod after_search;
mod expression;
mod goal;
mod needs;
mod systems;

use std::path::Path;

use crossbar_studies::case::Setup;
use crossbar_studies::report::Verdict;
use crossbar_studies::study::Study as _;
use crossbar_studies::study::precision::{CaseSubject, FormatFamily, Precision, PrecisionSubject};
use refsim::device::{Profile, takes_format};
use refsim::isa::Program;
use refsim::num::Format;
use serde_json::Value;

use super::{StudyFiles, findings};

/// Case with a ps_2_0 program, given without its first and last line; the program leaves its result in `r0`.
fn case(body: &str, constants: &str) -> String {
    let program = format!("ps_2_0\n{body}\nmov oC0, r0\n");
    format!(
        "shader_model = \"ps_2_0\"\nformat = \"fp32\"\n[pixel]\nsource = \"\"\"\n{program}\"\"\"\n[constants]\n{constants}\n\
         [geometry]\nfull_screen = true\n[target]\nsize = [2, 2]\nformat = \"rgba32f\"\n"
    )
}

fn setup(case: &str) -> Setup {
    Setup::from_bytes("case.toml", case.as_bytes(), Path::new("")).expect("a case")
}

fn subject(case: &str) -> CaseSubject {
    CaseSubject::new(setup(case), "case").expect("it is drawn")
}

fn study(case: &str, goal: &str, families: &[FormatFamily]) -> Precision {
    study_of(Box::new(subject(case)), goal, families)
}

fn study_of(subject: Box<dyn PrecisionSubject>, goal: &str, families: &[FormatFamily]) -> Precision {
    Precision { subject, goal: Some(goal.parse().expect("a goal")), families: families.to_vec(), budget: 10_000 }
}

fn document(study: &Precision) -> Value {
    findings(study).plain_document()
}

fn column<'d>(document: &'d Value, table: &str, key: &str) -> Vec<&'d Value> {
    let rows = document[table].as_array().unwrap_or_else(|| panic!("no {table} in {document}"));
    rows.iter().map(|row| row.get(key).unwrap_or_else(|| panic!("no {key} in {row}"))).collect()
}

fn texts(document: &Value, table: &str, key: &str) -> Vec<String> {
    column(document, table, key).into_iter().map(|cell| cell.as_str().expect("a text").to_owned()).collect()
}

/// Layout of a format, `eXmY` or `sI.F`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Layout {
    family: FormatFamily,
    /// Bits of the exponent or of the integer part.
    range: u8,
    /// Bits of the mantissa or of the fraction.
    digits: u8,
}

impl Layout {
    fn of(text: &str) -> Self {
        let (family, middle) = match text.as_bytes()[0] {
            b'e' => (FormatFamily::Float, 'm'),
            _ => (FormatFamily::Fixed, '.'),
        };
        let (range, digits) = text[1..].split_once(middle).expect("a layout");
        Self { family, range: range.parse().expect("bits"), digits: digits.parse().expect("bits") }
    }

    /// Layouts with one bit less: floats keep at least two exponent bits and a mantissa bit, fixed point a bit in
    /// addition to its sign.
    fn narrower(self) -> Vec<String> {
        let digits = self.digits.checked_sub(1).map(|digits| Self { digits, ..self });
        let range = self.range.checked_sub(1).map(|range| Self { range, ..self });
        let is_legal = |less: &Self| match self.family {
            FormatFamily::Float => less.range >= 2 && less.digits >= 1,
            FormatFamily::Fixed => less.range + less.digits > 0,
        };
        digits.into_iter().chain(range).filter(is_legal).map(|less| less.to_string()).collect()
    }
}

impl std::fmt::Display for Layout {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.family {
            FormatFamily::Float => write!(f, "e{}m{}", self.range, self.digits),
            FormatFamily::Fixed => write!(f, "s{}.{}", self.range, self.digits),
        }
    }
}

fn digits(cell: &Value) -> Option<u8> {
    cell.as_str().map(|text| Layout::of(text).digits)
}

/// Device of the exact run: registers in single precision.
fn exact_device(subject: &dyn PrecisionSubject) -> Profile {
    let mut device = subject.profile().clone();
    let single = Format::FP32.with_specials(device.rules.format.specials);
    device.set_format(single).expect("single precision is a format of registers");
    device
}

/// Instructions that can have their own format.
fn places(program: &Program) -> impl Iterator<Item = usize> {
    (0..program.instructions.len()).filter(|at| takes_format(&program.instructions[*at]))
}

/// Device for a subject with one program, with a format per instruction.
fn device_with(subject: &dyn PrecisionSubject, formats: &[String]) -> Profile {
    let (mut device, program) = (exact_device(subject), subject.programs()[0].program);
    let own = places(program).zip(formats).map(|(at, text)| (at, text.parse().expect("a format"))).collect();
    assert!(device.set_instruction_formats(program, own));
    device
}

/// Smallest uniform formats of both families.
fn minima(case: &str) -> Vec<String> {
    let document = document(&study(case, "largest_absolute=0", &[FormatFamily::Float, FormatFamily::Fixed]));
    column(&document, "families", "minimum")
        .into_iter()
        .map(|cell| cell.as_str().unwrap_or("none").to_owned())
        .collect()
}

/// A term, 3/4, has two significant bits. Of the partial sums, 3 (n - 1) / 4 has the most, log2 n more than the term,
/// and all sums are below n. Truncation never recovers what it lost.
#[test]
fn a_sum_of_n_equal_terms_needs_log2_n_more_bits() {
    for (n, expected) in [(4, ["e2m3", "s2.2"]), (8, ["e3m4", "s3.2"]), (16, ["e3m5", "s4.2"])] {
        let body = format!("mov r0, c0\n{}", "add r0, r0, c0\n".repeat(n - 1));
        let case = case(&body, "c0 = [0.75, 0.75, 0.75, 0.75]").replace("fp32", "fp32:rtz");
        assert_eq!(minima(&case), expected, "{n} terms");
    }
}

/// x^3 - x^2 + x/4 + 1/4 at 3/2 is 7/4. By Horner's rule the results are 1/2, 1 and 7/4; the powers are 9/4 and 27/8,
/// which has four bits after the first.
#[test]
fn horners_rule_needs_fewer_bits_than_powers() {
    let constants = "c0 = [1.5, 1.5, 1.5, 1.5]\nc1 = [-1, -1, -1, -1]\nc2 = [0.25, 0.25, 0.25, 0.25]";
    let horner = "mov r0, c0\nadd r1, r0, c1\nmad r1, r1, r0, c2\nmad r0, r1, r0, c2";
    assert_eq!(minima(&case(horner, constants)), ["e2m2", "s1.2"]);
    let powers = "mov r0, c0\nmul r1, r0, r0\nmul r2, r1, r0\nmad r2, r1, c1, r2\nmad r2, r0, c2, r2\nadd r0, r2, c2";
    assert_eq!(minima(&case(powers, constants)), ["e2m4", "s2.3"]);
}

/// Instruction 1 is never read; only instruction 0 affects the result.
#[test]
fn a_dead_instruction_has_no_blame() {
    let body = "mul r0, c0, c0\nmul r1, c1, c1";
    let constants = "c0 = [1.0625, 1, 1, 1]\nc1 = [1.3, 1.7, 1.1, 1.9]";
    let document = document(&study(&case(body, constants), "largest_absolute=0", &[FormatFamily::Float]));
    let needs = |key: &str| column(&document, "instructions_float", key);
    // 1.0625 squared is 289/256.
    assert_eq!(digits(&document["families"][0]["minimum"]), Some(8));
    assert_eq!(needs("blame_percent"), [100.0, 0.0, 100.0]);
    assert_eq!(needs("regained_percent")[..2], [0.0, 0.0]);
    assert_eq!((needs("alone")[..2].to_vec(), needs("others_at_minimum")[1]), (vec![&8.into(), &1.into()], &1.into()));
    assert_eq!(needs("note")[1], "no effect");
}

const POLYNOMIAL: &str = "mov r0, t0\nmad r1, r0, c0, c1\nmad r1, r1, r0, c2\nmul r0, r1, r0\nmad r0, r0, c3, r0";

/// Case whose instructions need different formats, and whose pixels have different values.
fn polynomial() -> String {
    let constants = "c0 = [0.3, 0.2, 0.1, 0.4]\nc1 = [0.7, 0.6, 0.5, 0.8]\nc2 = [1.1, 0.9, 1.3, 1.7]\nc3 = [0.01, 0.02, 0.03, 0.04]";
    case(&format!("dcl t0\n{POLYNOMIAL}"), constants)
        .replace("size = [2, 2]", "size = [8, 8]")
        .replace("rgba32f", "rgba8")
}

#[test]
fn a_mixed_assignment_meets_the_goal_and_one_bit_less_does_not() {
    let study = study(&polynomial(), "largest_codes<=1", &[FormatFamily::Float, FormatFamily::Fixed]);
    let document = document(&study);
    let largest = |formats: &[String]| {
        let device = device_with(&*study.subject, formats);
        study.subject.measure(&device, None).expect("it runs").value("largest_codes")
    };
    for (number, family) in ["float", "fixed"].into_iter().enumerate() {
        let found = &document["families"][number];
        let minimum: Format = found["minimum"].as_str().expect("one of 32 bits does").parse().expect("a format");
        let mixed = texts(&document, &format!("mixed_{family}"), "format");
        let bits = found["mixed_bits"].as_u64().expect("bits");
        assert!(found["one_minimal"] == true && bits <= u64::from(minimum.width()) * mixed.len() as u64);
        assert!(largest(&mixed) <= 1.0, "{mixed:?}");
        let mut refuted = Vec::new();
        for (place, format) in mixed.iter().enumerate() {
            for less in Layout::of(format).narrower() {
                let mut formats = mixed.clone();
                formats[place].clone_from(&less);
                assert!(largest(&formats) > 1.0, "{less} for {format} at {place}");
                refuted.push(less);
            }
        }
        let table = format!("refuted_{family}");
        assert_eq!(texts(&document, &table, "format"), refuted);
        let places = column(&document, &table, "largest_error_at_column_row");
        assert!(places.iter().all(|place| place.is_string()), "{places:?}");
    }
}

/// The device file, written by a study, with its mixed formats.
fn mixed_device(study: &Precision) -> Profile {
    let files = StudyFiles::of(study);
    let text = std::str::from_utf8(files.bytes("mixed.toml")).expect("text");
    Profile::from_device_file(text).expect("a device file")
}

#[test]
fn a_budget_that_runs_out_leaves_the_best_so_far() {
    let of_budget = |budget: u64| {
        let study = Precision { budget, ..study(&polynomial(), "largest_codes<=1", &[FormatFamily::Float]) };
        let document = document(&study);
        assert!(document["runs"].as_u64() <= Some(budget));
        assert_eq!(document["budget_spent"], budget < 10_000);
        let family = &document["families"][0];
        (family["one_minimal"].as_bool(), family["mixed_bits"].as_u64())
    };
    let (_, fewest) = of_budget(10_000);
    let mut seen = Vec::new();
    for budget in [1, 3, 20, 40, 60, 80, 10_000] {
        let (is_minimal, found) = of_budget(budget);
        assert!(found.is_none() || found >= fewest, "{budget}");
        seen.push(is_minimal);
    }
    assert!(seen.contains(&None) && seen.contains(&Some(false)) && seen.last() == Some(&Some(true)), "{seen:?}");
    let study = Precision { budget: 60, ..study(&polynomial(), "largest_codes<=1", &[FormatFamily::Float]) };
    let said = findings(&study).conclusions().join(" ");
    assert!(said.contains("after 60 runs"), "{said}");
}

#[test]
fn goals_that_tell_nothing_are_said() {
    let error = |case: &str, goal: &str| {
        let error = study(case, goal, &[FormatFamily::Float]).findings(&mut |_, _, _| {}).expect_err(goal);
        error.to_string()
    };
    let case = polynomial();
    assert_eq!(
        error(&case, "largest_codes<=-1"),
        "expected a goal that the exact run meets, found largest_codes<=-1, and largest_codes 0 there"
    );
    assert!(error(&case, "leaks=0").starts_with("expected a goal for largest_codes, mean_relative, "));
    let every =
        study(&case, "largest_codes<=255", &[FormatFamily::Float]).findings(&mut |_, _, _| {}).expect("it runs");
    assert!(every.conclusions().join(" ").contains("Every float format meets the goal, down to e2m1"));
    let none =
        study(&case, "largest_relative<=0", &[FormatFamily::Fixed]).findings(&mut |_, _, _| {}).expect("it runs");
    assert_eq!(none.verdict(), Verdict::Done, "the codes of a target hide small errors");
    let budget = Precision { budget: 0, ..study(&case, "largest_codes<=1", &[FormatFamily::Float]) };
    let error = budget.findings(&mut |_, _, _| {}).expect_err("no runs");
    assert_eq!(error.to_string(), "expected a budget of 1 run or more, found 0");
}

#[test]
fn a_program_without_instructions_is_refused() {
    let case = "shader_model = \"!!ARBfp1.0\"\nformat = \"fp32\"\n[pixel]\nsource = \"!!ARBfp1.0\\nEND\"\n[geometry]\n\
                full_screen = true\n[target]\nsize = [2, 2]\nformat = \"rgba8\"\n";
    let error =
        study(case, "largest_codes<=1", &[FormatFamily::Float]).findings(&mut |_, _, _| {}).expect_err("nothing");
    assert_eq!(error.to_string(), "case.toml [pixel]: expected instructions that compute or read texels, found none");
}

/// 1 / 0 is infinite in floats and the largest number in fixed point.
#[test]
fn infinite_values_are_counted_and_said() {
    let body = "mov r1, c0\nrcp r0.x, r1.x\nmov r0.yzw, r1";
    let study = study(&case(body, "c0 = [0, 1, 1, 1]"), "not_finite=0", &[FormatFamily::Float, FormatFamily::Fixed]);
    let found = study.findings(&mut |_, _, _| {}).expect("it runs");
    let said = found.conclusions().join(" ");
    assert!(said.contains("Every float format meets the goal") && said.contains("No fixed format meets"), "{said}");
    assert_eq!(study.subject.notes(), ["Of 16 channels of the exact run, 4 are infinite or NaN."]);
}

/// `mad` rounds once or twice: the switch determines how many bits a difference of close products needs.
#[test]
fn a_switch_that_matters_is_found() {
    let body = "mov r1, c0\nmad r0, r1, r1, c1";
    let case = case(body, "c0 = [1.0625, 1.0625, 1.0625, 1.0625]\nc1 = [-1.125, -1.125, -1.125, -1.125]");
    let document = document(&study(&case, "largest_absolute=0", &[FormatFamily::Float]));
    let rows = document["switches"].as_array().expect("switches");
    let minimum = |name: &str, value: &str| {
        let row = rows.iter().find(|row| row["switch"] == name && row["value"] == value).expect("a switch");
        digits(&row["minimum"])
    };
    // The square, 289/256, has 8 fraction bits; 289/256 - 288/256 has one significant bit, and 1.0625 four fraction
    // bits.
    assert_eq!([minimum("mad", "two-roundings"), minimum("mad", "fused")], [Some(8), Some(4)]);
    assert_eq!(minimum("lrp", "two-products"), Some(8));
}
