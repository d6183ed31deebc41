//! Photons followed through a medium, against what is exactly true of them: counts balance, mean paths depend on
//! volume and surface alone, half spaces have the albedo of Chandrasekhar's H function.

use crate::environment::by_form;
use approx::assert_relative_eq;
use crossbar::geom::{Hit, Mesh, Ray};
use crossbar::quadrature::SIXTEEN;
use crossbar::subsurface::fresnel::mean_transmittance;
use crossbar::subsurface::walk::{self, PhotonEntry, PhotonWalk, WalkTally};
use crossbar::subsurface::{Coefficients, Dipole};
use crossbar::tracer::{CastError, Caster};
use glam::DVec3;
use std::f64::consts::PI;

/// Fixed seeds give fixed verdicts; of what is true, one in 10^4 lies farther off than this many half widths.
const FAR: f64 = 2.3;

fn medium(sigma_s_prime: f64, sigma_a: f64, eta: f64, photons: u64) -> PhotonWalk {
    let full = by_form(1, 50);
    let walk = PhotonWalk::new(Coefficients { sigma_s_prime, sigma_a }, eta).unwrap();
    PhotonWalk { photons: photons * full, max_steps: 100_000, ..walk }
}

fn balanced(tally: &WalkTally, walk: &PhotonWalk) {
    assert_eq!(tally.entered(), walk.photons);
    assert_eq!(tally.left() + tally.absorbed() + tally.cut() + tally.lost(), walk.photons);
}

/// The mean path of light from everywhere in a body without absorption. Inside, radiance is eta^2 of that outside
/// whatever the scattering, so the path is 4 V / S times eta^2 over the mean transmittance.
fn mean_path(volume_by_surface: f64, eta: f64) -> f64 {
    4.0 * volume_by_surface * eta * eta / mean_transmittance(eta)
}

#[test]
fn without_absorption_all_photons_leave_a_sphere_after_the_mean_path() {
    for (sigma, eta, radius) in [(1.0, 1.3, 10.0), (0.1, 1.5, 3.0), (4.0, 1.0, 2.0)] {
        let walk = medium(sigma, 0.0, eta, 20_000);
        let tally = walk::sphere(&walk, radius, &[radius, 2.0 * radius]);
        balanced(&tally, &walk);
        assert_eq!((tally.left(), tally.cut(), tally.lost()), (walk.photons, 0, 0));
        assert_eq!((tally.total().mean, tally.total().half_width), (1.0, 0.0));
        let path = tally.mean_path();
        let exact = mean_path(radius / 3.0, eta);
        assert!(path.distance(exact) < FAR, "sigma {sigma}, eta {eta}: {path:?}, exactly {exact}");
    }
}

/// Chandrasekhar's H function of isotropic scattering at the sixteen points of [0, 1], and the albedo of a half space
/// for a beam at the cosine `mu`: `1 - H(mu) sqrt(1 - albedo)`.
fn half_space_albedo(albedo: f64, mu: f64) -> f64 {
    let root = (1.0 - albedo).sqrt();
    let next = |h: &[f64], mu: f64| {
        let sum: f64 = SIXTEEN.iter().zip(h).map(|(&(x, weight), h)| weight * x * h / (mu + x)).sum();
        1.0 / (root + 0.5 * albedo * sum)
    };
    let mut h = vec![1.0; SIXTEEN.len()];
    for _ in 0..400 {
        h = SIXTEEN.iter().zip(&h).map(|(&(x, _), &old)| 0.5 * (old + next(&h, x))).collect();
    }
    1.0 - root * next(&h, mu)
}

