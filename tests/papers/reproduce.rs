//! The papers' figures beside ours: verdicts, what they rest on, and what the book says of them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use approx::abs_diff_eq;
use crossbar::report::{Cell, NamedPicture, PictureGrid, Series, Table};
use crossbar::study::reproduce::report::{held, notes, tables, tally_line};
use crossbar::study::reproduce::{
    Bound, ENTRIES, EntryFindings, EntryRecord, Judgement, Method, ModelSize, Origin, PaperFigure, PaperRow, Prose,
    RecordStatus, Reproduced, RowSource, RowVerdict, Standing, choose, number, papers, printed, recorded, reproduce,
};

/// Worked out once.
static FOUND: LazyLock<Reproduced> =
    LazyLock::new(|| reproduce(ENTRIES, ModelSize::Reduced, &mut |_, _, _| ()).expect("the entries can be worked out"));

fn all() -> impl Iterator<Item = &'static PaperRow> {
    FOUND.iter().flat_map(|(_, found)| &found.rows)
}

fn findings(id: &str) -> &'static EntryFindings {
    &FOUND.iter().find(|(entry, _)| entry.id == id).expect("an entry").1
}

/// The rows: whoever changes the engine, a scene, a card or a weight sees here what it does to them.
#[test]
fn the_rows_are_these() {
    let line = |row: &PaperRow| {
        let PaperRow { device, method, target, ours, .. } = row;
        let PaperFigure { id, what, unit, .. } = target;
        let range = row.range().map(|[low, high]| format!(" ({low:.3} to {high:.3})")).unwrap_or_default();
        let rounded = if row.holds_by_rounding() { " by the rounding of the print" } else { "" };
        let source = if row.source == RowSource::Computed { String::new() } else { format!("{}: ", row.source) };
        let explained = row.explanation().map(|e| format!(" [{}]", e.text())).unwrap_or_default();
        let against = row.contradiction().map(|found| format!(" [{}]", found.text())).unwrap_or_default();
        let (paper, bound, verdict) = (target.text(), row.bound.text(), row.verdict());
        format!(
            "{id}: {what}, {device}, {method}: {paper} {unit}, ours {ours:.3}{range}, {bound}: \
             {source}{verdict}{rounded}{explained}{against}"
        )
    };
    let lines: Vec<String> = all().map(line).chain([tally_line(&FOUND)]).collect();
    insta::assert_snapshot!(lines.join("\n"));
}

