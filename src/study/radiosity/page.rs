//! Everything that goes into the output folder.

use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model};

use super::{Outcome, Parameters, Row, StudyError, SweepRow, Way, tables};
use crate::report::picture::rgb8;
use crate::report::{Cell, Chart, Figure, Line, Page, Provenance, ReportError, Scale, Table};
use crate::study::leaky_teapot_report::NamedFile;
use crate::study::timeline_trace::trace;

/// Pictures, tables, the trace of the first way on a card, and `index.html` last.
///
/// # Errors
/// [`StudyError::Report`] if an encoder refuses.
pub fn files(
    parameters: &Parameters,
    outcome: &Outcome,
    provenance: &Provenance,
) -> Result<Vec<NamedFile>, StudyError> {
    let png = |bytes: &[u8]| rgb8(parameters.camera.width() as usize, parameters.camera.height() as usize, bytes);
    let mut files = Vec::new();
    for row in &outcome.rows {
        files.push((format!("{}-flat.png", row.label), png(&row.pictures.flat)?));
        files.push((format!("{}-smooth.png", row.label), png(&row.pictures.smooth)?));
        if let Some(relit) = &row.pictures.relit {
            files.push((format!("{}-relit.png", row.label), png(relit)?));
        }
    }
    for frame in &outcome.frames {
        files.push((format!("iteration-{}.png", frame.iteration), png(&frame.flat)?));
    }
    let found = tables(parameters, outcome);
    files.push(("rows.csv".to_owned(), found.ways.csv()?.into_bytes()));
    files.push(("patches.csv".to_owned(), patches(outcome).csv()?.into_bytes()));
    let mut document = found.json();
    document["provenance"] = serde_json::json!(provenance);
    files.push(("study.json".to_owned(), format!("{document:#}\n").into_bytes()));
    let chart = residuals(outcome).map(|chart| chart.svg()).transpose()?;
    if let Some(svg) = &chart {
        files.push(("residual.svg".to_owned(), svg.clone().into_bytes()));
    }
    if !outcome.sweep.is_empty() {
        files.push(("sweep.csv".to_owned(), found.sweep.csv()?.into_bytes()));
    }
    let sweep = darkness(outcome).map(|chart| chart.svg()).transpose()?;
    if let Some(svg) = &sweep {
        files.push(("sweep.svg".to_owned(), svg.clone().into_bytes()));
    }
    if let Some(bytes) = timeline(parameters, outcome)? {
        files.push(("timeline.json".to_owned(), bytes));
    }
    let page = page(parameters, outcome, provenance, [chart, sweep])?;
    files.push(("index.html".to_owned(), page.html().into_bytes()));
    Ok(files)
}

/// A row a patch: where it is, what it is, and its radiosity by each way.
fn patches(outcome: &Outcome) -> Table {
    let mut headings: Vec<String> =
        ["patch", "x", "y", "z", "area", "open_area", "face", "material"].into_iter().map(str::to_owned).collect();
    for row in &outcome.rows {
        headings.extend(["r", "g", "b"].map(|c| format!("{}_{c}", row.label)));
    }
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let mut table = Table::new("Patches", &headings);
    for (i, patch) in outcome.patches.list().iter().enumerate() {
        let [x, y, z] = patch.center().into();
        let places: [Cell; 4] = [i.into(), x.into(), y.into(), z.into()];
        let areas: [Cell; 2] = [patch.area().into(), outcome.patches.open_area(i).into()];
        let parts: [Cell; 2] = [patch.face.into(), patch.material.into()];
        let found = outcome.rows.iter().flat_map(|row| row.radiosity[i].map(Cell::Real));
        table.push(places.into_iter().chain(areas).chain(parts).chain(found));
    }
    table
}

/// Figure 3: the residual of each way, iteration by iteration. `None` where nothing iterates.
fn residuals(outcome: &Outcome) -> Option<Chart> {
    let line = |row: &Row| Line {
        label: row.label.clone(),
        points: row.history.iter().enumerate().map(|(k, &error)| (k as f64, error)).collect(),
    };
    let lines: Vec<Line> =
        outcome.rows.iter().filter(|row| row.iterations() > 0 && row.way != Way::DIRECT).map(line).collect();
    (!lines.is_empty()).then(|| Chart {
        title: "Mean squared residual of M B - E".to_owned(),
        x: "iterations".to_owned(),
        y: "error".to_owned(),
        y_scale: Scale::Logarithmic,
        lines,
        ..Chart::default()
    })
}

/// Settings of switches get a line of their own where they change the error by more than this factor; the table has all.
const APART: f64 = 1.5;

