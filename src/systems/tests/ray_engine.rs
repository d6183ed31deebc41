//! Unit tests of the Ray Engine: cost equations, ray batches, buckets, ids.

use std::sync::Mutex;

use crossbar_base::geom::exact::Sides;
use crossbar_base::geom::teapot::teapot;
use crossbar_base::geom::{Mesh, Ray};
use crossbar_ground::scene::Camera;
use crossbar_systems::ray_engine::engine::{EngineCounts, EngineParameters, RayEngine};
use crossbar_systems::ray_engine::model::CostRates;
use crossbar_systems::ray_engine::ray_tree::{RayTree, RayTreeParameters};
use crossbar_systems::ray_engine::{Crossbar, RayBatch, Recording};
use refsim::machine::ExecutorKind;

use crate::device;

const GEFORCE3: CostRates = CostRates { fill_pixels_per_s: 390e6, readback_bytes_per_s: 250e6 };

#[test]
fn the_card_pays_from_the_least_number_of_triangles_on_and_not_before() {
    for host in [1e6, 20e6, 40e6, 100e6, 389e6] {
        for gamma in [1.0, 4.0, 16.0] {
            let least = GEFORCE3.least_triangles(host, gamma).expect("the card is faster");
            assert!(GEFORCE3.tests_per_s(f64::from(least), gamma) >= host * (1.0 - 1e-12));
            assert!(least == 1 || GEFORCE3.tests_per_s(f64::from(least - 1), gamma) < host);
        }
    }
    assert_eq!(GEFORCE3.least_triangles(390e6, 4.0), None);
}

#[test]
fn the_two_readings_of_table_2() {
    // Three of four rays met the card, in six visits; two visits ended on the host.
    let counts = EngineCounts { rays: 4, rays_on_card: 3, pass_rays: 6, forced_rays: 2, ..EngineCounts::default() };
    assert_eq!((counts.share_on_card(), counts.share_of_visits_on_card()), (0.75, 0.75));
    assert_eq!(EngineCounts { forced_rays: 6, ..counts }.share_of_visits_on_card(), 0.5);
    assert_eq!(EngineCounts::default().share_of_visits_on_card(), 0.0, "no visits at all");
}

#[test]
fn lists_are_laid_out_in_squares_and_padded_with_their_last_ray() {
    let ray = |x: usize| Ray::new([x as f32, 0.0, 0.0], [0.0, 0.0, 1.0]).expect("a ray");
    for count in [1, 255, 256, 257, 4096, 5000] {
        let list: Vec<Ray> = (0..count).map(ray).collect();
        let batch = RayBatch::from_list(&list);
        assert_eq!(batch.rays().len(), batch.width() as usize * batch.height() as usize, "a full rectangle");
        for (i, r) in list.iter().enumerate() {
            assert_eq!(batch.rays()[batch.pixel_of(i)], *r, "ray {i} of {count}");
        }
        let last = batch.rays().iter().filter(|r| *r == &ray(count - 1)).count();
        assert_eq!(last, batch.rays().len() - count + 1, "the last one is repeated");
    }
    assert_eq!(RayBatch::from_list(&[ray(1); 3]).common_origin(), Some([1.0, 0.0, 0.0]), "one origin");
    assert_eq!(RayBatch::from_list(&[]).height(), 0, "no rays, no rows");
}

#[test]
fn every_draw_of_resident_rays_is_that_of_a_new_one() {
    let whole = teapot(2).expect("the teapot tessellates");
    let mesh = Mesh::new(whole.positions().to_vec(), whole.triangles()[..64].to_vec()).expect("a part of it");
    let camera = Camera::teapot(16, 16).expect("the default camera");
    let rays = RayBatch::new(16, 16, camera.rays()).expect("a ray per pixel");
    for name in ["ideal-s3.12", "ideal-fp32"] {
        let crossbar = Crossbar::new(device(name), ExecutorKind::Batch).all_pairs(true);
        let new = crossbar.intersect(&mesh, &rays, Sides::Front).expect("the card intersects");
        assert!(new.hits.iter().any(Option::is_some), "{name}: something is hit");
        let mut resident = crossbar.make_resident(&mesh, &rays, Sides::Front).expect("the card takes them");
        for draw in 0..3 {
            let again = resident.intersect().expect("the card intersects");
            assert_eq!((&again.hits, &again.events), (&new.hits, &new.events), "{name}, draw {draw}");
        }
    }
}

/// A recording reports each of its buckets of 32 x 32 rays.
#[test]
fn every_bucket_is_reported() {
    let rays = RayBatch::new(65, 33, Camera::teapot(65, 33).expect("a camera").rays()).expect("a ray per pixel");
    let mesh = teapot(1).expect("the teapot tessellates");
    let reported = Mutex::new(Vec::new());
    let done = |done: usize, total: usize| reported.lock().expect("no panic").push((done, total));
    let recording = Recording { new_observer: None, done: Some(&done) };
    let crossbar = Crossbar::new(device("ideal-fp32"), ExecutorKind::Batch);
    let answer = crossbar.intersect_recorded(&mesh, &rays, Sides::Front, recording).expect("the card intersects");
    assert_eq!(answer.hits, crossbar.intersect(&mesh, &rays, Sides::Front).expect("the card intersects").hits);
    let mut reported = reported.into_inner().expect("no panic");
    reported.sort_unstable();
    assert_eq!(reported, (1..=6).map(|done| (done, 6)).collect::<Vec<_>>());
}

