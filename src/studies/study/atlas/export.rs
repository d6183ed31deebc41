//! Export of the atlas for other programs: OBJ with texture coordinates, and a table of the faces' rectangles.

use std::fmt::Write as _;

use crate::atlas::Atlas;
use crate::geom::Mesh;
use crate::geom::vector::narrow;

/// Encodes the mesh as OBJ, with every face split into two triangles for exact texture coordinates: u to the right and
/// v up, from 0 to 1 over the atlas.
pub(super) fn obj(mesh: &Mesh, atlas: &Atlas) -> String {
    let mut text = format!("# {} faces, each split into two triangles\nmtllib atlas.mtl\n", mesh.len());
    // Writing to a string does not fail.
    let mut line = |arguments: std::fmt::Arguments<'_>| writeln!(text, "{arguments}").unwrap_or_default();
    for [x, y, z] in mesh.positions() {
        line(format_args!("v {x} {y} {z}"));
    }
    let faces = || (0..mesh.len() as u32).map(|face| (atlas.places()[face as usize], atlas.drawn(face)));
    for (_, drawn) in faces() {
        let [x, y, z] = narrow(drawn.triangles[0][2].position);
        line(format_args!("v {x} {y} {z}"));
    }
    let side = f64::from(atlas.side());
    for (_, drawn) in faces() {
        let [[a, b, m], [.., c]] = drawn.triangles;
        for [x, y] in [a, b, m, c].map(|vertex| vertex.at.map(f64::from)) {
            line(format_args!("vt {} {}", x / side, 1.0 - y / side));
        }
    }
    line(format_args!("usemtl atlas"));
    let middles = mesh.positions().len() as u64 + 1;
    for ((place, _), (face, corners)) in faces().zip((0_u64..).zip(mesh.triangles())) {
        let [a, b, c] = place.in_turn(*corners).map(|vertex| u64::from(vertex) + 1);
        let (m, at) = (middles + face, 4 * face + 1);
        line(format_args!("f {a}/{at} {b}/{} {m}/{}", at + 1, at + 2));
        line(format_args!("f {a}/{at} {m}/{} {c}/{}", at + 2, at + 3));
    }
    text
}

/// Material of [`obj`], with the picture of the faces as its texture.
pub(super) const MATERIAL: &str = "newmtl atlas\nKd 1 1 1\nillum 1\nmap_Kd faces.png\n";

/// Table with a line per face: its rectangle in texels, orientation and area.
pub(super) fn faces(atlas: &Atlas) -> String {
    let mut text = "face,x,y,width,height,first,transposed,texel_area\n".to_owned();
    for (face, place) in (0_u32..).zip(atlas.places()) {
        let texel = &atlas.texels()[place.y as usize * atlas.side() as usize + place.x as usize];
        let [x, y, width, height] = [place.x, place.y, place.width, place.height];
        let (first, transposed, area) = (place.first, u8::from(place.transposed), texel.area);
        writeln!(text, "{face},{x},{y},{width},{height},{first},{transposed},{area:e}").unwrap_or_default();
    }
    text
}
