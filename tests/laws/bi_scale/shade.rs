//! Pixels shaded by equation 3.

use approx::assert_relative_eq;
use crossbar::bi_scale::directions::{LocalDirections, hemisphere};
use crossbar::bi_scale::paper;
use crossbar::bi_scale::product::by_rows;
use crossbar::bi_scale::shade::{
    ShadedPixel, TextureLookup, TracedLight, TracedPoint, TracedRung, TracedScene, pixel_frame,
};
use crossbar::bi_scale::texture::{BidirectionalTexture, MesoMaterial, MesoPatch, PatchKind};
use crossbar::bi_scale::transfer::{light_vector, transfer_matrix};
use crossbar::geom::{Mesh, Sides};
use crossbar::tracer::HostTracer;
use crossbar::transfer::grid::{FINE_DIRECTIONS, LIGHT_TEXELS};
use crossbar::transfer::synthetic::hills;
use crossbar::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crossbar::transfer::{Tangents, Vertices};
use glam::DVec3;
use proptest::prelude::*;

const VERTICES: u32 = 5;

/// Numbers of views, lights and texels along an edge.
fn sizes() -> impl Strategy<Value = [usize; 3]> {
    [1..4_usize, 1..4_usize, 1..5_usize]
}

fn texture([view, light, size]: [usize; 3], values: &[f32]) -> BidirectionalTexture {
    let [view, light] = [view, light].map(|side| LocalDirections::new(side).expect("directions"));
    let count = view.directions().len() * light.directions().len() * size * size;
    let samples = (0..count).map(|at| [0, 1, 2].map(|channel| values[(3 * at + channel) % values.len()]));
    BidirectionalTexture::new(size, view, light, samples.collect()).expect("a texture")
}

fn pixel() -> impl Strategy<Value = ShadedPixel> {
    let place = [-3.0..3.0_f64, -3.0..3.0_f64];
    let view = [-1.0..1.0_f64, -1.0..1.0_f64];
    let corners = [0..VERTICES, 0..VERTICES, 0..VERTICES];
    (corners, 0.0..1.0_f64, 0.0..1.0_f64, place, view, any::<bool>()).prop_map(|(corners, a, b, place, view, below)| {
        let mut view = hemisphere(view);
        if below {
            view.z = -view.z;
        }
        ShadedPixel { corners, weights: [a, (1.0 - a) * b, (1.0 - a) * (1.0 - b)], place, view }
    })
}

proptest! {
    #[test]
    fn the_fast_lookup_gives_the_bits_of_the_reference(
        sizes in sizes(),
        values in prop::collection::vec(0.0..4.0_f32, 97),
        light in prop::collection::vec(0.0..9.0_f64, 3 * 9 * VERTICES as usize),
        pixel in pixel(),
    ) {
        let texture = texture(sizes, &values);
        let lights = sizes[1] * sizes[1];
        let local = &light.as_chunks().0[..lights * VERTICES as usize];
        let found = TextureLookup::new(&texture).radiance(local, &pixel, &mut Vec::new());
        prop_assert_eq!(found, paper::radiance(&texture, local, &pixel));
        // Radiance is linear in the light: doubling the light doubles it exactly.
        let twice: Vec<[f64; 3]> = local.iter().map(|rgb| rgb.map(|value| 2.0 * value)).collect();
        prop_assert_eq!(paper::radiance(&texture, &twice, &pixel), found.map(|value| 2.0 * value));
    }

    /// A constant texture yields its value times the pixel's light, for any position and view.
    #[test]
    fn weights_sum_to_one(sizes in sizes(), pixel in pixel(), value in 0.1..3.0_f32) {
        let texture = texture(sizes, &[value]);
        let lights = sizes[1] * sizes[1];
        let local = vec![[0.5, 1.0, 2.0]; lights * VERTICES as usize];
        for (found, light) in paper::radiance(&texture, &local, &pixel).into_iter().zip([0.5, 1.0, 2.0]) {
            assert_relative_eq!(found, light * f64::from(value) * lights as f64, max_relative = 1e-12);
        }
    }
}