#[test]
fn without_triangles_nothing_is_hit() {
    let rays = RayBatch::new(2, 1, Camera::teapot(2, 1).expect("a camera").rays()).expect("two rays");
    let crossbar = Crossbar::new(device("ideal-fp32"), ExecutorKind::Batch);
    let mut resident =
        crossbar.make_resident(&Mesh::default(), &rays, Sides::Front).expect("no triangles are no error");
    assert_eq!(resident.intersect().expect("nothing to do").hits, [None, None]);
}

/// An id is a color of three bytes without loss, and alpha is 0 where a ray misses.
#[test]
fn every_id_comes_back_as_a_color() {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = Mesh::new(triangle.to_vec(), vec![[0, 1, 2]; 1 << 24]).expect("as many triangles as there are ids");
    let ray = |x: f32| Ray::new([x, 0.25, 1.0], [0.0, 0.0, -1.0]).expect("a ray");
    let rays = RayBatch::new(2, 1, vec![ray(0.25), ray(2.0)]).expect("two rays");
    let crossbar = Crossbar::new(device("ideal-fp32"), ExecutorKind::Batch);
    for id in [0, 1, 255, 256, 0x0012_3456, 0x00ff_ffff] {
        let answer = crossbar.intersect_pass(&mesh, &[id], &rays, Sides::Front, false).expect("the card intersects");
        let found: Vec<Option<u32>> = answer.hits.iter().map(|hit| hit.map(|hit| hit.triangle)).collect();
        assert_eq!(found, [Some(id), None], "{id:#x}");
    }
}

/// The rays in the order in which a ray tree releases them, and the number of buckets that it split.
fn bucketed(directions: &[[f32; 3]], bucket: usize) -> (Vec<u32>, u64) {
    let mut tree = RayTree::new(RayTreeParameters { bucket, merge: 0 });
    for (ray, direction) in (0..).zip(directions) {
        tree.insert(ray, &Ray::new([0.0; 3], *direction).expect("a ray"));
    }
    let splits = tree.counts().splits;
    let mut taken = Vec::new();
    while !tree.is_empty() {
        taken.extend(tree.take());
    }
    (taken, splits)
}

/// Faces with equally many rays leave the tree in the order +x -x +y -y +z -z.
#[test]
fn directions_go_to_their_faces() {
    let directions = [[-0.0, 0.0, -1e-40], [0.0, -3.0, 1.0], [1.0, 2.0, -1.5], [0.0, 0.5, 4.0], [-2.0, 1.0, 1.0]];
    let of_x = [2.0, 1.0, -1.0];
    let all = [&directions[..], &[of_x]].concat();
    assert_eq!(bucketed(&all, 8).0, [5, 4, 2, 1, 3, 0]);
    // Among equal components the first counts: a second ray in +x makes that face the fullest.
    assert_eq!(bucketed(&[&all[..], &[[1.0; 3]]].concat(), 8).0, [5, 6, 4, 2, 1, 3, 0]);
    // The length of a direction does not matter, only its point on the face: equal points cannot be split.
    assert_eq!(bucketed(&[of_x, [4.0, 2.0, -2.0], [1.0, 0.5, -0.5]], 1).1, 0);
    assert_eq!(bucketed(&[of_x, [2.0, 1.0, 1.0]], 1).1, 1);
    assert_eq!(bucketed(&[of_x, [2.0, -1.0, -1.0]], 1).1, 1);
}

/// The order in which an engine answers 1000 rays without hits, after `before` others. It is the order in which they
/// enter the tree, which has one bucket.
fn order(shuffle: Option<u64>, before: usize) -> Vec<u64> {
    let mesh = teapot(1).expect("the teapot tessellates");
    let tree = RayTreeParameters { bucket: 4096, merge: 0 };
    let parameters = EngineParameters { shuffle, tree, card: false, ..EngineParameters::default() };
    let mut engine = RayEngine::new(&mesh, device("r300"), ExecutorKind::Batch, parameters).expect("an engine");
    let ray = Ray::new([100.0, 100.0, 100.0], [0.0, 0.0, 1.0]).expect("a ray");
    let mut answer = |count: usize| {
        let first = engine.submit(&vec![ray; count]).expect("rays enter").0;
        engine.finish().expect("the host traces");
        engine.take_answers().into_iter().map(|(ticket, _)| ticket.0 - first).collect()
    };
    let _: Vec<u64> = answer(before);
    answer(1000)
}

#[test]
fn shuffled_rays_are_all_there_and_elsewhere() {
    let in_turn: Vec<u64> = (0..1000).collect();
    assert_eq!(order(None, 0), in_turn);
    let mut shuffled = order(Some(7), 0);
    assert_eq!(shuffled, order(Some(7), 0));
    assert_ne!(shuffled, order(Some(8), 0));
    assert_ne!(shuffled, order(Some(7), 1000));
    let moved = shuffled.iter().zip(&in_turn).filter(|(ray, place)| ray != place).count();
    assert!(moved > 950, "{moved} moved");
    shuffled.sort_unstable();
    assert_eq!(shuffled, in_turn);
}
