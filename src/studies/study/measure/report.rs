//! Findings about measured pixels.

use serde_json::json;

use super::file::CODES;
use super::settings::{Measure, Setting, Survey};
use crate::report::words::{counted, listed};
use crate::report::{Cell, Findings, FoundTable, Table, Verdict};

/// Maximum number of settings, and of codes, shown.
const MOST_SHOWN: usize = 20;

/// Tables of values and settings; the verdict is positive if a setting reproduces every measured code.
pub(super) fn findings(measure: &Measure, survey: &Survey) -> Findings {
    let fitting: Vec<&Setting> = survey.fitting().collect();
    let pixels: usize = measure.cases.iter().map(|case| case.pixels.len()).sum();
    let device = &measure.profile.name;
    let mut found = Findings::new(format!("{} on {device}", measure.name));
    found.introduce(format!(
        "{} in {} of {}, on {device}",
        counted(survey.codes, "measured code", "measured codes"),
        counted(pixels as u64, "pixel", "pixels"),
        counted(measure.cases.len() as u64, "case", "cases"),
    ));
    found.table(FoundTable::from(values(survey, &fitting)).field("values"));
    found.table(FoundTable::from(settings(survey)).field("settings"));
    if !survey.wrong.is_empty() {
        found.table(FoundTable::from(wrong(survey)).field("otherwise"));
    }
    let best = survey.settings.first().map_or(0, |(_, right)| *right);
    found.fields(json!({
        "measured": measure.name,
        "device": device,
        "codes": survey.codes,
        "fitting": fitting.len(),
        "of": survey.settings.len(),
        "best": best,
        "undecided": undecided(survey),
    }));
    let of = counted(survey.settings.len() as u64, "setting", "settings");
    found.conclusion(match fitting.len() {
        0 => format!("none of {of} reproduces all measured codes; the best reproduces {best} of {}", survey.codes),
        count => format!("{count} of {of} reproduce all measured codes"),
    });
    if !undecided(survey).is_empty() {
        found.print(format!("no measured code depends on {}", listed(&undecided(survey))));
    }
    found.conclude(Verdict::held(!fitting.is_empty()));
    found
}

/// Switches with several values that no measured code depends on.
fn undecided(survey: &Survey) -> Vec<&str> {
    let open = survey.questions.iter().enumerate().filter(|(at, _)| !survey.relevant.contains(at));
    open.filter(|(_, question)| question.values.len() > 1).map(|(_, question)| question.name.as_str()).collect()
}

/// A row for each value of each switch that matters.
fn values(survey: &Survey, fitting: &[&Setting]) -> Table {
    let mut table = Table::of("Switch values on which the codes depend", "switch value default most_right of verdict");
    for &at in &survey.relevant {
        let question = &survey.questions[at];
        let fits = |value: usize| fitting.iter().any(|setting| setting.get(&at) == Some(&value));
        let open = (0..question.values.len()).filter(|&value| fits(value)).count();
        for (value, name) in question.values.iter().enumerate() {
            let verdict = match (fits(value), open) {
                (true, 1) => "settled",
                (true, _) => "possible",
                (false, _) => "refuted",
            };
            table.push([
                Cell::from(question.name.as_str()),
                name.as_str().into(),
                Cell::Flag(*name == question.current),
                survey.best_with(at, value).into(),
                survey.codes.into(),
                verdict.into(),
            ]);
        }
    }
    table
}

/// The best settings, a column for each switch that matters.
fn settings(survey: &Survey) -> Table {
    let names = survey.relevant.iter().map(|&at| survey.questions[at].name.as_str());
    let headings: Vec<&str> = ["right", "of"].into_iter().chain(names).collect();
    let mut table = Table::new(format!("Best settings, at most {MOST_SHOWN}"), &headings);
    for (setting, right) in survey.settings.iter().take(MOST_SHOWN) {
        let values = setting.iter().map(|(&at, &value)| Cell::from(survey.questions[at].values[value].as_str()));
        table.push([Cell::from(*right), survey.codes.into()].into_iter().chain(values));
    }
    table
}

/// Codes that the best setting gets wrong.
fn wrong(survey: &Survey) -> Table {
    let title = format!("Codes that the best setting gets wrong: {}", survey.wrong.len());
    let mut table = Table::of(title, "line column measured drawn");
    for code in survey.wrong.iter().take(MOST_SHOWN) {
        table.push([code.line.into(), CODES[code.column].into(), code.measured.into(), code.drawn.into()]);
    }
    table
}
