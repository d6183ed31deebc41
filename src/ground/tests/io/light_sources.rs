use crossbar_ground::io::{LightSourceRow, parse_light_sources};
use std::path::Path;

fn parse(text: &str) -> Result<Vec<LightSourceRow>, String> {
    parse_light_sources(text.as_bytes(), Path::new("s.csv")).map_err(|error| error.to_string())
}

#[test]
fn a_line_is_a_source() {
    let expected = LightSourceRow { towards: [0.0, 0.0, 2.0], degrees: 1.5, radiance: [1.0, 2.0, 3.0] };
    assert_eq!(parse("x,y,z,degrees,r,g,b\n0,0,2,1.5,1,2,3\n"), Ok(vec![expected]));
    assert_eq!(parse("x,y,z,degrees,r,g,b\n"), Ok(vec![]));
}

#[test]
fn bad_lists_are_named() {
    assert_eq!(
        parse("0,0,1,1,1,1,1\n"),
        Err("s.csv:1: expected the header `x,y,z,degrees,r,g,b`, found `0,0,1,1,1,1,1`".to_owned())
    );
    for line in ["0,0,0,1,1,1,1", "0,0,1,0,1,1,1", "0,0,1,181,1,1,1", "0,0,1,1,-1,1,1", "0,0,1,1,nan,1,1", "0,0,1"] {
        let error = parse(&format!("x,y,z,degrees,r,g,b\n{line}\n")).expect_err(line);
        assert!(
            error.starts_with("s.csv:2: expected seven finite numbers") && error.ends_with(&format!("`{line}`")),
            "{error}"
        );
    }
}
