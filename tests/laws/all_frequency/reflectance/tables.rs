//! Tables of reflectance from files of any kind.

use std::fs;

use crate::support::file;
use crossbar::all_frequency::factor::{Factorization, load_product_table};
use proptest::prelude::*;

/// Loads a file with these contents: the side lengths of the view map and the light map, or the error message.
fn load(bytes: &[u8]) -> Result<[usize; 2], String> {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("q.csv");
    fs::write(&path, bytes).expect("written");
    let table = load_product_table(&path).map_err(|error| error.to_string())?;
    Ok([table.view().side(), table.light().side()])
}

proptest! {
    /// A table is accepted only if its numbers of rows and columns are squares.
    #[test]
    fn squares_are_maps_and_nothing_else(rows in 1..30_usize, columns in 1..30_usize) {
        let text = (vec!["0.5"; columns].join(",") + "\n").repeat(rows);
        let is_square = |count: usize| count.isqrt() * count.isqrt() == count;
        let found = load(text.as_bytes());
        prop_assert_eq!(found.is_ok(), is_square(rows) && is_square(columns), "{:?}", found);
    }
}

/// The example has terms; a table of zeros has none.
#[test]
fn the_example_has_terms() {
    let example = file("docs/examples/reflectance.csv");
    let table = load_product_table(&example).expect("a table");
    let found = Factorization::new(&table, 4).expect("terms");
    assert_eq!(([table.view().side(), table.light().side()], found.terms()), ([4, 4], 4));
    let zeros = crossbar::io::NumberTable { columns: 4, values: vec![0.0; 16] };
    let zeros = crossbar::all_frequency::factor::ProductTable::of_numbers(&zeros, "0".as_ref()).expect("a table");
    assert_eq!(Factorization::new(&zeros, 1).unwrap_err().error_code(), "crossbar::factor::dark");
}