#[test]
fn half_spaces_without_a_boundary_have_chandrasekhars_albedo() {
    assert_relative_eq!(half_space_albedo(1.0, 0.5), 1.0);
    for (albedo, mu) in [(0.5, 1.0), (0.9, 0.3), (0.99, 0.8)] {
        let walk = PhotonWalk { entry: PhotonEntry::Beam(mu), ..medium(albedo, 1.0 - albedo, 1.0, 50_000) };
        let tally = walk::half_space(&walk, &[1.0, 10.0]);
        balanced(&tally, &walk);
        let (total, exact) = (tally.total(), half_space_albedo(albedo, mu));
        assert!(total.distance(exact) < FAR, "albedo {albedo}, cosine {mu}: {total:?}, exactly {exact}");
        let within = tally.fraction_below(1).mean + tally.fraction(1).mean;
        assert!(within <= total.mean && within > 0.5 * total.mean, "{within}");
    }
}

#[test]
fn the_step_limit_is_counted() {
    let walk = PhotonWalk { max_steps: 10, ..medium(1.0, 0.0, 1.3, 5_000) };
    let tally = walk::half_space(&walk, &[]);
    balanced(&tally, &walk);
    assert!(tally.cut() > 1000 && tally.absorbed() == 0, "{}", tally.cut());
}

#[test]
fn bits_do_not_depend_on_threads() {
    let walk = medium(2.21, 0.0012, 1.3, 3_000);
    let on = |threads| {
        let pool = rayon_pool(threads);
        pool.install(|| walk::half_space(&walk, &[1.0, 5.0]))
    };
    assert_eq!(on(1), on(3));
    assert_ne!(on(1), walk::half_space(&PhotonWalk { seed: 2, ..walk }, &[1.0, 5.0]));
}

fn rayon_pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

/// The dipole against the walk in a half space, as docs/papers/subsurface.md prints both: bounds of rings in mean free
/// paths, what leaves in them after a million photons of another seed, and the dipole's part.
#[test]
fn the_dipole_is_as_far_off_as_the_page_says() {
    let walk = PhotonWalk { seed: 7, ..medium(2.21, 0.0012, 1.3, 20_000) };
    let dipole = Dipole::new(walk.coefficients, walk.eta).unwrap();
    let printed = [
        (0.25, 0.0644, 0.0157),
        (1.0, 0.1373, 0.1424),
        (4.0, 0.3258, 0.3442),
        (16.0, 0.3043, 0.3099),
        (64.0, 0.0740, 0.0819),
    ];
    let radii = printed.map(|(paths, _, _)| paths * dipole.mean_free_path());
    let tally = walk::half_space(&walk, &radii);
    balanced(&tally, &walk);
    assert!(tally.total().distance(0.9085) < FAR, "{:?}", tally.total());
    let mut inner = 0.0;
    for (bin, (&(_, walked, ring), outer)) in printed.iter().zip(radii).enumerate() {
        assert!(tally.fraction(bin).distance(walked) < FAR, "ring {bin}: {:?}, printed {walked}", tally.fraction(bin));
        assert_eq!(format!("{:.4}", dipole.ring(inner, outer)), format!("{ring:.4}"));
        inner = outer;
    }
}

/// A box's faces, tested one by one in f64.
struct PlainCaster<'a>(&'a Mesh);

impl Caster for PlainCaster<'_> {
    fn cast(&mut self, rays: &[Ray]) -> Result<Vec<Option<Hit>>, CastError> {
        let corners: Vec<[DVec3; 3]> =
            self.0.iter_corners().map(|c| c.map(|v| DVec3::from(v.map(f64::from)))).collect();
        Ok(rays.iter().map(|ray| first(&corners, ray)).collect())
    }
}

fn first(corners: &[[DVec3; 3]], ray: &Ray) -> Option<Hit> {
    let [origin, direction] = [ray.origin(), ray.direction()].map(|v| DVec3::from(v.map(f64::from)));
    let hits = corners.iter().enumerate().filter_map(|(triangle, &[a, b, c])| {
        let normal = (b - a).cross(c - a);
        let facing = normal.dot(direction);
        let t = normal.dot(a - origin) / facing;
        let at = origin + t * direction;
        let side = |p: DVec3, q: DVec3| (q - p).cross(at - p).dot(normal) >= 0.0;
        let hit = facing > 0.0 && t >= 0.0 && side(a, b) && side(b, c) && side(c, a);
        hit.then_some(Hit { triangle: triangle as u32, t: t as f32 })
    });
    hits.min_by(|a, b| a.t.total_cmp(&b.t))
}

