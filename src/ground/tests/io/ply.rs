use crossbar_ground::io::parse_ply;
use std::path::Path;

fn message(text: &str) -> String {
    parse_ply(text.as_bytes(), Path::new("m.ply")).unwrap_err().to_string()
}

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 1\nproperty list uchar int vertex_indices\nend_header\n";

#[test]
fn errors_name_their_line() {
    for (line, text) in [
        (1, "solid x\n"),
        (2, "ply\nx"),
        (3, "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"),
        (2, "ply\nend_header\n"),
        (11, &format!("{HEADER}0 0 0\n1 zero 0\n")),
        (11, &format!("{HEADER}0 0 0\n1 0 0\n")),
        (13, &format!("{HEADER}0 0 0\n1 0 0\n0 1 0\n2 0 1\n")),
        (13, &format!("{HEADER}0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")),
    ] {
        assert!(message(text).starts_with(&format!("m.ply:{line}: expected ")), "{}", message(text));
    }
    let no_vertex = "m.ply: expected an element `vertex` with the properties `x`, `y` and `z`, found none";
    assert_eq!(message("ply\nformat ascii 1.0\nend_header\n"), no_vertex);
}
