//! Transfer against closed forms, furnaces and the reference.

use std::f64::consts::PI;

use crossbar::all_frequency::paper::AllFrequencyReference;
use crossbar::all_frequency::transfer::{FactoredTransfer, TransferSegment};
use crossbar::elementary::{atan2, on_circle};
use crossbar::geom::random::CounterRng;
use crossbar::transfer::Vertices;
use crossbar::transfer::grid::{FINE_SIDE, FineDirections, Segmentation};
use crossbar::transfer::light::{CubeLight, HaarLight};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::SegmentCensus;
use glam::DVec3;

use super::{all, close, clutter, flat, observer, trace, vertices};

const WIDTHS: [BasisWidth; 2] = [BasisWidth::OneTexel, BasisWidth::TwoTexels];

fn cosine(s: DVec3, into: &mut [f64]) {
    into[0] = s.z;
}

/// A glossy product function in local coordinates: a lobe around the mirror direction, and a diffuse part.
fn product(v: DVec3, s: DVec3) -> f64 {
    let along = (v.z * s.z - v.x * s.x - v.y * s.y).max(0.0);
    s.z * (0.3 / PI + along * along * along * along * (1.0 + 0.3 * s.x))
}

const VIEWS: [DVec3; 3] = [DVec3::new(0.6, 0.0, 0.8), DVec3::Z, DVec3::new(-0.48, 0.64, 0.6)];

fn glossy(s: DVec3, into: &mut [f64]) {
    into.iter_mut().zip(VIEWS).for_each(|(value, view)| *value = product(view, s));
}

/// All rows of the product M L at a vertex, each with the sum of the magnitudes of its terms.
fn radiance(segments: &[TransferSegment], light: &HaarLight, vertex: u32, rows: usize) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; rows];
    for segment in segments {
        let Ok(point) = segment.vertices.binary_search(&vertex) else { continue };
        for (row, sum) in sums.iter_mut().enumerate() {
            let m = &segment.signal.point(point)[TransferSegment::row(row)];
            for (&m, l) in m.iter().zip(light.segment(0, segment.segment)) {
                *sum = [sum[0] + f64::from(m) * l, sum[1] + (f64::from(m) * l).abs()];
            }
        }
    }
    sums
}

fn segments(
    vertices: &Vertices,
    mesh: &crossbar::geom::Mesh,
    width: BasisWidth,
    rows: usize,
    response: impl Fn(DVec3, &mut [f64]) + Sync,
) -> Vec<TransferSegment> {
    let (maps, hats) = (trace(mesh, vertices, &all(vertices)), LinearBasis::new(width));
    let transfer = FactoredTransfer { vertices, maps: &maps, hats: &hats, rows, response: &response };
    transfer.segments().map(|segment| segment.expect("transfer")).collect()
}

/// An open white Lambert vertex under light 1 has radiance 1: the error of the quadrature, over normals of all kinds.
/// Directions are centers of fine texels, so a texel cut by the horizon counts entirely or not at all. But the cosine
/// is small there: over these normals, the error is at most 2.0e-5 of the albedo.
#[test]
fn an_open_vertex_in_a_furnace_shows_its_albedo() {
    let fine = FineDirections::get();
    let random = CounterRng::new(11);
    let axes = [DVec3::X, DVec3::Y, -DVec3::Z, DVec3::ONE, DVec3::new(1.0, -1.0, 0.0)];
    let normals = (0..200).map(|at| DVec3::from([0, 1, 2].map(|k| 2.0 * random.unit(at, 0, k) - 1.0)));
    let mut worst: f64 = 0.0;
    for normal in normals.chain(axes).map(DVec3::normalize) {
        let pairs = fine.directions().iter().zip(fine.solid_angles());
        let sum: f64 = pairs.map(|(s, w)| (normal.dot(*s)).max(0.0) * w).sum();
        worst = worst.max((sum / PI - 1.0).abs());
    }
    assert!(worst < FURNACE && worst > FURNACE / 1.2, "{worst:e}");
    let light = HaarLight::new(&CubeLight::constant([1.0; 3]).expect("a light"), Segmentation::Quarters);
    for (width, normal) in WIDTHS.into_iter().flat_map(|width| axes.map(|normal| (width, normal.normalize()))) {
        let mesh = flat(observer(normal).to_vec());
        let vertices = vertices(&mesh);
        let found = radiance(&segments(&vertices, &mesh, width, 1, cosine), &light, 0, 1)[0][0] / PI;
        // One rounding to f32 of each number of M; here all are positive.
        close(found, 1.0, FURNACE + 6e-8, "the furnace");
    }
}

/// Bound on the furnace's error.
const FURNACE: f64 = 2.2e-5;

