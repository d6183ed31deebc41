//! The printed rates: 29.7 iterations and 141 MFLOP a second on the card, 40 and 190 on the host.

use super::{CARD, Findings, PATCHES, ReproduceError, Storage, iteration};
use crate::radiosity::model;
use crate::radiosity::packing::Packing;
use crate::report::{Cell, Table};
use crate::study::reproduce::{Modelled, Printed, Row};

const PLACE: &str = "section 3.1";

pub(in crate::study::reproduce) fn findings() -> Result<Findings, ReproduceError> {
    let paper = iteration(PATCHES, Packing::Rgb, Storage::Fp32)?;
    let host = |value: f64, decimals: usize, unit: &'static str, found: f64, what: &str| Row {
        what: what.to_owned(),
        device: "Athlon 2800+",
        printed: Printed { value, decimals, unit, place: PLACE },
        rates: Modelled::predicted(found),
        pipeline: None,
        note: String::new(),
    };
    let card = |value: f64, decimals: usize, unit: &'static str, found: [Option<f64>; 2], what: &str, note: &str| Row {
        what: what.to_owned(),
        device: CARD,
        printed: Printed { value, decimals, unit, place: PLACE },
        rates: found[0].and_then(Modelled::predicted),
        pipeline: found[1].and_then(Modelled::predicted),
        note: note.to_owned(),
    };
    let passes = f64::from(model::passes(PATCHES, 1, model::BLOCK));
    let rows = vec![
        card(29.7, 1, "1/s", [None, Some(paper.per_s)], "Jacobi iterations", ""),
        // The paper's own arithmetic: so many operations an iteration, times its rate.
        card(141.0, 0, "MFLOP/s", [Some(model::mflops(PATCHES, 29.7)), Some(paper.mflops)], "operations of Jacobi", ""),
        card(7.0, 0, "passes", [Some(passes), Some(paper.passes as f64)], "passes an iteration, ceil(N / 254)", ""),
        card(
            10.0,
            0,
            "%",
            [None, Some(100.0 * paper.bandwidth)],
            "bandwidth used, \"perhaps as little as\"",
            "A guess of the authors'. Ours counts each texel of the matrix once and each of the vectors once a pass; lines of the texture \
             cache that are fetched and not used up would add to it. To know more one would need the size and the lines of the \
             card's texture cache, of which nothing is documented.",
        ),
        host(190.0, 0, "MFLOP/s", model::mflops(PATCHES, 40.0), "operations of Gauss-Seidel, 40 iterations/s"),
    ];
    Ok(Findings {
        text: vec![
            format!(
                "Both printed pairs of rates mean 4.75 million operations an iteration; at two an element that is {PATCHES} to 1543 \
                 patches, and we take the first. An iteration of that size is drawn on the emulated {CARD} and timed by the \
                 pipeline model. Nothing in it was set by this paper."
            ),
            "Where the time goes: each of a texel's two reads is of 16 bytes at a computed coordinate, which a texture unit of 4 bytes a clock \
             takes four clocks for; four registers are in use, two more than run at full speed; and of each quad of 2 x 2 \
             fragments half lies beside the one row of the target. These three figures of the card are guesses or measurements of \
             others, as `crossbar devices nv35` says."
                .to_owned(),
        ],
        rows,
        tables: vec![costs()?],
        charts: Vec::new(),
    })
}

/// What an iteration costs in each packing and precision.
fn costs() -> Result<Table, ReproduceError> {
    let mut table = Table::new(
        format!("An iteration of {PATCHES} patches; four elements a texel are one channel, the others three"),
        &[
            "packing",
            "storage",
            "passes",
            "draws",
            "texture_clocks",
            "arithmetic_clocks",
            "memory_clocks",
            "filled_%",
            "bandwidth_%",
            "iterations_per_s",
            "bound_by",
        ],
    );
    let rounded = |x: f64| Cell::Real((x * 10.0).round() / 10.0);
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
                rounded(100.0 * timed.filled),
                rounded(100.0 * timed.bandwidth),
                rounded(timed.per_s),
                format!("{:?}", timed.bottleneck).to_lowercase().into(),
            ]);
        }
    }
    Ok(table)
}
