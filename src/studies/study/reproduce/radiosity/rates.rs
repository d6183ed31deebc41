//! The printed rates: 29.7 iterations and 141 MFLOP per second on the card, 40 and 190 on the host. And their
//! dependence on the number of patches.

use super::{CARD, EntryFindings, PATCHES, PRINTED_CARD, PRINTED_HOST, ReproduceError, Storage, host, iteration};
use crate::radiosity::model;
use crate::radiosity::packing::Packing;
use crate::radiosity::rate::TimedIteration;
use crate::report::{Cell, Table};
use crate::study::reproduce::{Bound, Method, Origin, PaperFigure, PaperRow, Prose, Standing, number};

const PLACE: &str = "section 3.1";
/// Numbers of patches that are compared: six full blocks; six sides of 16 x 16; the four consistent with both pairs of
/// rates, with their neighbours; a round number.
const SIZES: [u32; 9] = [1524, 1536, 1539, 1540, 1541, 1542, 1543, 1544, 1600];
/// Inputs of the inferred number of patches.
const CHOSE_N: &str = "141 and 190 MFLOP/s, which chose the number of patches";

const HOW: &str = "Neither the number of patches nor that of passes is printed. Both printed pairs of rates mean {} million operations an iteration; \
    at two an element that leaves {} to {} patches, and we take the first. So the rows of operations are calibrated, and the number of passes is inferred. \
    An iteration of that size is drawn on the emulated {} and timed by the pipeline model, in which nothing was set by this paper; \
    the table gives it for other sizes.";

const WHERE: &str = "Where the time goes: each of a texel's two reads is of {} bytes at a computed coordinate, which a texture unit of {} bytes a clock \
    takes {} clocks for; and of each quad of fragments only {} % lie in the one row of the target. The unit's width and how registers slow the card \
    are guesses or measurements of others, as `crossbar devices` says.";

pub(in crate::study::reproduce) fn findings() -> Result<EntryFindings, ReproduceError> {
    let paper = iteration(PATCHES, Packing::Rgb, Storage::Fp32)?;
    let fits: Vec<u32> = (1..=2 * PATCHES).filter(|n| fits(*n)).collect();
    let ends = [fits.first(), fits.last()].map(|n| n.map_or_else(String::new, u32::to_string));
    let [least, most] = ends;
    let (sizes, texel) = (sizes()?, 16.0);
    let width = profile_width()?;
    Ok(EntryFindings {
        text: vec![
            Prose::new(HOW, [number(PRINTED_CARD.1 / PRINTED_CARD.0, 2), least, most, CARD.to_owned()]),
            Prose::new(
                WHERE,
                [number(texel, 0), number(width, 0), number(texel / width, 0), number(100.0 * paper.filled, 0)],
            ),
        ],
        rows: rows(&paper),
        questions: vec![
            "how many patches the authors' scene had.",
            "what share of its bandwidth the card used: the text guesses, and of the card's texture cache nothing is documented.",
        ],
        tables: vec![sizes, costs()?],
        ..EntryFindings::default()
    })
}

/// Bytes of a texel that a texture unit of the card fetches per clock.
fn profile_width() -> Result<f64, ReproduceError> {
    let profile = refsim::device::Profile::named(CARD)?;
    crate::study::reproduce::figure(&profile, "rates.texel_bytes_per_clock", profile.rates.texel_bytes_per_clock)
}

