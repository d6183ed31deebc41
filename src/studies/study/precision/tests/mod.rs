//! Programs with known answers.

mod after_search;

use std::path::Path;

use refsim::device::Profile;
use refsim::machine::ExecutorKind;

use super::bits::FormatBits;
use super::outcome::PrecisionOutcome;
use super::runs::Runs;
use super::*;
use crate::case::Setup;
use crate::report::Verdict;

/// Case of a ps_2_0 program without its first and last line: it leaves its result in `r0`.
fn case(body: &str, constants: &str) -> String {
    let program = format!("ps_2_0\n{body}\nmov oC0, r0\n");
    format!(
        "shader_model = \"ps_2_0\"\nformat = \"fp32\"\n[pixel]\nsource = \"\"\"\n{program}\"\"\"\n[constants]\n{constants}\n\
         [geometry]\nfull_screen = true\n[target]\nsize = [2, 2]\nformat = \"rgba32f\"\n"
    )
}

fn study(case: &str, goal: &str, families: &[FormatFamily]) -> Precision {
    let setup = Setup::from_bytes("case.toml", case.as_bytes(), Path::new("")).expect("a case");
    Precision {
        subject: Box::new(CaseSubject::new(setup, "case").expect("it is drawn")),
        goal: Some(goal.parse().expect("a goal")),
        families: families.to_vec(),
        budget: 10_000,
        costs: FormatCosts::default(),
        known: KnownRuns::default(),
    }
}

