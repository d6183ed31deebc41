//! Unit tests of subsurface scattering: the dipole and its sums, moments and tables of the factors, programs,
//! irradiance.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use crossbar_base::elementary::exp;
use crossbar_base::geom::{Mesh, Sides};
use crossbar_ground::atlas::Atlas;
use crossbar_ground::card::checked;
use crossbar_ground::tracer::HostTracer;
use crossbar_systems::subsurface::kernels::{
    GatherKernel, LinkLayout, MapTexture, TEXEL_LIGHTS, VERTEX_LIGHTS, VIEW_LIGHTS, programs,
};
use crossbar_systems::subsurface::materials::{MATERIALS, named};
use crossbar_systems::subsurface::multipole::{ClusterId, Factors, SurfaceMoments};
use crossbar_systems::subsurface::{
    Coefficients, Dipole, DistantSource, Material, Reference, distant_irradiance, exp_of_negative,
    fresnel_transmittance,
};
use glam::DVec3;
use refsim::device::Profile;
use refsim::isa::Version;

fn medium(sigma_s_prime: f64, sigma_a: f64) -> Dipole {
    Dipole::new(Coefficients { sigma_s_prime, sigma_a }, 1.3).expect("a medium")
}

fn figure_7() -> Dipole {
    medium(2.21, 0.0012)
}

#[test]
fn narrow_rings_and_far_ones_keep_their_digits() {
    let dipole = figure_7();
    for r in [0.0, 0.3, 5.0, 40.0] {
        let width = 1e-9;
        let ring = dipole.ring(r, r + width);
        let expected = PI * width * (2.0 * r + width) * dipole.r_d(r + 0.5 * width);
        assert_relative_eq!(ring, expected, max_relative = if r == 0.0 { 1e-9 } else { 1e-7 });
    }
    assert_relative_eq!(dipole.disc(3.0) + dipole.beyond(3.0), dipole.total(), max_relative = 1e-14);
    assert_eq!(dipole.disc(f64::INFINITY), dipole.beyond(0.0));
    assert_eq!([dipole.disc(0.0), dipole.r_d(f64::INFINITY), dipole.beyond(f64::INFINITY)], [0.0; 3]);
}

#[test]
fn extreme_figures_stay_finite() {
    for sigma_s_prime in [1e-30, 1e-10, 1.0, 1e30] {
        for sigma_a in [0.0, 1e-300, 1e-30, 1.0, 1e30] {
            let dipole = medium(sigma_s_prime, sigma_a);
            for r in [0.0, 1e-200, 1e-20, 1.0, 1e20, 1e200, f64::MAX] {
                let all = [dipole.r_d(r), dipole.disc(r), dipole.beyond(r), dipole.total()];
                assert!(all.iter().all(|value| value.is_finite() && *value >= 0.0), "{dipole:?} {r}: {all:?}");
            }
        }
    }
}

#[test]
fn the_exponential_of_sums_is_right() {
    for k in 0..200_000 {
        let x = f64::from(k) * 0.0035;
        assert_relative_eq!(exp_of_negative(x), exp(-x), max_relative = 9e-16);
    }
    assert_eq!([exp_of_negative(0.0), exp_of_negative(1e300)], [1.0, exp_of_negative(700.0)]);
}

/// Atlas of triangles of this size perpendicular to the x axis, one at each x in `places`.
fn dots(places: impl IntoIterator<Item = f32>, size: f32, side: u32) -> Atlas {
    let corners = |x: f32| [[x, 0.0, 0.0], [x, size, 0.0], [x, 0.0, size]];
    let positions: Vec<[f32; 3]> = places.into_iter().flat_map(corners).collect();
    let triangles = (0..positions.len() as u32 / 3).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
    Atlas::new(&Mesh::new(positions, triangles).expect("a mesh"), side).expect("an atlas")
}

