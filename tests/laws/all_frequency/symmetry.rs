//! Rotating mesh, light and frames together by a symmetry of the cube permutes directions: visibility bits are
//! permuted, radiance is unchanged.

use crate::environment::by_form;
use std::collections::BTreeMap;

use crossbar::all_frequency::transfer::FactoredTransfer;
use crossbar::geom::Mesh;
use crossbar::sphere::CubeMap;
use crossbar::transfer::grid::{FINE_DIRECTIONS, FINE_SIDE, LIGHT_SIDE, Segmentation};
use crossbar::transfer::light::{CubeLight, HaarLight};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::VisibilityMaps;
use crossbar::transfer::{Tangents, Vertices};
use glam::{DMat3, DVec3};

use super::{clutter, texel_of, trace};

/// The 24 rotations of the cube.
fn turns() -> Vec<DMat3> {
    let axes = [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z];
    let pairs = axes.into_iter().flat_map(|x| axes.map(|y| (x, y))).filter(|(x, y)| x.dot(*y) == 0.0);
    pairs.map(|(x, y)| DMat3::from_cols(x, y, x.cross(y))).collect()
}

fn turned(mesh: &Mesh, turn: &DMat3) -> Mesh {
    let all = |of: &[[f32; 3]]| -> Vec<[f32; 3]> {
        of.iter().map(|v| (*turn * DVec3::from(v.map(f64::from))).as_vec3().into()).collect()
    };
    let mesh_turned = Mesh::new(all(mesh.positions()), mesh.triangles().to_vec()).expect("a mesh");
    mesh_turned.with_normals(all(mesh.normals().expect("normals"))).expect("normals")
}

/// Image of each texel of a cube under a rotation.
fn places(turn: &DMat3, side: usize) -> Vec<usize> {
    let map = CubeMap::new(side);
    let direction = |at: usize| map.direction(at / (side * side), at % side, at / side % side);
    (0..map.len()).map(|at| texel_of(*turn * direction(at), side)).collect()
}

/// The product M L at every vertex, for a response of three components that depend on the tangent.
fn radiance(vertices: &Vertices, maps: &VisibilityMaps, light: &CubeLight) -> BTreeMap<u32, [f64; 3]> {
    let (hats, light) = (LinearBasis::new(BasisWidth::TwoTexels), HaarLight::new(light, Segmentation::Quarters));
    let response = |s: DVec3, into: &mut [f64]| into.copy_from_slice(&[s.z, s.z * s.x, s.z * s.y * s.y]);
    let transfer = FactoredTransfer { vertices, maps, hats: &hats, rows: 3, response: &response };
    let mut sums = BTreeMap::new();
    for segment in transfer.segments().map(|segment| segment.expect("transfer")) {
        for (point, &vertex) in segment.vertices.iter().enumerate() {
            let sum: &mut [f64; 3] = sums.entry(vertex).or_default();
            for (row, m) in segment.signal.point(point).chunks(256).enumerate() {
                sum[row] +=
                    m.iter().zip(light.segment(0, segment.segment)).map(|(&m, l)| f64::from(m) * l).sum::<f64>();
            }
        }
    }
    sums
}

/// By default every fourth of the 24 rotations: identity, quarter and half turns about axes, third turns about
/// diagonals.
#[test]
fn turns_of_the_cube_permute_bits_and_keep_radiance() {
    let mesh = clutter(5, 10, 1.5);
    let tangent = DVec3::new(0.3, -0.5, 0.8);
    let texels: Vec<[f64; 3]> = (0..6144_u32).map(|at| [f64::from(at * 7919 % 1000) / 100.0, 1.0, 0.0]).collect();
    let light = CubeLight::new(texels).expect("a light");
    let of_mesh = |mesh: &Mesh, tangent| {
        let vertices = Vertices::new(mesh, Tangents::Along(tangent)).expect("vertices");
        let of: Vec<u32> = (0..vertices.len() as u32).collect();
        let maps = trace(mesh, &vertices, &of);
        (vertices, maps)
    };
    let (vertices, maps) = of_mesh(&mesh, tangent);
    let expected = radiance(&vertices, &maps, &light);
    let step = by_form(4, 1);
    for turn in turns().into_iter().step_by(step) {
        let (turned_vertices, found) = of_mesh(&turned(&mesh, &turn), turn * tangent);
        let fine = places(&turn, FINE_SIDE);
        for map in 0..maps.len() {
            for (from, &to) in (0..FINE_DIRECTIONS).zip(&fine) {
                assert_eq!(
                    maps.is_visible(map, from),
                    found.is_visible(map, to),
                    "{turn}, vertex {map}, {from} to {to}"
                );
            }
        }
        let mut moved = vec![[0.0; 3]; 6144];
        places(&turn, LIGHT_SIDE).into_iter().zip(light.texels()).for_each(|(to, texel)| moved[to] = *texel);
        let found = radiance(&turned_vertices, &found, &CubeLight::new(moved).expect("a light"));
        for (vertex, expected) in &expected {
            for (found, expected) in found[vertex].iter().zip(expected) {
                // Transfer is rounded to f32: 2^-24 times a sum of magnitudes below 10 pi 10.
                assert!((found - expected).abs() < 2e-5, "{turn}, vertex {vertex}: {found} {expected}");
            }
        }
    }
}
