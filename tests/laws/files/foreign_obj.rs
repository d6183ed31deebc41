//! Compares the OBJ reader with the crate tobj: both find the same triangles, bit for bit and in the same order.

use std::path::Path;

use crossbar::io::parse_obj;
use proptest::prelude::*;
use tobj::LoadOptions;

type Corners = [[u32; 3]; 3];

/// The triangles that tobj reads from a text.
fn by_tobj(text: &str) -> Vec<Corners> {
    let options = LoadOptions { triangulate: true, single_index: true, ..LoadOptions::default() };
    let (models, _) =
        tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Err(tobj::LoadError::OpenFileFailed)).expect("a model");
    let meshes = models.iter().map(|model| &model.mesh);
    let corner = |mesh: &tobj::Mesh, index: u32| {
        let at = 3 * index as usize;
        [0, 1, 2].map(|axis| mesh.positions[at + axis].to_bits())
    };
    meshes.flat_map(|mesh| mesh.indices.chunks(3).map(|t| [0, 1, 2].map(|i| corner(mesh, t[i])))).collect()
}

fn by_crossbar(text: &str) -> Vec<Corners> {
    let mesh = parse_obj(text.as_bytes(), Path::new("m.obj")).expect("a model");
    mesh.iter_corners().map(|corners| corners.map(|corner| corner.map(f32::to_bits))).collect()
}

/// A coordinate, as programs write it.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        (-1e6f32..1e6).prop_map(|x| x.to_string()),
        (-1e3f32..1e3).prop_map(|x| format!("{x:.6}")),
        (-1e-30f32..1e30).prop_map(|x| format!("{x:e}")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    /// Triangles and convex quads with indices from the start and from the end, with and without texture and normal
    /// indices.
    #[test]
    fn another_reader_finds_the_same_triangles(
        positions in prop::collection::vec([number(), number(), number()], 3..20),
        faces in prop::collection::vec((any::<[prop::sample::Index; 3]>(), any::<bool>(), 0..3usize), 1..20),
    ) {
        let count = positions.len();
        let mut text = String::from("# a comment\no thing\ng part\ns off\nvn 0 0 1\nvt 0 0\n");
        positions.iter().for_each(|[x, y, z]| text += &format!("v {x} {y}  {z}\n"));
        for (corners, from_end, form) in faces {
            let index = |corner: &prop::sample::Index| match corner.index(count) {
                at if from_end => format!("-{}", count - at),
                at => (at + 1).to_string(),
            };
            let ending = ["", "/1/1", "//1"][form];
            text += &format!("f {}\n", corners.each_ref().map(|c| format!("{}{ending}", index(c))).join(" "));
        }
        text += "v 0 0 0\nv 4 0 0\nv 5 3 0\nv 0 2 0\nf -4 -3 -2 -1\n";
        prop_assert_eq!(by_crossbar(&text), by_tobj(&text));
    }
}
