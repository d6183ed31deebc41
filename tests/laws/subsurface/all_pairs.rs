//! Tests the reference over all pairs of texels, with texels from far below the mean free path to far above the
//! diffusion length.

use crate::support::plate;
use approx::assert_relative_eq;
use crossbar::atlas::Atlas;
use crossbar::quadrature::SIXTEEN;
use crossbar::subsurface::{Dipole, Reference};
use glam::DVec3;

use super::links_models::{atlas, marble, medium};

/// For a square of side 1, whose texels have sides of about 1/16.
const SIDE: u32 = 16;

pub(super) fn media() -> [Dipole; 3] {
    [marble(), medium(1.0, 0.0), medium(0.68, 0.9)]
}

/// A point of a plate receives what a half space returns, [`Dipole::total`], minus the part beyond the plate: at most
/// `Dipole::beyond` at the nearest edge's distance, and at least its value at the farthest corner's distance.
#[test]
fn a_plate_of_any_size_returns_the_half_space_s_total() {
    let atlas = atlas(&plate(1.0, 1.0), SIDE);
    // The texel nearest to the middle.
    let middle = DVec3::new(0.5, 0.5, 0.0);
    let distance = |texel: &usize| atlas.texels()[*texel].point.distance(middle);
    let i = (0..atlas.texels().len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("texels");
    for dipole in media() {
        for texel_mm in [0.02, 0.1, 0.5, 1.0, 2.0, 4.0, 9.0, 23.0, 100.0, 1e4, 1e9] {
            let mm_per_unit = texel_mm * f64::from(SIDE);
            let reference = Reference::new(&atlas, mm_per_unit, &dipole).expect("a scale");
            let found: f64 = (0..atlas.texels().len()).map(|j| reference.factor(i, j)).sum();
            // Points of the texel are within a tenth of the middle.
            let [least, most] = [0.4, 0.8].map(|r| dipole.total() - dipole.beyond(r * mm_per_unit));
            let within = 3e-3 * dipole.total();
            assert!(
                found > least - within && found < most + within,
                "texels of {texel_mm} mm: {found}, expected {least} to {most}"
            );
        }
    }
}

/// Two texels of one face are parallelograms of sides e and f, k e + l f apart. The points of both are
/// `(k + u) e + (l + v) f` apart with u and v from -1 to 1 by the densities 1 - |u| and 1 - |v|: equation 10 as an
/// integral over two numbers, with panels that get narrower toward the point where the points meet.
pub(super) fn parallelograms(dipole: &Dipole, [e, f]: [DVec3; 2], [k, l]: [f64; 2]) -> f64 {
    let panels = |middle: f64, side: DVec3| {
        let mut edges = vec![middle - 1.0, middle, middle + 1.0, 0.0];
        let mut at = 0.25 * dipole.z_r() / side.length();
        while at < 1.0 + middle.abs() {
            edges.extend([-at, at]);
            at *= 1.3;
        }
        edges.retain(|edge| (edge - middle).abs() <= 1.0);
        edges.sort_by(f64::total_cmp);
        edges
    };
    let nodes = |middle: f64, side: DVec3| -> Vec<(f64, f64)> {
        let panels = panels(middle, side);
        let of = |pair: &[f64]| {
            let (from, to) = (pair[0], pair[1]);
            SIXTEEN.map(|(x, weight)| {
                let at = from + (to - from) * x;
                (at, weight * (to - from) * (1.0 - (at - middle).abs()))
            })
        };
        panels.windows(2).flat_map(of).collect()
    };
    let across = nodes(l, f);
    let row = |&(u, weight): &(f64, f64)| {
        weight * across.iter().map(|&(v, weight)| weight * dipole.r_d((u * e + v * f).length())).sum::<f64>()
    };
    e.cross(f).length() * nodes(k, e).iter().map(row).sum::<f64>()
}

/// A texel that is a parallelogram, and so are its neighbors at these steps, on one face; and its sides.
pub(super) fn parallelogram(atlas: &Atlas, steps: &[u32]) -> (u32, [DVec3; 2]) {
    let corners = |texel: u32| -> Vec<DVec3> { atlas.part(texel).polygons().flatten().copied().collect() };
    let face = |texel: u32| atlas.texels()[texel as usize].face;
    let whole = |texel: u32| atlas.part(texel).polygons().count() == 1 && corners(texel).len() == 4;
    let texels = atlas.texels().len() as u32 - steps.iter().max().expect("steps");
    let i = (0..texels).find(|&i| steps.iter().all(|step| whole(i + step) && face(i + step) == face(i)));
    let ring = corners(i.expect("parallelograms"));
    (i.expect("parallelograms"), [ring[1] - ring[0], ring[2] - ring[1]])
}

/// How many of its sides a texel in the plane z = 0 is from another.
pub(super) fn apart(atlas: &Atlas, [e, f]: [DVec3; 2], [i, j]: [u32; 2]) -> [f64; 2] {
    let offset = atlas.texels()[j as usize].point - atlas.texels()[i as usize].point;
    let over = e.cross(f).z;
    [offset.cross(f).z / over, e.cross(offset).z / over]
}

#[test]
fn pairs_of_texels_have_equation_10_at_any_size() {
    let atlas = atlas(&plate(1.0, 1.0), SIDE);
    let (i, sides) = parallelogram(&atlas, &[0, 1, 2, 3]);
    for dipole in media() {
        for texel_mm in [0.1, 0.5, 1.0, 2.0, 4.0, 9.0, 23.0, 100.0] {
            let mm_per_unit = texel_mm * f64::from(SIDE);
            let reference = Reference::new(&atlas, mm_per_unit, &dipole).expect("a scale");
            for j in i..i + 3 {
                let expected =
                    parallelograms(&dipole, sides.map(|side| mm_per_unit * side), apart(&atlas, sides, [i, j]));
                let found = reference.factor(i as usize, j as usize);
                let within = 0.01 * dipole.total();
                assert!((found - expected).abs() < within, "{texel_mm} mm, texel {j}: {found}, expected {expected}");
                let back = reference.factor(j as usize, i as usize);
                assert_relative_eq!(found, back, epsilon = within);
            }
        }
    }
}
