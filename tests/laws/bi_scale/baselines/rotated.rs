//! Tests harmonics and shuffled visibility, both rotated into vertex frames.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use crossbar::bi_scale::baselines::{
    HarmonicRows, LocalLightError, LocalTransfer, ReshuffledVisibility, StoredTransfer, cell_integrals,
};
use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::matrix::SparseMatrix;
use crossbar::bi_scale::product::by_rows;
use crossbar::bi_scale::transfer::light_vector;
use crossbar::error::input_error;
use crossbar::sphere::{CubeMap, DirectionRule, harmonics};
use crossbar::transfer::grid::LIGHT_MAP;

use super::{light, transfer};
use crate::bi_scale::transfer::center as texel_center;

#[test]
fn cells_cover_the_hemisphere() {
    for side in [1, 3, 8] {
        let directions = LocalDirections::new(side).expect("a side");
        let cells = cell_integrals(&directions, 4);
        let sum = |at: usize| cells.iter().map(|cell| cell[at]).sum::<f64>();
        assert_relative_eq!((4.0 * PI).sqrt() * sum(0), TAU, max_relative = 1e-12);
        let exact = DirectionRule::hemisphere(8).project(4, |_| 1.0);
        for (at, exact) in exact.into_iter().enumerate() {
            // Points of equal solid angle, 16 along an edge of a cell, form a midpoint rule.
            let bound = 8.0 / (256 * side * side) as f64;
            assert!((sum(at) - exact).abs() < bound, "{side}, {at}: {} for {exact}", sum(at));
        }
    }
}

/// Light projected to an order, and matrices of harmonics, equal the results of plain loops over texels.
#[test]
fn harmonics_are_those_of_plain_loops() {
    let (vertices, matrix, directions) = transfer();
    let transfer = LocalTransfer::new(&matrix, vertices.frames(), &directions).expect("transfer");
    let (light, order, count) = (light(2), 3, 9);
    let angle = |texel: usize| LIGHT_MAP.solid_angle(texel % 32, texel / 32 % 32);
    let functions = |direction| {
        let mut y = vec![0.0; count];
        harmonics(order, direction, &mut y);
        y
    };
    let global: Vec<Vec<f64>> = (0..6144).map(|texel| functions(texel_center(texel))).collect();
    let of_light: Vec<f64> = (0..count).map(|b| (0..6144).map(|k| light[k] * global[k][b]).sum()).collect();
    let smooth = |texel: usize| (0..count).map(|b| of_light[b] * global[texel][b]).sum::<f64>() * angle(texel);
    let smooth: Vec<f64> = (0..6144).map(smooth).collect();
    let by_light = HarmonicRows::of_light(&matrix, order).expect("rows").multiply(&light);
    for (found, expected) in by_light.iter().zip(by_rows(&matrix, &smooth)) {
        assert_relative_eq!(*found, expected, max_relative = 1e-5, epsilon = 1e-5);
    }
    let both = HarmonicRows::of_both(&transfer, order).expect("rows").multiply(&light);
    let cells = cell_integrals(&directions, order);
    for (vertex, found) in both.chunks(16).enumerate() {
        let mut arriving = vec![0.0; count];
        for row in 16 * vertex..16 * (vertex + 1) {
            for entry in matrix.row(row) {
                let texel = entry.index as usize;
                let local = functions(vertices.frames()[vertex].to_local(texel_center(texel)));
                let radiance = 0.25 * f64::from(entry.value) * smooth[texel];
                (0..count).for_each(|a| arriving[a] += radiance * local[a]);
            }
        }
        for (found, cell) in found.iter().zip(&cells) {
            let expected: f64 = (0..count).map(|a| cell[a] * arriving[a]).sum();
            assert_relative_eq!(*found, expected, max_relative = 1e-4, epsilon = 1e-4);
        }
    }
}

/// For smooth light, the error decreases with the order. For hard light, low orders have a large error, which is larger
/// with harmonics on both sides than on one side.
#[test]
fn higher_orders_are_nearer() {
    let (vertices, matrix, directions) = transfer();
    let transfer = LocalTransfer::new(&matrix, vertices.frames(), &directions).expect("transfer");
    let smooth = light_vector(&(0..6144).map(|k| texel_center(k).x.max(0.0)).collect::<Vec<f64>>());
    let mut hard = vec![0.0; 6144];
    (40..44).for_each(|column| hard[4096 + 32 * 12 + column] = 1.0);
    let error = |rows: HarmonicRows, light: &[f64]| {
        LocalLightError::new(&rows.multiply(light), &by_rows(&matrix, light)).relative
    };
    let of_light = |order, light: &[f64]| error(HarmonicRows::of_light(&matrix, order).expect("rows"), light);
    let of_both = |order, light: &[f64]| error(HarmonicRows::of_both(&transfer, order).expect("rows"), light);
    let falling = [2, 5, 9].map(|order| of_light(order, &smooth));
    assert!(falling[0] > 2.0 * falling[1] && falling[1] > 2.0 * falling[2], "{falling:?}");
    assert!(falling[2] < 0.01, "{falling:?}");
    let falling = [2, 5, 9].map(|order| of_both(order, &smooth));
    assert!(falling[0] > falling[1] && falling[1] > falling[2], "{falling:?}");
    assert!(of_light(5, &smooth) < of_both(5, &smooth));
    assert!(of_light(5, &hard) > 0.5, "{}", of_light(5, &hard));
    let refused = HarmonicRows::of_light(&matrix, 11).unwrap_err().to_string();
    assert_eq!(refused, "expected an order of harmonics of 1 to 10, found 11");
}

