//! System 4: radiance transfer at the vertices of a mesh.

mod bad_input;
mod bounces;
mod brdf;
mod closed_forms;
mod equation_1;
mod models;
mod rotation;
mod scattering;

use std::f64::consts::PI;

use crate::support::{close, flat, soup};
use crossbar::cpca::transfer::TracedRays;
use crossbar::geom::{Mesh, Sides};
use crossbar::sphere::DirectionRule;
use crossbar::tracer::HostTracer;
use crossbar::transfer::Vertices;
use glam::DVec3;

/// Triangles with separate vertices.
#[derive(Default)]
struct Soup(Vec<[f32; 3]>);

impl Soup {
    /// A parallelogram that faces along `across` x `along`.
    fn quad(&mut self, corner: DVec3, across: DVec3, along: DVec3) {
        for place in [corner, corner + across, corner + across + along, corner, corner + across + along, corner + along]
        {
            self.0.push(place.as_vec3().into());
        }
    }

    /// A box between two corners whose faces point outward, or inward if the corners are exchanged.
    fn boxed(&mut self, low: DVec3, high: DVec3) {
        let d = high - low;
        for axis in 0..3 {
            let mut pick = [0.0; 3];
            pick[axis] = 1.0;
            let (along, [u, v]) = (DVec3::from(pick), [(axis + 1) % 3, (axis + 2) % 3]);
            let side = |k: usize| DVec3::AXES[k] * d[k];
            self.quad(low, side(v), side(u));
            self.quad(low + along * d, side(u), side(v));
        }
    }

    fn mesh(self) -> Mesh {
        soup(self.0)
    }

    /// A mesh with flat normals, one per triangle.
    fn flat(self) -> Mesh {
        flat(self.0)
    }
}

/// A floor and a wall of two squares each, and an overhanging block.
fn step() -> Mesh {
    let mut soup = Soup::default();
    for x in [0.0, 1.0] {
        soup.quad(DVec3::new(x, 0.0, 0.0), DVec3::X, DVec3::Y);
        soup.quad(DVec3::new(x, 1.0, 0.0), DVec3::X, DVec3::Z);
    }
    soup.boxed(DVec3::new(0.3, 0.2, 0.6), DVec3::new(1.1, 0.5, 0.8));
    soup.flat()
}

fn caster(mesh: &Mesh) -> HostTracer {
    HostTracer::new(mesh, Sides::Both)
}

fn trace(mesh: &Mesh, vertices: &Vertices, degree: usize) -> TracedRays {
    TracedRays::trace(vertices, DirectionRule::hemisphere(degree), &mut caster(mesh), true).expect("traced")
}

/// Coefficients of light with radiance 1 from all directions.
fn uniform(count: usize) -> Vec<f64> {
    let mut light = vec![0.0; count];
    light[0] = (4.0 * PI).sqrt();
    light
}

/// Coefficients of light, all of them nonzero.
fn mixed(count: usize) -> Vec<f64> {
    (0..count).map(|index| if index == 0 { 3.0 } else { ((index * 37 % 23) as f64 - 11.0) / 15.0 }).collect()
}

/// A unit ball of 8 n^2 triangles.
fn ball(parts: u32) -> Mesh {
    let mut soup = Soup::default();
    for octant in 0..8_u32 {
        let sign = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let signs = DVec3::new(sign(0), sign(1), sign(2));
        let inwards = signs.element_product() < 0.0;
        let at = |i: u32, j: u32| {
            let on = DVec3::new(f64::from(i), f64::from(j), f64::from(parts - i - j)) * signs;
            on.normalize().as_vec3().to_array()
        };
        let mut push = |mut corners: [[f32; 3]; 3]| {
            if inwards {
                corners.swap(1, 2);
            }
            soup.0.extend(corners);
        };
        for i in 0..parts {
            for j in 0..parts - i {
                push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 2 <= parts {
                    push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
    }
    soup.mesh().welded()
}
