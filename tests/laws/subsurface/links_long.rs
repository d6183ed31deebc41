//! Compares factors and links of texels that are long relative to the mean free path with integrals of equation 10
//! without subdivision.

use crate::environment::by_form;
use crate::support::{cuboid, plate};
use crossbar::geom::Mesh;
use crossbar::subsurface::links::{IrradianceMeans, LinkChoice, Links, MeanWeighting};
use crossbar::subsurface::multipole::{ClusterId, Factors};
use crossbar::subsurface::{Dipole, Reference};
use glam::DVec3;

use super::all_pairs::{apart, media, parallelogram, parallelograms};
use super::links_factors::mean_of_contours;
use super::links_models::{atlas, marble, root, surface};

const TOLERANCE: f64 = 0.01;

/// Two rectangles of the same length, with widths `width` and `other`, that meet along an edge at an angle; at 180
/// degrees they are coplanar.
fn folded([length, width, other]: [f32; 3], degrees: f32) -> Mesh {
    let [cosine, sine] = crossbar::elementary::on_circle(f64::from(degrees) / 360.0).map(|value| value as f32);
    let [y, z] = [-cosine * other, sine * other];
    let corners = [[0.0, -width, 0.0], [0.0, 0.0, 0.0], [0.0, y, z]];
    let positions = corners.iter().flat_map(|&[_, y, z]| [[0.0, y, z], [length, y, z]]).collect();
    Mesh::new(positions, vec![[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]]).expect("a mesh")
}

/// The allowed error of a factor.
fn allowed(dipole: &Dipole, exact: f64) -> f64 {
    TOLERANCE * (exact + 1e-5 * dipole.total())
}

/// Compares texels of one face with the integral over two numbers. A length is a texel's longer side in mean free
/// paths.
#[test]
fn long_texels_of_a_face_have_equation_10() {
    const SIDE: u32 = 8;
    let mut worst: f64 = 0.0;
    for aspect in [1.0, 2.0, 4.0, 9.0, 30.0] {
        let atlas = atlas(&plate(aspect, 1.0), SIDE);
        let (i, sides) = parallelogram(&atlas, &[0, 1, SIDE, SIDE + 1]);
        let longer = sides[0].length().max(sides[1].length());
        for dipole in media().into_iter().take(by_form(1, 3)) {
            for length in [3.0, 10.0, 30.0, 100.0, 1000.0] {
                let mm_per_unit = length * dipole.mean_free_path() / longer;
                let surface = surface(&atlas, mm_per_unit);
                let factors = Factors::new(&surface, [dipole], TOLERANCE).expect("a tolerance");
                let mut receiver = factors.receiver();
                for j in [i, i + 1, i + SIDE, i + SIDE + 1] {
                    let apart = apart(&atlas, sides, [i, j]);
                    let exact = parallelograms(&dipole, sides.map(|side| mm_per_unit * side), apart);
                    let [found] =
                        receiver.factor([i % SIDE, i / SIDE], ClusterId { level: 0, y: j / SIDE, x: j % SIDE });
                    let allowed = allowed(&dipole, exact);
                    assert!((found - exact).abs() <= allowed, "{aspect} : 1, {length}, {}: {found} for {exact}", j - i);
                    worst = worst.max((found - exact).abs() / allowed);
                }
            }
        }
    }
    assert!(worst > 1e-3, "{worst} leaves nothing to test");
}