/// Down-sampled visibility is shuffled direction by direction; finer texels do not remove its error.
#[test]
fn a_shuffle_takes_the_texel_of_each_direction() {
    let (vertices, matrix, directions) = transfer();
    let transfer = LocalTransfer::new(&matrix, vertices.frames(), &directions).expect("transfer");
    let (light, expected) = (light(4), by_rows(&matrix, &light(4)));
    let solid_angles: Vec<f64> =
        cell_integrals(&directions, 1).iter().map(|cell| (4.0 * PI).sqrt() * cell[0]).collect();
    let mut shares = vec![vec![0.0; 6144]; vertices.len()];
    for row in 0..matrix.rows() {
        let of_vertex = &mut shares[row / 16];
        matrix.row(row).iter().for_each(|e| of_vertex[e.index as usize] += 0.25 * f64::from(e.value));
    }
    for side in [1, 4, 16, 32] {
        let (cube, parts) = (CubeMap::new(side), 32 / side);
        let found = ReshuffledVisibility::new(&transfer, side).expect("a side").multiply(&light);
        for (row, found) in found.iter().enumerate() {
            let (vertex, local) = (row / 16, row % 16);
            let towards = vertices.frames()[vertex].to_global(directions.directions()[local]);
            let [face, column, line] = cube.texel_of(towards);
            let texels = (0..parts * parts)
                .map(|at| 1024 * face + 32 * (parts * line + at / parts) + parts * column + at % parts);
            let (mut flux, mut seen) = (0.0, 0.0);
            for texel in texels {
                flux += light[texel];
                seen += shares[vertex][texel];
            }
            let mean = seen / (parts * parts) as f64;
            let expected = mean * flux / cube.solid_angle(column, line) * solid_angles[local];
            assert_relative_eq!(*found, expected, max_relative = 1e-6, epsilon = 1e-9);
        }
        let error = LocalLightError::new(&found, &expected);
        assert!(error.relative > 0.05, "{side}: {error:?}");
    }
    assert_eq!(
        ReshuffledVisibility::new(&transfer, 5).unwrap_err().to_string(),
        "expected 1, 2, 4, 8, 16 or 32 texels along an edge of the coarse cube, found 5"
    );
}

/// At an unoccluded vertex under uniform light, each direction gets its solid angle.
#[test]
fn a_constant_light_stays_constant() {
    let (vertices, _, directions) = transfer();
    let frame = &vertices.frames()[..1];
    let mut open = SparseMatrix::new(6144, 0).unwrap();
    let mut rows = vec![Vec::new(); 16];
    for texel in 0..6144 {
        let nearest = directions.nearest(frame[0].to_local(texel_center(texel)));
        rows[nearest].push(crossbar::bi_scale::matrix::MatrixEntry { index: texel as u32, value: 1 });
    }
    rows.iter().for_each(|row| open.push_row(row).unwrap());
    let transfer = LocalTransfer::new(&open, frame, &directions).expect("transfer");
    let light = light_vector(&[1.0; 6144]);
    for side in [1, 2, 4, 8, 16, 32] {
        let found = ReshuffledVisibility::new(&transfer, side).unwrap().multiply(&light);
        assert_relative_eq!(found.iter().sum::<f64>(), TAU, max_relative = 1e-6);
    }
    let found = HarmonicRows::of_both(&transfer, 5).unwrap().multiply(&light);
    for (found, cell) in found.iter().zip(cell_integrals(&directions, 1)) {
        assert_relative_eq!(*found, (4.0 * PI).sqrt() * cell[0], max_relative = 2e-3);
    }
}

#[test]
fn frames_of_another_model_are_refused() {
    let (vertices, matrix, directions) = transfer();
    let expected = input_error!(
        "expected {} rows, one per vertex and local direction, found {}: name the model of the file",
        15 * 16,
        16 * 16
    );
    assert_eq!(LocalTransfer::new(&matrix, &vertices.frames()[1..], &directions).err(), Some(expected));
}
