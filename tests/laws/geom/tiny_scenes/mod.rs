//! Ten thousand tiny scenes (degenerate, coplanar, doubled, huge, tiny and needle-like triangles; rays along axes, in
//! planes, from surfaces, with zeros of both signs) through every path: no panic, no hang, no lost hit, and the same
//! bits.
//!
//! **What is tested.** The baseline is the card's f32 test over all pairs. Where its answer is right in exact
//! arithmetic, every path must give its bits. Where it is wrong, or has an error of t of a hundredth or more, a path
//! may differ, but only by skipping triangles: every reported hit passes the f32 test. docs/papers/ray_engine.md has a
//! table of fp32's errors.

mod scene;
mod single;

use crate::environment::by_form;
use crate::support::profile;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use crossbar::geom::{Hit, Mesh, Ray};
use crossbar::oracle::{Disagreement, DisagreementKind, Oracle, Tolerance};
use crossbar::ray_engine::Crossbar;
use crossbar::ray_engine::engine::{EngineParameters, RayEngine};
use crossbar::ray_engine::ray_tree::RayTreeParameters;
use crossbar::tracer::HostTracer;
use crossbar::tracer::octree::{GpuCells, OctreeParameters};
use rayon::prelude::*;
use refsim::machine::ExecutorKind;
use scene::Scene;

const SCENES: u64 = 10_000;
/// One scene in this many is drawn on the card; every scene with `CROSSBAR_FULL=1`.
const ON_CARD: usize = 8;
const IN_OCTREES: usize = 4;
/// Number of ULPs above which the relative error of t is at least a hundredth.
const ASTRAY: u64 = 1 << 17;
const TOLERANCE: Tolerance = Tolerance::ulps(4);

const OCTREES: [OctreeParameters; 4] = [
    OctreeParameters { most_triangles: usize::MAX, most_depth: 0 },
    OctreeParameters { most_triangles: 8, most_depth: 10 },
    OctreeParameters { most_triangles: 2, most_depth: 6 },
    OctreeParameters { most_triangles: 1, most_depth: 20 },
];

/// The answers of the f32 test over all pairs of a scene, and which of them are wrong.
struct Yardstick {
    scene: Scene,
    hits: Vec<Option<Hit>>,
    wrong: BTreeMap<usize, Disagreement>,
}

impl Yardstick {
    fn new(number: u64) -> Self {
        let scene = Scene::new(number);
        let tracer = HostTracer::with_octree(&scene.mesh, OCTREES[0], scene.sides);
        let hits: Vec<_> = scene.rays.iter().map(|ray| tracer.nearest_of_all(ray)).collect();
        let oracle = Oracle::new(&scene.mesh, scene.sides, TOLERANCE);
        let report = oracle.judge(&scene.rays, &hits).expect("one answer a ray");
        let wrong = report.disagreements().iter().map(|wrong| (wrong.ray, wrong.clone())).collect();
        Self { scene, hits, wrong }
    }

    /// Compares the hits of a path with the baseline: returns the number of rays that differ; panics if a difference is
    /// not allowed.
    fn hold(&self, name: &str, number: u64, hits: &[Option<Hit>]) -> usize {
        let bits = |hit: &Option<Hit>| hit.map(|hit| (hit.triangle, hit.t.to_bits()));
        assert_eq!(self.hits.len(), hits.len());
        let mut differing = 0;
        for (place, (all_pairs, path)) in self.hits.iter().zip(hits).enumerate() {
            if bits(all_pairs) == bits(path) {
                continue;
            }
            differing += 1;
            let ray = &self.scene.rays[place];
            let told = || format!("scene {number}, {name}, ray {place}: {ray:?}: {all_pairs:?} became {path:?}");
            let wrong = self.wrong.get(&place).unwrap_or_else(|| panic!("{}, but fp32 was right", told()));
            let astray = wrong.kind == DisagreementKind::TOff && wrong.t_ulps.is_none_or(|ulps| ulps > ASTRAY);
            let wrong_triangle = wrong.found.is_some() && wrong.kind != DisagreementKind::TOff;
            assert!(astray || wrong_triangle, "{}, but fp32 was right but for {:?} ULPs", told(), wrong.t_ulps);
            if let Some(hit) = path {
                assert_eq!(bits(&self.alone(ray, hit.triangle)), Some((0, hit.t.to_bits())), "{}: not granted", told());
            }
        }
        differing
    }

    /// The f32 test of one triangle, in a mesh to which two degenerate triangles give the scene's bounds.
    fn alone(&self, ray: &Ray, triangle: u32) -> Option<Hit> {
        let corners = self.scene.mesh.corners(triangle)?;
        let positions = corners.into_iter().chain(self.scene.mesh.bounds()?).collect();
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [3; 3], [4; 3]]).ok()?;
        HostTracer::with_octree(&mesh, OCTREES[0], self.scene.sides).nearest_of_all(ray)
    }
}

