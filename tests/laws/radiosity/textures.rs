//! Texture layouts can be read back.

use crossbar::card::Texels;
use crossbar::linalg::Matrix;
use crossbar::radiosity::card_system::CardSystem;
use crossbar::radiosity::packing;
use crossbar::radiosity::{FormFactors, System};
use proptest::prelude::*;

use super::random_system;

const LIMIT: usize = 2048;

fn rounded(matrix: &Matrix) -> Vec<Vec<f32>> {
    matrix.rows().map(|row| row.iter().map(|&x| x as f32).collect()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn every_layout_reads_back(size in 0..40_usize, seed in any::<u64>()) {
        let [a, b, c] = [0, 1, 2].map(|k| if size == 0 { Matrix::zeros([0; 2]).expect("small") } else { random_system(size, 0.9, seed ^ k).0 });
        let texels = packing::rgb_matrix([&a, &b, &c], LIMIT).expect("it fits");
        prop_assert_eq!((texels.width, texels.height, texels.texels.len()), (size, size, size * size));
        for (channel, matrix) in [&a, &b, &c].into_iter().enumerate() {
            prop_assert_eq!(from_rgb_matrix(&texels, size, channel), rounded(matrix));
        }
        let texels = packing::luminance_matrix(&a, LIMIT).expect("it fits");
        prop_assert_eq!((texels.width, texels.height), (size.div_ceil(4), size.div_ceil(4) * 4));
        prop_assert_eq!(from_luminance_matrix(&texels, size), rounded(&a));
        let values: Vec<[f64; 3]> = (0..size).map(|i| [i as f64, 0.1, -1e-3]).collect();
        let texels = packing::rgb_vector(&values, LIMIT).expect("it fits");
        let expected: Vec<[f32; 3]> = values.iter().map(|v| v.map(|x| x as f32)).collect();
        prop_assert_eq!(packing::from_rgb_vector(&texels), expected);
        let one: Vec<f64> = values.iter().map(|v| v[0] + v[1]).collect();
        let texels = packing::luminance_vector(&one, LIMIT).expect("it fits");
        prop_assert_eq!(texels.width, size.div_ceil(4));
        prop_assert_eq!(texels.texels.as_flattened()[..size].to_vec(), one.iter().map(|&x| x as f32).collect::<Vec<_>>());
    }
}

#[test]
fn a_texture_that_the_card_does_not_have_is_refused() {
    let matrix = Matrix::zeros([40; 2]).expect("small");
    let refused = packing::rgb_matrix([&matrix; 3], 32).expect_err("40 > 32");
    assert!(refused.to_string().contains("32 x 32 texels, the card's largest, found 40 x 40"), "{refused}");
    assert!(packing::luminance_matrix(&matrix, 32).is_err(), "it has 40 rows");
    assert!(packing::rgb_vector(&[[0.0; 3]; 33], 32).is_err());
    assert!(packing::luminance_vector(&[0.0; 33], 32).is_ok());
}

/// The first `size` rows and columns of a channel's matrix.
fn from_rgb_matrix(texels: &Texels, size: usize, channel: usize) -> Vec<Vec<f32>> {
    (0..size).map(|y| texels.row(y)[..size].iter().map(|texel| texel[channel]).collect()).collect()
}

fn from_luminance_matrix(texels: &Texels, size: usize) -> Vec<Vec<f32>> {
    (0..size).map(|y| texels.row(y).as_flattened()[..size].to_vec()).collect()
}

/// A patch that sees itself has a diagonal other than 1, by which the paper's equation does not divide E, but the card
/// must.
#[test]
fn the_diagonal_is_divided_out_of_both_sides() {
    let values = vec![0.5, 0.25, 0.25, 0.0];
    let factors =
        FormFactors::from_values(vec![1.0; 2], Matrix::new([2, 2], values).expect("a matrix")).expect("factors");
    let system = System::new(factors, vec![[0.5; 3]; 2], vec![[3.0, 0.75, 1.5], [0.0; 3]]).expect("a system");
    let card = CardSystem::rgb(&system, 254, LIMIT).expect("it fits");
    assert_eq!(card.emittance.texels[0], [4.0, 1.0, 2.0, 0.0]);
    assert_eq!(
        card.matrix.row(0),
        [[1.0, 1.0, 1.0, 0.0], [(-1.0_f64 / 6.0) as f32, (-1.0_f64 / 6.0) as f32, (-1.0_f64 / 6.0) as f32, 0.0]]
    );
}
