//! Page, tables, charts, pictures and trace of the study.

use std::collections::BTreeMap;

use super::conclusion::{conclude, least_accurate};
use super::outcome::{MethodRow, RadiosityOutcome};
use super::pictures::IterationPicture;
use super::{Parameters, SolveMethod, SweepRow, leaks, tables};
use crate::geom::vector::{narrow, place_bits};
use crate::picture::RgbImage;
use crate::radiosity::display::SmoothVertex;
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, NamedChart, NamedPicture, Scale, Series, Table, false_color};
use crate::study::{StudyError, timeline_trace};

pub(super) fn findings(parameters: &Parameters, outcome: &RadiosityOutcome) -> Result<Findings, StudyError> {
    let mut found = Findings::new("Matrix radiosity");
    found.keep_table(FoundTable::from(patches(outcome)).csv("patches"));
    found.keep_table(FoundTable::from(vertices(outcome)).csv("vertices"));
    // The trace is that of the first method on a card.
    if let Some((row, facts)) = outcome.rows.iter().find_map(|row| Some((row, row.card.as_ref()?))) {
        let what = format!("{}: new emittance, 4 iterations, the room shown", row.label);
        let trace = timeline_trace::file(&parameters.profile, &facts.log, &what)?;
        trace.into_iter().for_each(|bytes| found.keep_file("timeline.json", bytes));
    }
    conclude(&mut found, outcome);
    // The pictures of the least accurate method and of the direct one come first.
    let first = least_accurate(&outcome.rows).or(outcome.rows.first()).map(|row| &row.label);
    let (mut lead, mut pictures) = (Vec::new(), Vec::new());
    for row in &outcome.rows {
        let label = &row.label;
        let picture = |kind: &str, image: &RgbImage, what: &str| {
            NamedPicture::new(format!("{label}-{kind}"), image.clone(), format!("{label}: {what}"))
        };
        pictures.push(picture("flat", &row.pictures.flat, "each patch with its radiosity"));
        let leads = row.method == SolveMethod::DIRECT || Some(label) == first;
        let list = if leads { &mut lead } else { &mut pictures };
        list.push(picture("smooth", &row.pictures.smooth, "resampled to corners"));
    }
    let is_drawn = |number: &&u32| outcome.frames.iter().any(|frame| frame.iteration == **number);
    for number in parameters.options.frames.iter().filter(|number| !is_drawn(number)) {
        found.conclusion(format!(
            "No picture after iteration {number}: the first method on the card stopped before it."
        ));
    }
    found.pictures(lead);
    found.paragraph(format!(
        "The radiosities of {} are computed as by the fragment programs of Carr, Hall and Hart (2003, section 3), and \
         by solvers of the host. The emulated {} draws pictures from its radiosity texture, multiplied by {}, with the \
         sRGB curve.",
        counted(outcome.patches.list().len() as u64, "patch", "patches"),
        parameters.profile.title,
        Cell::ratio(outcome.exposure).text(),
    ));
    found.heading("The room");
    found.table(FoundTable::from(tables::room(parameters, outcome)).field("room"));
    found.pictures(pictures);
    leaks::report(&outcome.leaks, &mut found);
    let errors = outcome.rows.iter().filter_map(|row| Some((row.label.as_str(), row.pictures.error.as_ref()?)));
    let errors: Vec<_> = errors.collect();
    let errors = false_color::errors(parameters.camera.width(), &errors, |label, ends| {
        format!("{label} against direct: blue -{ends} % (darker), white 0, red +{ends} % (brighter)")
    });
    if !errors.is_empty() {
        found.heading("Darker and brighter than the direct solution");
        found.pictures(errors);
        found.paragraph(ERRORS);
    }
    if !outcome.frames.is_empty() {
        found.heading("Residual by iteration");
        found.pictures(outcome.frames.iter().map(frame).collect());
    }
    found.heading("Solution methods");
    found.table(FoundTable::from(tables::methods(outcome)).csv("rows").field("ways"));
    residuals(outcome).into_iter().for_each(|chart| found.chart(chart));
    found.explained_table(FoundTable::from(tables::ends(parameters, outcome)).field("ends"), ENDS);
    if outcome.rows.iter().any(|row| row.card.is_some()) {
        found.heading("On the card");
    }
    found.explained_table(FoundTable::from(tables::card(outcome)).field("card"), ON_THE_CARD);
    if !outcome.sweep.is_empty() {
        found.heading("Sweep over numbers of patches and open switches");
        darkness(outcome).into_iter().for_each(|chart| found.chart(chart));
    }
    let first: Vec<usize> = outcome.sweep.iter().map(|row| row.same_as).collect();
    let named = |row: usize| outcome.sweep[row].setting();
    let sweep = FoundTable::from(tables::sweep(outcome));
    let sweep = sweep.folded(&first, named, (["switch", "switches"], "the same bits"));
    found.explained_table(sweep.csv("sweep").field("sweep"), SWEEP);
    Ok(found)
}

const ERRORS: &str = "Colors are relative differences of each patch's luminance, on one scale for all pictures; the \
    bar below each picture shows the scale. docs/studies/radiosity.md explains why half precision darkens a room.";

const ENDS: &str = "An iteration in finite precision that never meets its tolerance returns to an earlier state, and \
    cycles from there on. States are compared bit for bit; the period is the smallest.";

const ON_THE_CARD: &str = "Operations are counted as in the paper: two per element and channel, without indexing. \
    bandwidth_used is the memory traffic of an iteration as a share of what the memory can transfer in that time.";

