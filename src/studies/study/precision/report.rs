//! Page and tables of the study.

use serde_json::json;

use super::bits::FormatBits;
use super::outcome::{FamilyOutcome, PrecisionOutcome};
use super::runs::Runs;
use super::search::{MixedFormats, assignment};
use super::tables::{self, number};
use crate::report::digits::count;
use crate::report::words::{counted, percent};
use crate::report::{Chart, Findings, FoundTable, NamedChart, NamedPicture, Scale, Series, Table, Verdict};
use crate::shader::SourceLine;
use crate::study::StudyError;

/// Builds the findings; draws the pictures.
pub(super) fn findings(outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<Findings, StudyError> {
    let profile = runs.subject.profile();
    let mut found = Findings::new(format!("Precision of {}", runs.subject.title()));
    let count = counted(runs.count() as u64, "instruction", "instructions");
    found.introduce(format!("{}: {count} on {}, goal {}", runs.subject.title(), profile.name, runs.goal));
    conclude(&mut found, outcome, runs);
    if let Some(chart) = chart(outcome, runs) {
        found.chart(chart);
    }
    pictures(&mut found, outcome, runs)?;
    runs.subject.notes().into_iter().for_each(|note| found.paragraph(note));
    tables::uniform(&mut found, outcome, runs);
    tables::half(&mut found, outcome, runs)?;
    outcome.families.iter().for_each(|family| tables::family(&mut found, family, runs));
    tables::switches(&mut found, outcome);
    found.heading("Measures");
    let mut measures = Table::of("Measures, against the exact run", "measure meaning");
    runs.subject.measures().iter().for_each(|measure| measures.push([measure.name.into(), measure.meaning.into()]));
    found.table(FoundTable::from(measures).field("measures").unprinted());
    fields(&mut found, outcome, runs);
    if let Some((_, mixed)) = outcome.cheapest()
        && let Some(device) = runs.device(profile, &assignment(&mixed.formats))
    {
        let programs: Vec<_> = runs.programs.iter().map(|studied| studied.program).collect();
        found.keep_file("mixed.toml", device.to_device_file(&programs).into_bytes());
    }
    let has_minimum = outcome.families.iter().any(|family| family.curve.minimum.is_some());
    found.conclude(Verdict::held(has_minimum));
    Ok(found)
}

/// Adds the sentences at the top.
fn conclude(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) {
    let (goal, measure) = (runs.goal, &runs.goal.measure);
    let given = outcome.given.map_or(String::new(), |value| format!(", and {} on the device as given", number(value)));
    found.conclusion(format!("Goal: {goal}; {measure} is {} in the exact run{given}.", number(outcome.exact)));
    let rules = &runs.subject.profile().rules;
    if rules.accumulator.is_some() || rules.storage.iter().next().is_some() {
        found.conclusion(
            "Only instruction formats are searched, not the device's formats of stored values and of sums.",
        );
    }
    for family in &outcome.families {
        let name = family.curve.family.name();
        let Some(minimum) = family.curve.minimum else {
            found.conclusion(match family.curve.is_complete {
                false => format!("The budget ran out before the smallest {name} format was found."),
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
                "More {} can be worse: {measure} is {} with {fewer}, and {} with {more}. All numbers of bits were \
                 tried; from {} on, every number meets the goal.",
                family.curve.family.digits(),
                number(points[&fewer]),
                number(points[&more]),
                minimum.digits,
            ));
        }
    }
    if let Some((curve, mixed)) = outcome.cheapest() {
        let of = curve.minimum.map_or(0, |minimum| minimum.width() * mixed.formats.len() as u32);
        found.conclusion(format!(
            "With one {} format per instruction, the instructions have {} bits in total instead of {}{}.",
            curve.family.name(),
            count(mixed.width().into()),
            count(of.into()),
            if mixed.is_minimal {
                "; with one bit less in any instruction, the goal is missed"
            } else {
                "; this is the best so far"
            },
        ));
    }
    let blamed = outcome.families.iter().find_map(|family| family.most_blamed().filter(|(_, share)| *share > 0.0));
    if let Some((place, share)) = blamed {
        let SourceLine { file, line, text, .. } = tables::line(place, runs);
        found.conclusion(format!(
            "Most to blame: {file}:{line}: `{text}`, which alone causes {} of the loss.",
            percent(share)
        ));
    }
    if outcome.budget_spent {
        let made = counted(runs.made, "run", "runs");
        found.conclusion(format!("The budget ended the study after {made}: the results are the best so far."));
    }
}

/// Chart of the curves, if there are points enough for an axis.
fn chart(outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Option<NamedChart> {
    let (goal, words) = (runs.goal, runs.goal.words());
    let mut lines: Vec<Series> = outcome.families.iter().map(|family| family.curve.line(f64::is_finite)).collect();
    let dot = |(name, bits, value): &(&str, FormatBits, f64)| {
        let point = Some((f64::from(bits.digits), *value)).filter(|point| point.1.is_finite());
        Series { label: (*name).to_owned(), points: point.into_iter().collect() }
    };
    let dots: Vec<Series> = outcome.named.iter().map(dot).collect();
    let mut values: Vec<f64> =
        lines.iter().chain(&dots).flat_map(|series| &series.points).map(|point| point.1).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < 2 {
        return None;
    }
    let positive = values.iter().copied().filter(|value| *value > 0.0);
    let y_scale = if positive.clone().count() < 2 { Scale::Linear } else { Scale::fitting(positive) };
    lines.push(goal.line(&lines));
    let zero = if y_scale == Scale::Logarithmic { " The axis cannot show values of 0." } else { "" };
    let chart = Chart {
        title: format!("{words} by bits of precision"),
        x: "mantissa or fraction bits of all instructions".to_owned(),
        y: words.clone(),
        y_scale,
        lines,
        dots,
        ..Chart::default()
    };
    let caption = format!(
        "{words} with all instructions in one format, against its mantissa or fraction bits; goal: {goal}.{zero}"
    );
    Some(NamedChart { name: "curve".to_owned(), chart, caption })
}

/// Adds the pictures: exact, in the smallest uniform format, and with one bit less.
fn pictures(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) -> Result<(), StudyError> {
    let mut shown = vec![(None, "exact".to_owned(), "exact run".to_owned())];
    for minimum in outcome.families.iter().filter_map(|family| family.curve.minimum) {
        for bits in [minimum].into_iter().chain(minimum.narrower().next()) {
            shown.push((Some(bits), bits.to_string(), format!("all instructions in {bits}")));
        }
    }
    let mut pictures = Vec::new();
    for (bits, name, caption) in shown {
        let measured = runs.subject.measure(&runs.uniform_device(runs.subject.profile(), bits), None)?;
        let value = number(measured.value(&runs.goal.measure));
        let caption = format!("{caption}: {} {value}", runs.goal.words());
        pictures.extend(measured.picture.map(|picture| NamedPicture::new(name, picture, caption)));
    }
    found.pictures(pictures);
    Ok(())
}

/// Adds the fields of the document.
fn fields(found: &mut Findings, outcome: &PrecisionOutcome, runs: &Runs<'_>) {
    let family = |family: &FamilyOutcome| {
        json!({
            "family": family.curve.family.name(),
            "minimum": family.curve.minimum.map(|bits| bits.to_string()),
            "counterexample": family.curve.scan.counterexample,
            "mixed_bits": family.mixed.as_ref().map(MixedFormats::width),
            "one_minimal": family.mixed.as_ref().map(|mixed| mixed.is_minimal),
            "held_back": family.held_back,
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
