//! Printed figures, and how near the models have to come.

use std::sync::LazyLock;

use rayon::prelude::*;

use crossbar::study::reproduce::report::{Reproduced, held};
use crossbar::study::reproduce::{ENTRIES, Judgement, Row, TOLERANCE, choose};

/// Worked out once.
static FOUND: LazyLock<Reproduced> = LazyLock::new(|| {
    ENTRIES.par_iter().map(|entry| (*entry, entry.reproduce().expect("an entry can be worked out"))).collect()
});

fn rows<'a>(found: &'a Reproduced, id: &str) -> Vec<&'a Row> {
    found.iter().filter(|(entry, _)| entry.id == id).flat_map(|(_, found)| &found.rows).collect()
}

/// Section 6.1, by the paper's own equation: to the digits.
#[test]
fn the_rates_give_every_printed_digit() {
    let judged: Vec<_> = rows(&FOUND, "equation-11").iter().map(|row| row.judge_rates()).collect();
    let (reproduced, calibrated) = (Judgement::Reproduced, Judgement::Calibrated);
    assert_eq!(judged, [reproduced, reproduced, calibrated, calibrated, reproduced, calibrated]);
}

/// No figure of the GeForce cards went into the pipeline model, so each has to come near by itself.
#[test]
fn the_pipeline_comes_near_what_it_never_saw() {
    for row in rows(&FOUND, "equation-11") {
        let model = row.pipeline.as_ref().expect("the pipeline has an opinion");
        assert_eq!(model.calibrated_on, None, "{}", row.what);
        let error = row.symmetric_error(model.value);
        assert!(
            error.abs() <= TOLERANCE,
            "{} on {}: {} is off by {:.1} %",
            row.what,
            row.device,
            model.value,
            100.0 * error
        );
    }
    let misses = FOUND.iter().flat_map(|(_, f)| &f.rows).filter(|row| row.judge_pipeline() == Judgement::Explained);
    assert!(misses.clone().all(|row| row.note.contains("To know more one would need")), "a miss says what to find out");
    let by_entry = |id: &str| misses.clone().filter(|row| rows(&FOUND, id).contains(row)).count();
    assert_eq!(by_entry("vertex-variant"), 3, "three cards");
    assert_eq!(by_entry("ray-engine-tables-1-2"), 7);
    assert_eq!(by_entry("ray-engine-table-3"), 1, "the infinitely fast card");
    assert_eq!(by_entry("ray-engine-table-4"), 1, "4 to 16 triangles");
    assert_eq!(by_entry("radiosity-rates"), 1, "what the authors guess of their bandwidth");
    assert_eq!(misses.clone().count(), 13);
    assert!(held(&FOUND));
}

#[test]
fn charts_and_tables_are_not_empty() {
    for (entry, found) in FOUND.iter() {
        assert!(!found.text.is_empty(), "{}", entry.id);
        assert!(found.tables.iter().all(|table| !table.rows().is_empty()), "{}", entry.id);
        assert!(found.charts.iter().all(|chart| chart.chart.svg().is_ok()), "{}", entry.id);
    }
    assert_eq!(choose(&["figure-7".to_owned()]).expect("an entry").len(), 1);
    assert!(choose(&["figure-8".to_owned()]).is_err());
}

/// In per cent over the host alone, which is the first row of Tables 3 to 5.
fn speed_ups(id: &str) -> Vec<[f64; 2]> {
    let rows = rows(&FOUND, id);
    let ours = |row: &Row| row.pipeline.as_ref().map_or(f64::NAN, |model| model.value);
    let over = |value: f64, first: f64| 100.0 * (value / first - 1.0);
    let alone = rows[0];
    rows[1..].iter().map(|row| [over(row.printed.value, alone.printed.value), over(ours(row), ours(alone))]).collect()
}