/// Records are of this program, and what is quick to compute has their bits. A change of a model, a printed figure or a
/// computation that makes a record stale shows here: `crossbar reproduce --record src/studies/records` makes it anew.
#[test]
fn records_are_of_this_program() {
    let mut quick = 0;
    for (entry, found) in FOUND.iter() {
        let record = recorded(entry).expect("a whole record");
        let is_quick = record.as_ref().is_some_and(EntryRecord::is_quick);
        match (&record, &found.record) {
            (None, None | Some(RecordStatus::Reduced(None))) => {}
            (Some(record), Some(RecordStatus::Recorded(made))) => assert!(record.made() == made && !is_quick),
            (Some(_), Some(RecordStatus::Computed { differ: 0, .. })) => assert!(is_quick, "{}", entry.id),
            (_, Some(status)) => panic!("{}: {}", entry.id, status.sentence().expect("a sentence")),
            (Some(_), None) => panic!("{} has a record and no choice of size", entry.id),
        }
        let confirmed = found.rows.iter().filter(|row| row.source == RowSource::Confirmed).count();
        assert_eq!(confirmed, if is_quick { found.rows.len() } else { 0 }, "{}", entry.id);
        quick += confirmed;
    }
    assert!(quick > 0, "no recorded row is computed anew");
    let files = std::fs::read_dir(file("src/studies/records")).expect("the records");
    let names = files.map(|file| file.expect("a file").file_name().into_string().expect("a name in ASCII"));
    let mut names: Vec<String> = names.filter_map(|name| Some(name.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    let mut known: Vec<&str> =
        ENTRIES.iter().filter(|entry| recorded(entry).is_ok_and(|found| found.is_some())).map(|it| it.id).collect();
    known.sort_unstable();
    assert_eq!(names, known, "every file of the folder is a record of the program");
}

/// Recorded rows and those of this run are counted; rows of reduced models have no verdict, and no tally has them.
#[test]
fn reduced_rows_are_not_counted() {
    for (entry, found) in FOUND.iter() {
        let reduced = matches!(found.record, Some(RecordStatus::Reduced(_)));
        assert!(found.rows.iter().all(|row| (row.source == RowSource::Reduced) == reduced), "{}", entry.id);
    }
    let reduced = all().filter(|row| row.verdict() == RowVerdict::Reduced).count();
    let counted: usize =
        RowVerdict::counted().map(|verdict| all().filter(|row| row.verdict() == verdict).count()).sum();
    assert_eq!(counted + reduced, all().count());
    assert!(tally_line(&FOUND).starts_with(&format!("{counted} figures: ")), "{}", tally_line(&FOUND));
}

/// A printed figure has one row, and a judged one has a row: what is not judged is listed with its reason.
#[test]
fn every_judged_figure_has_one_row() {
    let figures = papers().expect("the data").iter().flat_map(|paper| &paper.figures);
    let judged = figures.filter(|figure| matches!(figure.judgement, Judgement::Within(_)));
    let mut judged: Vec<&str> = judged.map(|figure| figure.id.as_str()).collect();
    let mut rows: Vec<&str> = all().map(|row| row.target.id.as_str()).collect();
    judged.sort_unstable();
    rows.sort_unstable();
    assert_eq!(rows, judged);
}

/// Section 6.1, by the paper's own equation: to the digits, in the table; rows of what is drawn have the pipeline's.
#[test]
fn the_equation_gives_every_printed_digit() {
    let found = findings("equation-11");
    let figures = [
        "results-4",
        "results-16",
        "fill-geforce3",
        "fill-geforce4",
        "ten-triangles-geforce3",
        "ten-triangles-geforce4",
    ];
    for (line, id) in found.tables[0].rows().iter().zip(figures) {
        let figure = printed(&format!("ray-engine/{id}")).expect("a figure");
        let equation: f64 = line[3].text().replace(',', "").parse().expect("a number");
        assert!(abs_diff_eq!(equation, figure.value, epsilon = figure.rounding()), "{id}: {equation}");
    }
    let verdicts: Vec<_> = found.rows.iter().map(|row| (row.method, row.verdict())).collect();
    let [print, drawn] = [(Method::Equation, RowVerdict::Consistent), (Method::Pipeline, RowVerdict::Predicted)];
    assert_eq!(verdicts, [print, print, drawn, drawn, drawn]);
}

/// A contradiction is computed from print, and stands in the notes; our values do not decide it.
#[test]
fn contradictions_come_with_their_computations() {
    let found: Vec<&PaperRow> = all().filter(|row| row.verdict() == RowVerdict::Contradictory).collect();
    let of = |paper: &str| found.iter().filter(|row| row.target.id.starts_with(paper)).count();
    assert_eq!(["ray-engine", "subsurface", "cpca", "all-frequency", "bi-scale"].map(of), [0, 15, 4, 0, 5]);
    let notes = notes(&FOUND);
    for row in &found {
        let text = row.contradiction().expect("a computation").text();
        assert!(text.contains(|c: char| c.is_ascii_digit()), "{text}");
        assert!(notes.rows().iter().any(|note| note[1].text() == "contradictory" && note[2].text() == text), "{text}");
    }
}

/// Evidence tells apart what is met: an order and print against print are no predictions.
#[test]
fn classes_of_evidence_follow_from_the_rows() {
    for row in all() {
        let numbers = !matches!(row.bound, Bound::Order | Bound::AtLeast | Bound::TooVague);
        let calibrated = matches!(row.standing, Standing::Calibrated { .. });
        let measured = row.method != Method::Equation;
        match row.verdict() {
            RowVerdict::Predicted => assert!(numbers && measured && !calibrated, "{}", row.target.id),
            RowVerdict::OrderOnly => assert!(!numbers && measured && !calibrated, "{}", row.target.id),
            RowVerdict::Consistent => assert!(!measured && !calibrated, "{}", row.target.id),
            _ => {}
        }
        // Rates are judged as rates.
        let rate = ["Hz", "fps", "frames/s"].contains(&row.target.unit.as_str());
        assert!(!rate || row.bound == Bound::Relative(Bound::SHARE), "{}", row.target.id);
    }
}

/// Numbers that are neither printed nor read off our own model can be told apart.
#[test]
fn origins_are_said() {
    let row = |id: &str| all().find(|row| row.target.id == id).expect("a row");
    let implied = &row("subsurface/lookups-fixed").target;
    assert_eq!((implied.text(), &implied.origin), ("20 (implied)".to_owned(), &Origin::Implied("1.25 L".to_owned())));
    assert!(matches!(row("cpca/figure-6").target.origin, Origin::Inferred(_)));
    for id in ["radiosity/jacobi-operations", "radiosity/gauss-seidel-operations"] {
        assert!(matches!(row(id).standing, Standing::Calibrated { .. }), "N was chosen from {id}");
    }
}

/// A calibrated row is no success, and being calibrated does not save it.
#[test]
fn calibration_hides_no_miss() {
    let radeon: Vec<_> =
        findings("radeon-8500").rows.iter().map(|row| (row.standing.to_string(), row.verdict())).collect();
    let calibrated = || "calibrated".to_owned();
    assert_eq!(radeon, [(calibrated(), RowVerdict::Missed)]);
    let mut calibrated = all().filter(|row| matches!(row.standing, Standing::Calibrated { .. }));
    let verdicts = [RowVerdict::Calibrated, RowVerdict::Missed, RowVerdict::Contradictory, RowVerdict::Reduced];
    assert!(calibrated.all(|row| verdicts.contains(&row.verdict())));
    assert!(!held(&FOUND), "whoever misses no figure any more says so, and the program then ends with 0");
}

/// A bound that a card worth nothing would meet says nothing.
#[test]
fn no_row_of_tables_3_to_5_is_met_by_the_host_alone() {
    let alone = &findings("ray-engine-table-3").rows[0];
    assert_eq!((alone.target.id.as_str(), alone.verdict()), ("ray-engine/host-alone", RowVerdict::Calibrated));
    let entries = ["ray-engine-table-3", "ray-engine-table-4", "ray-engine-table-5"];
    let rows = entries.iter().flat_map(|id| &findings(id).rows).filter(|row| row.target.unit == "rays/s");
    let others: Vec<&PaperRow> = rows.filter(|row| row.target.id != alone.target.id).collect();
    assert_eq!(others.len(), 8);
    assert!(others.iter().all(|row| !row.admits(alone.ours)));
}

/// An explanation of a row lies within its bound, and is a setting of a table of the same entry or its neighbours.
#[test]
fn explanations_reach_what_they_explain() {
    let explained: Vec<_> = all().filter_map(|row| Some((row, row.explanation()?))).collect();
    for (row, explanation) in &explained {
        assert!(row.admits(explanation.value()) && !row.holds(), "{}", row.target.id);
    }
    assert_eq!(explained.len(), all().filter(|row| row.verdict() == RowVerdict::Explained).count());
}

/// Differences are shares of what the paper has, in rows and wherever else a table has them.
#[test]
fn differences_are_against_the_paper() {
    for row in all() {
        let (ours, paper) = (row.ours, row.target.value);
        assert_eq!(row.difference(), (ours - paper) / paper, "{}", row.target.id);
    }
    let [predicted, calibrated] = tables(&FOUND);
    let column = |table: &Table, name: &str| table.headings().iter().position(|heading| heading == name);
    for table in [predicted, calibrated] {
        let place = column(&table, "difference_%").expect("a column");
        for shown in table.rows() {
            let is_it = |row: &&PaperRow| row.target.what == shown[0].text() && row.target.place == shown[1].text();
            let differences: Vec<_> =
                all().filter(is_it).map(|row| Cell::decimals(100.0 * row.difference(), 1)).collect();
            assert!(differences.contains(&shown[place]), "{}: {}", shown[0].text(), shown[place].text());
        }
    }
}

/// A reason stands once, with all its rows; what is explained is counted, and not as reproduced.
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
    assert!(tally_line(&FOUND).contains(&format!("outside their bounds, {explained} of them explained")));
}

/// The three experiments: what another reading of the rays on the card, another octree of the host alone and other
/// costs of commands give.
#[test]
fn what_the_paper_leaves_open_is_swept() {
    let columns = |id: &str, table: usize| findings(id).tables[table].headings().len() - 5;
    assert_eq!(columns("ray-engine-tables-1-2", 1), 2, "rays and visits");
    assert_eq!(columns("ray-engine-table-4", 1), 2, "rays and visits");
    assert_eq!(columns("ray-engine-table-3", 1), 8, "leaves");
    assert_eq!(columns("ray-engine-table-5", 1), 4, "factors");
    // Twice the costs bring 64 rays home, and lose asynchronous read-back: no explanation.
    let small = all().find(|row| row.target.id == "ray-engine/plus-card").expect("a row");
    assert_eq!((small.verdict(), small.explanation()), (RowVerdict::Missed, None));
}

/// The chosen number of patches is one of four that give both printed pairs of rates.
#[test]
fn the_number_of_patches_is_swept() {
    let sizes = &findings("radiosity-rates").tables[0];
    let at = |name: &str| sizes.headings().iter().position(|heading| heading == name).expect("a column");
    let (jacobi, seidel) = (at("reads_141"), at("reads_190"));
    let both = sizes.rows().iter().filter(|row| [jacobi, seidel].iter().all(|i| row[*i].text() == "yes"));
    let both: Vec<String> = both.map(|row| row[0].text()).collect();
    assert_eq!(both, ["1,540", "1,541", "1,542", "1,543"]);
    assert!(sizes.rows().len() > both.len(), "and others that do not");
}

#[test]
fn a_miss_comes_with_an_open_question() {
    for (entry, found) in FOUND.iter() {
        let missed = found.rows.iter().any(|row| row.verdict() == RowVerdict::Missed);
        assert!(!missed || !found.questions.is_empty(), "{}", entry.id);
    }
}

/// Figures in sentences are the run's: what is written by hand has digits in names alone.
#[test]
fn no_figure_is_written_by_hand() {
    let prose = |text: &Prose| {
        assert!(text.is_whole(), "{}", text.template());
        figures_in(text.template())
    };
    for (entry, found) in FOUND.iter() {
        let captions = found.charts.iter().map(|chart| &chart.caption);
        let mut figures: Vec<String> = found.text.iter().chain(captions).flat_map(prose).collect();
        figures.extend(found.questions.iter().flat_map(|question| figures_in(question)));
        assert_eq!(figures, Vec::<String>::new(), "{}", entry.id);
    }
}

/// Numbers of a text that name nothing: not part of a word (`GeForce3`), and not behind `Table`, `equation` and the
/// like.
fn figures_in(text: &str) -> Vec<String> {
    const BEFORE: [&str; 7] = ["table", "figure", "equation", "section", "radeon", "step", "tables"];
    let words: Vec<&str> =
        text.split_whitespace().map(|word| word.trim_matches(|c: char| !c.is_alphanumeric())).collect();
    let is_figure = |(i, word): (usize, &&str)| {
        let bare = word.split("'").next().unwrap_or_default();
        let number = bare.starts_with(|c: char| c.is_ascii_digit()) && !bare.contains(char::is_alphabetic);
        let named = i > 0 && BEFORE.contains(&words[i - 1].to_lowercase().as_str());
        (number && !named).then(|| (*word).to_owned())
    };
    words.iter().enumerate().filter_map(is_figure).collect()
}

#[test]
fn figures_are_told_from_names() {
    assert_eq!(figures_in("a GeForce3's Table 3, equation 11, section 6.1's entry in fp32"), Vec::<String>::new());
    assert_eq!(figures_in("within 15 % of 29, or 2.5 times"), ["15", "29", "2.5"]);
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

/// Figure 4: the card's time is linear in the elements of the matrix, the host's more than that.
#[test]
fn the_card_is_linear_and_the_host_is_not() {
    let [rgb, luminance, host] = &findings("radiosity-figure-4").charts[0].chart.lines[..] else {
        panic!("three lines")
    };
    // Milliseconds an element, but for the origin.
    let slopes = |line: &Series| -> Vec<f64> { line.points[1..].iter().map(|(n, ms)| ms / n).collect() };
    for line in [rgb, luminance] {
        let all = slopes(line);
        let last = all[all.len() - 1];
        // From 512 patches on; below, what a draw costs by itself shows.
        assert!(
            all[3..].iter().all(|slope| abs_diff_eq!(slope / last, 1.0, epsilon = 0.01)),
            "{}: {all:?}",
            line.label
        );
    }
    let all = slopes(host);
    assert!(all.windows(2).all(|two| two[1] >= two[0]) && all[6] > 5.0 * all[0], "{all:?}");
}

/// Where models and BRDFs are lost, an order is judged and nothing closer; what the appendix prints to its digits.
#[test]
fn lost_models_are_judged_by_order() {
    for id in ["cpca-figure-6", "cpca-figure-10", "cpca-figure-11", "cpca-table-1", "cpca-coherence"] {
        let found = findings(id);
        // Frame rates, and what another card gains, follow from sizes and overdraw as printed.
        let rows = || found.rows.iter().filter(|row| !["Hz", "%"].contains(&row.target.unit.as_str()));
        assert!(rows().all(|row| matches!(row.bound, Bound::Order | Bound::AtLeast)), "{id}");
        assert!(rows().all(|row| row.target.value != 1.0 || row.bound == Bound::AtLeast), "{id}: 1 is no order");
    }
    let appendix = &findings("cpca-appendix").rows;
    assert!(appendix.iter().all(|row| row.bound == Bound::Print && row.verdict() == RowVerdict::Predicted));
    assert_eq!(appendix.len(), 17);
}

/// Reflectance factors: the textbooks' forms judge the rows, and every other form stands in a table beside them.
#[test]
fn reflectance_factors_have_the_printed_rows() {
    let found = findings("all-frequency-factors");
    let errors = found.rows.iter().filter(|row| row.target.unit == "1/sr");
    assert_eq!((errors.count(), found.rows.len(), found.tables.len()), (20, 26, 4));
    let forms = |table: usize| found.tables[table].headings().len() - 5;
    assert_eq!([forms(0), forms(1)], [7, 7], "four on maps, and each lobe at equal angles");
    for table in &found.tables[..2] {
        for row in table.rows() {
            assert_eq!(row[4].text().trim_end_matches(" *"), row[5].text().trim_end_matches(" *"), "the first form");
        }
    }
    let vague = found.rows.iter().filter(|row| row.verdict() == RowVerdict::TooVague);
    assert_eq!(vague.count(), 1, "Figure 3's threshold");
}

/// Figure 11: each additional vector helps, and more on the smooth model. Pictures stand beside the rows. Which of the
/// two models has the larger errors is for the run at full size: reduced, folds and feathers are of few vertices each.
#[test]
fn smooth_transfer_compresses_better() {
    let figure = findings("cpca-figure-11");
    let errors = || figure.rows.iter().filter(|row| row.target.what.contains("squared error"));
    let falling = |row: &&PaperRow| row.target.id.starts_with("cpca/falls-");
    assert_eq!(errors().filter(falling).count(), 6);
    assert!(errors().filter(falling).all(PaperRow::holds));
    let falls =
        |name: &str| -> f64 { errors().filter(|row| row.target.what.starts_with(name)).map(|row| row.ours).product() };
    assert!(falls("bird") > falls("Buddha"), "{} and {}", falls("bird"), falls("Buddha"));
    assert_eq!((pictures("cpca-figure-11").len(), pictures("cpca-figure-10").len()), (10, 4));
}

/// Number of pixels, black apart, whose hue differs from that of the most frequent color.
fn other_hues(colors: &BTreeMap<[u8; 3], usize>) -> usize {
    let hue = |color: &[u8; 3]| color.map(|value| f64::from(value) / f64::from(color[0].max(color[1]).max(color[2])));
    let lit = || colors.iter().filter(|(color, _)| color.iter().any(|&value| value > 64));
    let (main, _) = lit().max_by_key(|(_, count)| **count).expect("a color");
    let is_other = |color: &[u8; 3]| hue(color).iter().zip(hue(main)).any(|(value, main)| (value - main).abs() > 0.2);
    lit().filter(|(color, _)| is_other(color)).map(|(_, count)| count).sum()
}

/// The pictures of an entry, without those of its light.
fn pictures(id: &str) -> Vec<&'static NamedPicture> {
    let all = findings(id).pictures.iter().flat_map(PictureGrid::pictures);
    all.filter(|picture| !picture.name.ends_with("light")).collect()
}

/// Figures 4, 5 and 7 to 9 have their pictures, none of them empty or like another one of its entry.
#[test]
fn figures_have_their_pictures() {
    let counts = [
        ("cpca-figures-3-4", 7),
        ("cpca-coherence", 8),
        ("cpca-figure-7", 5),
        ("cpca-figure-8", 4),
        ("cpca-figure-9", 6),
        ("all-frequency-figures", 49),
    ];
    for (id, count) in counts {
        let pictures = pictures(id);
        assert_eq!(pictures.len(), count, "{id}");
        for (at, picture) in pictures.iter().enumerate() {
            let pixels = |picture: &NamedPicture| picture.image.pixels().map(|pixel| pixel.0).collect::<Vec<_>>();
            let full = matches!(findings(id).record, Some(RecordStatus::Computed { .. }));
            assert_eq!(picture.image.width(), if full { 640 } else { 320 }, "{}", picture.name);
            let mut seen: BTreeMap<[u8; 3], usize> = BTreeMap::new();
            pixels(picture).into_iter().for_each(|pixel| *seen.entry(pixel).or_default() += 1);
            assert!(seen.len() > 2, "{id}, {}: {} colors", picture.name, seen.len());
            // Mixed with the ground, a group keeps its hue: another hue is another group.
            let others = other_hues(&seen);
            assert!(id != "cpca-coherence" || others > 32, "{id}, {}: {others} pixels", picture.name);
            for other in &pictures[..at] {
                assert!(pixels(other) != pixels(picture), "{id}: {} and {}", other.name, picture.name);
            }
        }
    }
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Holds a file against what it should be, or writes it: as snapshots do, by `INSTA_UPDATE=always`.
fn hold(path: &str, expected: &str) {
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(file(path), expected).expect("it can be written");
    }
    let found = std::fs::read_to_string(file(path)).unwrap_or_default();
    assert!(found == expected, "{path} is out of date: INSTA_UPDATE=always cargo test --test papers writes it");
}

/// Omega and clusters do not depend on coding, and each further representative lowers the error.
#[test]
fn clusters_and_codes_of_models_keep_their_laws() {
    let found = findings("all-frequency-table-1");
    assert_eq!((found.rows.len(), found.tables.len()), (33, 6));
    for row in found.tables[1].rows().iter().filter(|row| ["omega", "size after clustering"].contains(&&*what(row))) {
        let text = |at: usize| row[at].text().trim_end_matches(" *").to_owned();
        assert!((5..20).all(|at| text(at) == text(4)), "{}", row[0].text());
    }
    for row in found.tables[5].rows() {
        let errors: Vec<f64> = row[1..].iter().map(|cell| cell.text().parse().expect("a number")).collect();
        assert!(errors.len() == 16 && errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    }
}

/// Table 1 has all readings: with a ground, which can only take light away, a row's range has a smaller omega.
#[test]
fn a_ground_takes_light_away() {
    for row in findings("all-frequency-table-1").rows.iter().filter(|row| row.target.unit == "%") {
        let [least, most] = row.range().expect("readings");
        assert!(!row.target.id.contains("omega") || (least < row.ours && most == row.ours), "{}", row.target.id);
        assert_eq!(row.holds(), row.admits(least) && row.admits(most), "{}", row.target.id);
    }
}

/// The class of a miss is data of the figure: every missed row has one, and no other figure.
#[test]
fn missed_rows_have_their_class() {
    let judged = all().filter(|row| row.verdict() != RowVerdict::Reduced);
    let wrong = judged.filter(|row| (row.verdict() == RowVerdict::Missed) != row.target.missed.is_some());
    assert_eq!(wrong.map(|row| row.target.id.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
    let figures = papers().expect("the data").iter().flat_map(|paper| &paper.figures);
    let idle = figures.filter(|figure| figure.missed.is_some() && matches!(figure.judgement, Judgement::Not(_)));
    assert_eq!(idle.map(|figure| figure.id.as_str()).collect::<Vec<_>>(), Vec::<&str>::new());
}

/// Figures 2, 5 and 6: more terms, more representatives and more light coefficients are nearer.
#[test]
fn pictures_get_nearer_with_what_is_kept() {
    let found = findings("all-frequency-figures");
    assert_eq!((found.rows.len(), found.tables.len()), (15, 5));
    for (table, column) in
        [(1, "relative_squared_error"), (2, "squared_error"), (2, "rms_%"), (3, "rms_%"), (3, "flicker_%")]
    {
        let table = &found.tables[table];
        let at = table.headings().iter().position(|heading| heading == column).expect("the column");
        let values: Vec<f64> = table.rows().iter().map(|row| row[at].text().parse().expect("a number")).collect();
        let forms = if table.headings()[0] == "form" { 2 } else { 1 };
        for values in values.chunks(values.len() / forms) {
            assert!(values.len() > 3 && values.is_sorted_by(|a, b| a > b), "{column}: {values:?}");
        }
    }
}

/// Subject of a row of Table 1, without the model.
fn what(row: &[Cell]) -> String {
    row[0].text().rsplit(": ").next().unwrap_or_default().to_owned()
}

/// The text with what stands between `<!-- reproduce: NAME -->` and `<!-- /reproduce -->` replaced by what `of` says.
fn filled(text: &str, of: impl Fn(&str) -> String) -> String {
    const END: &str = "<!-- /reproduce -->";
    let mut parts = text.split("<!-- reproduce: ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once(" -->").expect("the mark's end");
        let (_, rest) = rest.split_once(END).expect("an end mark for each mark");
        out.push_str(&format!("<!-- reproduce: {name} -->{}{END}{rest}", of(name)));
    }
    out
}

fn markdown(table: &Table) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = row(table.headings().iter().map(|_| "---".to_owned()).collect());
    let body = table.rows().iter().map(|cells| row(cells.iter().map(|cell| cell.text()).collect()));
    [row(table.shown_headings()), rule].into_iter().chain(body).collect()
}

/// Where figures are missed, calibrated ones among them: `Table 1 (2 of 6)`.
fn missed_by_place() -> String {
    let mut places: Vec<(&str, &str, [usize; 2])> = Vec::new();
    for (paper, row) in FOUND.iter().flat_map(|(entry, found)| found.rows.iter().map(|row| (paper_of(entry.id), row))) {
        let found = places.iter().position(|(p, place, _)| (*p, *place) == (paper, row.target.place.as_str()));
        let at = found.unwrap_or_else(|| {
            places.push((paper, &row.target.place, [0, 0]));
            places.len() - 1
        });
        places[at].2[0] += usize::from(row.verdict() == RowVerdict::Missed);
        places[at].2[1] += usize::from(row.verdict() != RowVerdict::Reduced);
    }
    let missed = places.iter().filter(|(.., [missed, _])| *missed > 0);
    let text = missed.map(|(paper, place, [missed, all])| format!("{paper}, {place} ({missed} of {all})"));
    text.collect::<Vec<_>>().join("; ")
}

fn paper_of(id: &str) -> &'static str {
    const PAPERS: [(&str, &str); 5] = [
        ("radiosity", "radiosity"),
        ("subsurface", "subsurface"),
        ("cpca", "CPCA"),
        ("all-frequency", "all-frequency transfer"),
        ("bi-scale", "bi-scale transfer"),
    ];
    PAPERS.iter().find(|(begin, _)| id.starts_with(begin)).map_or("Ray Engine", |(_, paper)| paper)
}

/// Text of the book for a name: `rows ID...`, `calibrated ID...`, `table ID PLACE`, `tally`, `missed`.
fn said(name: &str) -> String {
    let words: Vec<&str> = name.split(' ').collect();
    let of =
        |ids: &[&str]| -> Reproduced { FOUND.iter().filter(|(entry, _)| ids.contains(&entry.id)).cloned().collect() };
    let table = match words[..] {
        ["tally"] => {
            let counted = || all().filter(|row| row.verdict() != RowVerdict::Reduced);
            let judged = || counted().filter(|row| !matches!(row.standing, Standing::Calibrated { .. }));
            let recorded = || counted().filter(|row| row.source != RowSource::Computed);
            let confirmed = recorded().filter(|row| row.source == RowSource::Confirmed).count();
            let count = |verdict| judged().filter(|row| row.verdict() == verdict).count();
            return format!(
                "of {} figures {} are predicted within bounds in numbers, {} are met in order only, and {} are the papers' \
                 own values set against each other; {} are explained and {} missed, outside their bounds; {} are contradicted \
                 by their own paper; {} are too vague to judge. {} are recorded at full size, {confirmed} of them computed anew with \
                 the same bits; {} more have reduced models alone and are not judged",
                judged().count(),
                count(RowVerdict::Predicted),
                count(RowVerdict::OrderOnly),
                count(RowVerdict::Consistent),
                count(RowVerdict::Explained),
                count(RowVerdict::Missed),
                count(RowVerdict::Contradictory),
                count(RowVerdict::TooVague),
                recorded().filter(|row| row.source != RowSource::Reduced).count(),
                all().count() - counted().count(),
            );
        }
        ["missed"] => return missed_by_place(),
        ["rows", ref ids @ ..] => tables(&of(ids))[0].clone(),
        ["calibrated", ref ids @ ..] => tables(&of(ids))[1].clone(),
        ["table", id, place] => findings(id).tables[place.parse::<usize>().expect("a place from 0")].clone(),
        _ => panic!("unknown block `{name}`"),
    };
    format!("\n\n{}\n", markdown(&table))
}

/// The page of what works and those of the papers.
fn pages() -> Vec<String> {
    let folder = std::fs::read_dir(file("docs/papers")).expect("the papers' pages");
    let names = folder.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in ASCII"));
    let mut pages: Vec<String> =
        names.filter(|name| name.ends_with(".md")).map(|name| format!("docs/papers/{name}")).collect();
    pages.sort();
    pages.insert(0, "docs/status.md".to_owned());
    pages
}

/// The book's figures are the program's.
#[test]
fn the_book_says_what_the_program_says() {
    for path in pages() {
        let text = std::fs::read_to_string(file(&path)).expect("a page");
        assert!(text.contains("<!-- reproduce: "), "{path} has figures of the program");
        hold(&path, &filled(&text, said));
    }
}

/// No entry that judges figures is left out of the book.
#[test]
fn every_row_stands_in_the_book() {
    let texts = pages().iter().map(|path| std::fs::read_to_string(file(path)).expect("a page")).collect::<String>();
    let blocks = texts.split("<!-- reproduce: rows ").skip(1).filter_map(|rest| rest.split_once(" -->"));
    let shown: BTreeSet<&str> = blocks.flat_map(|(ids, _)| ids.split(' ')).collect();
    for (entry, found) in FOUND.iter() {
        assert!(found.rows.is_empty() || shown.contains(entry.id), "{} has rows that no page shows", entry.id);
    }
}

/// The book's charts are the program's.
#[test]
fn the_book_draws_what_the_program_draws() {
    for (id, name) in [
        ("ray-engine-tables-1-2", "ray-engine-table-2"),
        ("ray-engine-table-3", "ray-engine-host-octree"),
        ("ray-engine-table-5", "ray-engine-table-5"),
    ] {
        let chart = findings(id).charts.iter().find(|chart| chart.name == name).expect("a chart");
        hold(&format!("docs/papers/{}.svg", name.replace('-', "_")), &chart.chart.svg().expect("a drawing"));
    }
}

#[test]
fn blocks_are_filled() {
    let text = "a <!-- reproduce: tally -->old<!-- /reproduce --> b";
    assert_eq!(filled(text, |name| name.to_uppercase()), text.replace("old", "TALLY"));
    assert_eq!(number(2.5, 1), "2.5");
}