/// Texels on both sides of an edge, with equal and different lengths, compared with exact integrals over one texel from
/// points of the other. A length is the edge's, in mean free paths.
#[test]
fn long_texels_across_an_edge_have_equation_10() {
    let folds = [(180.0, 1.0), (30.0, 1.0), (90.0, 2.0), (90.0, 9.0), (120.0, 4.0), (60.0, 30.0)];
    for (degrees, aspect) in folds.into_iter().step_by(by_form(3, 1)) {
        let atlas = atlas(&folded([1.0, 1.0 / aspect, 0.5 / aspect], degrees), 2);
        for dipole in media().into_iter().take(by_form(1, 3)) {
            for length in [3.0, 30.0, 10.0, 100.0, 1000.0].into_iter().take(by_form(2, 5)) {
                let mm_per_unit = length * dipole.mean_free_path();
                let surface = surface(&atlas, mm_per_unit);
                let factors = Factors::new(&surface, [dipole], TOLERANCE).expect("a tolerance");
                for (i, j) in (0..4).map(|j| (1, j)) {
                    let [found] = factors.factor([i % 2, i / 2], ClusterId { level: 0, y: j / 2, x: j % 2 });
                    let exact = mean_of_contours(&atlas, mm_per_unit, &dipole, [i, j], found + 1e-5 * dipole.total());
                    let allowed = allowed(&dipole, exact);
                    assert!(
                        (found - exact).abs() <= allowed,
                        "{degrees} degrees, {aspect} : 1, {length}, {i} to {j}: {found} for {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn models_of_long_texels_have_the_radiosity_of_all_pairs() {
    let adaptive = LinkChoice::Adaptive { count: 64 };
    let models = [
        ("300 x 40 mm", plate(300.0, 40.0), 16, adaptive),
        ("40 x 40 mm", plate(40.0, 40.0), 4, adaptive),
        ("700 x 2 mm", plate(700.0, 2.0), 16, adaptive),
        ("a cube of 300 mm", cuboid([0.0; 3], [300.0; 3]), 16, LinkChoice::Fixed { level: 2 }),
    ];
    // The 700 mm plate and the cube together take a minute.
    for (name, mesh, side, choice) in models.into_iter().take(by_form(2, 4)) {
        let atlas = atlas(&mesh, side);
        let surface = surface(&atlas, 1.0);
        let texels = (side * side) as usize;
        let links = Links::new(&surface, &[marble()], choice, TOLERANCE).expect("links");
        let ones = IrradianceMeans::new(&surface, &vec![[1.0; 3]; texels], MeanWeighting::Area).expect("one per texel");
        let reference = Reference::new(&atlas, 1.0, &marble()).expect("a scale");
        let rows = 0..by_form(2, side as usize);
        let exact = reference.radiosity(&vec![1.0; texels], rows, &mut |_, _| ()).expect("one per texel");
        for (texel, (found, exact)) in links.gather(&ones).iter().zip(&exact).enumerate() {
            let [found, ..] = found;
            assert!((found / exact - 1.0).abs() <= TOLERANCE, "{name}, texel {texel}: {found}, of all pairs {exact}");
        }
    }
}

/// Both sides of a thin sheet, far from its rim: a texel receives the plane's total from its own side, and from the
/// other side the part beyond a disc whose radius is the sheet's thickness.
#[test]
fn a_thin_sheet_has_light_from_both_sides() {
    for ([length, width], media) in [([1e5, 8e4], &media()[..]), ([300.0, 240.0], &media()[..1])] {
        for height in [0.1, 1.0] {
            let atlas = atlas(&cuboid([0.0; 3], [length, width, height]), 16);
            let surface = surface(&atlas, 1.0);
            let is_inside = |point: DVec3| {
                let from_rim = |at: f64, side: f32| at.min(f64::from(side) - at) / f64::from(side);
                from_rim(point.x, length).min(from_rim(point.y, width)) > 0.3
            };
            let inside = (0..256).filter(|&texel: &u32| is_inside(atlas.texels()[texel as usize].point));
            let inside: Vec<u32> = inside.step_by(by_form(7, 3)).collect();
            assert!(inside.len() > 1, "no texels");
            for dipole in media {
                let factors = Factors::new(&surface, [*dipole], TOLERANCE).expect("a tolerance");
                let mut receiver = factors.receiver();
                let exact = dipole.total() + dipole.beyond(f64::from(height));
                for texel in &inside {
                    let [found] = receiver.factor([texel % 16, texel / 16], root(&surface));
                    assert!(
                        (found / exact - 1.0).abs() <= TOLERANCE,
                        "{length}, {height}, {texel}: {found}, not {exact}"
                    );
                }
            }
        }
    }
}
