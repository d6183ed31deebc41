//! Height fields, their bidirectional textures, and pixels shaded with them.

use std::f64::consts::TAU;
use std::path::Path;

use crate::support::in_threads;
use approx::assert_relative_eq;
use crossbar::bi_scale::directions::{LocalDirections, hemisphere};
use crossbar::bi_scale::texture::{
    BidirectionalTexture, HeightField, MesoMaterial, MesoPatch, MesoTexel, PatchKind, load_bidirectional_texture,
    write_bidirectional_texture,
};
use crossbar::elementary::on_circle;
use crossbar::transfer::brdf::Brdf;
use glam::DVec3;
use proptest::prelude::*;

fn directions(side: usize) -> LocalDirections {
    LocalDirections::new(side).expect("directions")
}

/// Any direction above the horizon, including almost grazing ones.
fn direction() -> impl Strategy<Value = DVec3> {
    let at = || prop_oneof![6 => -1.0..1.0_f64, 1 => Just(0.0), 1 => Just(-0.999), 1 => Just(0.9)];
    [at(), at()].prop_map(hemisphere)
}

/// Texture positions, including the centers and borders of texels.
fn place() -> impl Strategy<Value = [f64; 2]> {
    let at = || prop_oneof![3 => -1.0..2.0_f64, 1 => (0..32_u8).prop_map(|at| f64::from(at) / 16.0)];
    [at(), at()]
}

/// Height fields of a few texels: arbitrary heights, steps, or almost flat.
fn heights() -> impl Strategy<Value = HeightField> {
    (1..9_usize, 0.001..0.5_f64).prop_flat_map(|(side, relief)| {
        let height = prop_oneof![3 => 0.0..1.0_f64, 1 => Just(0.0), 1 => Just(1.0)];
        prop::collection::vec(height, side * side).prop_map(move |heights| {
            let heights: Vec<f64> = heights.iter().map(|height| relief * height).collect();
            HeightField::new(side, &heights).expect("heights")
        })
    })
}

fn glossy() -> MesoMaterial {
    let lobe = Brdf::Ward { albedo: 0.0, specular: 0.3, roughness: [0.2, 0.5] };
    MesoMaterial { color: [0.3, 0.4, 0.1], lobe: Some(lobe), lobe_color: [1.0, 0.8, 0.5] }
}