/// The baselines of all scenes, shared by the tests. Tests must initialize this before they start parallel work: a
/// waiting worker could be the one that has to run the initialization.
static YARDSTICKS: LazyLock<Vec<Yardstick>> =
    LazyLock::new(|| (0..SCENES).into_par_iter().map(Yardstick::new).collect());

/// The sum of `each` over every `step`-th scene, in parallel.
fn sum(step: usize, each: impl Fn(u64, &Yardstick) -> usize + Sync + Send) -> usize {
    let yardsticks: &[Yardstick] = &YARDSTICKS;
    yardsticks.par_iter().enumerate().step_by(step).map(|(number, yardstick)| each(number as u64, yardstick)).sum()
}

/// The step through the scenes: `step`, or 1 with `CROSSBAR_FULL=1`.
fn every(step: usize) -> usize {
    by_form(step, 1)
}

#[test]
fn the_octree_finds_what_all_pairs_find() {
    let step = every(IN_OCTREES);
    let differing = sum(step, |number, yardstick| {
        let scene = &yardstick.scene;
        let mut differing = 0;
        for (at, parameters) in OCTREES.into_iter().enumerate() {
            let tracer = HostTracer::with_octree(&scene.mesh, parameters, scene.sides);
            let (hits, _) = tracer.nearest_all(&scene.rays);
            differing += yardstick.hold(&format!("octree {at}"), number, &hits);
            let cells = GpuCells::mark(tracer.octree(), 1..=3);
            let hits: Vec<_> = scene.rays.iter().map(|ray| tracer.nearest_in(ray, Some(&cells)).0).collect();
            differing += yardstick.hold(&format!("GPU cells in octree {at}"), number, &hits);
        }
        differing
    });
    // Only rays on which fp32 is wrong may differ: 1 in 5,000 answers, according to the page.
    assert!(differing * step < 400, "{differing} answers differ");
}

#[test]
fn the_card_and_the_engine_find_what_all_pairs_find() {
    let step = every(ON_CARD);
    sum(step, |number, yardstick| {
        let scene = &yardstick.scene;
        let mut differing = 0;
        // A t far below a batch's largest t loses bits in the depth buffer, and a larger t is lost; scenes of moderate
        // size have no such t.
        if scene.moderate {
            let card = Crossbar::new(profile("ideal-fp32"), ExecutorKind::Batch).all_pairs(true);
            let hits = card.intersect_list(&scene.mesh, &scene.rays, scene.sides).expect("the card works");
            differing += yardstick.hold("card", number, &hits);
        }
        let parameters = EngineParameters {
            octree: OCTREES[1 + number as usize / step % 3],
            triangles: 1..=[1, 4, 12][number as usize % 3],
            rays: 1 + number as usize / 7 % 4,
            tree: RayTreeParameters { bucket: 5, merge: 2 },
            waiting: 9,
            sides: scene.sides,
            ..EngineParameters::default()
        };
        let mut engine =
            RayEngine::new(&scene.mesh, profile("ideal-fp32"), ExecutorKind::Batch, parameters).expect("an engine");
        let hits = engine.trace(&scene.rays).expect("the card works");
        differing + yardstick.hold("engine", number, &hits)
    });
}

#[test]
fn every_difference_between_fp32_and_the_truth_is_counted() {
    let yardsticks: &[Yardstick] = &YARDSTICKS;
    // For scenes of one size, and of mixed sizes: numbers of rays, of true hits, and of wrong answers by kind.
    let ([mut rays, mut surface], mut counts) = ([[0; 2]; 2], BTreeMap::<DisagreementKind, [usize; 2]>::new());
    let hits_truly = yardsticks.par_iter().enumerate().map(|(number, Yardstick { scene, hits, .. })| {
        let scale = single::scale(&scene.mesh);
        for (ray, hit) in scene.rays.iter().zip(hits) {
            let any = scene.mesh.iter_corners().any(|corners| single::meets(ray, corners, scene.sides, scale));
            assert_eq!(any, hit.is_some(), "scene {number}, {ray:?}");
        }
        Oracle::new(&scene.mesh, scene.sides, TOLERANCE).judge(&scene.rays, hits).expect("one answer a ray").surface()
    });
    for (Yardstick { scene, hits, wrong }, truly) in yardsticks.iter().zip(hits_truly.collect::<Vec<_>>()) {
        let column = usize::from(!scene.moderate);
        rays[column] += hits.len();
        surface[column] += truly;
        wrong.values().for_each(|wrong| counts.entry(wrong.kind).or_default()[column] += 1);
    }
    let of = |column: usize| format!("of {} rays, {} truly hit", rays[column], surface[column]);
    let mut table = format!("| | {} | {} |\n|---|---|---|\n", of(0), of(1));
    for (kind, [one, mixed]) in counts {
        table += &format!("| {kind} | {one} | {mixed} |\n");
    }
    let page = include_str!("../../../../docs/papers/ray_engine.md").replace('\r', "");
    assert!(page.contains(&table), "docs/papers/ray_engine.md has another table:\n{table}");
}
