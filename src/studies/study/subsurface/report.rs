//! The study's page, tables, charts, pictures and trace.

use super::conclusion::conclude;
use super::outcome::SubsurfaceOutcome;
use super::{ALL_PAIRS_SIDE, Parameters, WayRow, pictures, tables};
use crate::options::one_of::name;
use crate::report::words::counted;
use crate::report::{Cell, Findings, FoundTable, NamedChart, Scale, Series};
use crate::study::{StudyError, timeline_trace};

pub(super) fn findings(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Result<Findings, StudyError> {
    let mut found = Findings::new("Subsurface scattering");
    found.keep_table(FoundTable::from(tables::faces(parameters, outcome)).csv("faces").field("faces"));
    found.keep_table(FoundTable::from(tables::vertices(parameters, outcome)).csv("vertices"));
    if let Some(row) = outcome.rows.first() {
        let what = format!("{}: light, levels, gather, view", row.label);
        if let Some(bytes) = timeline_trace::file(&parameters.profile, &row.log, &what)? {
            found.keep_file("timeline.json", bytes);
        }
        found.keep_layers("whole", row.picture.clone());
    }
    conclude(&mut found, parameters, outcome);
    outcome.cast.iter().for_each(|cast| cast.report(&mut found));
    let exposure = pictures::exposure(outcome)?;
    if let Some(row) = outcome.rows.first() {
        found.pictures(pictures::lead(row, exposure)?);
    }
    found.paragraph(format!(
        "The model is {}, {}, made of {}. The three passes of Carr, Hall and Hart (2003, section 4) run on the \
         emulated {}. Pictures are radiance multiplied by {}, with the sRGB curve.",
        parameters.model,
        counted(parameters.mesh.len() as u64, "face", "faces"),
        parameters.material.name,
        parameters.profile.title,
        Cell::ratio(exposure).text(),
    ));
    found.heading("Model and medium");
    found.table(FoundTable::from(tables::model(parameters, outcome)).field("model"));
    found.explained_table(FoundTable::from(tables::medium(parameters, outcome)).field("medium"), MEDIUM);
    found.heading("The maps of passes 1 and 2");
    found.pictures(pictures::maps(outcome));
    found.heading("Ways of gathering");
    let without = format!("{ERRORS}{ALL_PAIRS_SIDE} x {ALL_PAIRS_SIDE}) links have no reference.");
    found.explained_table(FoundTable::from(tables::errors(outcome)).csv("rows").field("ways"), &without);
    found.explained_table(FoundTable::from(tables::angles(outcome)).csv("angles").field("angles"), ANGLES);
    error_chart(parameters, outcome).into_iter().for_each(|chart| found.chart(chart));
    found.pictures(pictures::ways(&outcome.rows, exposure)?);
    found.pictures(pictures::errors(outcome));
    found.heading("On the card");
    found.explained_table(FoundTable::from(tables::storage(outcome)).field("storage"), STORAGE);
    found.explained_table(FoundTable::from(tables::times(outcome)).field("times"), TIMES);
    Ok(found)
}

const MEDIUM: &str = "The diffusion length is 1 over the effective transport coefficient sigma_tr; total_R_d is the \
    share of light that a flat half space reflects.";

const ERRORS: &str = "Columns that begin with links compare the host's double-precision sum over the links with its \
    sum over all pairs of texels; plain_means does the same with level means that weight texels equally, as mipmaps \
    of plain irradiance would. Columns that begin with card compare the card with the host's sum over the same links, \
    and columns that begin with all compare it with the sum over all pairs. Without all pairs (`--all-pairs no`, and \
    the default of atlases above ";

const ANGLES: &str = "The lit side of a model dominates a root mean square over the whole model. Here the errors in \
    every bin of angles are relative to the light of that bin: at 0 degrees the surface faces the light; at 180 \
    degrees it faces away, and all light arrives from afar.";

const STORAGE: &str = "Fixed links store places in constants and four factors per texel; an adaptive link is one \
    texel with place, factor and level. lost_to_0 counts factors below the format's smallest number. places_rounded \
    counts coordinates of adaptive links that the format cannot represent; such links read a neighbor's light. \
    instructions counts those of all programs of pass 2; samplers counts those of the largest program only.";

const TIMES: &str = "Times are modelled, not measured; the model has no constant from this paper.";

/// Chart of the error against the number of links, one line per choice; `None` for fewer than two numbers.
fn error_chart(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Option<NamedChart> {
    let mut lines: Vec<Series> = Vec::new();
    for (row, error) in outcome.rows.iter().filter_map(|row| Some((row, row.error?))) {
        let point = (row.way.choice.per_texel(parameters.options.side) as f64, 100.0 * error.rms);
        Series::add(&mut lines, line(row), point);
    }
    let numbers = || lines.iter().flat_map(|line| &line.points).map(|point| point.0);
    let (least, most) = (numbers().fold(f64::INFINITY, f64::min), numbers().fold(0.0, f64::max));
    let labels = ["Error of B against the sum over all pairs", "links per texel", "root mean square error, %"];
    let scale = Scale::fitting(numbers());
    (most > least)
        .then(|| NamedChart::logarithmic("error", labels, (scale, lines), "The error of links and card together."))
}

/// Name of a row's way of gathering, without its number of links.
fn line(row: &WayRow) -> String {
    let channels = if row.way.rgb { ", RGB" } else { "" };
    let choice = row.way.choice.word();
    format!("{choice}{channels}, {} links, {} map", name(&row.way.links), name(&row.way.map))
}
