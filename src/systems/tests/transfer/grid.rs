//! The cube of light texels: its segments, hat functions and wavelets.

use crossbar_systems::transfer::grid::{FINE_SIDE, FineDirections, LIGHT_TEXELS, Segmentation, light_texel};
use crossbar_systems::transfer::haar::{Haar, HaarSupport};
use crossbar_systems::transfer::linear_basis::{BasisWeights, BasisWidth};

use crate::sphere::CubeMap;

#[test]
fn texels_and_places_are_one_to_one() {
    for (segmentation, count, side) in [(Segmentation::Quarters, 24, 16), (Segmentation::Faces, 6, 32)] {
        assert_eq!((segmentation.count(), segmentation.side()), (count, side));
        for texel in 0..LIGHT_TEXELS {
            let [segment, place] = segmentation.place(texel);
            assert_eq!(segmentation.texel(segment, place), texel);
        }
    }
    // Face 2, row 17, column 3: the lower left quarter, row 1.
    assert_eq!(Segmentation::Quarters.place(2 * 1024 + 17 * 32 + 3), [2 * 4 + 2, 16 + 3]);
    assert_eq!(light_texel(3 * 16_384 + 5 * 128 + 127), 3 * 1024 + 32 + 31);
}

#[test]
fn fine_directions_cover_the_sphere() {
    let fine = FineDirections::get();
    let sum: f64 = fine.solid_angles().iter().sum();
    assert!((sum / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12, "{sum}");
    assert_eq!(fine.directions()[4 * 16_384 + 64 * 128 + 64], CubeMap::new(FINE_SIDE).direction(4, 64, 64));
}

#[test]
fn inside_a_face_hats_are_bilinear() {
    // Fine row 41 is row 1 of texel row 10, 1/8 above its center; fine column 47 is column 3 of texel column 11, 3/8
    // right.
    let found: Vec<_> = BasisWeights::of(BasisWidth::TwoTexels, 4 * 16_384 + 41 * 128 + 47).iter().collect();
    let at = |row: usize, column: usize| 4 * 1024 + row * 32 + column;
    let expected =
        [(at(10, 11), 35.0 / 64.0), (at(10, 12), 21.0 / 64.0), (at(9, 11), 5.0 / 64.0), (at(9, 12), 3.0 / 64.0)];
    assert_eq!(found, expected);
    let one: Vec<_> = BasisWeights::of(BasisWidth::OneTexel, 4 * 16_384 + 41 * 128 + 47).iter().collect();
    assert_eq!(one, [(at(10, 11), 1.0)]);
}

#[test]
fn beyond_an_edge_lies_the_next_face() {
    // The texels with a weight in the fine direction at a corner of a texel of +x.
    let around = |row: usize, column: usize| {
        let weights = BasisWeights::of(BasisWidth::TwoTexels, row * 128 + column);
        weights.iter().map(|(texel, _)| texel).collect::<Vec<_>>()
    };
    // +x has -z on its right and +y above; beyond its right border is -z's left column.
    assert_eq!(around(31, 127), [7 * 32 + 31, 5 * 1024 + 7 * 32, 8 * 32 + 31, 5 * 1024 + 8 * 32]);
    assert_eq!(around(31, 0), [7 * 32, 4 * 1024 + 7 * 32 + 31, 8 * 32, 4 * 1024 + 8 * 32 + 31]);
    // Above +x's row 0 is +y's right column; +x's columns run along -z, +y's rows along +z.
    let above = |column: usize| 2 * 1024 + (31 - column) * 32 + 31;
    assert_eq!(around(0, 3), [0, 1, above(0), above(1)]);
    // At a corner of the cube there are three texels.
    assert_eq!(around(0, 0), [0, 4 * 1024 + 31, above(0)]);
}

#[test]
fn two_by_two_as_defined() {
    let mut square = [8.0, 4.0, 2.0, 0.0];
    Haar::new(2).forward(&mut square);
    assert_eq!(square, [7.0, 3.0, 5.0, 1.0]);
    Haar::new(2).inverse(&mut square);
    assert_eq!(square, [8.0, 4.0, 2.0, 0.0]);
}

#[test]
fn a_basis_function_vanishes_outside_its_support() {
    let mut haar = Haar::new(8);
    for coefficient in 0..64 {
        let mut square = [0.0; 64];
        square[coefficient] = 1.0;
        haar.inverse(&mut square);
        let HaarSupport { row, column, side } = haar.support(coefficient);
        for (at, value) in square.into_iter().enumerate() {
            let within = (row..row + side).contains(&(at / 8)) && (column..column + side).contains(&(at % 8));
            // Values are plus or minus 1 / side, so that the squares sum to 1.
            assert_eq!(value.abs(), if within { 1.0 / side as f64 } else { 0.0 }, "{coefficient} at {at}");
        }
    }
}
