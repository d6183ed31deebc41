//! Matrix radiosity: properties of light in every solver.

mod all_pictures;
mod bias;
mod covered;
mod cycles;
mod display;
mod errors;
mod factors;
mod light;
mod on_card;
mod others;
mod solvers;
mod textures;

use crate::support::profile;
use crossbar::geom::random::CounterRng;
use crossbar::geom::{Mesh, Sides};
use crossbar::linalg::Matrix;
use crossbar::radiosity::on_card::{CardSolver, Storage};
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::rooms::{self, CornellBox};
use crossbar::radiosity::{FormFactors, Patches, Subdivision, System};
use crossbar::scene::{Material, Scene};
use crossbar::tracer::HostTracer;
use refsim::machine::ExecutorKind;

/// The Cornell box without blocks, with closure of form factors enforced.
fn cornell(patches: usize) -> System {
    let patches = Patches::new(&rooms::cornell(CornellBox::default()), Subdivision::AtMost(patches)).expect("patches");
    let mut factors = FormFactors::unoccluded(&patches).expect("factors");
    factors.enforce_closure().expect("a closed room");
    System::new(factors, patches.reflectances(), patches.emittances()).expect("a system")
}

/// Returns `true` if every row of form factors sums to 1 within a tolerance, except rows of patches that see nothing.
fn are_closed(factors: &FormFactors, tolerance: f64) -> bool {
    factors.row_sums().into_iter().all(|sum| sum == 0.0 || (sum - 1.0).abs() <= tolerance)
}

/// A mesh whose surface reflects half of the light.
fn white(mesh: Mesh) -> Scene {
    let count = mesh.len();
    Scene::new(mesh, vec![Material::diffuse("white", [0.5; 3])], vec![0; count], Vec::new()).expect("a scene")
}

fn tracer(scene: &Scene) -> HostTracer {
    HostTracer::new(scene.mesh(), Sides::Both)
}

/// A diagonally dominant asymmetric matrix whose off-diagonal row sums are at most `reach` of the diagonal, and a
/// right-hand side.
fn random_system(size: usize, reach: f64, seed: u64) -> (Matrix, Vec<f64>) {
    let random = CounterRng::new(seed);
    let number = |i: usize, j: usize| random.unit(i as u64, j as u64, 0);
    let mut matrix = Matrix::zeros([size; 2]).expect("small");
    for i in 0..size {
        let diagonal = 0.5 + number(i, size);
        let weights: Vec<f64> = (0..size).map(|j| if i == j { 0.0 } else { number(i, j) }).collect();
        let sum: f64 = weights.iter().sum();
        let row = matrix.row_mut(i);
        for (value, weight) in row.iter_mut().zip(&weights) {
            *value = -weight * diagonal * reach / sum;
        }
        row[i] = diagonal;
    }
    (matrix, (0..size).map(|i| number(i, size + 1)).collect())
}

fn card(system: &System, packing: Packing, storage: Storage) -> CardSolver {
    CardSolver::new(profile("nv35"), ExecutorKind::Batch, system, packing, storage).expect("a card")
}
