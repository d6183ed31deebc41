use crossbar_base::error::InputError;
use crossbar_base::geom::Mesh;
use crossbar_ground::io::{load_mesh, parse_obj};
use std::path::Path;

fn parse(text: &str) -> Result<Mesh, InputError> {
    parse_obj(text.as_bytes(), Path::new("m.obj"))
}

fn message(text: &str) -> String {
    parse(text).unwrap_err().to_string()
}

#[test]
fn a_byte_order_mark_hides_no_vertex() {
    for end in ["\n", "\r\n", "\r"] {
        let text = "\u{feff}v 5 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3".replace('\n', end);
        assert_eq!(parse(&text).expect("a mesh").positions()[0], [5.0, 0.0, 0.0]);
    }
}

#[test]
fn errors_name_their_line() {
    for text in ["v 0 nan 0\nf 1 1 1", "v 0 1e39 0", "v 0 0", "v 0 0 0 2"] {
        assert!(message(text).starts_with("m.obj:1: expected "), "{text}");
    }
    for corners in ["1 2", "1 2 4", "1 2 -4", "0 1 2", "1 2 9223372036854775807", "1 2 -9223372036854775808", "1 2 x"] {
        let error = message(&format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf {corners}"));
        assert!(error.starts_with("m.obj:4: ") && error.contains("expected "), "{error}");
    }
    assert_eq!(message("v 0 0 0"), "m.obj: expected at least one face (a line `f 1 2 3`), found none");
    let missing = Path::new("/no/such/file.obj");
    assert_eq!(load_mesh(missing).unwrap_err().to_string(), "cannot read the model /no/such/file.obj");
}

#[test]
fn a_face_may_come_before_its_vertices() {
    assert_eq!(parse("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0").expect("a mesh").len(), 1);
}