/// Runs a study and looks at what it found.
fn with_outcome<T>(study: &Precision, look: impl FnOnce(&PrecisionOutcome, &mut Runs<'_>) -> T) -> T {
    let goal = study.goal().expect("a goal");
    let mut progress = |_: &str, _, _| {};
    let mut runs = study.runs(&goal, &study.known, &mut progress).expect("instructions");
    let outcome = study.outcome(&mut runs).expect("it runs");
    look(&outcome, &mut runs)
}

/// Smallest uniform formats.
fn minima(case: &str) -> Vec<String> {
    let study = study(case, "largest_absolute=0", &[FormatFamily::Float, FormatFamily::Fixed]);
    with_outcome(&study, |outcome, _| {
        let minimum =
            |family: &outcome::FamilyOutcome| family.curve.minimum.map_or("none".to_owned(), |m| m.to_string());
        outcome.families.iter().map(minimum).collect()
    })
}

/// A term of two significant bits, 3/4: of the partial sums 3 (n - 1) / 4 has the most bits, log2 n more than the term,
/// and n terms reach below n. Truncation never makes good what it lost.
#[test]
fn a_sum_of_n_equal_terms_needs_log2_n_more_bits() {
    for (n, expected) in [(4, ["e2m3", "s2.2"]), (8, ["e3m4", "s3.2"]), (16, ["e3m5", "s4.2"])] {
        let body = format!("mov r0, c0\n{}", "add r0, r0, c0\n".repeat(n - 1));
        let case = case(&body, "c0 = [0.75, 0.75, 0.75, 0.75]").replace("fp32", "fp32:rtz");
        assert_eq!(minima(&case), expected, "{n} terms");
    }
}

#[test]
fn a_product_of_powers_of_two_needs_no_mantissa() {
    let body = "mov r0, c0\nmul r0, r0, c1\nmul r0, r0, c1\nmul r0, r0, c1";
    let constants = "c0 = [0.25, 0.25, 0.25, 0.25]\nc1 = [2, 2, 2, 2]";
    // The largest is 2, which fixed point has with two integer bits.
    assert_eq!(minima(&case(body, constants)), ["e3m1", "s2.2"]);
}

/// x^3 - x^2 + x/4 + 1/4 at 3/2 is 7/4. By Horner's rule the results are 1/2, 1 and 7/4; the powers are 9/4 and 27/8,
/// which has four bits behind the first.
#[test]
fn horners_rule_needs_fewer_bits_than_powers() {
    let constants = "c0 = [1.5, 1.5, 1.5, 1.5]\nc1 = [-1, -1, -1, -1]\nc2 = [0.25, 0.25, 0.25, 0.25]";
    let horner = "mov r0, c0\nadd r1, r0, c1\nmad r1, r1, r0, c2\nmad r0, r1, r0, c2";
    assert_eq!(minima(&case(horner, constants)), ["e2m2", "s1.2"]);
    let powers = "mov r0, c0\nmul r1, r0, r0\nmul r2, r1, r0\nmad r2, r1, c1, r2\nmad r2, r0, c2, r2\nadd r0, r2, c2";
    assert_eq!(minima(&case(powers, constants)), ["e2m4", "s2.3"]);
}

#[test]
fn a_program_that_saturates_needs_its_integer_bits() {
    let body = "mov r0, c0\nadd r0, r0, c1\nsub r0, r0, c1";
    let constants = "c0 = [0.25, 0.25, 0.25, 0.25]\nc1 = [6, 6, 6, 6]";
    assert_eq!(minima(&case(body, constants)), ["e3m4", "s3.2"]);
}

/// Instruction 1 is never read; instruction 0 alone decides.
#[test]
fn a_dead_instruction_has_no_blame() {
    let body = "mul r0, c0, c0\nmul r1, c1, c1";
    let constants = "c0 = [1.0625, 1, 1, 1]\nc1 = [1.3, 1.7, 1.1, 1.9]";
    let study = study(&case(body, constants), "largest_absolute=0", &[FormatFamily::Float]);
    with_outcome(&study, |outcome, _| {
        let needs = &outcome.families[0].needs;
        // 1.0625 squared is 289/256.
        assert_eq!(outcome.families[0].curve.minimum.map(|m| m.digits), Some(8));
        assert_eq!([needs[0].blame, needs[1].blame, needs[2].blame], [Some(1.0), Some(0.0), Some(1.0)]);
        assert_eq!([needs[0].regained, needs[1].regained], [Some(0.0), Some(0.0)]);
        assert_eq!([needs[0].alone, needs[1].alone, needs[1].in_company], [Some(8), Some(1), Some(1)]);
    });
    let found = study.findings(&mut |_, _, _| {}).expect("it runs");
    let document = found.plain_document();
    assert_eq!(document["instructions_float"][1]["note"], "no effect", "{document}");
}

/// Ranges are those of the exact results, and a local error is that of one operation on exact operands.
#[test]
fn ranges_and_local_errors_are_those_of_the_results() {
    let body = "mul r0, c0, c0\nmul r0, r0, c1";
    let study = study(
        &case(body, "c0 = [3, 3, 3, 3]\nc1 = [0.125, 0.125, 0.125, 0.125]"),
        "largest_relative<=0.2",
        &[FormatFamily::Float],
    );
    with_outcome(&study, |outcome, _| {
        let exponents: Vec<_> = outcome.ranges.iter().map(|range| range.expect("traced").exponents).collect();
        assert_eq!(exponents, [Some([3, 3]), Some([0, 0]), Some([0, 0])]);
        let family = &outcome.families[0];
        assert_eq!(family.curve.minimum.map(|m| m.digits), Some(1));
        // 9 in steps of 4 is 8, and 9/8 in steps of 1/2 is 1.
        let local: Vec<_> = family.needs.iter().map(|needs| needs.local.map(|l| [l.median, l.largest])).collect();
        assert_eq!(local, [Some([0.25; 2]), Some([0.25; 2]), Some([0.25; 2])]);
    });
}

const POLYNOMIAL: &str = "mov r0, t0\nmad r1, r0, c0, c1\nmad r1, r1, r0, c2\nmul r0, r1, r0\nmad r0, r0, c3, r0";

/// Case whose instructions need different formats, with pixels of different values.
fn polynomial() -> String {
    let constants = "c0 = [0.3, 0.2, 0.1, 0.4]\nc1 = [0.7, 0.6, 0.5, 0.8]\nc2 = [1.1, 0.9, 1.3, 1.7]\nc3 = [0.01, 0.02, 0.03, 0.04]";
    case(&format!("dcl t0\n{POLYNOMIAL}"), constants)
        .replace("size = [2, 2]", "size = [8, 8]")
        .replace("rgba32f", "rgba8")
}

#[test]
fn a_mixed_assignment_meets_the_goal_and_one_bit_less_does_not() {
    let study = study(&polynomial(), "largest_codes<=1", &[FormatFamily::Float, FormatFamily::Fixed]);
    with_outcome(&study, |outcome, runs| {
        for family in &outcome.families {
            let minimum = family.curve.minimum.expect("one of 32 bits does");
            let mixed = family.mixed.as_ref().expect("the smallest uniform format at least");
            assert!(mixed.is_minimal && mixed.cost <= f64::from(minimum.width()) * mixed.formats.len() as f64);
            let scalar = |formats: &[FormatBits]| {
                let formats: Vec<_> = formats.iter().copied().map(Some).collect();
                let device = runs.device(runs.subject.profile(), &formats).expect("few formats");
                runs.shown(&device, ExecutorKind::Scalar).expect("it runs").value("largest_codes")
            };
            assert!(scalar(&mixed.formats) <= 1.0, "{:?}", mixed.formats);
            assert_eq!(family.checked, Some(scalar(&mixed.formats)));
            let mut refuted = 0;
            for (place, bits) in mixed.formats.iter().enumerate() {
                for less in bits.narrower() {
                    let mut formats = mixed.formats.clone();
                    formats[place] = less;
                    assert!(scalar(&formats) > 1.0, "{less} for {bits} at {place}");
                    refuted += 1;
                }
            }
            assert_eq!(mixed.refuted.len(), refuted);
        }
    });
}

#[test]
fn the_mixed_device_draws_what_was_found() {
    let study = study(&polynomial(), "largest_codes<=1", &[FormatFamily::Fixed]);
    let mut found = study.findings(&mut |_, _, _| {}).expect("it runs");
    assert_eq!(found.verdict(), Verdict::Done);
    let document = found.plain_document();
    let files = found.take_files(&Provenance::new("test")).expect("files");
    let (_, text) = files.iter().find(|(name, _)| name == "mixed.toml").expect("a device");
    let device = Profile::from_device_file(std::str::from_utf8(text).expect("text")).expect("a device file");
    assert_eq!(device.instruction_formats().iter().map(|(_, formats)| formats.len()).sum::<usize>(), 6);
    let value = study.subject.measure(&device, ExecutorKind::Scalar, None).expect("it runs").value("largest_codes");
    assert_eq!(document["families"][0]["scalar"], value);
}

#[test]
fn a_budget_that_runs_out_leaves_the_best_so_far() {
    let case = polynomial();
    let full = study(&case, "largest_codes<=1", &[FormatFamily::Float]);
    let runs_of = |budget: u64| {
        let study = Precision { budget, ..study(&case, "largest_codes<=1", &[FormatFamily::Float]) };
        with_outcome(&study, |outcome, runs| {
            assert!(runs.made <= budget);
            let mixed = outcome.families.first().and_then(|family| family.mixed.clone());
            (outcome.budget_spent, mixed.map(|mixed| (mixed.is_minimal, mixed.cost)))
        })
    };
    let cost = with_outcome(&full, |outcome, _| outcome.families[0].mixed.as_ref().map(|mixed| mixed.cost));
    let mut seen = Vec::new();
    for budget in [1, 3, 20, 40, 60, 80, 10_000] {
        let (spent, mixed) = runs_of(budget);
        assert_eq!(spent, budget < 10_000);
        assert!(mixed.is_none_or(|(_, found)| Some(found) >= cost), "{budget}");
        seen.push(mixed.map(|(minimal, _)| minimal));
    }
    assert!(seen.contains(&None) && seen.contains(&Some(false)) && seen.last() == Some(&Some(true)), "{seen:?}");
    let study = Precision { budget: 60, ..full };
    let found = study.findings(&mut |_, _, _| {}).expect("it runs");
    let said = found.conclusions().join(" ");
    assert!(said.contains("after 60 runs") && found.plain_document()["budget_spent"] == true, "{said}");
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
    assert_eq!(study.subject.notes(), ["Of 16 channels of the exact run 4 are infinite or NaN."]);
}

/// `mad` rounds once or twice: the switch decides how many bits a difference of close products needs.
#[test]
fn a_switch_that_matters_is_found() {
    let body = "mov r1, c0\nmad r0, r1, r1, c1";
    let case = case(body, "c0 = [1.0625, 1.0625, 1.0625, 1.0625]\nc1 = [-1.125, -1.125, -1.125, -1.125]");
    let study = study(&case, "largest_absolute=0", &[FormatFamily::Float]);
    with_outcome(&study, |outcome, _| {
        let minimum = |name: &str, value: &str| {
            let row = outcome.switches.iter().find(|row| row.switch == name && row.value == value).expect("a switch");
            row.found.as_ref().expect("it runs").minimum.map(|bits| bits.digits)
        };
        // The square, 289/256, has 8 bits behind the point; 289/256 - 288/256 has one, and 1.0625 four.
        assert_eq!([minimum("mad", "two-roundings"), minimum("mad", "fused")], [Some(8), Some(4)]);
        assert_eq!(minimum("lrp", "two-products"), Some(8));
    });
}
