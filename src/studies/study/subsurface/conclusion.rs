//! The conclusion from the rows, as sentences.

use std::cmp::Reverse;

use super::outcome::SubsurfaceOutcome;
use super::{AngleBin, BinError, GatherWay, Parameters, WayRow};
use crate::report::digits::{Quantity, shown};
use crate::report::words::{counted, listed, percent};
use crate::report::{Findings, Tone};
use crate::subsurface::links::LinkChoice;

/// Largest error at which the conclusion calls a choice of links sufficient.
const ENOUGH: f64 = 0.01;

pub(super) fn conclude(found: &mut Findings, parameters: &Parameters, outcome: &SubsurfaceOutcome) {
    let rows = &outcome.rows;
    let sentences = [accuracy(rows), by_angle(parameters, rows), smallest(rows), speed(parameters, rows)];
    let warnings = [repeated(outcome), coarse(outcome), thin(outcome)];
    sentences.into_iter().chain(warnings).flatten().for_each(|sentence| found.conclusion(sentence));
    let errors = rows.iter().filter_map(|row| row.error);
    let (good, bad): (Vec<_>, Vec<_>) = errors.partition(|error| error.rms <= ENOUGH);
    found.tally(
        good.len() as u64,
        ["variant within 1 % of the sum over all pairs", "variants within 1 % of the sum over all pairs"],
        Tone::Good,
    );
    found.tally(bad.len() as u64, ["variant beyond 1 %", "variants beyond 1 %"], Tone::Bad);
}

fn accuracy(rows: &[WayRow]) -> Option<String> {
    let judged = || rows.iter().filter_map(|row| Some((row, row.error?.rms)));
    let (best, least) = judged().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (worst, most) = judged().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let (least, most) = (percent(least), percent(most));
    Some(if best.label == worst.label {
        format!(
            "{} differs from the sum over all pairs by an rms error of {least}; its links alone account for {}.",
            best.label,
            percent(best.links_error.map_or(0.0, |error| error.rms))
        )
    } else {
        format!(
            "{} is nearest to the sum over all pairs, with an rms error of {least}; {} is farthest, with {most}.",
            best.label, worst.label
        )
    })
}

/// Reads the error of one choice of links from a pair of bins, one per choice.
type ErrorOf = fn((&AngleBin, &AngleBin)) -> f64;

/// Compares fixed and adaptive links by angle from the light, at the largest number of links that both have.
fn by_angle(parameters: &Parameters, rows: &[WayRow]) -> Option<String> {
    let count = |row: &WayRow| row.way.choice.per_texel(parameters.options.side);
    let is_fixed = |row: &WayRow| matches!(row.way.choice, LinkChoice::Fixed { .. });
    let alike = |one: &WayRow, other: &WayRow| {
        count(one) == count(other) && GatherWay { choice: one.way.choice, ..other.way } == one.way
    };
    let judged = || rows.iter().filter(|row| !row.angles.is_empty());
    let pairs = judged()
        .filter(|row| is_fixed(row))
        .filter_map(|fixed| Some((fixed, judged().find(|row| !is_fixed(row) && alike(fixed, row))?)));
    // Takes the first of equal numbers.
    let (fixed, adaptive) = pairs.min_by_key(|(fixed, _)| Reverse(count(fixed)))?;
    let bins = || fixed.angles.iter().zip(&adaptive.angles);
    let better =
        |[of, other]: [ErrorOf; 2]| ranges(bins().filter(|&bins| of(bins) < other(bins)).map(|(bin, _)| bin.degrees));
    let errors: [ErrorOf; 2] = [|(fixed, _)| fixed.links.rms, |(_, adaptive)| adaptive.links.rms];
    let places = [better([errors[1], errors[0]]), better(errors)];
    let places = ["adaptive", "fixed"].into_iter().zip(places).filter(|(_, places)| !places.is_empty());
    let places: Vec<String> =
        places.map(|(choice, places)| format!("{choice} links at {} degrees", listed(&places))).collect();
    let (last, of_adaptive) = bins().next_back()?;
    let signed = |error: BinError| format!("{}{}", if error.mean > 0.0 { "+" } else { "" }, percent(error.mean));
    let [from, to] = last.degrees;
    Some(format!(
        "With {} links per texel, by the angle between normal and light, {} are nearer to the sum over all pairs; at \
         {from} to {to} degrees, the mean of B is off by {} with adaptive links and by {} with fixed links.",
        count(fixed),
        places.join(" and "),
        signed(of_adaptive.links),
        signed(last.links),
    ))
}