fn rows(paper: &TimedIteration) -> Vec<PaperRow> {
    let printed = |value: f64, decimals: u8, unit: &'static str| PaperFigure::printed(value, decimals, unit, PLACE);
    let calibrated = Standing::Calibrated { on: CHOSE_N };
    let predicted = Standing::Predicted { from: CHOSE_N };
    let (jacobi, gauss_seidel) = (model::mflops(PATCHES, PRINTED_CARD.0), model::mflops(PATCHES, PRINTED_HOST.0));
    let passes = f64::from(model::passes(PATCHES, 1, model::BLOCK));
    let inferred =
        Origin::Inferred("ceil(N / 254) for the inferred number of patches; the paper prints neither".to_owned());
    vec![
        PaperRow::new(
            "Jacobi iterations",
            (CARD, Method::Pipeline),
            printed(PRINTED_CARD.0, 1, "1/s"),
            (paper.per_s, predicted),
            Bound::PREDICTION,
        ),
        // The paper's own arithmetic: operations per iteration, times its rate.
        PaperRow::new(
            "operations of Jacobi, 2 N N times the printed rate",
            (CARD, Method::Equation),
            printed(PRINTED_CARD.1, 0, "MFLOP/s"),
            (jacobi, calibrated),
            Bound::Print,
        ),
        PaperRow::new(
            "operations of Gauss-Seidel, 2 N N times the printed rate",
            (HOST, Method::Equation),
            printed(PRINTED_HOST.1, 0, "MFLOP/s"),
            (gauss_seidel, calibrated),
            Bound::Print,
        ),
        PaperRow::new(
            "Gauss-Seidel iterations",
            (HOST, Method::Host),
            printed(PRINTED_HOST.0, 0, "1/s"),
            (1.0 / host::iteration(PATCHES), Standing::Calibrated { on: "this figure, which sets what memory costs" }),
            Bound::Print,
        ),
        PaperRow::new(
            "passes an iteration",
            (CARD, Method::Pipeline),
            PaperFigure { origin: inferred, ..printed(passes, 0, "passes") },
            (paper.passes as f64, calibrated),
            Bound::Print,
        ),
        // "Only a fraction (perhaps as little as 10%)": any value well below all of it is consistent with that.
        PaperRow::new(
            "bandwidth used, at least; \"perhaps as little as\"",
            (CARD, Method::Pipeline),
            printed(10.0, 0, "%"),
            (100.0 * paper.bandwidth, predicted),
            Bound::TooVague,
        ),
    ]
}

const HOST: &str = "Athlon 2800+";

/// Returns `true` if both printed pairs of rates are consistent with this number of patches.
fn fits(patches: u32) -> bool {
    [PRINTED_CARD, PRINTED_HOST].iter().all(|(rate, mflops)| model::mflops(patches, *rate).round() == *mflops)
}

/// Table of the dependence on the number of patches.
fn sizes() -> Result<Table, ReproduceError> {
    let mut table = Table::of(
        "What the number of patches decides",
        "patches passes iterations_per_s difference_% MFLOP/s_of_Jacobi reads_141 MFLOP/s_of_Gauss-Seidel \
         reads_190",
    );
    for patches in SIZES {
        let timed = iteration(patches, Packing::Rgb, Storage::Fp32)?;
        let reads = |(rate, mflops): (f64, f64)| -> [Cell; 2] {
            let ours = model::mflops(patches, rate);
            [Cell::measured(ours), (ours.round() == mflops).into()]
        };
        let head: [Cell; 4] = [
            patches.into(),
            timed.passes.into(),
            Cell::measured(timed.per_s),
            Cell::percent(100.0 * (timed.per_s / PRINTED_CARD.0 - 1.0)),
        ];
        table.push(head.into_iter().chain(reads(PRINTED_CARD)).chain(reads(PRINTED_HOST)));
    }
    Ok(table)
}

/// Table of the cost of an iteration in each packing and precision.
fn costs() -> Result<Table, ReproduceError> {
    let mut table = Table::of(
        format!("An iteration of {PATCHES} patches; four elements a texel are one channel, the others three"),
        "packing storage passes draws texture_clocks arithmetic_clocks memory_clocks filled_% bandwidth_% \
         iterations_per_s bound_by",
    );
    for packing in [Packing::Rgb, Packing::Luminance] {
        for storage in [Storage::Fp32, Storage::Fp16] {
            let timed = iteration(PATCHES, packing, storage)?;
            table.push([
                if packing == Packing::Rgb { "rgb" } else { "luminance" }.into(),
                if storage == Storage::Fp32 { "fp32" } else { "fp16" }.into(),
                timed.passes.into(),
                timed.draws.into(),
                timed.textures.into(),
                timed.arithmetic.into(),
                timed.memory.into(),
                Cell::percent(100.0 * timed.filled),
                Cell::percent(100.0 * timed.bandwidth),
                Cell::measured(timed.per_s),
                timed.bottleneck.to_string().into(),
            ]);
        }
    }
    Ok(table)
}
