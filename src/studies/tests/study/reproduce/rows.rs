//! Rows: bounds, verdicts, contradictions, and what sweeps explain.

use crossbar_ground::card::frame_time::FrameTime;
use crossbar_studies::study::reproduce::{
    Bound, Contradiction, Dependence, Judgement, Method, MissClass, Origin, Paper, PaperFigure, PaperRow, RowVerdict,
    Setting, Sweep,
};
use refsim::timing::Picoseconds;

fn target(value: f64, decimals: u8) -> PaperFigure {
    PaperFigure {
        paper: Paper::RayEngine,
        id: "ray-engine/tests".to_owned(),
        what: "tests".to_owned(),
        value,
        decimals,
        unit: "M/s".to_owned(),
        place: "section 6.1".to_owned(),
        origin: Origin::Printed,
        judgement: Judgement::Within(Bound::Relative(0.1)),
        stated: "2026-11-26".to_owned(),
        missed: Some(MissClass::ModelLost),
        equation: None,
    }
}

/// A row with our value and the printed value 15.6, within a bound of 10 % plus the printed value's rounding.
pub(super) fn row(ours: f64) -> PaperRow {
    let dependence = Dependence::Predicted { from: "" };
    PaperRow::new(("nv20", Method::Pipeline), &target(15.6, 1), (ours, dependence)).expect("a judged figure")
}

fn with(mut row: PaperRow, set: impl FnOnce(&mut PaperRow)) -> PaperRow {
    set(&mut row);
    row
}

fn bounded(row: PaperRow, bound: Bound) -> PaperRow {
    with(row, |row| row.bound = bound)
}

#[test]
fn a_value_outside_its_bound_is_missed_and_no_word_changes_that() {
    assert_eq!(
        [15.0, 18.0, 13.0].map(|ours| row(ours).verdict()),
        [RowVerdict::Predicted, RowVerdict::Missed, RowVerdict::Missed]
    );
    assert_eq!([15.0, 18.0].map(|ours| row(ours).missed()), [None, Some(MissClass::ModelLost)]);
}

/// Success by consistency, or by order alone, is distinguished from a prediction.
#[test]
fn classes_of_success_are_told_apart() {
    let equation = with(row(15.6), |row| row.method = Method::Equation);
    let [at_least, order] = [Bound::AtLeast, Bound::Order].map(|bound| bounded(row(200.0), bound).verdict());
    assert_eq!(equation.verdict(), RowVerdict::Consistent);
    assert_eq!([at_least, order], [RowVerdict::OrderOnly; 2]);
    assert_eq!(bounded(equation, Bound::Order).verdict(), RowVerdict::Consistent);
}

/// A reading within the bound does not hide another allowed reading outside it.
#[test]
fn every_reading_must_lie_within_the_bound() {
    assert_eq!(row(15.6).with_readings([15.0, 16.0]).verdict(), RowVerdict::Predicted);
    let apart = row(15.6).with_readings([15.0, 18.0]);
    assert_eq!((apart.verdict(), apart.range()), (RowVerdict::Missed, Some([15.0, 18.0])));
    assert_eq!(row(15.6).range(), None);
}

#[test]
fn a_row_says_that_it_needs_the_rounding() {
    assert!(row(14.0).holds_by_rounding() && !row(14.1).holds_by_rounding() && !row(13.0).holds_by_rounding());
}

/// 15.6 and 33.2 contradict each other, each with a bound of 10 %: 15.6 and 36.0 agree with one of them, 20.0 with
/// neither.
#[test]
fn a_figure_that_its_paper_contradicts_is_missed_by_a_value_that_agrees_with_neither() {
    let contradiction = || Contradiction::between(&target(15.6, 1), 33.2, "the other table");
    let verdicts = [15.6, 36.0, 20.0].map(|ours| row(ours).contradicted(contradiction()).verdict());
    assert_eq!(verdicts, [RowVerdict::Contradictory, RowVerdict::Contradictory, RowVerdict::Missed]);
    let apart = row(15.6).with_readings([33.2]).contradicted(contradiction());
    assert_eq!(apart.verdict(), RowVerdict::Missed, "one reading for each value agrees with neither");
    let waits = || Contradiction::if_holds(true, "waits are inside");
    let verdicts = [15.6, 33.2].map(|ours| row(ours).contradicted(waits()).verdict());
    assert_eq!(verdicts, [RowVerdict::Contradictory, RowVerdict::Missed]);
}

/// A bound that admits every possible value judges nothing; a bound that some possible value misses does. Equal values
/// have no order, so they do not make a row meaningful whose order cannot be reversed.
#[test]
fn what_cannot_fail_is_met_by_construction() {
    let confined = |range, bound| bounded(row(15.6), bound).confined(range, "a tree").verdict();
    assert_eq!(confined([15.6, 15.6], Bound::Print), RowVerdict::ByConstruction);
    assert_eq!(confined([1.0, f64::INFINITY], Bound::Order), RowVerdict::ByConstruction);
    assert_eq!(confined([0.9, f64::INFINITY], Bound::Order), RowVerdict::OrderOnly);
    assert_eq!(confined([15.0, 18.0], Bound::Relative(0.1)), RowVerdict::Predicted);
    let outside = row(20.0).confined([15.6, 15.6], "a tree");
    assert_eq!(outside.verdict(), RowVerdict::Missed, "a wrong reason hides no miss");
}

/// If the host works for all 20 ms of a frame, the rate depends only on the host and is calibrated. If the host waits
/// for the card, the rate is not calibrated.
#[test]
fn a_frame_that_the_host_decides_is_an_equation() {
    let frame = Picoseconds(20_000_000_000);
    let time = |host: u64| FrameTime { frame, host: Picoseconds(host), ..FrameTime::default() };
    let methods = [20_000_000_000, 19_000_000_000].map(|host| Method::from(&time(host)));
    assert_eq!(methods, [Method::Equation, Method::Pipeline]);
}

