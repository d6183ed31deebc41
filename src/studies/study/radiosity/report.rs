//! Page, tables, charts, pictures and trace of the study.

use std::collections::BTreeMap;

use super::conclusion::{conclude, least_accurate};
use super::leaks;
use super::pictures::IterationPicture;
use super::tables::{Tables, tables};
use super::{MethodRow, Parameters, RadiosityOutcome, SolveMethod, SweepRow};
use crate::geom::vector::narrow;
use crate::radiosity::display::SmoothVertex;
use crate::report::digits::{Quantity, shown};
use crate::report::words::counted;
use crate::report::{Cell, Chart, Findings, FoundTable, NamedChart, NamedPicture, Scale, Series, Table, false_color};
use crate::study::{StudyError, timeline_trace};

pub(super) fn findings(parameters: &Parameters, outcome: RadiosityOutcome) -> Result<Findings, StudyError> {
    let mut found = Findings::new("Matrix radiosity");
    found.keep_table(FoundTable::from(patches(&outcome)).csv("patches"));
    found.keep_table(FoundTable::from(vertices(&outcome)).csv("vertices"));
    if let Some(bytes) = timeline(parameters, &outcome)? {
        found.keep_file("timeline.json", bytes);
    }
    conclude(&mut found, &outcome);
    let about = format!(
        "{}, solved as by the fragment programs of Carr, Hall and Hart (2003, section 3), and by solvers of the host. \
         The emulated {} draws pictures from its radiosity texture, times {}, with the sRGB curve.",
        counted(outcome.patches.list().len() as u64, "patch", "patches"),
        parameters.profile.title,
        Cell::ratio(outcome.exposure).text(),
    );
    let Tables { room, methods, ends, card, sweep } = tables(parameters, &outcome);
    let (residuals, darkness) = (residuals(&outcome), darkness(&outcome));
    let errors = errors(parameters, &outcome);
    // The pictures of the least accurate method and of the direct one come first.
    let first = least_accurate(&outcome.rows).or(outcome.rows.first()).map(|row| row.label.clone());
    let (mut lead, mut pictures) = (Vec::new(), Vec::new());
    for row in outcome.rows {
        let leads = row.method == SolveMethod::DIRECT || Some(&row.label) == first.as_ref();
        let (label, drawn) = (row.label, row.pictures);
        let picture = |kind: &str, image, what: &str| {
            NamedPicture::new(format!("{label}-{kind}"), image, format!("{label}: {what}"))
        };
        pictures.push(picture("flat", drawn.flat, "each patch with its radiosity"));
        let smooth = picture("smooth", drawn.smooth, "resampled to corners");
        if leads { lead.push(smooth) } else { pictures.push(smooth) }
    }
    let is_drawn = |number: &&u32| outcome.frames.iter().any(|frame| frame.iteration == **number);
    for number in parameters.options.frames.iter().filter(|number| !is_drawn(number)) {
        found.conclusion(format!(
            "No picture after iteration {number}: the first method on the card stopped before it."
        ));
    }
    let frames: Vec<NamedPicture> = outcome.frames.into_iter().map(frame).collect();
    found.pictures(lead);
    found.paragraph(about);
    found.heading("The room");
    found.table(FoundTable::from(room).field("room"));
    found.pictures(pictures);
    leaks::report(&outcome.leaks, &mut found);
    if !errors.is_empty() {
        found.heading("Darker and brighter than the direct solution");
        found.pictures(errors);
        found.paragraph(ERRORS);
    }
    if !frames.is_empty() {
        found.heading("Residual by iteration");
        found.pictures(frames);
    }
    found.heading("Solution methods");
    found.table(FoundTable::from(methods).csv("rows").field("ways"));
    residuals.into_iter().for_each(|chart| found.chart(chart));
    let has_rows = |table: &Table| !table.rows().is_empty();
    found.explained_table(FoundTable::from(ends).field("ends"), ENDS);
    if has_rows(&card) {
        found.heading("On the card");
    }
    found.explained_table(FoundTable::from(card).field("card"), ON_THE_CARD);
    if has_rows(&sweep) {
        found.heading("Sweep over numbers of patches and open switches");
        darkness.into_iter().for_each(|chart| found.chart(chart));
    }
    let first: Vec<usize> = outcome.sweep.iter().map(|row| row.same_as).collect();
    let named = |row: usize| outcome.sweep[row].setting();
    let sweep = FoundTable::from(sweep).folded(&first, named, (["switch", "switches"], "the same bits"));
    found.explained_table(sweep.csv("sweep").field("sweep"), SWEEP);
    Ok(found)
}

const ERRORS: &str = "Colors are relative differences of each patch's luminance, on one scale for all pictures; the \
    bar below each picture shows it. docs/studies/radiosity.md explains why half precision darkens a room.";

const ENDS: &str = "An iteration in finite precision that never meets its tolerance repeats an earlier state, and \
    cycles from there on. States are compared bit for bit; the period is the smallest.";

const ON_THE_CARD: &str = "Operations are counted as in the paper: two per element and channel, without indexing. \
    bandwidth_used is the memory traffic of an iteration as a share of what the memory can transfer in that time.";

const SWEEP: &str = "A switch is an open question about the card; each is changed alone. Settings with the same bits \
    share a row. predicted_mean is the first-order prediction if every term of a sum is rounded to the sum's step.";