/// A box of these sides with the corner at the origin, faces counter-clockwise from outside.
pub(crate) fn cuboid([x, y, z]: [f32; 3]) -> Mesh {
    let corners = (0..8u8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { [x, y, z][axis] } else { 0.0 }));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh::new(corners.collect(), triangles.collect()).unwrap()
}

#[test]
fn light_from_everywhere_leaves_a_box_from_everywhere() {
    let mesh = cuboid([1.0, 2.0, 0.5]);
    let areas: Vec<f64> = (0..12).map(|face| mesh.area(face)).collect();
    let surface: f64 = areas.iter().sum();
    let walk = medium(0.8, 0.0, 1.3, 12_000);
    let mm_per_unit = 4.0;
    let tally = walk::mesh(&walk, &mesh, mm_per_unit, &areas, &mut PlainCaster(&mesh)).unwrap();
    balanced(&tally, &walk);
    assert_eq!((tally.absorbed(), tally.cut()), (0, 0));
    assert!(tally.lost() <= walk.photons / 1000, "{} of {}", tally.lost(), walk.photons);
    let exact = mean_path(mm_per_unit * 1.0 / surface, 1.3);
    assert!(tally.mean_path().distance(exact) < FAR, "{:?}, exactly {exact}", tally.mean_path());
    for (face, area) in areas.iter().enumerate() {
        let fraction = tally.fraction(face);
        assert!(fraction.distance(area / surface) < FAR, "face {face}: {fraction:?}, exactly {}", area / surface);
        let exitance = tally.exitance(face).mean;
        assert_relative_eq!(exitance * area * mm_per_unit * mm_per_unit, fraction.mean, max_relative = 1e-12);
    }
}

#[test]
fn light_through_one_face_leaves_there_most() {
    let mesh = cuboid([10.0, 10.0, 10.0]);
    let mut flux = vec![0.0; 12];
    flux[2] = 1.0;
    let walk = medium(1.0, 0.1, 1.3, 4_000);
    let tally = walk::mesh(&walk, &mesh, 10.0, &flux, &mut PlainCaster(&mesh)).unwrap();
    balanced(&tally, &walk);
    assert!(tally.absorbed() > 0);
    let there = tally.fraction(2).mean + tally.fraction(3).mean;
    let elsewhere = tally.total().mean - there;
    assert!(tally.fraction(2).mean > tally.fraction(3).mean && there > 4.0 * elsewhere, "{there} {elsewhere}");
    for (flux, scale) in [(vec![1.0; 11], 1.0), (vec![0.0; 12], 1.0), (vec![f64::NAN; 12], 1.0), (vec![1.0; 12], 0.0)] {
        walk::mesh(&walk, &mesh, scale, &flux, &mut PlainCaster(&mesh)).unwrap_err();
    }
    let open = Mesh::new(mesh.positions().to_vec(), mesh.triangles()[2..].to_vec()).unwrap();
    let areas: Vec<f64> = (0..10).map(|face| open.area(face)).collect();
    let tally = walk::mesh(&walk, &open, 1.0, &areas, &mut PlainCaster(&open)).unwrap();
    balanced(&tally, &walk);
    assert!(tally.lost() > 100, "an open mesh loses photons: {}", tally.lost());
}

#[test]
fn a_large_sphere_is_a_half_space() {
    let walk = medium(1.0, 0.05, 1.3, 20_000);
    let [flat, round] = [walk::half_space(&walk, &[2.0]), walk::sphere(&walk, 1000.0, &[2.0])];
    let gap = (flat.total().mean - round.total().mean).abs();
    assert!(gap < 2.0 * (flat.total().half_width + round.total().half_width), "{gap}");
    assert_relative_eq!(flat.exitance(0).mean, flat.fraction(0).mean / (4.0 * PI), max_relative = 1e-14);
}
