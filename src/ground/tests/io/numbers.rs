use crossbar_ground::io::{NumberTable, load_numbers, parse_numbers, write_npy};
use std::path::Path;

#[test]
fn both_kinds_hold_the_same_numbers() {
    let name = Path::new("numbers");
    let values = [1.0_f32, 2.5, -3.0, 4.0];
    let (table, mut array) = (NumberTable { columns: 2, values: values.to_vec() }, Vec::new());
    write_npy(&table, &mut array).expect("written");
    for bytes in [&array[..], b"1,2.5\n-3,4\n"] {
        assert_eq!(parse_numbers(bytes, name).expect("numbers"), table);
        let wide = NumberTable { columns: 2, values: values.map(f64::from).to_vec() };
        assert_eq!(parse_numbers(bytes, name).expect("numbers"), wide);
    }
    let error = parse_numbers::<f64>(b"1,2\n3\n", name).expect_err("ragged");
    assert_eq!(error.error_code(), "crossbar::table::ragged");
    let cut = parse_numbers::<f64>(&array[..array.len() - 1], name).expect_err("cut");
    assert_eq!(cut.error_code(), "crossbar::npy::size");
    let missing = load_numbers::<f64>(Path::new("no/such/file.csv"), "table", 8).expect_err("missing");
    assert_eq!(missing.error_code(), "crossbar::file::unreadable");
}
