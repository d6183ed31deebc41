//! Table 1: frames per second and the fractions of the passes.
//!
//! The frame rates are 60 over integers to two per cent: they are synchronised to a display, so that pass times contain
//! waits. Only pass 2 at 1024 x 1024 is longer than the possible wait, and the same on all three models.

use super::counts::MODELS;
use super::gather::{GatherCost, VARIANTS, all_costs};
use super::{
    Bound, CARD, EntryFindings, LINKS, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Shared,
    Standing, Sweep, number,
};
use crate::report::{Cell, Table};

/// Cards in addition to the paper's.
const OTHER_CARDS: [&str; 3] = ["nv35", "fx5800", "nv30"];
/// Printed row of Table 1: frames per second, and the fractions of the passes in per cent.
#[derive(Clone, Copy, Debug)]
pub(super) struct PrintedFrame {
    pub(super) rate: f64,
    pub(super) shares: [f64; 3],
}

/// Printed rows at 512 and at 1024 texels.
pub(super) const PRINTED: [[PrintedFrame; 2]; 3] = [
    [PrintedFrame { rate: 61.10, shares: [11.0, 82.0, 7.0] }, PrintedFrame { rate: 15.40, shares: [13.0, 85.0, 2.0] }],
    [PrintedFrame { rate: 30.35, shares: [43.0, 43.0, 14.0] }, PrintedFrame { rate: 15.09, shares: [8.0, 85.0, 7.0] }],
    [
        PrintedFrame { rate: 30.33, shares: [37.0, 34.0, 28.0] },
        PrintedFrame { rate: 12.05, shares: [18.0, 68.0, 14.0] },
    ],
];
/// Refresh rate of the display that the rates are synchronised to, in Hz.
pub(super) const DISPLAY: f64 = 60.0;
/// Texels along a side.
pub(super) const SIDES: [f64; 2] = [512.0, 1024.0];

const LOCKED: &str = "The six frame rates times {} are {} to {}: whole fractions of the rate of a display of about {} Hz. So a frame waits for the \
    display, and only the second pass at {} x {}, the longest part and alike on all models within {} %, says how fast the card is.";
const OPEN: &str = "Neither the format of the radiosity map nor which links were timed is printed. The rows are those of fixed links and an 8-bit map, \
    which automatic mipmaps (section 4.2.2) need on this card; the table has every variant, for every card of the time. They spread by a factor of {}.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let costs = shared.gather()?;
    let ms = |cost: &GatherCost| 1e3 * cost.seconds(SIDES[1]);
    let mut rows: Vec<PaperRow> = Vec::new();
    for ((model, ..), [_, PrintedFrame { rate, shares: [_, share, _] }]) in MODELS.iter().zip(PRINTED) {
        let target = PaperFigure {
            origin: Origin::Implied(format!("{share} % of 1/{rate} s")),
            ..PaperFigure::printed(1e3 / rate * share / 100.0, 1, "ms", "table 1")
        };
        let ours = (ms(&costs[0]), Standing::Predicted { from: "" });
        rows.push(PaperRow::new(
            format!("pass 2 at 1024 x 1024, {model}"),
            (CARD, Method::Pipeline),
            target,
            ours,
            Bound::PREDICTION,
        ));
    }
    let setting = |(variant, cost): (&super::gather::Variant, &GatherCost)| Setting {
        at: variant.name.to_owned(),
        values: vec![ms(cost); rows.len()],
    };
    let settings = VARIANTS.iter().zip(costs).map(setting).collect();
    let sweep = Sweep { name: "What the text leaves open of pass 2", parameter: "variant", settings };
    sweep.explain(&mut rows);
    let times: Vec<f64> = costs.iter().map(ms).collect();
    let spread = times.iter().copied().fold(0.0, f64::max) / times.iter().copied().fold(f64::INFINITY, f64::min);
    let target = |row: &PaperRow| row.target.value;
    let apart =
        rows.iter().map(target).fold(0.0, f64::max) / rows.iter().map(target).fold(f64::INFINITY, f64::min) - 1.0;
    let [factors, least, most] = locked();
    Ok(EntryFindings {
        text: vec![
            Prose::new(
                LOCKED,
                [
                    factors,
                    least,
                    most,
                    number(DISPLAY, 0),
                    number(SIDES[1], 0),
                    number(SIDES[1], 0),
                    number(100.0 * apart, 1),
                ],
            ),
            Prose::new(OPEN, [number(spread, 1)]),
        ],
        rows,
        tables: vec![variants(costs)?, frames()],
        questions: vec![
            "the format of the radiosity map, the choice of links, and whether waits for the display are in the times.",
        ],
        ..EntryFindings::default()
    })
}

/// Factor of the rates, and the smallest and the largest product.
fn locked() -> [String; 3] {
    let products: Vec<(f64, f64)> =
        PRINTED.iter().flatten().map(|printed| ((DISPLAY / printed.rate).round(), printed.rate)).collect();
    let factors: Vec<String> = products.iter().map(|(factor, _)| number(*factor, 0)).collect();
    let product = |&(factor, rate): &(f64, f64)| factor * rate;
    let least = products.iter().map(product).fold(f64::INFINITY, f64::min);
    let most = products.iter().map(product).fold(0.0, f64::max);
    [factors.join(", "), number(least, 1), number(most, 1)]
}

/// Table of pass 2 at 1024 x 1024 for each variant on each card.
fn variants(costs: &[GatherCost]) -> Result<Table, ReproduceError> {
    let mut table = Table::of(
        "Pass 2 of 16 links at 1024 x 1024 in ms, by the pipeline model; the paper's are 55.2 to 56.4",
        "variant fx5900 nv35 fx5800 nv30 ns_per_link",
    );
    let others = OTHER_CARDS.map(all_costs).into_iter().collect::<Result<Vec<_>, _>>()?;
    for (at, (variant, cost)) in VARIANTS.iter().zip(costs).enumerate() {
        let seconds = |cost: &GatherCost| cost.seconds(SIDES[1]);
        let per_link = seconds(cost) * 1e9 / (LINKS as f64 * SIDES[1] * SIDES[1]);
        let on_all = std::iter::once(cost).chain(others.iter().map(|costs| &costs[at]));
        let times = on_all.map(|cost| Cell::measured(1e3 * seconds(cost)));
        table.push(std::iter::once(Cell::from(variant.name)).chain(times).chain([Cell::measured(per_link)]));
    }
    Ok(table)
}

/// Table 1 as printed, with derived values.
fn frames() -> Table {
    let mut table = Table::of(
        "Table 1 as printed: frames, and pass 2 as far as shares of whole per cents tell",
        "model faces atlas frames_per_s display_periods pass_2_% pass_2_ms",
    );
    for ((model, faces, _), printed) in MODELS.iter().zip(PRINTED) {
        for (side, PrintedFrame { rate, shares: [_, share, _] }) in SIDES.iter().zip(printed) {
            table.push([
                (*model).into(),
                (*faces).into(),
                format!("{side} x {side}").into(),
                Cell::decimals(rate, 2),
                ((DISPLAY / rate).round() as u32).into(),
                Cell::decimals(share, 0),
                Cell::decimals(1e3 / rate * share / 100.0, 2),
            ]);
        }
    }
    table
}
