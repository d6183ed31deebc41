//! Compares the methods of Figure 1 with the reference, closed forms, and each other.

use std::f64::consts::PI;

use crossbar::all_frequency::baselines::{BaselineSubject, FixedView, HarmonicTransfer};
use crossbar::all_frequency::factor::{Lobe, ProductFunction};
use crossbar::all_frequency::paper::AllFrequencyReference;
use crossbar::geom::Mesh;
use crossbar::transfer::Vertices;
use crossbar::transfer::brdf::Brdf;
use crossbar::transfer::grid::Segmentation;
use crossbar::transfer::light::{CubeLight, DiskSource, HaarLight, TruncationPriority};
use crossbar::transfer::linear_basis::{BasisWidth, LinearBasis};
use crossbar::transfer::visibility::VisibilityMaps;
use glam::{DMat3, DVec3};

use super::{all, close, clutter, flat, observer, trace, vertices};

const EYE: DVec3 = DVec3::new(1.5, -2.0, 2.5);

/// Triangles that shadow each other, and the visibility of each vertex.
struct Clutter {
    vertices: Vertices,
    maps: VisibilityMaps,
    hats: LinearBasis,
}

impl Clutter {
    fn new(mesh: &Mesh, width: BasisWidth) -> Self {
        let vertices = vertices(mesh);
        let maps = trace(mesh, &vertices, &all(&vertices));
        Self { vertices, maps, hats: LinearBasis::new(width) }
    }

    fn subject<'a>(&'a self, product: &'a dyn ProductFunction) -> BaselineSubject<'a> {
        let Self { vertices, maps, hats } = self;
        BaselineSubject { vertices, maps, hats, product }
    }
}

/// Two disks, one of them small.
fn light() -> CubeLight {
    let disk = |towards: DVec3, degrees: f64, radiance| DiskSource {
        towards: towards.normalize(),
        radius: degrees.to_radians(),
        radiance,
    };
    let disks = [
        disk(DVec3::new(0.3, -0.4, 1.0), 25.0, [1.0, 2.0, 0.5]),
        disk(DVec3::new(1.0, 0.2, 0.4), 2.0, [90.0, 40.0, 60.0]),
    ];
    CubeLight::from_disks(&disks, &DMat3::IDENTITY).expect("a light")
}

fn squares(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// With a fixed view and untruncated light, the result equals a direct sum of f over directions.
#[test]
fn a_fixed_view_under_the_whole_light_is_the_reference() {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    for width in [BasisWidth::OneTexel, BasisWidth::TwoTexels] {
        let clutter = Clutter::new(&clutter(3, 12, 0.9), width);
        let texels = light();
        let found = FixedView(clutter.subject(&lobe)).radiance(EYE, &[texels.texels()]).remove(0);
        let product = |view: DVec3, light: DVec3| lobe.value(view, light);
        let mut lit = 0;
        for (vertex, found) in found.iter().enumerate().step_by(5) {
            let place = DVec3::from(clutter.vertices.positions()[vertex].map(f64::from));
            let view = clutter.vertices.frames()[vertex].to_local((EYE - place).normalize());
            if view.z <= 0.0 {
                assert_eq!(*found, [0.0; 3], "vertex {vertex} is seen from below");
                continue;
            }
            for channel in 0..3 {
                let light: Vec<f64> = texels.texels().iter().map(|rgb| rgb[channel]).collect();
                let reference = AllFrequencyReference {
                    vertices: &clutter.vertices,
                    product: &product,
                    light: &light,
                    hats: width,
                };
                let sees = |face: usize, row: usize, column: usize| {
                    clutter.maps.is_visible(vertex, (face * 128 + row) * 128 + column)
                };
                let expected = reference.exit_radiance(vertex, view, sees);
                close(found[channel], expected, 1e-11 * expected.abs().max(1e-3), "towards the view");
                lit += usize::from(expected > 1e-3);
            }
        }
        assert!(lit > 5, "{lit} lit channels");
    }
}

/// Harmonics of the upper hemisphere and of the clamped cosine share only the bands 0 and 1, so order 2 gives the exact
/// radiance of an open Lambert vertex in a furnace: its albedo, up to fine texels cut by the horizon.
#[test]
fn harmonics_of_a_furnace_are_the_albedo() {
    let open = Clutter::new(&flat(observer(DVec3::new(0.3, -0.5, 0.9).normalize()).to_vec()), BasisWidth::TwoTexels);
    let lambert = Brdf::Lambert { albedo: 0.7 };
    let white = CubeLight::constant([1.0, 2.0, 0.5]).expect("a light");
    for order in [2, 3, 5] {
        let baseline = HarmonicTransfer::new(open.subject(&lambert), order);
        let light = baseline.light(white.texels());
        close(light[0][0], (4.0 * PI).sqrt(), 1e-9, "the first harmonic of a furnace");
        // Up to l = 3 the cube's symmetry makes the sums over its directions 0; beyond that, the rule's error is of the
        // order of the square of a fine texel's width, 1/64 of a face.
        let (symmetric, others) = light[1..].split_at(light.len().min(16) - 1);
        assert!(symmetric.iter().flatten().all(|value| value.abs() < 1e-9), "{light:?}");
        assert!(others.iter().flatten().all(|value| value.abs() < 1.0 / (64.0 * 64.0)), "{light:?}");
        let found = baseline.radiance(DVec3::new(0.3, -0.5, 0.9) * 4.0, &light)[0];
        for (found, radiance) in found.into_iter().zip([1.0, 2.0, 0.5]) {
            close(found, 0.7 * radiance, 2e-4, "an open vertex");
        }
    }
}

/// Higher orders are closer to the exact picture, but none is as close as the complete light at a fixed view. At a
/// fixed view, more kept coefficients are closer.
#[test]
fn more_is_nearer() {
    let lobe = Lobe::cook_torrance(0.4, 0.5);
    let clutter = Clutter::new(&clutter(3, 12, 0.9), BasisWidth::TwoTexels);
    let (subject, texels) = (clutter.subject(&lobe), light());
    let faces = HaarLight::new(&texels, Segmentation::Faces);
    let kept = [10, 40, 160, 6144].map(|keep| {
        let cut = faces.truncated(keep, TruncationPriority::Area);
        cut.light.radiances()
    });
    let lights: Vec<&[[f64; 3]]> = kept.iter().map(Vec::as_slice).chain([texels.texels()]).collect();
    let mut wavelets = FixedView(subject).radiance(EYE, &lights);
    let exact = wavelets.pop().expect("five lights");
    let all = squares(&exact, &vec![[0.0; 3]; exact.len()]);
    let errors: Vec<f64> = wavelets.iter().map(|found| squares(found, &exact) / all).collect();
    assert!(errors.windows(2).all(|two| two[1] < two[0]) && errors[3] < 1e-24, "{errors:?}");
    let orders = [2, 3, 5, 8].map(|order| {
        let baseline = HarmonicTransfer::new(subject, order);
        squares(&baseline.radiance(EYE, &baseline.light(texels.texels())), &exact) / all
    });
    assert!(orders.windows(2).all(|two| two[1] < two[0]), "{orders:?}");
    assert!(orders[2] > 1e-3, "order 5 has no room for a disk of two degrees: {orders:?}");
}
