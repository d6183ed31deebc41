//! Matrix radiosity on the card: solutions, relighting, helpful refusals, and counts of instructions.

use crate::support::profile;
use approx::abs_diff_eq;
use crossbar::radiosity::card_system::CardSystem;
use crossbar::radiosity::on_card::{CardSolver, Storage};
use crossbar::radiosity::packing::Packing;
use crossbar::radiosity::solve::{Options, Solver};
use crossbar::radiosity::{kernels, model};
use refsim::asm::assemble;
use refsim::check::{RuleId, check};
use refsim::machine::ExecutorKind;

use super::{card, cornell};

#[test]
fn a_solution_is_reached_and_its_history_is_the_residuals() {
    let system = cornell(120);
    for packing in [Packing::Rgb, Packing::Luminance] {
        let mut card = card(&system, packing, Storage::Fp32);
        let options = Options { tolerance: 1e-4, ..Options::default() };
        let mut seen = Vec::new();
        let solution = card.solve(&system, &options, &mut |i| seen.push((i.number, i.residual))).expect("a solution");
        assert!(solution.converged && solution.cycle.is_none());
        assert_eq!(solution.history, seen);
        assert_eq!(solution.iterations() as usize + 1, seen.len());
        let host = system.solve_channel(0, Solver::Jacobi, &Options::default());
        for ((_, found), expected) in seen.iter().zip(host.expect("a solution").history) {
            assert!(
                abs_diff_eq!(found[0], expected, epsilon = 1e-3 * expected),
                "{} against the host's {expected}",
                found[0]
            );
        }
    }
}

#[test]
fn relighting_goes_on_from_the_last_solution() {
    let mut system = cornell(100);
    let options = Options { tolerance: 1e-5, ..Options::default() };
    for packing in [Packing::Rgb, Packing::Luminance] {
        let mut card = card(&system, packing, Storage::Fp32);
        let cold = card.solve(&system, &options, &mut |_| ()).expect("a solution");
        let dimmed: Vec<[f64; 3]> = system.emittance().iter().map(|e| e.map(|x| 0.98 * x)).collect();
        system.set_emittance(dimmed).expect("emittances");
        card.set_emittance(&system).expect("uploaded");
        let before = card.read().expect("radiosities");
        assert_eq!(before, cold.radiosity, "a change of light leaves radiosities where they are");
        let warm = card.solve(&system, &options, &mut |_| ()).expect("a solution");
        assert!(warm.converged && warm.iterations() < cold.iterations(), "{} {}", warm.iterations(), cold.iterations());
        // The bits equal the results of a card that had the new light from the start.
        let mut other = self::card(&system, packing, Storage::Fp32);
        other.load(&before).expect("radiosities");
        (0..warm.iterations()).try_for_each(|_| other.iterate()).expect("iterations");
        assert_eq!(other.read().expect("radiosities"), warm.radiosity);
    }
}

/// Section 3 of the paper: 1024 instructions, 254 texels, ceil(N / 254) passes.
#[test]
fn programs_are_as_long_as_the_card_takes() {
    let nv35 = profile("nv35");
    let counts = |packing, storage, size| {
        let systems = [CardSystem::zeros(packing, size, 254, 4096).expect("it fits")];
        let card = CardSolver::of(nv35.clone(), ExecutorKind::Batch, &systems, storage).expect("a card");
        let elements = if packing == Packing::Rgb { 1 } else { 4 };
        assert_eq!(card.passes() as u32, model::passes(size as u32, elements, model::BLOCK));
        card.programs().iter().map(|p| (p.kernel.name, p.texels, p.instructions())).collect::<Vec<_>>()
    };
    let rgb = [("rgb_first.fp", 254, 1021), ("rgb_next.fp", 254, 1019), ("rgb_next.fp", 16, 67)];
    assert_eq!(counts(Packing::Rgb, Storage::Fp32, 1540), rgb);
    let luminance = [("luminance_first.fp", 254, 1023), ("luminance_next.fp", 131, 529)];
    assert_eq!(counts(Packing::Luminance, Storage::Fp32, 1540), luminance);
    assert_eq!(counts(Packing::Rgb, Storage::Fp16, 254), [("rgb_first_half.fp", 254, 1021)]);
    assert_eq!(counts(Packing::Luminance, Storage::Fp16, 1016), [("luminance_first_half.fp", 254, 1023)]);
    for kernel in kernels::BLOCKS {
        let verdict = |texels| check(assemble(&kernel.unrolled(texels)).expect("a program"), &nv35);
        let block = kernel.block(1024);
        assert_eq!(verdict(block).expect("it fits").instructions.len(), kernel.overhead() + block * kernel.per_texel());
        let refused = verdict(block + 1).expect_err("too long");
        assert_eq!(
            refused.violations.iter().map(|v| v.rule).collect::<Vec<_>>(),
            [RuleId::TooManyInstructions],
            "{}",
            kernel.name
        );
        let whole = check(assemble(kernel.text).expect("a program"), &nv35).expect("a file is a program for one texel");
        assert_eq!(whole.instructions.len(), verdict(1).expect("a program").instructions.len());
    }
}

#[test]
fn what_a_card_can_not_do_is_refused() {
    let system = cornell(20);
    let (batch, rgb, single) = (ExecutorKind::Batch, Packing::Rgb, Storage::Fp32);
    let zeros = |packing, size, block| CardSystem::zeros(packing, size, block, 1 << 13).expect("it fits");
    let mut small = profile("nv35");
    small.limits.max_texture_size = Some(8);
    let mut card = card(&system, rgb, single);
    let new = |profile, systems: &[CardSystem]| CardSolver::of(profile, batch, systems, single);
    assert!(CardSolver::new(profile("r300"), batch, &system, rgb, single).is_err());
    assert!(CardSolver::new(small, batch, &system, rgb, single).is_err());
    for systems in [
        &[zeros(rgb, 300, 300)][..],
        &[zeros(Packing::Luminance, 4097, 254)],
        &[],
        &[zeros(rgb, 4, 8), zeros(rgb, 4, 8)],
        &[4, 8, 4].map(|size| zeros(Packing::Luminance, size, 8)),
    ] {
        assert!(new(profile("nv35"), systems).is_err(), "{} systems", systems.len());
    }
    assert!(card.set_emittance(&cornell(60)).is_err() && card.load(&[[0.0; 3]; 3]).is_err());
}
