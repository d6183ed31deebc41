//! Reasons for rows' verdicts: sources, bounds, classes, explanations.

use crossbar::study::reproduce::report::{evidence_line, notes};
use crossbar::study::reproduce::{Bound, Judgement, RowSource, RowVerdict, figures, timed};

use super::{FOUND, all, row};

/// Every judged figure has exactly one row. Figures that are not judged are listed with the reason.
#[test]
fn every_judged_figure_has_one_row() {
    let figures = figures().expect("the data").iter();
    let judged = figures.filter(|figure| matches!(figure.judgement, Judgement::Within(_)));
    let mut judged: Vec<String> = judged.map(|figure| figure.id.clone()).collect();
    let mut rows: Vec<String> = all().map(|row| row.target.id.clone()).collect();
    judged.sort_unstable();
    rows.sort_unstable();
    assert_eq!(rows, judged);
}

#[test]
fn rates_have_the_bound_of_predictions() {
    let rates = all().filter(|row| ["Hz", "fps", "frames/s"].contains(&row.target.unit.as_str()));
    let wrong = rates.filter(|row| row.bound != Bound::Relative(Bound::SHARE));
    assert_eq!(wrong.map(|row| row.target.id.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
}

/// Values of a confined row lie within its range, and a confined row whose bound admits the whole range is met by
/// construction. The number was counted by hand: a block, three trees, fixed links, lossless biclusters, six errors
/// that fall with vectors, six overdraws, terms and representatives.
#[test]
fn what_cannot_fail_is_no_evidence() {
    let confined: Vec<_> = all().filter_map(|row| Some((row, row.confinement()?.0))).collect();
    for (row, [least, most]) in &confined {
        for value in std::iter::once(row.ours).chain(row.readings.iter().copied()) {
            assert!(*least <= value && value <= *most, "{}: {value} of {least} to {most}", row.target.id);
        }
        assert_eq!(row.verdict(), RowVerdict::ByConstruction, "{}", row.target.id);
    }
    assert_eq!(confined.len(), 1 + 3 + 1 + 1 + 6 + 6 + 1 + 1);
}

/// The tally's sentence has a number for each verdict, and the numbers add up to the number of rows.
#[test]
fn the_parts_of_the_tally_add_up() {
    let numbers = |text: &str| -> Vec<usize> { text.split([' ', ',']).filter_map(|word| word.parse().ok()).collect() };
    let of_tally = || all().filter(|row| !row.is_calibrated());
    let evidence = evidence_line(&FOUND);
    let (parts, recorded) = evidence.split_once(';').expect("two parts");
    let found = numbers(parts);
    assert_eq!((found[0], found[1..].iter().sum::<usize>()), (of_tally().count(), of_tally().count()), "{parts}");
    assert_eq!(numbers(recorded), [of_tally().filter(|row| row.source != RowSource::Computed).count()]);
}

/// Benches in modelled time measure the same quantities as rows.
#[test]
fn timed_work_has_the_times_of_its_rows() {
    for work in timed()
        .expect("the cards take the work")
        .iter()
        .filter(|work| work.figure != "ray-engine/radeon-8500" || work.device == "r200")
    {
        let (row, seconds) = (row(work.figure), work.time.seconds());
        let ours = match row.target.unit.as_str() {
            "ms" => 1e3 * seconds,
            "M/s" => 1e-6 * work.items as f64 / seconds,
            _ => 1.0 / seconds,
        };
        assert!((ours / row.ours - 1.0).abs() < 1e-9, "{}: {ours}, {}", work.figure, row.ours);
    }
}

/// Each reason is listed once, with all its rows.
#[test]
fn every_explanation_is_said_once() {
    let notes = notes(&FOUND);
    let mut reasons: Vec<String> = notes.rows().iter().map(|row| row[1].text() + &row[2].text()).collect();
    let said = reasons.len();
    reasons.sort();
    reasons.dedup();
    assert_eq!(reasons.len(), said);
    let explained = all().filter(|row| row.verdict() == RowVerdict::Explained).count();
    let rows = notes.rows().iter().filter(|row| row[1].text() == "explained").map(|row| row[3].text());
    assert_eq!(rows.flat_map(|rows| rows.split("; ").map(str::to_owned).collect::<Vec<_>>()).count(), explained);
}

/// Exactly the missed rows have a miss class in the figure data, and no unjudged figure has one.
#[test]
fn missed_rows_have_their_class() {
    let wrong = all().filter(|row| (row.verdict() == RowVerdict::Missed) != row.target.missed.is_some());
    assert_eq!(wrong.map(|row| row.target.id.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
    let idle = figures()
        .expect("the data")
        .iter()
        .filter(|figure| figure.missed.is_some() && matches!(figure.judgement, Judgement::Not(_)));
    assert_eq!(idle.map(|figure| figure.id.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
}

#[test]
fn a_miss_comes_with_an_open_question() {
    for (entry, found) in FOUND.iter() {
        let missed = found.rows.iter().any(|row| row.verdict() == RowVerdict::Missed);
        assert!(!missed || !found.questions.is_empty(), "{}", entry.id);
    }
}
