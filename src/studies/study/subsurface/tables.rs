//! The tables of the study.

use super::all_pairs::GatherError;
use super::outcome::SubsurfaceOutcome;
use super::{Parameters, model};
use crate::report::{Cell, Table};
use crate::subsurface::on_card::PassKind;

pub(super) fn model(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        "The model in mm, and the medium's lengths",
        "faces atlas area_mm2 diagonal_mm shortest_side_mm texel_mm shortest_mean_free_path_mm longest_diffusion_length_mm \
         coarse_texels_%",
    );
    let lengths = &outcome.lengths;
    let scale = parameters.options.mm_per_unit * parameters.options.mm_per_unit;
    table.push([
        parameters.mesh.len().into(),
        format!("{0} x {0}", parameters.options.side).into(),
        Cell::measured(outcome.atlas.area() * scale),
        Cell::measured(lengths.diagonal),
        Cell::measured(lengths.shortest_side),
        Cell::measured(lengths.texel),
        Cell::measured(lengths.mean_free_path),
        Cell::measured(lengths.diffusion_length),
        Cell::percent(100.0 * lengths.coarse),
    ]);
    table
}

pub(super) fn medium(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        format!("{}: coefficients per mm, lengths in mm", parameters.material.name),
        "channel sigma_s_prime sigma_a eta mean_free_path diffusion_length total_R_d",
    );
    for (channel, dipole) in ["red", "green", "blue"].into_iter().zip(&outcome.dipoles) {
        let of = dipole.coefficients();
        table.push([
            channel.into(),
            of.sigma_s_prime.into(),
            of.sigma_a.into(),
            dipole.eta().into(),
            Cell::measured(dipole.mean_free_path()),
            Cell::measured(dipole.diffusion_length()),
            Cell::decimals(dipole.total(), 6),
        ]);
    }
    table
}

pub(super) fn errors(outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        "Ways of gathering, with errors relative to B: root mean square by area, maximum, and roughness among \
         neighboring texels (seams)",
        "way links_rms_% links_largest_% links_seams_% plain_means_rms_% card_rms_% card_largest_% all_rms_% all_largest_%",
    );
    let rms = |error: GatherError| Cell::percent(100.0 * error.rms);
    let largest = |error: GatherError| Cell::percent(100.0 * error.largest);
    let or_empty = |error: Option<GatherError>, of: fn(GatherError) -> Cell| error.map_or(Cell::Empty, of);
    for row in &outcome.rows {
        table.push([
            row.label.as_str().into(),
            or_empty(row.links_error, rms),
            or_empty(row.links_error, largest),
            row.seams.map_or(Cell::Empty, |seams| Cell::percent(100.0 * seams)),
            or_empty(row.plain_error, rms),
            rms(row.card_error),
            largest(row.card_error),
            or_empty(row.error, rms),
            or_empty(row.error, largest),
        ]);
    }
    table
}

/// Table of errors by angle from the light, one row per way of gathering and bin.
pub(super) fn angles(outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        "Errors by the angle between normal and light, relative to the sum over all pairs: error of the mean of B, and rms error of B",
        "way from_degrees to_degrees area_% B_all_pairs links_% links_rms_% all_% all_rms_%",
    );
    for (row, bin) in outcome.rows.iter().flat_map(|row| row.angles.iter().map(move |bin| (row, bin))) {
        let [from, to] = bin.degrees;
        let share = |share: f64| Cell::percent(100.0 * share);
        let head: [Cell; 5] =
            [row.label.as_str().into(), from.into(), to.into(), share(bin.area), Cell::measured(bin.radiosity)];
        table.push(head.into_iter().chain([bin.links.mean, bin.links.rms, bin.all.mean, bin.all.rms].map(share)));
    }
    table
}

pub(super) fn storage(outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        "Card resources; reads and instructions are per texel of pass 2",
        "way link_MB memory_MB passes link_reads map_reads instructions samplers factors lost_to_0 denormal places_rounded map_saturated",
    );
    for row in &outcome.rows {
        let sum = |of: usize| row.programs.iter().map(|program| program[of]).sum::<usize>();
        table.push([
            row.label.as_str().into(),
            Cell::measured(row.memory[1] as f64 / 1e6),
            Cell::measured(row.memory[0] as f64 / 1e6),
            row.programs.len().into(),
            row.lookups[0].into(),
            row.lookups[1].into(),
            sum(0).into(),
            row.programs.iter().map(|program| program[1]).max().unwrap_or(0).into(),
            row.lost.factors.into(),
            row.lost.flushed.into(),
            row.lost.denormal.into(),
            row.lost.places.into(),
            row.saturated.into(),
        ]);
    }
    table
}

/// Table of modelled times, one row per way of gathering for which times are known.
pub(super) fn times(outcome: &SubsurfaceOutcome) -> Table {
    let mut table = Table::of(
        "A frame with a new light, by the pipeline model; a new view takes only pass 3",
        "way pass_1_ms levels_ms pass_2_ms pass_3_ms frame_ms frames_per_s pass_2_bound_by",
    );
    for (row, times) in outcome.rows.iter().filter_map(|row| Some((row, row.times?))) {
        let ms = |at: usize| times[at].time.seconds() * 1e3;
        let frame: f64 = (0..PassKind::ALL.len()).map(ms).sum();
        table.push([
            row.label.as_str().into(),
            Cell::measured(ms(0)),
            Cell::measured(ms(1)),
            Cell::measured(ms(2)),
            Cell::measured(ms(3)),
            Cell::measured(frame),
            Cell::measured(1e3 / frame),
            times[2].bottleneck.map_or(Cell::Empty, |bound| bound.to_string().into()),
        ]);
    }
    table
}

pub(super) fn faces(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Table {
    let columns: Vec<_> = outcome.columns().map(|(_, texels)| model::by_face(&outcome.atlas, texels)).collect();
    let mut table = Table::with_colors("Faces", "face area_mm2", outcome.columns().map(|(label, _)| label));
    let scale = parameters.options.mm_per_unit * parameters.options.mm_per_unit;
    for face in 0..outcome.atlas.places().len() {
        let area = parameters.mesh.area(face as u32) * scale;
        let head: [Cell; 2] = [face.into(), area.into()];
        table.push(head.into_iter().chain(columns.iter().flat_map(|values| values[face]).map(Cell::from)));
    }
    table
}

pub(super) fn vertices(parameters: &Parameters, outcome: &SubsurfaceOutcome) -> Table {
    let at_vertices = |(_, texels)| model::by_vertex(&outcome.atlas, &parameters.mesh, texels);
    let columns: Vec<_> = outcome.columns().map(at_vertices).collect();
    let mut table = Table::with_colors("Vertices", "vertex x y z", outcome.columns().map(|(label, _)| label));
    for (vertex, place) in parameters.mesh.positions().iter().enumerate() {
        let head = [Cell::from(vertex)].into_iter().chain(place.map(Cell::from));
        let found = columns.iter().flat_map(|values| [0, 1, 2].map(|c| values[vertex].map(|value| value[c]).into()));
        table.push(head.chain(found));
    }
    table
}