#[test]
fn far_pairs_of_the_reference_have_the_dipole_s_r_d() {
    let places = [0.0, 1e-3, 0.5, 3.0, 40.0, 1000.0];
    let atlas = dots(places, 1e-8, 4);
    let dipole = figure_7();
    let reference = Reference::new(&atlas, 1.0, &dipole).expect("a scale");
    let texels = atlas.texels();
    let here = texels.iter().position(|texel| texel.face == 0).expect("a texel of the first face");
    for (other, texel) in texels.iter().enumerate() {
        let r = f64::from(places[texel.face as usize]);
        assert_relative_eq!(reference.factor(here, other) / texel.area, dipole.r_d(r), max_relative = 1e-13);
    }
    let light: Vec<f64> = (1..=texels.len()).map(|k| k as f64).collect();
    let direct: f64 = light.iter().enumerate().map(|(other, light)| reference.factor(here, other) * light).sum();
    let sum = reference.radiosity(&light, 0..4, &mut |_, _| {}).expect("an irradiance per texel")[here];
    assert_relative_eq!(sum, direct, max_relative = 1e-15);
}

/// The rule of near pairs is exact for quadratic functions: its error for R_d falls with the fourth power of the
/// texels' size, and larger texels are divided until their parts are no longer than a mean free path. The comparison
/// uses means over midpoints of 8 x 8 and 16 x 16 parts of both texels, extrapolated to remove the error of second
/// order.
#[test]
fn near_pairs_of_the_reference_are_exact_to_second_order() {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let atlas = Atlas::new(&Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh"), 16).expect("an atlas");
    let dipole = medium(2.62, 0.0041);
    let mut worst = Vec::new();
    for texel_mm in [0.01, 0.02, 0.2, 0.4, 0.7, 1.0] {
        let mm_per_unit = 16.0 * texel_mm;
        let reference = Reference::new(&atlas, mm_per_unit, &dipole).expect("a scale");
        let mean = |i: u32, j: u32, parts: u32| {
            let there: Vec<DVec3> = atlas.points(j, parts).collect();
            let r_d = |from: DVec3| there.iter().map(|to| dipole.r_d(mm_per_unit * from.distance(*to))).sum::<f64>();
            atlas.points(i, parts).map(r_d).sum::<f64>() / f64::from(parts.pow(4))
        };
        let mut off = 0.0_f64;
        for i in [0, 5, 37, 100, 119, 136] {
            for j in [i, i + 1, i + 3, i + 17, i + 48] {
                let exact = (4.0 * mean(i, j, 16) - mean(i, j, 8)) / 3.0;
                let area = mm_per_unit * mm_per_unit * atlas.texels()[j as usize].area;
                off = off.max((reference.factor(i as usize, j as usize) / area / exact - 1.0).abs());
            }
        }
        worst.push(off);
    }
    // Measured: 1.2e-7, 1.8e-6, 5.4e-4, 5.9e-4, 1.1e-3, 1.7e-3.
    let allowed = [2e-7, 2e-6, 6e-4, 7e-4, 1.2e-3, 1.8e-3];
    assert!(worst.iter().zip(allowed).all(|(off, allowed)| *off < allowed), "{worst:?}");
    assert!(worst[1] < 17.0 * worst[0], "the fourth power: {worst:?}");
}

/// If texels are far smaller than their distance, their factors are the tabulated R_d. Within 25 diffusion lengths the
/// table is never above R_d, and below it by a relative error of at most 1e-6; the largest error exceeds 1e-9.
#[test]
fn the_table_keeps_its_bound_and_is_never_above_r_d() {
    let (count, side) = (2000_u16, 64);
    let place = |k: u16| {
        let t = f32::from(k) / f32::from(count);
        300.0 * (t * t * t)
    };
    let atlas = dots((0..count).map(place), 1e-8, side);
    let surface = SurfaceMoments::new(&atlas, 1.0).expect("a scale");
    let texel_of = |face: u16| atlas.texels().iter().position(|texel| texel.face == u32::from(face)).expect("a texel");
    for dipole in [figure_7(), medium(0.68, 0.9), medium(1.0, 0.0), medium(40.0, 7.0)] {
        let factors = Factors::new(&surface, [dipole], 0.01).expect("a tolerance");
        let (mut receiver, mut worst) = (factors.receiver(), 0.0_f64);
        for here in (0..10).map(|k| 7 * k * k) {
            let [y, x] = [texel_of(here) as u32 / side, texel_of(here) as u32 % side];
            for (other, texel) in (0..).zip(atlas.texels()) {
                let there = ClusterId { level: 0, y: other / side, x: other % side };
                let r = surface.moments(there).0.distance(surface.moments(ClusterId { level: 0, y, x }).0);
                if dipole.sigma_tr() * r > 25.0 || r < 1e-3 {
                    continue;
                }
                let [factor] = receiver.factor([x, y], there);
                let (found, exact) = (factor / texel.area, dipole.r_d(r));
                let error = (found - exact) / exact;
                assert!((-1e-12..=1e-6 + 1e-12).contains(&-error), "at {r}: {error}");
                worst = worst.max(-error);
            }
        }
        assert!(worst > 1e-9, "the bound is far from {worst}");
    }
}

#[test]
fn extreme_media_have_factors() {
    let atlas = dots([0.0, 1e-20, 1.0, 2.0], 1e-8, 4);
    let surface = SurfaceMoments::new(&atlas, 1e20).expect("a scale");
    for (s, a) in [(1e-30, 0.0), (1e-30, 1e30), (1e30, 0.0), (1e30, 1e30), (1.0, 1e-300)] {
        let factors = Factors::new(&surface, [medium(s, a)], 0.01).expect("a tolerance");
        for (k, j) in (0..16).flat_map(|k| (0..16).map(move |j| (k, j))) {
            let [value] = factors.factor([k % 4, k / 4], ClusterId { level: 0, y: j / 4, x: j % 4 });
            assert!(value.is_finite(), "{s} {a} {k} {j}: {value}");
        }
    }
}

/// Area, mean point and second moments about it of some triangles.
fn moments(triangles: &[[DVec3; 3]]) -> (f64, DVec3, [f64; 6]) {
    let area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length() / 2.0;
    let all: f64 = triangles.iter().map(|&triangle| area(triangle)).sum();
    let mean: DVec3 = triangles.iter().map(|&t| area(t) / all / 3.0 * t.iter().sum::<DVec3>()).sum();
    let mut second = [0.0; 6];
    for triangle in triangles {
        let about = triangle.map(|corner| corner - mean);
        for v in about.into_iter().chain([about.iter().sum()]) {
            let products = [v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z];
            let weight = area(*triangle) / all / 12.0;
            second.iter_mut().zip(products).for_each(|(sum, product)| *sum += weight * product);
        }
    }
    (all, mean, second)
}

/// For every cluster of an atlas: moments equal the moments of the polygons under its texels, and a ball of 5 times its
/// squared size contains all corners. Faces have rectangles of many shapes, whose diagonal texels have parts on both
/// sides of the diagonal.
#[test]
fn moments_of_clusters_are_those_of_the_triangles_under_them() {
    let corners = vec![[0.0, 0.0, 0.0], [4.0, 1.0, 0.0], [2.0, 5.0, 3.0], [-1.0, 2.0, 4.0], [0.5, -3.0, 0.25]];
    let faces = vec![[0, 1, 2], [0, 2, 3], [0, 4, 1], [4, 3, 2], [1, 4, 2]];
    let mesh = Mesh::new(corners, faces).expect("a mesh");
    for (side, mm_per_unit) in [(4, 1.0), (32, 2.5), (512, 1.0)] {
        let atlas = Atlas::new(&mesh, side).expect("an atlas");
        let surface = SurfaceMoments::new(&atlas, mm_per_unit).expect("a scale");
        let under = |texel: u32| -> Vec<[DVec3; 3]> {
            let part = atlas.part(texel);
            let fan = |ring: &[DVec3]| (2..ring.len()).map(|k| [ring[0], ring[k - 1], ring[k]]).collect::<Vec<_>>();
            part.polygons().flat_map(fan).map(|t| t.map(|corner| mm_per_unit * corner)).collect()
        };
        for level in 0..surface.level_count() {
            let width = side >> level;
            // Of the largest atlas, only some clusters are tested: Morton order has a bit for each level.
            for place in (0..width * width).step_by(if side > 32 { 4099 } else { 1 }) {
                let (y, x) = (place / width, place % width);
                let rows = (y << level)..((y + 1) << level);
                let texels = rows.flat_map(|row| ((x << level)..((x + 1) << level)).map(move |at| row * side + at));
                let triangles: Vec<[DVec3; 3]> = texels.flat_map(under).collect();
                let (area, mean, second) = moments(&triangles);
                let cluster = ClusterId { level, y, x };
                let (point, covariance, size_squared) = surface.moments(cluster);
                assert_relative_eq!(surface.cluster_area(cluster), area, max_relative = 1e-11);
                let scale = mm_per_unit * 5.0;
                // Plain sums of many triangles lose at most one rounding error per term.
                let rounding = 1e-12_f64.max(triangles.len() as f64 * f64::EPSILON);
                assert!(point.abs_diff_eq(mean, rounding * scale), "{cluster:?}: {point}, expected {mean}");
                for (found, expected) in covariance.into_iter().zip(second) {
                    assert!((found - expected).abs() < rounding * scale * scale, "{cluster:?}: {found} for {expected}");
                }
                let corners = triangles.iter().flatten().map(|corner| corner.distance_squared(point));
                let (farthest, spread) = (corners.fold(0.0, f64::max), second[0] + second[1] + second[2]);
                if level == 0 {
                    assert_relative_eq!(size_squared, spread.max(farthest / 5.0), max_relative = 1e-9);
                }
                assert!(size_squared >= spread.max(farthest / 5.0) * (1.0 - 1e-9), "{cluster:?}: {size_squared}");
            }
        }
    }
}

#[test]
fn every_program_runs_on_every_geforce_fx() {
    let names = Profile::card_names().into_iter().chain(Profile::variant_names());
    let profiles = names.map(|name| Profile::named(name).expect("a device"));
    let cards: Vec<Profile> = profiles.filter(|p| p.limits.versions.contains(&Version::Fp1_0)).collect();
    assert!(cards.len() >= 4, "two cards and their variants");
    for profile in cards {
        for (name, text) in programs() {
            checked(&profile, name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        }
    }
}

#[test]
fn a_file_is_the_program_for_one_light() {
    for kernel in [VERTEX_LIGHTS, TEXEL_LIGHTS[0], TEXEL_LIGHTS[1], VIEW_LIGHTS] {
        assert_eq!(kernel.text(1), kernel.kernel.text);
        let two = kernel.text(2);
        let last = kernel.first + 2 * kernel.step - 1;
        assert!(two.contains(&format!("{}{last}", kernel.prefix)), "{two}");
    }
}

/// Four links share a texture of factors, so a link takes 1.25 lookups. An adaptive link takes two.
#[test]
fn sixteen_links_fit_as_the_paper_has_them() {
    let nv35 = Profile::named("nv35").expect("a card");
    let kernel = |layout, map, rgb| GatherKernel { layout, rgb, map, half: false, continues: false, tiles: 1 };
    let fixed = kernel(LinkLayout::Fixed, MapTexture::Leveled, false);
    assert_eq!((fixed.instructions(16), fixed.samplers(16)), (37, 5));
    let rgb = kernel(LinkLayout::Fixed, MapTexture::Leveled, true);
    assert_eq!((rgb.instructions(16), rgb.samplers(16)), (53, 13));
    let adaptive = kernel(LinkLayout::Adaptive, MapTexture::Leveled, false);
    assert_eq!((adaptive.instructions(16), adaptive.samplers(16)), (49, 17));
    assert!(adaptive.checked(&nv35, 15).is_ok());
    let refused = adaptive.checked(&nv35, 16).expect_err("17 samplers").to_string();
    assert!(refused.contains("TEX16"), "{refused}");
    // Sixteen textures as tiles of one texture take one pass, and an addition for each but the first.
    let tiled = GatherKernel { tiles: 4, ..adaptive };
    assert_eq!((tiled.instructions(16), tiled.samplers(16), tiled.constants(16)), (49 + 15, 2, 1 + 15));
    assert!(tiled.checked(&nv35, 16).is_ok());
    for kernel in GatherKernel::all() {
        let most = (1..=64).rev().find(|&n| kernel.samplers(n) <= 16 && kernel.constants(n) <= 64).expect("one");
        let program = kernel.checked(&nv35, most).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(program.instructions.len(), kernel.instructions(most), "{}", kernel.name());
    }
}

#[test]
fn the_most_lights_are_what_the_card_takes() {
    let nv35 = Profile::named("nv35").expect("a card");
    for (kernel, instructions, constants) in
        [(VERTEX_LIGHTS, 256, 256), (VIEW_LIGHTS, 256, 256), (TEXEL_LIGHTS[0], 1024, 64), (TEXEL_LIGHTS[1], 1024, 64)]
    {
        let most = kernel.most_lights(instructions, constants);
        kernel.checked(&nv35, most).unwrap_or_else(|e| panic!("{e}"));
        assert!(kernel.checked(&nv35, most + 1).is_err(), "{}: {most} is not the most", kernel.kernel.name);
    }
}

/// A lid over half of a floor shadows that half and no other part.
#[test]
fn distant_light_has_shadows() {
    let square = |z: f32, x: [f32; 2]| [[x[0], -1.0, z], [x[1], -1.0, z], [x[1], 1.0, z], [x[0], 1.0, z]];
    let corners = [square(0.0, [-1.0, 1.0]), square(0.5, [0.01, 1.0])].concat();
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]).expect("a mesh");
    let atlas = Atlas::new(&mesh, 16).expect("an atlas");
    let source = DistantSource { towards: DVec3::Z, irradiance: [1.0, 2.0, 0.0] };
    let mut caster = HostTracer::new(&mesh, Sides::Both);
    let found = distant_irradiance(&atlas, &[source], 1.3, &mut caster).expect("traced");
    let full = fresnel_transmittance(1.3, 1.0);
    for (at, (texel, found)) in atlas.texels().iter().zip(&found).enumerate() {
        let weights = atlas.places()[texel.face as usize].weights((at % 16) as f64 + 0.5, (at / 16) as f64 + 0.5);
        let middle = DVec3::from(weights).dot(DVec3::from(atlas.corners(texel.face).map(|corner| corner.x)));
        let share = if texel.face < 2 && middle > 0.01 { 0.0 } else { full };
        let expected = DVec3::new(share, 2.0 * share, 0.0);
        assert!((DVec3::from(*found) - expected).length() < 1e-12, "{found:?}, expected {expected} at {texel:?}");
    }
    let from_below = DistantSource { towards: DVec3::NEG_Z, ..source };
    let dark = distant_irradiance(&atlas, &[from_below], 1.3, &mut caster).expect("traced");
    assert!(dark.iter().flatten().all(|&value| value == 0.0));
}

#[test]
fn all_published_materials_are_media_and_names_are_unique() {
    for (i, material) in MATERIALS.iter().enumerate() {
        let checked = Material::new(material.name, material.material().channels, material.eta.value);
        assert_eq!(checked, Ok(material.material()));
        assert_eq!(named(&material.name.to_uppercase()), Some(&MATERIALS[i]));
    }
    assert_eq!(named("Butter"), None);
}
