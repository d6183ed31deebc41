//! Products on the card compared with the host bit by bit.

use crossbar_systems::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crossbar_systems::bi_scale::matrix::{MatrixEntry, SparseMatrix};
use crossbar_systems::bi_scale::on_card::{GatherCard, LightFormat};
use crossbar_systems::bi_scale::product::Gather;
use refsim::machine::ExecutorKind;

use crate::device;
use crate::geom::random::CounterRng;

/// A matrix of multiples of 1/4 in runs, so that biclusters have many rows; some rows and columns are empty.
fn matrix(rows: usize, columns: usize, seed: u64) -> SparseMatrix {
    let random = CounterRng::new(seed);
    let mut matrix = SparseMatrix::new(columns, 2).expect("columns");
    for row in 0..rows {
        let value = |column: usize| match random.unit((row / 5) as u64, column as u64, 0) {
            draw if draw < 0.6 || row % 13 == 4 || column % 11 == 7 => 0,
            draw if draw < 0.9 => 4,
            _ => 1 + (4.0 * random.unit(row as u64, column as u64, 1)) as i32,
        };
        let entries = (0..columns).map(|column| MatrixEntry { index: column as u32, value: value(column) });
        let entries: Vec<MatrixEntry> = entries.filter(|entry| entry.value != 0).collect();
        matrix.push_row(&entries).expect("a row");
    }
    matrix
}

fn biclusters(matrix: &SparseMatrix) -> Biclustering {
    bicluster(matrix, SEED, &mut |_| ()).expect("biclusters")
}

fn light(columns: usize, seed: u64) -> Vec<[f32; 3]> {
    let random = CounterRng::new(seed);
    (0..columns as u64).map(|k| [0, 1, 2].map(|channel| (3.0 * random.unit(k, channel, 2)) as f32)).collect()
}

fn bits(numbers: &[[f32; 3]]) -> Vec<[u32; 3]> {
    numbers.iter().map(|rgb| rgb.map(f32::to_bits)).collect()
}

/// Small programs and textures divide the sums into many passes and textures.
#[test]
fn products_are_the_hosts_bit_by_bit() {
    for (rows, columns, seed) in [(300, 90, 1), (77, 200, 2), (1, 1, 3), (5, 40, 4)] {
        let matrix = matrix(rows, columns, seed);
        let found = biclusters(&matrix);
        for (name, instructions, side) in [("gt200", 512, 8192), ("ideal-fp32", 512, 8192), ("gt200", 40, 32)] {
            let mut profile = device(name);
            profile.limits.instructions = Some(instructions);
            profile.limits.max_texture_size = Some(side);
            let mut card = GatherCard::new(profile, ExecutorKind::Batch, &found, LightFormat::Fp32).expect("a card");
            let counts = card.counts();
            let least = [found.column_entries(), found.row_entries()].map(|count| count as u64);
            assert!(counts.places[0] >= least[0] && counts.places[1] >= least[1], "{counts:?}, {least:?}");
            assert!(instructions == 512 || rows < 50 || counts.passes[1] > 5, "{counts:?}");
            for seed in 10..12 {
                let light = light(columns, seed);
                let local = card.multiply(&light).expect("a product");
                assert_eq!(bits(&local), bits(&Gather::new(&found).multiply(&light)), "{rows} x {columns}, {name}");
            }
            let negative: Vec<[f32; 3]> = light(columns, 5).iter().map(|rgb| rgb.map(|value| 1.5 - value)).collect();
            let local = card.multiply(&negative).expect("a product");
            assert_eq!(bits(&local), bits(&Gather::new(&found).multiply(&negative)), "{rows} x {columns}, {name}");
        }
    }
}

/// With light in fewer bits, errors are at most half a step of the largest number times the sum of the row's values.
#[test]
fn light_in_fewer_bits_is_off_by_its_steps() {
    let (matrix, light) = (matrix(200, 100, 6), light(100, 7));
    let found = biclusters(&matrix);
    let expected = Gather::new(&found).multiply(&light);
    let mut worst = Vec::new();
    for (format, step) in [(LightFormat::Bytes, 1.0 / 255.0), (LightFormat::Fp16, 1.0 / 2048.0)] {
        let mut card = GatherCard::new(device("gt200"), ExecutorKind::Batch, &found, format).expect("a card");
        let local = card.multiply(&light).expect("a product");
        let largest = light.as_flattened().iter().fold(0.0_f32, |most, &value| most.max(value));
        let mut off = 0.0_f64;
        for (row, (local, expected)) in local.iter().zip(&expected).enumerate() {
            let unit: f64 = matrix.row(row).iter().map(|entry| matrix.value(entry.value)).sum();
            let bound = unit * f64::from(largest) * (0.5 * step + 1e-6);
            for channel in 0..3 {
                let error = (f64::from(local[channel]) - f64::from(expected[channel])).abs();
                assert!(error <= bound, "{format}, row {row}: {error} of {bound}");
                off = off.max(error);
            }
        }
        worst.push(off);
    }
    assert!(worst[0] > 4.0 * worst[1] && worst[1] > 0.0, "{worst:?}");
}

#[test]
fn what_does_not_fit_is_refused() {
    let found = biclusters(&matrix(20, 10, 1));
    let mut card = GatherCard::new(device("gt200"), ExecutorKind::Batch, &found, LightFormat::Bytes).expect("a card");
    let lights = [vec![[1.0; 3]; 9], vec![[-1.0; 3]; 10], vec![[f32::INFINITY; 3]; 10]];
    let mut messages = lights.map(|light| card.multiply(&light).expect_err("refused").to_string()).to_vec();
    // Rows that are all one bicluster.
    let mut small = device("gt200");
    small.limits.max_texture_size = Some(4);
    let of_rows = |rows: usize| {
        let mut matrix = SparseMatrix::new(2, 0).expect("columns");
        (0..rows).for_each(|_| matrix.push_row(&[MatrixEntry { index: 0, value: 1 }]).expect("a row"));
        GatherCard::new(small.clone(), ExecutorKind::Batch, &biclusters(&matrix), LightFormat::Fp32)
    };
    assert!(of_rows(15).is_ok());
    messages.push(of_rows(16).expect_err("refused").to_string());
    insta::assert_snapshot!(messages.join("\n"), @r"
    expected 10 numbers of light, found 9
    expected finite light, of 0 or more if it is stored in bytes, found -1
    expected finite light, of 0 or more if it is stored in bytes, found inf
    16 rows need a texture of 8 x 4 texels; `gt200` has textures of 4 per side (limits.max_texture_size); use fewer
    ");
}
