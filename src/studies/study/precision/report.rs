//! Page and tables of the study.

use serde_json::json;

use super::bits::FormatBits;
use super::outcome::{FamilyOutcome, Precision, PrecisionOutcome};
use super::runs::Runs;
use super::tables::number;
use super::{family_report, half_report, pictures, tables};
use crate::report::words::{counted, percent};
use crate::report::{Chart, Findings, FoundTable, NamedChart, Scale, Series, Verdict};
use crate::shader::SourceLine;
use crate::study::StudyError;

/// Builds the findings; draws the pictures.
pub(super) fn findings(study: &Precision, outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<Findings, StudyError> {
    let profile = runs.subject.profile();
    let mut found = Findings::new(format!("Precision of {}", runs.subject.title()));
    let count = counted(runs.count() as u64, "instruction", "instructions");
    found.introduce(format!("{}: {count} on {}, goal {}", runs.subject.title(), profile.name, runs.goal));
    conclude(&mut found, study, outcome, runs);
    if let Some(chart) = chart(outcome, runs) {
        found.chart(chart);
    }
    pictures::pictures(&mut found, outcome, runs)?;
    runs.subject.notes().into_iter().for_each(|note| found.paragraph(note));
    found.heading("Formats for all instructions");
    found.table(FoundTable::from(tables::named(outcome, runs)).csv("formats").field("formats"));
    found.table(FoundTable::from(tables::curves(outcome, runs)).csv("curve").field("curve").unprinted());
    half_report::report(&mut found, &outcome.half, runs)?;
    for family in &outcome.families {
        family_report::per_instruction(&mut found, study, family, runs);
    }
    open_switches(&mut found, outcome);
    found.heading("Measures");
    found.table(FoundTable::from(tables::measures(runs)).field("measures").unprinted());
    fields(&mut found, outcome, runs);
    if let Some(family) = outcome.cheapest() {
        let programs: Vec<_> = runs.programs.iter().map(|studied| studied.program).collect();
        let formats: Vec<_> = family.mixed.iter().flat_map(|mixed| &mixed.formats).copied().map(Some).collect();
        if let Some(device) = runs.device(profile, &formats) {
            found.keep_file("mixed.toml", device.to_device_file(&programs).into_bytes());
        }
    }
    let has_minimum = outcome.families.iter().any(|family| family.curve.minimum.is_some());
    found.conclude(Verdict::held(has_minimum));
    Ok(found)
}

/// Adds the table of switches.
fn open_switches(found: &mut Findings, outcome: &PrecisionOutcome) {
    if outcome.switches.is_empty() {
        return;
    }
    found.heading("Open switches");
    let (table, first, names) = tables::switches(outcome);
    let table = FoundTable::from(table).folded(&first, |row| names[row].clone(), (["value", "values"], "the same"));
    found.explained_table(
        table.csv("switches").field("switches"),
        "Each value of each switch that has several, one at a time. The minimum has the exponent or integer bits of \
         the curve; the reference is the exact run of the device as given.",
    );
}

/// Adds the sentences at the top.
fn conclude(found: &mut Findings, study: &Precision, outcome: &PrecisionOutcome, runs: &Runs<'_>) {
    let (goal, measure) = (runs.goal, &runs.goal.measure);
    let given = outcome.given.map_or(String::new(), |value| format!(", and {} on the device as given", number(value)));
    found.conclusion(format!("Goal: {goal}; {measure} is {} in the exact run{given}.", number(outcome.exact)));
    let rules = &runs.subject.profile().rules;
    if rules.accumulator.is_some() || rules.storage.iter().next().is_some() {
        found.conclusion("Only instruction formats are searched, not the device's formats of storages and sums.");
    }
    for family in &outcome.families {
        let name = family.curve.family.name();
        let Some(minimum) = family.curve.minimum else {
            found.conclusion(match family.curve.is_complete {
                false => format!("The budget ended before a smallest {name} format was found."),
                true => format!("No {name} format meets the goal for all instructions."),
            });
            continue;
        };
        if minimum == FormatBits::narrowest(family.curve.family) {
            found.conclusion(format!(
                "Every {name} format meets the goal, down to {minimum}: the goal does not distinguish formats."
            ));
            continue;
        }
        found.conclusion(format!("Smallest {name} format of all instructions: {minimum}, {} bits.", minimum.width()));
        if let Some([fewer, more]) = family.curve.scan.counterexample {
            let points = &family.curve.scan.points;
            found.conclusion(format!(
                "More {} can be worse: {measure} is {} with {fewer}, and {} with {more}. All were tried; from {} on \
                 every number meets the goal.",
                family.curve.family.digits(),
                number(points[&fewer]),
                number(points[&more]),
                minimum.digits,
            ));
        }
    }
    if let Some((family, mixed)) = outcome.cheapest().and_then(|family| Some((family, family.mixed.as_ref()?))) {
        let of = family.curve.minimum.map_or(0.0, |minimum| study.costs.sum(&vec![minimum; mixed.formats.len()]));
        let unit = if study.costs.is_table() { "cost" } else { "bits" };
        found.conclusion(format!(
            "With a {} format per instruction: {} {unit} in place of {}{}.",
            family.curve.family.name(),
            number(mixed.cost),
            number(of),
            if mixed.is_minimal { "; one bit less anywhere misses the goal" } else { ", the best so far" },
        ));
    }
    let blamed = outcome.families.iter().find_map(|family| family.most_blamed().filter(|(_, share)| *share > 0.0));
    if let Some((place, share)) = blamed {
        let SourceLine { file, line, text, .. } = tables::line(place, runs);
        found.conclusion(format!("Most to blame: {file}:{line}: `{text}`, {} of the loss alone.", percent(share)));
    }
    if outcome.budget_spent {
        let made = counted(runs.made, "run", "runs");
        found.conclusion(format!("The budget ended the study after {made}: the results are the best so far."));
    }
}

/// Chart of the curves, if there are points enough for an axis.
fn chart(outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Option<NamedChart> {
    let mut lines: Vec<Series> = outcome
        .families
        .iter()
        .map(|family| Series {
            label: format!("{}, {}", family.curve.family.name(), family.curve.range_text()),
            points: finite(family.curve.scan.points.iter().map(|(bits, value)| (f64::from(*bits), *value))),
        })
        .collect();
    let dots: Vec<Series> = outcome
        .named
        .iter()
        .map(|(name, bits, value)| Series {
            label: (*name).to_owned(),
            points: finite([(f64::from(bits.digits), *value)]),
        })
        .collect();
    let mut values: Vec<f64> =
        lines.iter().chain(&dots).flat_map(|series| &series.points).map(|point| point.1).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < 2 {
        return None;
    }
    let positive = values.iter().copied().filter(|value| *value > 0.0);
    let y_scale = if positive.clone().count() < 2 { Scale::Linear } else { Scale::fitting(positive) };
    lines.push(runs.goal.line(&lines));
    let zero = if y_scale == Scale::Logarithmic { " The axis cannot show values of 0." } else { "" };
    let chart = Chart {
        title: format!("{} by bits of precision", runs.goal.words()),
        x: "mantissa or fraction bits of all instructions".to_owned(),
        y: runs.goal.words(),
        y_scale,
        lines,
        dots,
        ..Chart::default()
    };
    let caption = format!(
        "{} with all instructions in one format, against its mantissa or fraction bits; goal: {}.{zero}",
        runs.goal.words(),
        runs.goal
    );
    Some(NamedChart { name: "curve".to_owned(), chart, caption })
}

fn finite(points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    points.into_iter().filter(|point| point.1.is_finite()).collect()
}

/// Adds the fields of the document.
fn fields(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) {
    let family = |family: &FamilyOutcome| {
        json!({
            "family": family.curve.family.name(),
            "minimum": family.curve.minimum.map(|bits| bits.to_string()),
            "counterexample": family.curve.scan.counterexample,
            "mixed_cost": family.mixed.as_ref().map(|mixed| mixed.cost),
            "one_minimal": family.mixed.as_ref().map(|mixed| mixed.is_minimal),
            "held_back": family.held_back,
            "spare": family.spare,
        })
    };
    found.fields(json!({
        "title": runs.subject.title(),
        "device": runs.subject.profile().name,
        "goal": runs.goal.to_string(),
        "exact": outcome.exact,
        "given": outcome.given,
        "families": outcome.families.iter().map(family).collect::<Vec<_>>(),
        "runs": runs.made,
        "budget_spent": outcome.budget_spent,
    }));
}