/// By how much the room is too dark or too bright, by number of patches: a line for the card as it is in each way, and
/// one for each setting that makes a difference. `None` without a sweep.
fn darkness(outcome: &Outcome) -> Option<Chart> {
    let error = |row: &SweepRow| 100.0 * row.off.bias.abs();
    let apart = |row: &SweepRow| {
        let same = |other: &&SweepRow| other.as_it_is && (other.patches, &other.way) == (row.patches, &row.way);
        let default = outcome.sweep.iter().find(same).map_or(0.0, error);
        error(row).max(default) > APART * error(row).min(default)
    };
    let label = |row: &SweepRow| {
        let turned = row.switches.iter().filter(|_| !row.as_it_is).map(|(name, value)| format!("{name}={value}"));
        std::iter::once(row.way.clone()).chain(turned.take(1)).collect::<Vec<_>>().join(", ")
    };
    let mut lines: Vec<Line> = Vec::new();
    for row in outcome.sweep.iter().filter(|row| row.as_it_is || apart(row)) {
        let (label, point) = (label(row), (row.patches as f64, error(row)));
        match lines.iter_mut().find(|line| line.label == label) {
            Some(line) => line.points.push(point),
            None => lines.push(Line { label, points: vec![point] }),
        }
    }
    (!lines.is_empty()).then(|| Chart {
        title: "Mean error of patches that do not shine, either way".to_owned(),
        x: "patches".to_owned(),
        y: "error, %".to_owned(),
        y_scale: Scale::Logarithmic,
        lines,
        ..Chart::default()
    })
}

/// The first way on a card that has a log, as a trace.
fn timeline(parameters: &Parameters, outcome: &Outcome) -> Result<Option<Vec<u8>>, StudyError> {
    let Some((row, facts)) = outcome.rows.iter().find_map(|row| Some((row, row.card.as_ref()?))) else {
        return Ok(None);
    };
    let Ok(model) = Model::new(Level::Pipeline, &parameters.profile) else { return Ok(None) };
    let replayed = replay(&facts.log, &model, &Options::of(Level::Pipeline))?;
    let what = format!("{}: new emittance, 4 iterations, the room shown", row.label);
    let trace = trace(&parameters.profile, "pipeline", &what, &replayed.timeline);
    let mut bytes = Vec::new();
    trace.write(&mut bytes).map_err(|e| ReportError::Encode { format: "JSON", reason: e.to_string() })?;
    Ok(Some(bytes))
}

fn page(
    parameters: &Parameters,
    outcome: &Outcome,
    provenance: &Provenance,
    [chart, sweep]: [Option<String>; 2],
) -> Result<Page, StudyError> {
    let png = |bytes: &[u8]| rgb8(parameters.camera.width() as usize, parameters.camera.height() as usize, bytes);
    let found = tables(parameters, outcome);
    let mut pictures = Vec::new();
    let mut relit = Vec::new();
    for row in &outcome.rows {
        pictures.push(Figure::new(png(&row.pictures.flat)?, format!("{}: each patch in its radiosity", row.label)));
        pictures.push(Figure::new(png(&row.pictures.smooth)?, format!("{}: resampled to corners", row.label)));
        if let Some(bytes) = &row.pictures.relit {
            relit.push(Figure::new(png(bytes)?, format!("{}: after the changes", row.label)));
        }
    }
    let mut frames = Vec::new();
    for frame in &outcome.frames {
        let plural = if frame.iteration == 1 { "" } else { "s" };
        frames.push(Figure::new(png(&frame.flat)?, format!("after {} iteration{plural}", frame.iteration)));
    }
    let mut page = Page::new("Matrix radiosity", provenance.clone())
        .text(format!(
            "{} patches, solved as the fragment programs of Carr, Hall and Hart (2003, section 3) would solve them, and by \
             solvers of the host. Pictures are drawn by the emulated {} from its radiosity texture, times {}, with the sRGB curve.",
            outcome.patches.list().len(),
            parameters.profile.title,
            tables::digits(outcome.exposure, 3).text(),
        ))
        .table(found.room)
        .heading("The room")
        .figures(pictures);
    if !frames.is_empty() {
        page = page.heading("Iteration by iteration").figures(frames);
    }
    page = page.heading("How it was solved").table(found.ways);
    if let Some(svg) = chart {
        page =
            page.drawing(svg, "The mean over the channels of the mean squared residual, as in the paper's Figure 3.");
    }
    if !found.ends.rows().is_empty() {
        page = page.table(found.ends).text(
            "An iteration in finitely many bits that never meets its tolerance comes back to a state that it was in before, and goes \
             round from there on. States are compared bit for bit; the period is the smallest.",
        );
    }
    if !found.card.rows().is_empty() {
        page = page.heading("On the card").table(found.card).text(
            "Operations are counted as the paper does: two an element and channel, indexing left out. bandwidth_used is what an \
             iteration moves to and from memory, of the most that the memory can.",
        );
    }
    if !relit.is_empty() {
        page = page.heading("Relit").figures(relit).table(found.relit);
    }
    if !found.sweep.rows().is_empty() {
        page = page.heading("Other numbers of patches, other answers to open questions");
        if let Some(svg) = sweep {
            page = page.drawing(svg, "The mean error of what does not shine, in per cent of itself, without its sign.");
        }
        page = page.table(found.sweep).text(
            "A switch is an open question about the card; each is turned alone. Settings that find the same bits share a row. \
             predicted_mean is what follows to first order from rounding every term of a sum to the sum's own step.",
        );
    }
    Ok(page)
}
