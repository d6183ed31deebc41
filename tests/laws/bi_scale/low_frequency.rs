//! Light in harmonics of the vertices' frames, compared with plain loops.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use crossbar::bi_scale::directions::LocalDirections;
use crossbar::bi_scale::low_frequency::{LowFrequencyTransfer, cell_integrals};
use crossbar::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar::bi_scale::product::by_rows;
use crossbar::bi_scale::transfer::{light_vector, transfer_matrix};
use crossbar::geom::random::CounterRng;
use crossbar::sphere::{DirectionRule, harmonics};
use crossbar::transfer::Vertices;
use crossbar::transfer::grid::LIGHT_MAP;
use crossbar::transfer::visibility::Horizon;

use super::sight;
use super::transfer::center as texel_center;

/// The transfer of hills to 4 x 4 directions.
fn transfer() -> (Vertices, SparseMatrix, LocalDirections) {
    let (vertices, maps) = sight(1, Horizon::Normal);
    let directions = LocalDirections::new(4).expect("a side");
    let matrix = transfer_matrix(&vertices, &maps, &directions).expect("a matrix");
    (vertices, matrix, directions)
}

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

#[test]
fn harmonics_are_those_of_plain_loops() {
    let (vertices, matrix, directions) = transfer();
    let random = CounterRng::new(2);
    let light = light_vector(&(0..6144).map(|texel| 3.0 * random.unit(texel, 0, 0)).collect::<Vec<f64>>());
    let (order, count) = (3, 9);
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
    let found = LowFrequencyTransfer::new(&matrix, vertices.frames(), &directions, order).expect("transfer");
    let cells = cell_integrals(&directions, order);
    for (vertex, found) in found.multiply(&light).chunks(16).enumerate() {
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

/// For smooth light, the error decreases with the order.
#[test]
fn higher_orders_are_nearer() {
    let (vertices, matrix, directions) = transfer();
    let smooth = light_vector(&(0..6144).map(|k| texel_center(k).x.max(0.0)).collect::<Vec<f64>>());
    let expected = by_rows(&matrix, &smooth);
    let error = |order| {
        let found = LowFrequencyTransfer::new(&matrix, vertices.frames(), &directions, order).expect("transfer");
        found.multiply(&smooth).iter().zip(&expected).map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    let falling = [2, 5, 9].map(error);
    assert!(falling[0] > falling[1] && falling[1] > falling[2], "{falling:?}");
}

/// At an unoccluded vertex under uniform light, each direction gets its solid angle.
#[test]
fn a_constant_light_stays_constant() {
    let (vertices, _, directions) = transfer();
    let frames = &vertices.frames()[..1];
    let mut open = SparseMatrix::new(6144, 0).unwrap();
    let mut rows = vec![Vec::new(); 16];
    for texel in 0..6144 {
        let nearest = directions.nearest(frames[0].to_local(texel_center(texel)));
        rows[nearest].push(MatrixEntry { index: texel as u32, value: 1 });
    }
    rows.iter().for_each(|row| open.push_row(row).unwrap());
    let found = LowFrequencyTransfer::new(&open, frames, &directions, 5).unwrap().multiply(&light_vector(&[1.0; 6144]));
    for (found, cell) in found.iter().zip(cell_integrals(&directions, 1)) {
        assert_relative_eq!(*found, (4.0 * PI).sqrt() * cell[0], max_relative = 2e-3);
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let (vertices, matrix, directions) = transfer();
    let is_refused = |matrix: &SparseMatrix, vertex: usize, order| {
        LowFrequencyTransfer::new(matrix, &vertices.frames()[vertex..], &directions, order).is_err()
    };
    assert!(is_refused(&matrix, 1, 5), "the frames of another model");
    assert!(is_refused(&matrix, 0, 11), "an order above 10");
    assert!(is_refused(&SparseMatrix::new(32, 0).expect("columns"), 0, 5), "32 columns");
}