fn patch(heights: HeightField, material: MesoMaterial) -> MesoPatch {
    let texels = (0..heights.heights().len()).map(|at| MesoTexel { material: 0, turns: at as f64 / 7.0 });
    let texels = texels.collect();
    MesoPatch::new(heights, vec![material], texels).expect("a patch")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// The visible point lies on the line of sight and on the surface, and no part of the surface is in front of it.
    #[test]
    fn what_is_seen_lies_behind_its_place(heights in heights(), place in place(), view in direction()) {
        prop_assume!(view.z > 0.01);
        let patch = patch(heights, glossy());
        let point = patch.seen(place, view).point(&patch);
        let from = DVec3::new(place[0] - place[0].floor(), place[1] - place[1].floor(), 0.0);
        let along = (from - point).dot(view);
        prop_assert!((from - point - along * view).length() < 1e-9, "{point} from {from}");
        prop_assert!((patch.heights().height([point.x, point.y]) - point.z).abs() < 1e-9);
        for step in 1..500 {
            let above = point + along * f64::from(step) / 500.0 * view;
            let height = patch.heights().height([above.x, above.y]);
            prop_assert!(height <= above.z + 1e-9, "{height} at {above}, in front of {point}");
        }
    }

    /// Shadows compared with points along the light's ray: if a point is below the surface, the texel is dark; if the
    /// texel is dark, a point is below the surface or almost below it.
    #[test]
    fn shadows_are_where_the_surface_is_in_the_way(
        heights in heights(), place in place(), view in direction(), light in direction(),
    ) {
        prop_assume!(view.z > 0.05 && light.z > 0.05);
        let patch = patch(heights, MesoMaterial::diffuse([1.0; 3]));
        let seen = patch.seen(place, view);
        let point = seen.point(&patch);
        // On lines between cells, each side has a different normal.
        let side = patch.heights().side() as f64;
        let is_between = [point.x, point.y].map(|at| ((at * side - 0.5) - (at * side - 0.5).round()).abs()).iter().all(|at| *at > 1e-6);
        prop_assume!(is_between);
        let cosine = patch.heights().normal([point.x, point.y]).dot(light);
        prop_assume!(cosine > 1e-6);
        let is_dark = patch.reflected(&seen, light) == [0.0; 3];
        let length = -point.z / light.z;
        let depth = (1..20_000).map(|step| {
            let at = point + length * f64::from(step) / 20_000.0 * light;
            patch.heights().height([at.x, at.y]) - at.z
        });
        let depth = depth.fold(f64::NEG_INFINITY, f64::max);
        // Between two of the points the surface rises by at most its steepest slope times their distance.
        let steepest = 2.0 * 8.0 * 0.5 * (length / 20_000.0);
        prop_assert!(if depth > 1e-9 { is_dark } else { !is_dark || depth > -steepest }, "{depth}, {is_dark}");
    }

    /// Any view and light, also grazing ones whose rays end at their reach, get finite responses of 0 or more.
    #[test]
    fn responses_are_finite(heights in heights(), place in place(), view in direction(), light in direction()) {
        let response = patch(heights, glossy()).response(place, view, light);
        prop_assert!(response.iter().all(|value| value.is_finite() && *value >= 0.0), "{response:?}");
    }

    #[test]
    fn patches_repeat(heights in heights(), view in direction(), light in direction(), u in 0..64_u8, v in 0..64_u8) {
        let patch = patch(heights, glossy());
        let place = [u, v].map(|at| f64::from(at) / 64.0);
        let expected = patch.response(place, view, light);
        for [right, down] in [[1.0, 0.0], [0.0, -1.0], [-3.0, 5.0]] {
            prop_assert_eq!(patch.response([place[0] + right, place[1] + down], view, light), expected);
        }
    }

    /// A flat patch responds with its BRDF times the cosine, whatever the number of heights, and the BRDF is
    /// reciprocal.
    #[test]
    fn flat_patches_are_their_material(
        place in place(), view in direction(), light in direction(), turns in 0.0..1.0_f64, side in 1..5_usize,
    ) {
        prop_assume!(view.z > 1e-6 && light.z > 1e-6);
        let heights = HeightField::new(side, &vec![0.25; side * side]).expect("heights");
        let texels = vec![MesoTexel { material: 0, turns }; side * side];
        let patch = MesoPatch::new(heights, vec![glossy()], texels).expect("a patch");
        let expected = patch.response(place, view, light);
        let [cosine, sine] = on_circle(turns);
        let local = |v: DVec3| DVec3::new(cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z);
        for (found, brdf) in expected.into_iter().zip(glossy().value(local(view), local(light))) {
            assert_relative_eq!(found, brdf * light.z, max_relative = 1e-9);
        }
        let back = patch.response(place, light, view);
        for (one, other) in expected.into_iter().zip(back) {
            assert_relative_eq!(one / light.z, other / view.z, max_relative = 1e-9);
        }
    }
}

/// A square pit twice as wide as deep, viewed at 45 degrees through its middle: the line of sight meets the foot of the
/// wall.
#[test]
fn parallax_moves_points_by_their_depth() {
    let side = 64;
    let is_deep = |at: usize| (16..48).contains(&(at % side)) && (16..48).contains(&(at / side));
    let heights: Vec<f64> = (0..side * side).map(|at| if is_deep(at) { -0.125 } else { 0.0 }).collect();
    let patch = patch(HeightField::new(side, &heights).expect("heights"), MesoMaterial::diffuse([0.5; 3]));
    let view = DVec3::new(0.6, 0.0, 0.8);
    let point = patch.seen([0.5, 0.5], view).point(&patch);
    assert_relative_eq!(point.x, 0.5 - 0.125 * 0.75, max_relative = 1e-12);
    assert_eq!((point.y, point.z), (0.5, -0.125));
    // Light along the view reaches that point; low light from the far side does not.
    assert!(patch.response([0.5, 0.5], view, view)[0] > 0.0);
    assert_eq!(patch.response([0.5, 0.5], view, DVec3::new(-0.96, 0.0, 0.28)), [0.0; 3]);
}