/// False-color pictures of the error of each solution on the card, all with the same scale.
fn errors(parameters: &Parameters, outcome: &RadiosityOutcome) -> Vec<NamedPicture> {
    let errors = || outcome.rows.iter().filter_map(|row| Some((row.label.as_str(), row.pictures.error.as_ref()?)));
    let finite = errors().flat_map(|(_, error)| error).filter(|error| error.is_finite());
    let scale = finite.fold(0.0, |most: f64, error| most.max(error.abs()));
    if scale == 0.0 {
        return Vec::new();
    }
    let ends = shown(100.0 * scale, Quantity::Percent);
    let picture = |(label, error): (&str, &Vec<f64>)| {
        let caption = format!(
            "{label} against direct: blue -{ends} % (darker), white 0, red +{ends} % (brighter){}",
            false_color::not_finite(error)
        );
        let image = false_color::signed(parameters.camera.width(), error, scale);
        NamedPicture::new(format!("{label}-error"), image, caption)
    };
    errors().map(picture).collect()
}

/// Picture of the room after some iterations.
fn frame(frame: IterationPicture) -> NamedPicture {
    let caption = format!("after {}", counted(frame.iteration.into(), "iteration", "iterations"));
    NamedPicture::new(format!("iteration-{}", frame.iteration), frame.flat, caption)
}

/// Table with a row per patch: its position, its areas, its material, and its radiosity by each method.
fn patches(outcome: &RadiosityOutcome) -> Table {
    let mut headings: Vec<String> =
        ["patch", "x", "y", "z", "area", "open_area", "face", "material"].into_iter().map(str::to_owned).collect();
    headings.extend(channels(outcome));
    let mut table = Table::new("Patches", &headings);
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

/// Table of the vertices of the smooth display: position, first vertex of the model at that position, material of the
/// patches, and radiosity by each method.
fn vertices(outcome: &RadiosityOutcome) -> Table {
    let of_model = first_places(outcome.patches.mesh().positions());
    let mut headings: Vec<String> =
        ["vertex", "x", "y", "z", "of_model", "material", "patches"].into_iter().map(str::to_owned).collect();
    headings.extend(channels(outcome));
    let mut table = Table::new("Vertices", &headings);
    for (i, vertex) in SmoothVertex::all(&outcome.patches).iter().enumerate() {
        let [x, y, z] = vertex.at.to_array();
        let material = vertex.patches.first().map(|&patch| outcome.patches.list()[patch as usize].material);
        let places: [Cell; 4] = [i.into(), x.into(), y.into(), z.into()];
        let number = |number: Option<u32>| number.map_or(Cell::Empty, Cell::from);
        let of_model = of_model.get(&place(narrow(vertex.at))).copied();
        let parts: [Cell; 3] = [number(of_model), number(material), vertex.patches.len().into()];
        let found = outcome.rows.iter().flat_map(|row| vertex.mean(&row.radiosity).map(Cell::from));
        table.push(places.into_iter().chain(parts).chain(found));
    }
    table
}

/// First vertex at each position of a model.
fn first_places(positions: &[[f32; 3]]) -> BTreeMap<[u32; 3], u32> {
    let mut first = BTreeMap::new();
    for (vertex, &at) in (0..).zip(positions) {
        first.entry(place(at)).or_insert(vertex);
    }
    first
}

/// Bits of a position; both zeros give the same bits.
fn place(at: [f32; 3]) -> [u32; 3] {
    at.map(|x| (x + 0.0).to_bits())
}

/// Column names of all methods' radiosities.
fn channels(outcome: &RadiosityOutcome) -> impl Iterator<Item = String> + '_ {
    outcome.rows.iter().flat_map(|row| ["r", "g", "b"].map(|c| format!("{}_{c}", row.label)))
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
    iterates.then(|| logarithmic("residual", names, (scale, lines), caption))
}

/// Ratio of mean errors above which a setting of a switch has its own line; the table has all settings.
const APART: f64 = 1.5;

/// Chart of the mean error by number of patches: a line per method on the card with its defaults, and a line per
/// setting that makes a difference. `None` without a sweep.
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
    for (_, row) in outcome
        .sweep
        .iter()
        .enumerate()
        .filter(|(place, row)| row.switch.is_none() || (row.same_as == *place && apart(row)))
    {
        let (label, point) = (label(row), (row.patches as f64, error(row)));
        match lines.iter_mut().find(|line| line.label == label) {
            Some(line) => line.points.push(point),
            None => lines.push(Series { label, points: vec![point] }),
        }
    }
    let caption = "Absolute value of the mean relative error of non-emitting patches, in per cent.";
    let names = ["Mean error of non-emitting patches", "patches", "error, %"];
    let scale = Scale::fitting(lines.iter().flat_map(|line| &line.points).map(|point| point.0));
    (!lines.is_empty()).then(|| logarithmic("sweep", names, (scale, lines), caption))
}

fn logarithmic(
    name: &str,
    [title, x, y]: [&str; 3],
    (x_scale, lines): (Scale, Vec<Series>),
    caption: &str,
) -> NamedChart {
    let (title, x, y) = (title.to_owned(), x.to_owned(), y.to_owned());
    let chart = Chart { title, x, y, x_scale, y_scale: Scale::Logarithmic, lines, ..Chart::default() };
    NamedChart { name: name.to_owned(), chart, caption: caption.to_owned() }
}

/// Encodes the log of the first method on a card as a trace; `None` for devices without timing.
fn timeline(parameters: &Parameters, outcome: &RadiosityOutcome) -> Result<Option<Vec<u8>>, StudyError> {
    let Some((row, facts)) = outcome.rows.iter().find_map(|row| Some((row, row.card.as_ref()?))) else {
        return Ok(None);
    };
    let what = format!("{}: new emittance, 4 iterations, the room shown", row.label);
    timeline_trace::file(&parameters.profile, &facts.log, &what)
}
