use crossbar_ground::io::parse_ply;
use std::path::Path;

fn message(text: &str) -> String {
    parse_ply(text.as_bytes(), Path::new("m.ply")).unwrap_err().to_string()
}

const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                      element face 1\nproperty list uchar int vertex_indices\nend_header\n";

#[test]
fn polygons_become_fans_and_other_elements_are_passed_over() {
    let text = "ply\nformat ascii 1.0\ncomment caf\u{e9}\nelement vertex 4\nproperty double x\nproperty float32 y\n\
                property int z\nproperty uchar red\nproperty float s\nproperty float t\nelement material 1\n\
                property list uchar float x\nelement face 2\nproperty list uint8 uint vertex_index\nend_header\n\
                0 0 0 255 0 0\n1 0 0 0 1 0\n\n1 1 0 7 1 1\n0 1 0 8 0 1\n2 0.5 0.25\n4 0 1 2 3\n3 3 2 1\n";
    let mesh = parse_ply(text.as_bytes(), Path::new("m.ply")).expect("a mesh");
    let by_cr = parse_ply(text.replace('\n', "\r").as_bytes(), Path::new("m.ply")).expect("a mesh");
    assert_eq!(by_cr, mesh);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3], [3, 2, 1]]);
    assert_eq!(mesh.positions()[2], [1.0, 1.0, 0.0]);
    assert_eq!((mesh.normals(), mesh.texcoords().map(|uv| uv[3])), (None, Some([0.0, 1.0])));
}

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