const SWEEP: &str = "A switch is an open question about the card; each switch is changed alone. Settings with the same \
    bits share a row. predicted_mean is the first-order prediction of mean_relative if every term of a sum is rounded \
    to the sum's step.";

fn frame(frame: &IterationPicture) -> NamedPicture {
    let caption = format!("after {}", counted(frame.iteration.into(), "iteration", "iterations"));
    NamedPicture::new(format!("iteration-{}", frame.iteration), frame.flat.clone(), caption)
}

fn patches(outcome: &RadiosityOutcome) -> Table {
    let mut table = Table::with_colors("Patches", "patch x y z area open_area face material", labels(outcome));
    for (i, patch) in outcome.patches.list().iter().enumerate() {
        let [x, y, z] = patch.center().to_array();
        let places: [Cell; 4] = [i.into(), x.into(), y.into(), z.into()];
        let areas: [Cell; 2] = [patch.area().into(), outcome.patches.open_area(i).into()];
        let parts: [Cell; 2] = [patch.face.into(), patch.material.into()];
        let found = outcome.rows.iter().flat_map(|row| row.radiosity[i].map(Cell::from));
        table.push(places.into_iter().chain(areas).chain(parts).chain(found));
    }
    table
}

/// Table of the vertices of the smooth display, each with the first vertex of the model at its position.
fn vertices(outcome: &RadiosityOutcome) -> Table {
    let mut of_model: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    for (vertex, &at) in (0..).zip(outcome.patches.mesh().positions()) {
        of_model.entry(place_bits(at)).or_insert(vertex);
    }
    let mut table = Table::with_colors("Vertices", "vertex x y z of_model material patches", labels(outcome));
    for (i, vertex) in SmoothVertex::all(&outcome.patches).iter().enumerate() {
        let [x, y, z] = vertex.at.to_array();
        let material = vertex.patches.first().map(|&patch| outcome.patches.list()[patch as usize].material);
        let places: [Cell; 4] = [i.into(), x.into(), y.into(), z.into()];
        let of_model = of_model.get(&place_bits(narrow(vertex.at))).copied();
        let parts: [Cell; 3] = [of_model.into(), material.into(), vertex.patches.len().into()];
        let found = outcome.rows.iter().flat_map(|row| vertex.mean(&row.radiosity).map(Cell::from));
        table.push(places.into_iter().chain(parts).chain(found));
    }
    table
}

fn labels(outcome: &RadiosityOutcome) -> impl Iterator<Item = &str> {
    outcome.rows.iter().map(|row| row.label.as_str())
}

/// Chart of Figure 3: the residual of each method by iteration. `None` if nothing iterates, or if everything is exact
/// after one iteration, so that there is no second point above 0.
fn residuals(outcome: &RadiosityOutcome) -> Option<NamedChart> {
    let line = |row: &MethodRow| Series {
        label: row.label.clone(),
        points: row.history.iter().enumerate().map(|(k, &error)| (k as f64, error)).collect(),
    };
    let lines: Vec<Series> =
        outcome.rows.iter().filter(|row| row.iterations() > 0 && row.method != SolveMethod::DIRECT).map(line).collect();
    let caption = "The mean over the channels of the mean squared residual, as in the paper's Figure 3.";
    let names = ["Mean squared residual of M B - E", "iterations", "error"];
    // A diverging method must not compress the others into a corner.
    let scale = Scale::fitting(lines.iter().filter_map(|line| line.points.last()).map(|end| end.0));
    let shown = lines.iter().flat_map(|line| &line.points).filter(|point| point.1 > 0.0);
    let iterates = shown.map(|point| point.0).fold(0.0, f64::max) > 0.0;
    iterates.then(|| NamedChart::logarithmic("residual", names, (scale, lines), caption))
}

/// Ratio of mean errors above which a setting of a switch has its own line; the table has all settings.
const APART: f64 = 1.5;

/// Chart of the mean error by number of patches, for the defaults and for settings that make a difference.
fn darkness(outcome: &RadiosityOutcome) -> Option<NamedChart> {
    let error = |row: &SweepRow| 100.0 * row.error.bias.abs();
    let apart = |row: &SweepRow| {
        let same =
            |other: &&SweepRow| other.switch.is_none() && (other.patches, &other.method) == (row.patches, &row.method);
        let default = outcome.sweep.iter().find(same).map_or(0.0, error);
        error(row).max(default) > APART * error(row).min(default)
    };
    let label = |row: &SweepRow| {
        let turned = row.switch.as_ref().map(|_| row.setting());
        std::iter::once(row.method.clone()).chain(turned).collect::<Vec<_>>().join(", ")
    };
    let mut lines: Vec<Series> = Vec::new();
    let is_own = |(place, row): &(usize, &SweepRow)| row.switch.is_none() || (row.same_as == *place && apart(row));
    for (_, row) in outcome.sweep.iter().enumerate().filter(is_own) {
        Series::add(&mut lines, label(row), (row.patches as f64, error(row)));
    }
    let caption = "Absolute value of the mean relative error of non-emitting patches, in per cent.";
    let names = ["Mean error of non-emitting patches", "patches", "error, %"];
    let scale = Scale::fitting(lines.iter().flat_map(|line| &line.points).map(|point| point.0));
    (!lines.is_empty()).then(|| NamedChart::logarithmic("sweep", names, (scale, lines), caption))
}
