//! The ray tree returns every ray exactly once.

use crossbar::geom::Ray;
use crossbar::geom::random::CounterRng;
use crossbar::ray_engine::ray_tree::{RayTree, RayTreeParameters};
use proptest::prelude::*;

fn ray(i: u64, spread: f64) -> Ray {
    let random = CounterRng::new(11);
    let part = |sample, k| (spread * (2.0 * random.unit(i, sample, k) - 1.0)) as f32;
    let d = [0, 1, 2].map(|k| 2.0 * random.unit(i, 1, k) as f32 - 1.0);
    Ray::new([0, 1, 2].map(|k| part(0, k)), if d == [0.0; 3] { [1.0, 0.0, 0.0] } else { d }).expect("a ray")
}

proptest! {
    #[test]
    fn every_ray_comes_out_once(
        bucket in 1usize..40, merge in 0usize..60, steps in prop::collection::vec(any::<bool>(), 1..2000), alike in any::<bool>(),
    ) {
        let mut tree = RayTree::new(RayTreeParameters { bucket, merge });
        let (mut put, mut out) = (0_u32, Vec::new());
        for insert in steps {
            if insert {
                tree.insert(put, &ray(if alike { 0 } else { u64::from(put) }, 5.0));
                put += 1;
            } else {
                let taken = tree.take();
                prop_assert!(taken.len() <= bucket);
                out.extend(taken);
            }
            prop_assert_eq!(tree.len(), put as usize - out.len());
        }
        while !tree.is_empty() {
            let taken = tree.take();
            prop_assert!(!taken.is_empty(), "a tree that holds rays gives some");
            out.extend(taken);
        }
        out.sort_unstable();
        prop_assert_eq!(out, (0..put).collect::<Vec<_>>());
        let counts = tree.counts();
        prop_assert_eq!(counts.inserted, u64::from(put));
        prop_assert_eq!(counts.own + counts.stolen, u64::from(put));
    }
}

#[test]
fn buckets_are_coherent_and_well_filled() {
    let mut tree = RayTree::new(RayTreeParameters::default());
    for i in 0..100_000_u32 {
        tree.insert(i, &ray(u64::from(i), 10.0));
    }
    let full = tree.occupancy();
    let mean = full.iter().sum::<f64>() / full.len() as f64;
    assert!((0.3..0.9).contains(&mean), "the mean bucket is {:.0} % full", 100.0 * mean);
    let spread = |rays: &[u32]| {
        let directions: Vec<[f64; 3]> = rays
            .iter()
            .map(|&i| {
                let d = ray(u64::from(i), 10.0).direction().map(f64::from);
                let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
                d.map(|x| x / length)
            })
            .collect();
        let mean = |k: usize| directions.iter().map(|d| d[k]).sum::<f64>() / directions.len() as f64;
        1.0 - [0, 1, 2].map(|k| mean(k) * mean(k)).iter().sum::<f64>().sqrt()
    };
    let batch = tree.take();
    assert_eq!(batch.len(), 256, "stolen rays fill it up");
    let everything: Vec<u32> = (0..100_000).collect();
    assert!(spread(&batch) < 0.3 * spread(&everything), "one way rather than all ways");
    assert!(tree.bytes() < 100_000 * 100, "{} B a ray", tree.bytes() / 100_000);
}