/// Shadows only remove light: no point of a white patch reflects more than it receives, up to the error of 32 x 32
/// directions for a tilted cosine; a rough surface reflects less.
#[test]
fn relief_makes_no_light() {
    let light = directions(32);
    let solid_angle = TAU / light.directions().len() as f64;
    for kind in PatchKind::ALL {
        let heights = kind.patch(1.0).heights().clone();
        let texels = vec![MesoTexel::default(); heights.heights().len()];
        let patch = MesoPatch::new(heights, vec![MesoMaterial::diffuse([1.0; 3])], texels).expect("a patch");
        let mut least = 1.0_f64;
        for at in 0..100 {
            let place = [f64::from(at % 10) / 10.0, f64::from(at / 10) / 10.0];
            let sum: f64 = light.directions().iter().map(|&light| patch.response(place, DVec3::Z, light)[0]).sum();
            assert!(sum * solid_angle <= 1.01, "{kind} at {place:?}: {}", sum * solid_angle);
            least = least.min(sum * solid_angle);
        }
        assert!(least < 0.9, "{kind}: {least}");
    }
}

/// Samples are the patch's response at the centers of texels, for the view and light of their indices, with any number
/// of threads.
#[test]
fn textures_hold_the_response() {
    let patch = PatchKind::Mail.patch(1.0);
    let (view, light) = (directions(3), directions(4));
    let made = |threads| in_threads(threads, || patch.texture(8, &view, &light, &mut |_, _| ()).expect("a texture"));
    let texture = made(1);
    assert_eq!(texture, made(3));
    for (number, texel) in [(0, 0), (4, 13), (8, 63)] {
        for (d, &toward) in light.directions().iter().enumerate() {
            let place = [texel % 8, texel / 8].map(|at| (at as f64 + 0.5) / 8.0);
            let expected = patch.response(place, view.directions()[number], toward).map(|value| value as f32);
            assert_eq!(texture.patch(number, d)[texel], expected);
        }
    }
}

#[test]
fn files_of_textures() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let path = folder.path().join("b.npy");
    let load = || load_bidirectional_texture(&path);
    let samples: Vec<[f32; 3]> = (0..4 * 9 * 4).map(|at| [at as f32, 0.5, 0.25]).collect();
    let texture = BidirectionalTexture::new(2, directions(2), directions(3), samples.clone()).expect("a texture");
    let mut bytes = Vec::new();
    write_bidirectional_texture(&texture, &mut bytes).expect("written");
    std::fs::write(&path, &bytes).expect("written");
    assert_eq!(load().expect("a texture"), texture);
    let is_refused = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("written");
        load().is_err()
    };
    let flat = samples.as_flattened();
    let [mut nan, mut below] = [flat.to_vec(), flat.to_vec()];
    (nan[4 * 3 + 1], below[4 * 3 + 1]) = (f32::NAN, -0.5);
    for (shape, values) in [
        (&[3, 9, 2, 2, 3][..], &flat[..3 * 9 * 4 * 3]),
        (&[4, 8, 2, 2, 3], &flat[..4 * 8 * 4 * 3]),
        (&[4, 9, 2, 2, 3, 1], flat),
        (&[4, 9, 2, 6], flat),
        (&[4, 9, 1, 4, 3], flat),
        (&[4, 9, 2, 2, 3], &nan),
        (&[4, 9, 2, 2, 3], &below),
    ] {
        let mut bytes = Vec::new();
        crossbar::io::write_npy_array(shape, values, &mut bytes).expect("written");
        assert!(is_refused(&bytes), "{shape:?}");
    }
    for end in [0, 7, 100, bytes.len() - 1] {
        assert!(is_refused(&bytes[..end]), "{end} bytes");
    }
    assert!(load_bidirectional_texture(Path::new("nowhere.npy")).is_err());
}
