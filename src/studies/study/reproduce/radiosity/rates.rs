//! The printed rates, 29.7 iterations and 141 MFLOP per second on the card, 40 and 190 on the host, and their
//! dependence on the number of patches.

use refsim::device::Profile;

use super::{CARD, EntryFindings, PATCHES, PrintedRates, Shared, Storage, StudyError, host, iteration};
use crate::card::KernelText;
use crate::radiosity::packing::Packing;
use crate::radiosity::rate::TimedIteration;
use crate::radiosity::{kernels, model};
use crate::report::{Cell, Table};
use crate::study::reproduce::error::figure;
use crate::study::reproduce::{Dependence, Method, PaperRow, paper_row, paragraph};

/// Numbers of patches that are compared: six full blocks; six sides of 16 x 16 patches; the four numbers consistent
/// with both pairs of rates, with their neighbors; and a round number.
const SIZES: [u32; 9] = [1524, 1536, 1539, 1540, 1541, 1542, 1543, 1544, 1600];
/// Inputs of the inferred number of patches.
const CHOSE_N: &str = "141 and 190 MFLOP/s, which determined the number of patches";
/// Inputs of the rate on the card: the host's rates alone allow the same numbers of patches.
const HOST_CHOSE_N: &str = "190 MFLOP/s and 40 iterations/s of the host, which determined the number of patches";
const HOW: &str = "The paper prints neither the number of patches nor the number of passes. Each printed pair of rates implies {} million \
    operations per iteration. At two operations per matrix element, this leaves {} to {} patches, and we use the smallest number. So the rows of \
    operations are calibrated; the number of passes would be {}. An iteration of this size is drawn on the emulated {} and timed by the pipeline \
    model, which has no constant from this paper; the table lists other sizes.";
const WHERE: &str = "Texture reads and partly filled quads take most of the time. Each of a texel's two reads fetches {} bytes at a computed \
    coordinate; for this, a texture unit of {} bytes per clock takes {} clocks. The target is a single row, so only {} % of a quad's fragments \
    lie in it. The unit's width and the slowdown by registers are guesses or others' measurements; `crossbar devices` lists them.";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let paper = iteration(PATCHES, Packing::Rgb, Storage::Fp32)?;
    let printed = PrintedRates::both()?;
    let fits: Vec<u32> = (1..=2 * PATCHES).filter(|n| fits(*n, &printed)).collect();
    let [least, most] = [fits.first(), fits.last()].map(|n| n.map_or_else(String::new, u32::to_string));
    let operations = (printed[0].mflops / printed[0].per_s, 2);
    let profile = Profile::named(CARD)?;
    let (texel, width) = (16.0, figure(&profile, "rates.texel_bytes_per_clock", profile.rates.texel_bytes_per_clock)?);
    Ok(EntryFindings::new(
        [
            paragraph(HOW, &[&operations, &least, &most, &paper.passes, &CARD]),
            paragraph(WHERE, &[&texel, &width, &(texel / width), &(100.0 * paper.filled)]),
        ],
        rows(&paper, &printed)?,
        [
            "the number of patches in the authors' scene.",
            "the share of its bandwidth that the card used: the text guesses it, and the card's texture cache is undocumented.",
        ],
        [sizes(&printed)?, costs()?],
    ))
}

fn rows(paper: &TimedIteration, [card, host]: &[PrintedRates; 2]) -> Result<Vec<PaperRow>, StudyError> {
    let calibrated = Dependence::Calibrated { on: CHOSE_N };
    let predicted = Dependence::Predicted { from: HOST_CHOSE_N };
    let of_host = (
        1.0 / host::iteration(PATCHES)?,
        Dependence::Calibrated { on: "this figure, which determined the cost of memory reads" },
    );
    // The paper's own arithmetic: operations per iteration multiplied by the iteration rate.
    let (jacobi, gauss_seidel) = (model::mflops(PATCHES, card.per_s), model::mflops(PATCHES, host.per_s));
    let block = |kernel: KernelText| {
        let texels = kernel.block(model::MAX_INSTRUCTIONS as usize);
        [texels, kernel.overhead() + texels * kernel.per_texel()].map(|count| count as f64)
    };
    let [[texels, rgb], [_, luminance]] = [kernels::RGB_FIRST, kernels::LUMINANCE_FIRST].map(block);
    let limit = f64::from(model::MAX_INSTRUCTIONS);
    let long = |id, ours| {
        let from = Dependence::Predicted { from: "1024 instructions per program" };
        paper_row(id, (CARD, Method::Pipeline), (ours, from))
    };
    Ok(vec![
        long("radiosity/block-elements", texels)?,
        long("radiosity/block-instructions", rgb)?
            .with_readings([luminance])
            .confined([limit - 3.0, limit], "a block has as many texels, of four instructions each, as fit"),
        paper_row("radiosity/jacobi-rate", (CARD, Method::Pipeline), (paper.per_s, predicted))?,
        paper_row("radiosity/jacobi-operations", (CARD, Method::Equation), (jacobi, calibrated))?,
        paper_row("radiosity/gauss-seidel-operations", (HOST, Method::Equation), (gauss_seidel, calibrated))?,
        paper_row("radiosity/gauss-seidel-rate", (HOST, Method::Host), of_host)?,
        // "Only a fraction (perhaps as little as 10%)": any value well below 100 % is consistent with that.
        paper_row("radiosity/bandwidth", (CARD, Method::Pipeline), (100.0 * paper.bandwidth, predicted))?,
    ])
}

const HOST: &str = "Athlon 2800+";

/// Returns `true` if both printed pairs of rates are consistent with this number of patches.
fn fits(patches: u32, printed: &[PrintedRates; 2]) -> bool {
    printed.iter().all(|rates| model::mflops(patches, rates.per_s).round() == rates.mflops)
}

fn sizes(printed: &[PrintedRates; 2]) -> Result<Table, StudyError> {
    let mut table = Table::of(
        "Rates by number of patches",
        "patches passes iterations_per_s difference_% MFLOP/s_of_Jacobi reads_141 MFLOP/s_of_Gauss-Seidel \
         reads_190",
    );
    for patches in SIZES {
        let timed = iteration(patches, Packing::Rgb, Storage::Fp32)?;
        let reads = |rates: &PrintedRates| -> [Cell; 2] {
            let ours = model::mflops(patches, rates.per_s);
            [Cell::measured(ours), (ours.round() == rates.mflops).into()]
        };
        let head: [Cell; 4] = [
            patches.into(),
            timed.passes.into(),
            Cell::measured(timed.per_s),
            Cell::percent(100.0 * (timed.per_s / printed[0].per_s - 1.0)),
        ];
        table.push(head.into_iter().chain(printed.iter().flat_map(reads)));
    }
    Ok(table)
}

fn costs() -> Result<Table, StudyError> {
    let mut table = Table::of(
        format!(
            "An iteration of {PATCHES} patches: three channels (rgb), or one with four elements per texel (luminance)"
        ),
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
