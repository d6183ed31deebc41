//! Matrix radiosity: iterations on every executor against plain loops on the host, bit for bit.

use crossbar::card::Texels;
use crossbar::linalg::Matrix;
use crossbar::radiosity::card_system::CardSystem;
use crossbar::radiosity::on_card::{CardSolver, Fit, Storage};
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::{FormFactors, System};
use refsim::device::Profile;
#[cfg(feature = "wgpu")]
use refsim::exec::gpu::testing;
use refsim::machine::{Executor, ExecutorKind};

use crate::random::Random;

const LIMIT: usize = 4096;

fn nv35() -> Profile {
    Profile::named("nv35").expect("a card")
}

/// All executors by name; the scalar one first.
fn executors() -> Vec<(&'static str, Executor)> {
    let all = vec![("scalar", ExecutorKind::Scalar.into()), ("batch", ExecutorKind::Batch.into())];
    #[cfg(feature = "wgpu")]
    let all = all.into_iter().chain(on_gpu()).collect();
    all
}

/// The adapter; `None` without one, panics where a missing adapter counts as a failure.
#[cfg(feature = "wgpu")]
fn on_gpu() -> Option<(&'static str, Executor)> {
    let gpu = testing::shared().unwrap_or_else(|e| panic!("{e}"))?;
    Some(("wgpu", Executor::Gpu { gpu }))
}

fn bits(texels: &Texels) -> Vec<[u32; 4]> {
    texels.texels.iter().map(|texel| texel.map(f32::to_bits)).collect()
}

/// Form factors of a room that leaks a little, no two alike; reflectances below 1.
fn room(size: usize, seed: u64) -> System {
    let mut random = Random::named("radiosity", seed);
    let mut number = || f64::from(random.below(1 << 20) as u32 + 1) / f64::from(1 << 20);
    let mut factors = Matrix::zeros([size; 2]).expect("small");
    for i in 0..size {
        let row = factors.row_mut(i);
        row.iter_mut().for_each(|f| *f = number());
        let sum: f64 = row.iter().sum();
        row.iter_mut().for_each(|f| *f *= 0.95 / sum);
    }
    let factors = FormFactors::from_values(vec![1.0; size], factors).expect("factors");
    let mut colors = |most: f64| (0..size).map(|_| [number() * most, number() * most, number() * most]).collect();
    let reflectance = colors(0.9);
    System::new(factors, reflectance, colors(10.0)).expect("a system")
}

/// One iteration by plain loops over f32: B + e, minus A B in the order of j. With four elements per texel, the four
/// partial sums of a block start from 0, and are added from the left.
fn step(system: &CardSystem, b: &Texels) -> Texels {
    let (matrix, emittance, mut next) = (&system.matrix, &system.emittance.texels, b.clone());
    let flat = b.texels.as_flattened();
    for i in 0..flat.len() {
        let (x, c) = (i / 4, i % 4);
        let start = flat[i] + emittance[x][c];
        next.texels[x][c] = match system.packing {
            Packing::Rgb => matrix.row(x).iter().zip(&b.texels).fold(start, |sum, (m, b)| sum - m[c] * b[c]),
            Packing::Luminance => {
                let size = 4 * system.block;
                let blocks = matrix.row(i).as_flattened().chunks(size).zip(flat.chunks(size));
                blocks.fold(start, |sum, (m, b)| {
                    let lane = |c: usize| (c..m.len()).step_by(4).fold(0.0_f32, |sum, j| sum - m[j] * b[j]);
                    sum + (((lane(0) + lane(1)) + lane(2)) + lane(3))
                })
            }
        };
    }
    next
}

/// Two iterations on a card, compared with iterations on the host.
fn iterations_agree(name: &str, executor: &Executor, systems: &[CardSystem]) {
    let mut card = CardSolver::of(nv35(), executor, systems, Storage::Fp32).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(card.passes(), systems[0].matrix.width.div_ceil(systems[0].block));
    let zero = |system: &CardSystem| Texels::vector(vec![[0.0; 4]; system.emittance.width]);
    let mut at: Vec<Texels> = systems.iter().map(zero).collect();
    for iteration in 0..2 {
        at = systems.iter().zip(&at).map(|(system, at)| step(system, at)).collect();
        card.iterate().unwrap_or_else(|e| panic!("{name}: {e}"));
        let read = card.read_texels().unwrap_or_else(|e| panic!("{name}: {e}"));
        for (place, (found, expected)) in read.iter().zip(&at).enumerate() {
            assert_eq!(bits(found), bits(expected), "{name}: system {place}, iteration {iteration}");
        }
    }
}

fn luminance(system: &System, block: usize) -> Vec<CardSystem> {
    let channel =
        |c| CardSystem::luminance(system.matrix(c), &system.right_hand_side(c), block, LIMIT).expect("it fits");
    (0..3).map(channel).collect()
}

pub(crate) fn every_pass_is_the_hosts() {
    let rgb = [(1, 254), (5, 2), (23, 6), (64, 16)].map(|(size, block)| {
        (size, block, vec![CardSystem::rgb(&room(size, size as u64), block, LIMIT).expect("it fits")])
    });
    let four = [(1, 254), (6, 1), (23, 4), (64, 5)]
        .map(|(size, block)| (size, block, luminance(&room(size, size as u64), block)));
    for (size, block, systems) in rgb.into_iter().chain(four) {
        for (name, executor) in executors() {
            iterations_agree(&format!("{name}, {size} patches in blocks of {block}"), &executor, &systems);
        }
    }
}

/// Sizes around the paper's block: one less, equal, one and two more.
pub(crate) fn full_blocks_are_the_hosts() {
    let fit = Fit::of(&nv35(), Packing::Rgb).expect("a fit");
    assert_eq!(fit, Fit { block: 254, limit: 4096 });
    for size in 253..=256 {
        let system = room(size, 3);
        let rgb = CardSystem::rgb(&system, fit.block, LIMIT).expect("it fits");
        assert_eq!(rgb.matrix.width.div_ceil(rgb.block), if size > 254 { 2 } else { 1 });
        iterations_agree("batch", &ExecutorKind::Batch.into(), &[rgb]);
    }
    let systems = luminance(&room(1018, 4), fit.block);
    iterations_agree("batch", &ExecutorKind::Batch.into(), &systems[..1]);
    let rgb = CardSystem::rgb(&room(255, 5), fit.block, LIMIT).expect("it fits");
    iterations_agree("scalar", &ExecutorKind::Scalar.into(), &[rgb]);
}
