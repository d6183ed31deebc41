use crossbar_ground::io::{parse_cube_table, write_cube_table};
use std::path::Path;

fn parse(text: &str) -> Result<Vec<[f64; 3]>, String> {
    parse_cube_table(text.as_bytes(), Path::new("l.csv"), 1).map_err(|error| error.to_string())
}

const TAIL: &str = "1,0,0,1,0,0\n2,0,0,2,0,0\n3,0,0,3,0,0\n5,0,0,5,0,0\n4,0,0,4,0,0.5\n";

#[test]
fn a_line_is_a_texel_in_any_order() {
    let texels = parse(&format!("face,row,column,r,g,b\n{TAIL}0,0,0, 0.25 ,1e3,0\n")).expect("a map");
    assert_eq!(texels[0], [0.25, 1000.0, 0.0]);
    assert_eq!(texels[4..], [[4.0, 0.0, 0.5], [5.0, 0.0, 0.0]]);
    assert_eq!(parse(&write_cube_table(&texels, 1)), Ok(texels.clone()));
    let signed: Vec<[f64; 3]> = texels.iter().map(|rgb| rgb.map(|value| -value)).collect();
    assert_eq!(parse(&write_cube_table(&signed, 1)), Ok(signed));
}

#[test]
fn bad_tables_are_named() {
    let error = |line: &str| parse(&format!("face,row,column,r,g,b\n{TAIL}{line}\n")).expect_err("no map");
    assert_eq!(parse(""), Err("l.csv:1: expected the header `face,row,column,r,g,b`, found ``".to_owned()));
    for line in
        ["0,0,0,1,1", "6,0,0,1,1,1", "up,0,0,1,1,1", "0,1,0,1,1,1", "0,0,-1,1,1,1", "0,0,0,1,nan,1", "0,0,0,1,1,x"]
    {
        assert!(error(line).starts_with("l.csv:7: expected "), "{}", error(line));
    }
    assert_eq!(error("1,0,0,1,1,1"), "l.csv:7: the texel at face 1, row 0, column 0 is on line 2, too");
    let missing = "l.csv: expected 6 texels, 1 of them are missing, the first at face 0, row 0, column 0";
    assert_eq!(error(""), missing);
}
