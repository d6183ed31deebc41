//! Conclusion of the study, in sentences.

use std::cmp::Reverse;

use refsim::num::{Format, FormatKind, Rounding};

use super::outcome::SHARED;
use super::{FormatLimits, Holes, Tally, TeapotRow};
use crate::ray_engine::EdgeRule;
use crate::report::digits::count;
use crate::report::words::{counted, listed, percent};
use crate::report::{Findings, Tone};
use crate::study::configuration::Configuration;

/// Maximum number of names in a sentence; further ones are counted.
pub(super) const MAX_NAMES: usize = 4;

impl Tally {
    /// Number of rays with a wrong result.
    pub const fn wrong(&self) -> u64 {
        self.leaks + self.false_hits + self.wrong_triangle
    }
}

/// Unit of the counts, singular and plural.
pub(super) type CountUnit = [&'static str; 2];

/// Sentence about the card in the headline.
const RADEON: &str = "The Radeon 8500 (R200) is ATI's card of 2001, the first with ps_1_4; its pixel arithmetic is \
                      16-bit fixed point.";
/// Sentence about leaks.
const LEAK: &str = "A leak is a ray that should hit the surface but misses it: it can slip between two triangles that \
                    share an edge, so the background shows.";

/// Adds the conclusion and the tally to the findings.
pub(super) fn conclude(found: &mut Findings, rows: &[TeapotRow], unit: &CountUnit) {
    let sentences = [verdict(rows, unit), seams(rows), cured(rows)].into_iter().flatten();
    let limits: Vec<(&str, FormatLimits)> = rows.iter().map(|row| (label(row), row.limits)).collect();
    let lost = [
        limited(&limits, FormatLimits::loses_normals, FormatLimits::lost_normals),
        limited(&limits, FormatLimits::is_coarse, FormatLimits::coarse_distances),
    ];
    let all = most_leaks(rows, unit).into_iter().chain(sentences).chain(lost.into_iter().flatten());
    all.for_each(|sentence| found.conclusion(sentence));
    let rows_with = |of: fn(&Tally) -> bool| rows.iter().filter(|row| of(&row.tally)).count() as u64;
    let right = [format!("row right in every {}", unit[0]), format!("rows right in every {}", unit[0])];
    found.tally(rows_with(|t| t.wrong() == 0), right.each_ref().map(String::as_str), Tone::Good);
    let wrong = rows_with(|t| t.wrong() > 0 && t.leaks == 0);
    found.tally(wrong, ["row with errors but no leak", "rows with errors but no leak"], Tone::Neutral);
    found.tally(rows_with(|t| t.leaks > 0), ["leaking row", "leaking rows"], Tone::Bad);
}

/// Sentence about the rows whose format loses something; `None` if no row does.
fn limited(
    rows: &[(&str, FormatLimits)],
    is_limited: fn(&FormatLimits) -> bool,
    clause: fn(&[FormatLimits]) -> String,
) -> Option<String> {
    let (labels, limits): (Vec<&str>, Vec<FormatLimits>) =
        rows.iter().copied().filter(|(_, limits)| is_limited(limits)).unzip();
    (!labels.is_empty()).then(|| format!("In {}, {}.", names(&labels), clause(&limits)))
}

fn names(rows: &[&str]) -> String {
    match rows.len() {
        0..=MAX_NAMES => listed(rows),
        more => counted(more as u64, "row", "rows"),
    }
}

/// Sentence about the rows that are correct everywhere.
fn verdict(rows: &[TeapotRow], [one, more]: &CountUnit) -> Option<String> {
    let right: Vec<&str> = rows.iter().filter(|row| row.tally.wrong() == 0).map(label).collect();
    let best = rows.iter().min_by_key(|row| row.tally.wrong())?;
    let names = names(&right);
    let wrong = counted(best.tally.wrong(), one, more);
    Some(match (right.len(), rows.len() - right.len()) {
        (0, 1) => format!("{} is wrong in {wrong} of {}.", label(best), count(best.tally.rays)),
        (1, 0) => format!("{} is right in every {one}.", label(best)),
        (0, _) => {
            format!("No row is right in every {one}; {} is wrong in the fewest: {wrong}.", label(best))
        }
        (_, 0) => format!("Every row is right in every {one}."),
        (1, others) => format!("Of {} rows, only {names} is right in every {one}.", count(others as u64 + 1)),
        (some, others) => format!("Of {} rows, {names} are right in every {one}.", count((some + others) as u64)),
    })
}

/// The headline: the fraction of the surface that the leakiest row loses; if they were traced, also the fractions that
/// its card loses when it rounds to nearest, and when it evaluates each edge once. Then what a newcomer needs to read
/// it: the card and a leak. Empty if no row leaks.
fn most_leaks(rows: &[TeapotRow], [one, more]: &CountUnit) -> Vec<String> {
    // The first one on a tie.
    let worst = rows.iter().min_by_key(|row| Reverse(row.tally.leaks)).filter(|row| row.tally.leaks > 0);
    let Some(worst) = worst else { return Vec::new() };
    let Tally { leaks, surface, .. } = worst.tally;
    let loses = |row: &TeapotRow| percent(row.tally.leak_share());
    let card = &worst.configuration.profile.name;
    let as_is = is_row(worst, card, EdgeRule::Paper, false);
    let relief = [
        (EdgeRule::Paper, true, "rounded to nearest, it loses"),
        (EdgeRule::SharedEdges, false, "with each edge evaluated once, it loses"),
    ];
    let relief = relief.into_iter().filter(|_| as_is).filter_map(|(edges, nearest, words)| {
        rows.iter().find(|row| is_row(row, card, edges, nearest)).map(|row| format!("; {words} {}", loses(row)))
    });
    let headline = format!(
        "{} loses {} of the surface's {more}: {} of {} leak{}.",
        arithmetic(worst),
        loses(worst),
        count(leaks),
        counted(surface, one, more),
        relief.collect::<String>(),
    );
    let card = name(worst).starts_with("ATI Radeon 8500").then_some(RADEON);
    std::iter::once(headline).chain(card.into_iter().chain([LEAK]).map(str::to_owned)).collect()
}

/// Returns `true` for the row with this card and edge rule, rounded to nearest if `nearest`, otherwise as the card
/// rounds.
pub(super) fn is_row(row: &TeapotRow, card: &str, edges: EdgeRule, nearest: bool) -> bool {
    let switch = row.configuration.switch.as_ref().map(|(name, value)| (name.as_str(), value.as_str()));
    row.edge_rule == edges && row.configuration.profile.name == card && switch == nearest.then_some(("rounding", "rne"))
}

/// Name of a row in words: its card, what was changed, and how it evaluates edges.
pub(super) fn name(row: &TeapotRow) -> String {
    let Configuration { label, profile, switch } = &row.configuration;
    let card = match profile.title.split_once(" (") {
        Some((card, _)) if label.trim_end_matches(SHARED) == profile.name || switch.is_some() => card,
        _ => return label.clone(),
    };
    let switch = match switch.as_ref().map(|(name, value)| (name.as_str(), value.as_str())) {
        None => String::new(),
        Some(("rounding", "rne")) => ", rounded to nearest".to_owned(),
        Some((name, value)) => format!(", {name} = {value}"),
    };
    let edges = if row.edge_rule == EdgeRule::SharedEdges { ", shared edges" } else { "" };
    format!("{card}{switch}{edges}")
}

/// Name of a row; if it is an unchanged card, with its arithmetic.
fn arithmetic(row: &TeapotRow) -> String {
    let Format { kind, rounding, .. } = row.configuration.profile.rules.format;
    let bits = row.configuration.profile.rules.format.width();
    let name = name(row);
    if name == row.configuration.label || row.configuration.switch.is_some() {
        return name;
    }
    let kind = match kind {
        FormatKind::Fixed { .. } => "fixed-point",
        FormatKind::Normalized { .. } => "integer",
        FormatKind::Float { .. } => "floating-point",
    };
    let rounded = match rounding {
        Rounding::Down => ", rounded down,",
        Rounding::TowardZero => ", rounded toward zero,",
        _ => "",
    };
    format!("The {bits}-bit {kind} arithmetic of the {name}{rounded}")
}

/// Sentence about the rows with shared edges; `None` without such rows, or if no rays were aimed at the inside of the
/// surface.
fn cured(rows: &[TeapotRow]) -> Option<String> {
    let shared = || rows.iter().filter(|row| row.edge_rule == EdgeRule::SharedEdges);
    let most = |which: usize| shared().map(|row| row.holes[which]).max_by_key(|holes| holes.leaks);
    let said = |Holes { rays, leaks }: Holes| match leaks {
        0 => format!("none of {}", count(rays)),
        some => format!("up to {} of {}", count(some), count(rays)),
    };
    let [edges, vertices] = [most(1)?, most(2)?];
    (edges.rays > 0).then(|| {
        format!(
            "With shared edges, {} rays aimed at edges inside the surface leak, and {} rays aimed at vertices.",
            said(edges),
            said(vertices)
        )
    })
}

/// Sentence about the rays aimed at edges, with the paper's program; `None` without such rays.
fn seams(rows: &[TeapotRow]) -> Option<String> {
    let rows: Vec<&TeapotRow> = rows.iter().filter(|row| row.edge_rule == EdgeRule::Paper).collect();
    let shares = rows.iter().filter(|row| row.edges.surface > 0).map(|row| row.edges.leak_share());
    let leaking = rows.iter().filter(|row| row.edges.leaks > 0).count();
    let least = shares.clone().min_by(f64::total_cmp)?;
    let most = shares.max_by(f64::total_cmp)?;
    let (share, place) = if leaking == 0 {
        ("none".to_owned(), String::new())
    } else if leaking < rows.len() {
        (format!("up to {}", percent(most)), format!(", in {leaking} of {} rows", rows.len()))
    } else if least == most {
        (percent(most), String::new())
    } else {
        (format!("{} to {}", percent(least), percent(most)), ", depending on the row".to_owned())
    };
    Some(format!("With the paper's program, {share} of the rays aimed at shared edges leak{place}."))
}

fn label(row: &TeapotRow) -> &str {
    &row.configuration.label
}
