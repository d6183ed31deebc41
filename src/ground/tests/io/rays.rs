use crossbar_base::geom::Ray;
use crossbar_ground::io::{load_rays, parse_rays, write_hits};
use std::path::Path;

fn message(text: &str) -> String {
    parse_rays(text.as_bytes(), Path::new("r.csv")).unwrap_err().to_string()
}

#[test]
fn numbers_are_rounded_once() {
    let text = "ox,oy,oz,dx,dy,dz\n0.1,-0,1e-45,3e38,0.3333333333333333,-2\n0,0,0,0,0,-1\n";
    let rays = parse_rays(text.as_bytes(), Path::new("r.csv")).expect("rays");
    let first = Ray::new([0.1, -0.0, 1e-45], [3.0e38, 1.0 / 3.0, -2.0]).expect("a ray");
    assert_eq!(rays, [first, Ray::new([0.0; 3], [0.0, 0.0, -1.0]).expect("a ray")]);
    assert_eq!(rays[0].origin()[1].to_bits(), (-0.0_f32).to_bits());
}

#[test]
fn errors_say_where_and_what() {
    assert_eq!(message(""), "r.csv:1: expected the header `ox,oy,oz,dx,dy,dz`, found ``");
    assert_eq!(message("ox,oy,oz\n"), "r.csv:1: expected the header `ox,oy,oz,dx,dy,dz`, found `ox,oy,oz`");
    let with = |line: &str| message(&format!("ox,oy,oz,dx,dy,dz\r\n0,0,0, 0,0,1\n{line}\n"));
    assert_eq!(with("1,2,3"), "r.csv:3: expected 6 numbers (ox,oy,oz,dx,dy,dz), found 3 fields");
    assert_eq!(with("1,2,3,4,five,6"), "r.csv:3: expected a number for dy, found `five`");
    assert_eq!(with("1,2,3,0,0,0"), "r.csv:3: expected a direction, found (0, 0, 0)");
    assert_eq!(with("1,nan,3,0,0,1"), "r.csv:3: expected a finite number for oy, found `nan`");
    let large = "a number that is not too large for a 32-bit float: at most 3.4028235e38";
    assert_eq!(with("1,2,3,0,0,1e39"), format!("r.csv:3: expected {large} for dz, found `1e39`"));
    let missing = load_rays(Path::new("/no/such.csv")).unwrap_err().to_string();
    assert_eq!(missing, "cannot read the table of rays /no/such.csv");
}

#[test]
fn hits_read_back_to_the_same_bits() {
    let hits = [Some((7, f64::from(0.1_f32))), None, Some((8, 1e39)), Some((9, f64::INFINITY))];
    let mut text = Vec::new();
    write_hits(&hits, &mut text).expect("written");
    assert_eq!(text, b"ray,triangle,t\n0,7,0.1\n1,-1,inf\n2,8,1e39\n3,9,inf\n");
}