/// A square that faces the vertex from above blocks its form factor: 4/pi (x / sqrt(1 + x^2) atan(x / sqrt(1 + x^2)))
/// with x = half side / height, for a vertex below the square's center.
#[test]
fn a_square_overhead_shadows_its_form_factor() {
    let light = HaarLight::new(&CubeLight::constant([1.0; 3]).expect("a light"), Segmentation::Quarters);
    for (x, turns) in [(0.3, 0.0), (1.0, 0.07), (2.0, 0.11), (5.0, 0.03)] {
        let [cos, sin] = on_circle(turns);
        let corner = |a: f64, b: f64| [(x * (a * cos - b * sin)) as f32, (x * (a * sin + b * cos)) as f32, 1.0];
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let mesh = flat([observer(DVec3::Z), [a, b, c], [a, c, d]].concat());
        let vertices = vertices(&mesh);
        let found = radiance(&segments(&vertices, &mesh, BasisWidth::TwoTexels, 1, cosine), &light, 0, 1)[0][0] / PI;
        let root = (1.0 + x * x).sqrt();
        let factor = 4.0 / PI * x / root * atan2(x, root);
        // Fine texels along the rim count entirely or not at all: their number is below 4 sides of 128 (1 + |tan|) / x,
        // a random walk of halves of their form factor, which is at most 1 / (pi 64^2). Eight standard deviations.
        let texels: f64 = 4.0 * FINE_SIDE as f64 * 1.5 * x.max(1.0);
        let tolerance = 8.0 * texels.sqrt() * 0.3 / (PI * 64.0 * 64.0) + FURNACE;
        close(found, 1.0 - factor, tolerance, &format!("half side {x}"));
    }
}

/// M L equals the reference's sum over directions, with its own directions, solid angles, frames and interpolation of
/// the light, from the same visibility bits. Only rounding differs: each number of M is rounded once to f32, 2^-24 of
/// its term, and sums in another order have some 1e5 roundings of f64.
#[test]
fn transfer_times_light_is_the_reference() {
    let random = CounterRng::new(4);
    let texels: Vec<f64> =
        (0..6144).map(|at| if random.unit(at, 0, 0) < 0.1 { 50.0 } else { random.unit(at, 0, 1) }).collect();
    let light = CubeLight::new(texels.iter().map(|&value| [value; 3]).collect()).expect("a light");
    let light = HaarLight::new(&light, Segmentation::Quarters);
    for (seed, size) in [(0, 0.4), (1, 1.5), (2, 3.0)] {
        let mesh = clutter(seed, 8, size);
        let vertices = vertices(&mesh);
        let maps = trace(&mesh, &vertices, &all(&vertices));
        for width in WIDTHS {
            let found = segments(&vertices, &mesh, width, 3, glossy);
            let reference =
                AllFrequencyReference { vertices: &vertices, product: &product, light: &texels, hats: width };
            for vertex in (0..vertices.len()).step_by(5) {
                let sums = radiance(&found, &light, vertex as u32, 3);
                for (view, [sum, terms]) in VIEWS.into_iter().zip(sums) {
                    let sees =
                        |face, row, column| maps.is_visible(vertex, (face * FINE_SIDE + row) * FINE_SIDE + column);
                    let expected = reference.exit_radiance(vertex, view, sees);
                    let bound = terms * f64::EPSILON * (536_870_912.0 / 2.0 + 1e5);
                    close(sum, expected, bound, &format!("clutter {seed}, {width}, vertex {vertex}"));
                }
            }
        }
    }
}

/// A segment contains the vertices that see any part of it and omits the others; the transform is applied to raw
/// transfer.
#[test]
fn empty_segments_are_left_out_and_counted() {
    let mesh = clutter(6, 12, 2.5);
    let vertices = vertices(&mesh);
    let maps = trace(&mesh, &vertices, &all(&vertices));
    for width in WIDTHS {
        let hats = LinearBasis::new(width);
        let transfer = FactoredTransfer { vertices: &vertices, maps: &maps, hats: &hats, rows: 3, response: &glossy };
        let census = SegmentCensus::new(&vertices, &maps, &hats);
        let mut nonempty = 0;
        for segment in transfer.segments().map(|segment| segment.expect("transfer")) {
            nonempty += segment.vertices.len() as u64;
            assert_eq!(segment.signal.points(), segment.vertices.len());
            for vertex in all(&vertices) {
                let raw = transfer.raw(segment.segment, vertex as usize);
                let energy: f64 = raw.iter().map(|value| value * value).sum();
                match segment.vertices.binary_search(&vertex) {
                    Err(_) => assert_eq!(energy, 0.0),
                    Ok(point) => {
                        let found =
                            segment.signal.point(point).iter().map(|&m| f64::from(m) * f64::from(m)).sum::<f64>();
                        close(found, energy, 1e-6 * energy, "Parseval");
                    }
                }
            }
        }
        assert_eq!(nonempty, census.nonempty);
        assert_eq!(census.segments, census.below_horizon + census.shadowed + census.nonempty);
        assert!(census.shadowed > 0 && census.omega() < 0.8, "{census:?}");
    }
    let none = FactoredTransfer {
        vertices: &vertices,
        maps: &maps,
        hats: &LinearBasis::new(BasisWidth::OneTexel),
        rows: 0,
        response: &glossy,
    };
    assert!(none.segment(0).is_err_and(|error| error.to_string().contains("at least 1 for the number of rows")));
}