/// At a vertex, a pixel's frame equals the vertex's frame; between vertices it is right-handed and orthonormal.
#[test]
fn frames_are_interpolated() {
    let vertices = Vertices::new(&hills(3), Tangents::Along(DVec3::X)).expect("vertices");
    for &corners in vertices.triangles() {
        for (at, weights) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let (found, own) = (pixel_frame(&vertices, corners, weights), vertices.frames()[corners[at] as usize]);
            assert!(found.normal().distance(own.normal()) < 1e-14 && found.tangent().distance(own.tangent()) < 1e-14);
        }
        let between = pixel_frame(&vertices, corners, [0.2, 0.3, 0.5]).matrix();
        assert_relative_eq!(between.determinant(), 1.0, max_relative = 1e-12);
    }
}

const SAMPLING: VisibilitySampling = VisibilitySampling { log2_samples: 1, horizon: Horizon::Normal };

fn square() -> (Mesh, Vertices) {
    let corners = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).expect("a mesh");
    let vertices = Vertices::new(&mesh, Tangents::Along(DVec3::X)).expect("vertices");
    (mesh, vertices)
}

/// Radiance at each rung, from a point in the middle of a square toward an eye above it.
fn rungs(patch: &MesoPatch, texture: &BidirectionalTexture, radiance: [f64; 3]) -> [[f64; 3]; TracedRung::ALL.len()] {
    rungs_at(patch, texture, radiance, ([0.3, 0.7], DVec3::new(0.28, 0.0, 0.96)))
}

fn rungs_at(
    patch: &MesoPatch,
    texture: &BidirectionalTexture,
    radiance: [f64; 3],
    (place, view): ([f64; 2], DVec3),
) -> [[f64; 3]; TracedRung::ALL.len()] {
    let (mesh, vertices) = square();
    let weights = [0.5, 0.25, 0.25];
    let frame = pixel_frame(&vertices, vertices.triangles()[0], weights);
    let point = TracedPoint::new(mesh.corners(0).expect("a triangle"), weights, frame).expect("a point");
    let pixel = ShadedPixel { corners: vertices.triangles()[0], weights, place, view };
    let tracer = HostTracer::new(&mesh, Sides::Both);
    let scene = TracedScene { tracer: &tracer, length: 8.0, sampling: SAMPLING };
    let (fine, texels) = (vec![radiance; FINE_DIRECTIONS], vec![radiance; LIGHT_TEXELS]);
    scene.rungs(&point, &pixel, (patch, texture), TracedLight { fine: &fine, texels: &texels })
}

fn sampled(patch: &MesoPatch, size: usize, side: usize) -> BidirectionalTexture {
    let directions = |side: usize| LocalDirections::new(side).expect("directions");
    patch.texture(size, &directions(4), &directions(side), &mut |_, _| ()).expect("a texture")
}