/// Table 3, from the one constant that is calibrated: the card helps, not waiting for it helps more, and were it infinitely fast still more.
#[test]
fn the_card_pays_in_the_printed_order() {
    let found = speed_ups("ray-engine-table-3");
    assert!(0.0 < found[0][1] && found[0][1] < found[1][1] && found[1][1] < found[2][1], "{found:?}");
    for [printed, ours] in &found[..2] {
        assert!((ours - printed).abs() <= 10.0, "{ours} % for {printed} %");
    }
    // Missed by 27 points, and explained: held so that whoever comes nearer says so.
    assert!((found[2][1] - found[2][0] + 27.0).abs() < 1.0, "{found:?}");
}

/// Table 5: every number of rays pays, some more than the smallest do, and the largest passes less again.
#[test]
fn larger_passes_pay_up_to_a_point() {
    let found = speed_ups("ray-engine-table-5");
    for [printed, ours] in &found {
        assert!(*ours > 0.0 && (ours - printed).abs() <= 10.0, "{ours} % for {printed} %");
    }
    assert!(found[1][1] > found[0][1] && found[3][1] < found[1][1] && found[3][1] < found[2][1], "{found:?}");
}

/// The tables' rows: whoever changes the engine, a scene or a weight sees here what it does to them.
#[test]
fn the_tables_are_these() {
    let row = |row: &Row| {
        let ours = row.pipeline.as_ref().map_or(f64::NAN, |model| model.value);
        format!(
            "{}, {}: printed {} {}, ours {ours:.1}",
            row.printed.place, row.what, row.printed.value, row.printed.unit
        )
    };
    let tables = ["ray-engine-tables-1-2", "ray-engine-table-3", "ray-engine-table-4", "ray-engine-table-5"];
    let lines: Vec<String> = tables.iter().flat_map(|id| rows(&FOUND, id)).map(row).collect();
    insta::assert_snapshot!(lines.join("\n"));
}

/// Section 3.1 of the radiosity paper: no figure of it went into the model of its card.
#[test]
fn the_iterations_of_radiosity_come_near() {
    let found = rows(&FOUND, "radiosity-rates");
    let judged: Vec<_> = found.iter().map(|row| (row.judge_rates(), row.judge_pipeline())).collect();
    use Judgement::{Explained, Near, Reproduced, Silent};
    let expected =
        [(Silent, Near), (Reproduced, Near), (Reproduced, Reproduced), (Silent, Explained), (Reproduced, Silent)];
    assert_eq!(judged, expected);
    let modelled = found.iter().flat_map(|row| [&row.rates, &row.pipeline]).flatten();
    assert!(modelled.clone().all(|model| model.calibrated_on.is_none()));
    let per_s = found[0].pipeline.as_ref().expect("a model").value;
    assert!((per_s - 31.58).abs() < 0.01, "whoever comes nearer to 29.7 than 31.58 says so: {per_s}");
}

/// Figure 3: about twice, in each channel.
#[test]
fn jacobi_needs_about_twice_as_many_late() {
    for row in rows(&FOUND, "radiosity-figure-3") {
        assert_eq!(row.judge_pipeline(), Judgement::Reproduced, "{}", row.what);
    }
}

/// Figure 4: the card's time is linear in the elements of the matrix, the host's more than that.
#[test]
fn the_card_is_linear_and_the_host_is_not() {
    let (_, found) = FOUND.iter().find(|(entry, _)| entry.id == "radiosity-figure-4").expect("an entry");
    let [rgb, luminance, host] = &found.charts[0].chart.lines[..] else { panic!("three lines") };
    // Milliseconds an element, but for the origin.
    let slopes =
        |line: &crossbar::report::Line| -> Vec<f64> { line.points[1..].iter().map(|(n, ms)| ms / n).collect() };
    for line in [rgb, luminance] {
        let all = slopes(line);
        let last = all[all.len() - 1];
        // From 512 patches on; below, what a draw costs by itself shows.
        assert!(all[3..].iter().all(|slope| (slope / last - 1.0).abs() < 0.01), "{}: {all:?}", line.label);
    }
    let all = slopes(host);
    assert!(all.windows(2).all(|two| two[1] >= two[0]) && all[6] > 5.0 * all[0], "{all:?}");
    assert!(slopes(rgb)[6] > all[6] && slopes(luminance)[6] < all[6], "who is ahead at 2048 patches");
}
