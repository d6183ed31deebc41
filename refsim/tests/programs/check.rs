//! Tests the checker on the programs of fixtures/shaders/check: for every rule a legal program and one that violates
//! it.

use std::{collections::BTreeSet, fs, path::PathBuf};

use refsim::{
    asm,
    check::{self, CheckReport, RuleId},
    device::Profile,
    isa::Program,
};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../fixtures/shaders/check")
}

/// Loads a program and the device that its first line names: `// r200: purpose`.
fn load(name: &str) -> (String, Program, Profile) {
    let text = fs::read_to_string(folder().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let header = text.lines().next().and_then(|l| l.strip_prefix("// ")).unwrap();
    let device = header.split(": ").next().unwrap();
    let profile = Profile::named(device).unwrap_or_else(|e| panic!("{name}: {e}"));
    let program = asm::assemble(&text).unwrap_or_else(|e| panic!("{name}: {e:?}"));
    (text, program, profile)
}

/// Renders a violation with all its fields.
fn render(text: &str, report: &CheckReport) -> String {
    use miette::Diagnostic;
    let shown = report.to_string();
    let mut out = format!("{}\n", shown.lines().next().unwrap());
    for v in &report.violations {
        let code = v.code().unwrap();
        let help = v.help().unwrap();
        let before = &text[..v.span.start as usize];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let shown = &text[v.span.start as usize..v.span.end as usize];
        out += &format!("{code}: {v}\n  at {line}:{column} `{shown}`: {}\n  help: {help}\n", v.label);
        if let (Some(key), limit, found) = (v.key, v.limit, v.found) {
            out += &format!("  key: {key} limit: {limit:?} found: {found:?}\n");
        }
    }
    out
}

/// On a device without limits, the checker accepts only registers that the executors have.
#[test]
fn ideal_devices_end_where_the_register_files_do() {
    let profile = Profile::named("ideal-fp32").unwrap();
    let rules = |text: &str| match check::check(asm::assemble(text).unwrap(), &profile) {
        Ok(_) => Vec::new(),
        Err(report) => report.violations.iter().map(|v| v.rule).collect(),
    };
    let text = |r: u32, c: u32| format!("ps_2_a\ndef c{c}, 0.5, 0.25, 0.125, 1\nmov r{r}, c{c}\nmov oC0, r{r}");
    assert_eq!(rules(&text(31, 255)), []);
    assert!(rules(&text(32, 0)).iter().all(|rule| *rule == RuleId::NoSuchRegister) && !rules(&text(32, 0)).is_empty());
    assert!(
        rules(&text(0, 256)).iter().all(|rule| *rule == RuleId::NoSuchRegister) && !rules(&text(0, 256)).is_empty()
    );
    let last = crate::running::run(&text(31, 255), &profile, &[]);
    assert_eq!(last.results[0].colors[0].map(f32::from_bits), [0.5, 0.25, 0.125, 1.0]);
}

#[test]
fn every_rule_has_a_program_that_keeps_it_and_one_that_breaks_it() {
    let mut all = String::new();
    for rule in RuleId::ALL {
        let (text, program, profile) = load(&format!("{rule}_good.psa"));
        check::check(program, &profile).unwrap_or_else(|r| panic!("{rule}_good: {}", render(&text, &r)));
        let (text, program, profile) = load(&format!("{rule}_bad.psa"));
        let report = check::check(program, &profile).expect_err(&format!("{rule}_bad passes"));
        assert!(report.violations.iter().all(|v| v.rule == *rule), "{rule}_bad: {}", render(&text, &report));
        all += &format!("==== {rule}: {}\n{}\n", rule.text(), render(&text, &report));
    }
    insta::assert_snapshot!(all);
}

fn verdict(text: &str, device: &str) -> Result<(), String> {
    let program = asm::assemble(text).unwrap_or_else(|e| panic!("{e:?}"));
    let profile = Profile::named(device).unwrap();
    check::check(program, &profile).map(|_| ()).map_err(|report| render(text, &report))
}

#[test]
fn texcrd_passes_on_no_more_than_there_is() {
    let text = |read: &str| {
        format!("ps_1_4\ntexld r1, t0\nmov r5.rg, r1\nphase\ntexcrd r2.rgb, r5\nmov r0, c0\nmov r0.rgb, r2.{read}\n")
    };
    verdict(&text("g"), "r200").unwrap();
    insta::assert_snapshot!(verdict(&text("b"), "r200").unwrap_err());
}

#[test]
fn every_violation_is_reported_in_one_go() {
    let text = "ps_1_4\ntexld r9, t0\nmul r0.rgb, t1, v0_bx2\nrcp r0, r0\nphase\nphase\nmov_x8 c0, r1\n";
    let program = asm::assemble(text).unwrap();
    let report = check::check(program, &Profile::named("r200").unwrap()).unwrap_err();
    let broken: BTreeSet<RuleId> = report.violations.iter().map(|v| v.rule).collect();
    for rule in [
        RuleId::UnsupportedInstruction,
        RuleId::RepeatedPhase,
        RuleId::NoSuchRegister,
        RuleId::UnwrittenRead,
        RuleId::UnwrittenResult,
        RuleId::InvalidDestination,
        RuleId::ColorReadInPhase1,
        RuleId::ArithmeticReadsCoordinates,
    ] {
        assert!(broken.contains(&rule), "{rule} is missing from {broken:?}");
    }
    assert!(report.violations.is_sorted_by_key(|v| v.span.start));
}

#[test]
fn period_programs_are_not_turned_away_for_the_rules_of_this_house() {
    // The kernels are legal. Apart from limits, the assembler's fixtures violate only these rules: a constant beyond 1,
    // components never written, a cmp onto itself.
    let careless = [RuleId::MisplacedDefinition, RuleId::UnwrittenRead, RuleId::CmpOrDp4];
    let mut seen = 0;
    let mut wrong = String::new();
    for place in ["../fixtures/shaders/asm", "../src/systems/ray_engine/kernels"] {
        let place = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(place);
        for entry in fs::read_dir(&place).unwrap() {
            let path = entry.unwrap().path();
            if !path.extension().is_some_and(|e| e == "psa" || e == "vsa") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let program = asm::assemble(&text).unwrap_or_else(|e| panic!("{e:?}"));
            let report = check::check(program, &Profile::named("ideal-fp32").unwrap()).err();
            let kernel = place.ends_with("kernels");
            let excused = |r: &CheckReport| !kernel && r.violations.iter().all(|v| careless.contains(&v.rule));
            if let Some(report) = report.filter(|r| !excused(r)) {
                let report = render(&text, &report);
                wrong += &format!("{}: {report}\n", path.display());
            }
            seen += 1;
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(seen > 20, "only {seen} programs");
}

#[test]
fn a_version_limit_is_lifted_on_ideal_devices_only() {
    let mut text = "ps_1_4\n".to_owned();
    for stage in 0..6 {
        text += &format!("texld r{stage}, t0\n");
    }
    for _ in 0..9 {
        text += "add r0, r0, r1\n";
    }
    assert!(verdict(&text, "r200").unwrap_err().contains("allows 8"));
    assert!(verdict(&text, "r300").unwrap_err().contains("`ps_1_4` allows 8"));
    verdict(&text, "ideal-fp16").unwrap();
}

#[test]
fn an_instruction_that_the_version_lacks_still_counts_as_a_write() {
    let program = asm::assemble("ps_1_1\ncmp r0, v0, v0, v1\n").unwrap();
    let report = check::check(program, &Profile::named("ideal-fp32").unwrap()).unwrap_err();
    let rules: Vec<RuleId> = report.violations.iter().map(|v| v.rule).collect();
    assert_eq!(rules, [RuleId::UnsupportedInstruction], "cmp is not in ps_1_1, and nothing else is wrong: {report}");
}