/// A Lambert square under uniform light 1 reflects its albedo. Ray tracing has the error of 49,152 directions in the
/// integral of the cosine, transfer has the error of M directions: the mean cosine of their centers is too large by the
/// factor 1 + 2 / M, and routing texels to the nearest center adds a smaller error.
#[test]
fn white_furnace_of_pixels() {
    let albedo = [0.25, 0.5, 1.0];
    let patch = MesoPatch::plain(MesoMaterial::diffuse(albedo)).expect("a patch");
    let (mesh, vertices) = square();
    let mut caster = HostTracer::new(&mesh, Sides::Both);
    let maps = VisibilityMaps::trace_sampled(&vertices, &[0, 1, 2, 3], SAMPLING, &mut caster, &mut |_, _| ());
    let maps = maps.expect("maps");
    let light = light_vector(&vec![1.0; LIGHT_TEXELS]);
    for side in [8, 12, 16, 32] {
        let texture = sampled(&patch, 1, side);
        let error = 4.0 / (side * side) as f64 + 1e-3;
        let matrix = transfer_matrix(&vertices, &maps, texture.light()).expect("a matrix");
        let local: Vec<[f64; 3]> = by_rows(&matrix, &light).into_iter().map(|value| [value; 3]).collect();
        let weights = [0.2, 0.3, 0.5];
        let pixel = ShadedPixel { corners: [0, 1, 2], weights, place: [0.1, 0.2], view: DVec3::Z };
        let by_transfer = paper::radiance(&texture, &local, &pixel);
        let by_rays = rungs(&patch, &texture, [1.0; 3]);
        for (channel, albedo) in albedo.into_iter().enumerate() {
            assert_relative_eq!(by_transfer[channel], albedo, max_relative = error);
            let rung = |rung: TracedRung| by_rays[rung as usize][channel];
            assert_relative_eq!(rung(TracedRung::Exact), albedo, max_relative = 1e-3);
            assert_eq!(rung(TracedRung::Light), rung(TracedRung::Exact), "the same light");
            // Without occluders, only the rim of the horizon changes.
            assert_relative_eq!(rung(TracedRung::Visibility), albedo, max_relative = 2e-3);
            assert_relative_eq!(rung(TracedRung::Directions), by_transfer[channel], max_relative = 1e-6);
            for last in [TracedRung::Views, TracedRung::Texture] {
                assert_relative_eq!(rung(last), rung(TracedRung::Directions), max_relative = 1e-6);
            }
        }
    }
}

/// A rough patch is darker than a flat one at every rung; with more directions and finer textures the rungs converge.
#[test]
fn rungs_come_together() {
    let patch = PatchKind::Bricks.patch(1.0);
    let apart = |size: usize, side: usize| {
        let found = rungs(&patch, &sampled(&patch, size, side), [1.0; 3]);
        let [exact, directions, texture] =
            [TracedRung::Exact, TracedRung::Directions, TracedRung::Texture].map(|rung| found[rung as usize][0]);
        assert!(exact > 0.0 && exact < 0.6, "{exact}");
        [(directions - exact).abs() / exact, (texture - directions).abs() / exact]
    };
    let [of_8, _] = apart(16, 8);
    let [of_16, of_texture] = apart(32, 16);
    assert!(of_16 < 0.02 && of_16 <= of_8 + 1e-3, "{of_8}, {of_16}");
    assert!(of_texture < 0.5, "{of_texture}");
}

/// At a sample of a texture (the center of a texel, toward one of the views), only single precision causes an error; at
/// the center of a texel, texels cause no error for any view.
#[test]
fn samples_cost_nothing() {
    let patch = PatchKind::Bricks.patch(1.0);
    let texture = sampled(&patch, 8, 4);
    let middle = [0.3125, 0.6875];
    let view = texture.view().directions()[5];
    let at = |place, view| {
        let found = rungs_at(&patch, &texture, [1.0; 3], (place, view));
        [TracedRung::Directions, TracedRung::Views, TracedRung::Texture].map(|rung| found[rung as usize][0])
    };
    let [directions, views, texels] = at(middle, view);
    assert!(directions > 0.0);
    assert_relative_eq!(views, directions, max_relative = 1e-9);
    assert_relative_eq!(texels, directions, max_relative = 1e-6);
    let oblique = DVec3::new(0.6, 0.0, 0.8);
    let [directions, views, texels] = at(middle, oblique);
    assert!((views - directions).abs() > 1e-4 * directions, "{views}, {directions}");
    assert_relative_eq!(texels, views, max_relative = 1e-6);
    let [_, views, texels] = at([0.25, 0.6], view);
    assert!((texels - views).abs() > 1e-4 * views, "{texels}, {views}");
}