/// Joins consecutive bins into ranges such as "0 to 45".
fn ranges(bins: impl Iterator<Item = [f64; 2]>) -> Vec<String> {
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    for [from, to] in bins {
        match ranges.last_mut() {
            Some(last) if last[1] == from => last[1] = to,
            _ => ranges.push([from, to]),
        }
    }
    ranges.iter().map(|[from, to]| format!("{from} to {to}")).collect()
}

fn smallest(rows: &[WayRow]) -> Option<String> {
    if rows.iter().all(|row| row.error.is_none()) {
        return None;
    }
    let within = rows.iter().filter(|row| row.error.is_some_and(|error| error.rms <= ENOUGH));
    Some(match within.min_by_key(|row| row.memory[0]) {
        Some(row) => {
            let size = shown(row.memory[0] as f64 / 1e6, Quantity::Measured);
            format!("{} has the smallest storage within 1 %, {size} MB.", row.label)
        }
        None => "No variant is within 1 % of the sum over all pairs.".to_owned(),
    })
}

fn speed(parameters: &Parameters, rows: &[WayRow]) -> Option<String> {
    let gather = |row: &&WayRow| row.times.map(|times| times[2].time);
    let timed = || rows.iter().filter(|row| row.times.is_some());
    let (fast, slow) = (timed().min_by_key(gather)?, timed().max_by_key(gather)?);
    let ms = |row: &WayRow| shown(row.times.map_or(0.0, |times| times[2].time.seconds() * 1e3), Quantity::Measured);
    let on = &parameters.profile.title;
    Some(if fast.label == slow.label {
        format!("Pass 2 takes {} ms on the {on}.", ms(fast))
    } else {
        format!("Pass 2 takes from {} ms ({}) to {} ms ({}) on the {on}.", ms(fast), fast.label, ms(slow), slow.label)
    })
}

/// Warns of repeated faces: a face listed twice counts as two surfaces, and light enters and leaves both.
fn repeated(outcome: &SubsurfaceOutcome) -> Option<String> {
    let count = outcome.atlas.census().duplicate_faces as u64;
    (count > 0).then(|| {
        let faces = counted(count, "face of the model lies", "faces of the model lie");
        format!("{faces} on another face: such places count twice, and reflect too much light.")
    })
}

/// Warns of coarse texels: if texels are longer than the mean free path, peaks of R_d fall between them.
fn coarse(outcome: &SubsurfaceOutcome) -> Option<String> {
    let lengths = &outcome.lengths;
    (lengths.coarse > 0.0).then(|| {
        format!(
            "On {} of the surface, texels are longer than the shortest mean free path ({} mm), so finer detail is lost \
             there; a larger atlas would show it.",
            percent(lengths.coarse),
            shown(lengths.mean_free_path, Quantity::Measured),
        )
    })
}

/// Warns of thin models: the dipole assumes a half space, so light must not reach the model's other side.
fn thin(outcome: &SubsurfaceOutcome) -> Option<String> {
    let lengths = &outcome.lengths;
    let (thickness, reach) = (lengths.thickness?, 2.0 * lengths.diffusion_length);
    let because = if reach.is_infinite() {
        "A channel of the medium does not absorb, so its light passes through the model".to_owned()
    } else if thickness < reach {
        format!("Two diffusion lengths, {} mm, reach through the model", shown(reach, Quantity::Measured))
    } else {
        return None;
    };
    Some(format!(
        "{because}, whose median thickness is {} mm: the dipole, which assumes a half space, is wrong there.",
        shown(thickness, Quantity::Measured)
    ))
}
