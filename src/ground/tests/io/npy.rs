use crossbar_ground::io::npy::MAGIC;
use crossbar_ground::io::{
    NumberArray, NumberTable, load_numbers_or_codes, parse_npy_array, parse_numbers, write_npy_array,
};
use std::path::Path;

fn file(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
    let length = (header.len() as u32).to_le_bytes();
    let length = if version == 1 { &length[..2] } else { &length[..] };
    [MAGIC, &[version, 0], length, header.as_bytes(), data].concat()
}

fn parse(bytes: &[u8]) -> Result<NumberTable, String> {
    parse_npy_array(bytes, Path::new("a.npy")).map(NumberTable::from).map_err(|error| error.to_string())
}

#[test]
fn all_versions_and_types_are_read() {
    let values = [1.5_f32, -2.0, 0.1, 3e38, 0.0, -0.0];
    let bytes = |descr: &str| -> Vec<u8> {
        let one = |&value: &f32| match descr {
            "<f4" => value.to_le_bytes().to_vec(),
            ">f4" => value.to_be_bytes().to_vec(),
            "<f8" => f64::from(value).to_le_bytes().to_vec(),
            _ => f64::from(value).to_be_bytes().to_vec(),
        };
        values.iter().flat_map(one).collect()
    };
    for (version, shape, columns) in [(1, "(2, 3)", 3), (2, "(3, 1, 2)", 2), (3, "(6,)", 1)] {
        for descr in ["<f4", ">f4", "<f8", ">f8"] {
            let header = format!(" {{\"descr\": '{descr}', 'shape': {shape}, 'fortran_order': False}}  \n");
            let expected = NumberTable { columns, values: values.to_vec() };
            let file = file(version, &header, &bytes(descr));
            assert_eq!(parse(&file), Ok(expected), "{version} {descr}");
            let wide = parse_numbers::<f64>(&file, Path::new("a.npy")).expect("a table");
            assert_eq!(wide.values, values.map(f64::from), "{version} {descr}");
        }
    }
}

#[test]
fn what_is_written_is_read() {
    let table = NumberTable { columns: 3, values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0] };
    let mut bytes = Vec::new();
    write_npy_array(&[2, 3], &table.values, &mut bytes).expect("written");
    assert_eq!((bytes.len() - 24) % 64, 0);
    assert_eq!(parse(&bytes), Ok(table));
    for length in 0..bytes.len() {
        assert!(parse(&bytes[..length]).is_err(), "{length} bytes");
    }
    assert!(parse(&[&bytes[..], &[0]].concat()).is_err());
}

#[test]
fn shapes_are_kept() {
    for shape in [&[6][..], &[2, 3], &[1, 2, 1, 3]] {
        let values = vec![0.5, -1.0, 2.0, 3.0, 4.0, 5.0];
        let mut bytes = Vec::new();
        write_npy_array(shape, &values, &mut bytes).expect("written");
        let found = parse_npy_array(&bytes, Path::new("a.npy")).expect("an array");
        assert_eq!(found, NumberArray { shape: shape.to_vec(), values });
    }
}

#[test]
fn what_is_not_read_is_named() {
    let error = |header: &str, data: &[u8]| parse(&file(1, header, data)).expect_err("no table");
    let with = |descr: &str, order: &str, shape: &str| {
        format!("{{'descr': {descr}, 'fortran_order': {order}, 'shape': {shape}}}")
    };
    for (header, bytes, found) in [
        (with("'<f4'", "True", "(1, 1)"), 4, "found Fortran order"),
        (with("'<i4'", "False", "(1, 1)"), 4, "found `<i4`"),
        (with("'<f4'", "False", "(2, 3)"), 20, "expected 6 x 4 bytes of numbers, found 20 bytes"),
    ] {
        let error = error(&header, &[0; 20][..bytes]);
        assert!(error.starts_with("a.npy: expected ") && error.ends_with(found), "{error}");
    }
    for shape in ["()", "(0, 3)", "(3, 0)", "(9999999999999, 9999999999999)"] {
        assert!(error(&with("'<f4'", "False", shape), &[]).starts_with("a.npy: expected"), "{shape}");
    }
    let header = with("'<f8'", "False", "(1,)");
    let range = error(&header, &1e39_f64.to_le_bytes());
    assert_eq!(range, "a.npy: number 0 (counted from 0) is too large for a 32-bit float: 1e39");
    let wide = parse_numbers::<f64>(&file(1, &header, &1e39_f64.to_le_bytes()), Path::new("a.npy")).expect("a table");
    assert_eq!(wide.values, [1e39], "f64 holds it");
    let twice = "{'shape': (1,), 'shape': (1,)}";
    for header in [twice, "", "{", "{'descr'}", "{'x': 1}", "{'shape': (-1,)}", "[1]", "{'shape': (1,) 'descr': '<f4'}"]
    {
        assert!(error(header, &[]).contains("expected"), "{header}");
    }
    assert!(parse(b"PK").is_err() && parse(&file(4, "", &[])).is_err());
}

/// A type that no reader knows is refused with the types that this reader reads.
#[test]
fn patterns_are_among_the_types_of_a_matrix() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.npy");
    std::fs::write(&path, file(1, "{'descr': '|b1', 'fortran_order': False, 'shape': (1,)}", &[1])).expect("written");
    let error = load_numbers_or_codes(&path, "matrix", 100).expect_err("truth values").to_string();
    assert!(error.ends_with("or patterns of type u1, <u2 or <u4, found `|b1`"), "{error}");
}