#[test]
fn a_calibrated_value_proves_nothing_and_still_has_a_bound() {
    let calibrated = |ours: f64| with(row(ours), |row| row.dependence = Dependence::Calibrated { on: "itself" });
    assert_eq!(calibrated(15.6).verdict(), RowVerdict::Calibrated);
    assert_eq!(calibrated(10.0).verdict(), RowVerdict::Missed);
}

#[test]
fn vague_text_is_no_success() {
    assert_eq!(bounded(row(15.6), Bound::TooVague).verdict(), RowVerdict::TooVague);
}

#[test]
fn differences_are_shares_of_what_is_printed() {
    assert_eq!(row(31.2).difference(), 1.0);
    assert_eq!(row(7.8).difference(), -0.5);
}

const PREDICTION: Bound = Bound::Relative(Bound::SHARE);

fn admits(bound: Bound, (printed, rounding): (f64, f64), value: f64) -> bool {
    bound.admits(printed, rounding, value)
}

#[test]
fn digits_are_compared_as_printed() {
    assert!(admits(Bound::Print, (15.6, 0.05), 15.625) && !admits(Bound::Print, (15.6, 0.05), 15.66));
    assert!(admits(Bound::Print, (114.0, 0.5), 113.6) && !admits(Bound::Print, (114.0, 0.5), 114.6));
}

#[test]
fn a_share_is_of_what_is_printed() {
    assert_eq!(Bound::Relative(0.1).interval(100.0, 0.5), Some([89.5, 110.5]));
}

/// Equal values have no order.
#[test]
fn an_order_is_a_side_of_1() {
    let side = |printed: f64| [1.01, 1.0, 0.9].map(|value| admits(Bound::Order, (printed, 0.005), value));
    assert_eq!(side(3.05), [true, false, false]);
    assert_eq!(side(0.4), [false, false, true]);
}

/// Not every value that rounds to 2 satisfies "about twice".
#[test]
fn about_twice_is_no_wider_than_any_prediction() {
    let twice = (2.0, 0.05);
    assert!(admits(PREDICTION, twice, 1.8) && !admits(PREDICTION, twice, 1.6) && !admits(PREDICTION, twice, 2.4));
}

/// A prediction that the card brings no gain is outside the bound.
#[test]
fn the_calibrated_value_itself_is_outside() {
    let gained = (147_630.0, 0.5);
    let bound = Bound::Gain { share: 0.15, over: 135_812.0 };
    assert!(!admits(bound, gained, 135_812.0) && admits(bound, gained, 148_000.0));
    assert!(admits(PREDICTION, gained, 135_812.0), "as a share of the whole it would pass");
}

#[test]
fn what_rounds_to_the_print_does_not_contradict_it() {
    let rate = target(15.6, 1);
    assert_eq!(Contradiction::between(&rate, 15.649, "a quotient"), None);
    let found = Contradiction::between(&rate, 15.7, "a quotient").expect("another value");
    assert_eq!(found.text(), "15.70 M/s: a quotient");
}

fn sweep(settings: &[[f64; 2]]) -> Sweep {
    let setting = |(i, values): (usize, &[f64; 2])| Setting { at: i.to_string(), values: values.to_vec() };
    let settings = settings.iter().enumerate().map(setting).collect();
    Sweep { name: "costs", parameter: "factor", settings }
}

#[test]
fn what_a_setting_reaches_is_explained_by_it() {
    let mut rows = [row(20.0), row(15.6)];
    sweep(&[[19.0, 15.6], [16.0, 15.0]]).explain(&mut rows);
    assert_eq!(rows.each_ref().map(PaperRow::verdict), [RowVerdict::Explained, RowVerdict::Predicted]);
    let explanation = rows[0].explanation().expect("the second setting");
    assert_eq!((explanation.at.as_str(), explanation.value), ("1", 16.0));
    assert!(rows[1].explanation().is_none(), "what holds needs no explanation");
}

#[test]
fn what_no_setting_reaches_stays_missed() {
    let mut rows = [row(20.0), row(15.6)];
    sweep(&[[19.0, 15.6], [25.0, 15.0]]).explain(&mut rows);
    assert_eq!(rows[0].verdict(), RowVerdict::Missed);
}

/// Among settings that exclude each other, only the setting that explains the most rows counts.
#[test]
fn one_setting_explains_all_that_a_sweep_explains() {
    let explained = |settings: &[[f64; 3]]| {
        let mut rows = [row(20.0), row(21.0), row(22.0)];
        let setting = |(i, values): (usize, &[f64; 3])| Setting { at: i.to_string(), values: values.to_vec() };
        let settings = settings.iter().enumerate().map(setting).collect();
        Sweep { name: "costs", parameter: "factor", settings }.explain(&mut rows);
        rows.map(|row| row.explanation().map_or(String::new(), |found| found.at.clone()))
    };
    assert_eq!(explained(&[[16.0, 30.0, 30.0], [30.0, 16.0, 15.0], [16.0, 15.0, 30.0]]), ["", "1", "1"]);
    assert_eq!(explained(&[[16.0, 30.0, 30.0], [30.0, 16.0, 30.0]]), ["0", "", ""]);
}

/// A setting that reaches one row must not lose another one.
#[test]
fn a_setting_that_loses_another_row_explains_nothing() {
    let mut rows = [row(20.0), row(15.6)];
    sweep(&[[16.0, 9.0]]).explain(&mut rows);
    assert_eq!(rows[0].verdict(), RowVerdict::Missed);
}
