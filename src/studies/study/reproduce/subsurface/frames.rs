//! Whole frames: passes 1 and 3 in addition to pass 2, on stand-ins for the paper's models; the frame rate on a
//! display; and the time of links.
//!
//! Passes 1 and 3 draw the model, so they are drawn with as many faces as the paper's models have. Pass 2 is that of
//! [`super::gather`]. The window is not printed; ours has as many pixels as the smaller atlas has texels.

use super::counts::MODELS;
use super::frame_cost::{FrameCost, MapCost, WINDOW, cost};
use super::gather::{GatherCost, VARIANTS, Variant, all_costs};
use super::table_1::{DISPLAY, PRINTED, PrintedFrame, SIDES};
use super::{
    Bound, CARD, EntryFindings, LINKS, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Shared,
    Standing, Sweep, number,
};
use crate::geom::Mesh;
use crate::report::{Cell, Table};
use crate::scene::built::meshes;
use crate::subsurface::on_card::MapFormat;

/// Card of Figure 7.
const OTHER_CARD: &str = "fx5800";
/// Printed frames per second of Figure 7.
const FIGURE_7: f64 = 40.0;
/// Printed time of all links of the larger atlas, in seconds.
const LINK_SECONDS: f64 = 9.0;
/// Clocks of one evaluation of R_d on the host of section 3: two exponentials, two square roots and two quotients in
/// sequence, of 95, 27 and 20 clocks each, from memory of the manufacturer's optimisation guide. A guess.
const EVALUATION_CLOCKS: f64 = 2.0 * (95.0 + 27.0 + 20.0);
/// Its clock in Hz (Tom's Hardware).
const HOST_HZ: f64 = 2.083e9;
/// Evaluations of R_d per link, swept.
const EVALUATIONS: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 8.0];

const HOW: &str = "The first and the third pass are drawn on stand-ins of as many faces, by vertex as the text has it, with the transmittance towards the \
    eye from a texture and a window of {} x {} pixels, which is not printed. Links are fixed and the map has bytes, which the sweep replaces by the other \
    variants, each with its own first pass and levels: the card generates levels of bytes by itself, those of floats are passes, {} times as dear in half \
    precision.";
const LOCK: &str = "A display of {} Hz shows a finished frame at its next refresh, so that a frame takes a whole number of periods of {} ms: the modelled \
    rates are {} over the periods that the three passes and the map's levels need. The waits are in the printed shares, so the printed times of passes are \
    upper bounds of what they took, most of all for the shorter passes: the dolphin's first pass is printed with {} ms at the smaller atlas and with {} ms at \
    the larger one.";
const HOST: &str = "The time of links is that of one evaluation of R_d per link on the host of section three of the paper; which host computed them is not \
    printed. The sweep takes more evaluations per link.";

/// Place of the variant of the rows in [`VARIANTS`]: fixed links and an 8-bit map.
const OURS: usize = 0;

/// Frames per second on a display with vertical synchronisation, for frames of `seconds` seconds.
fn locked(seconds: f64) -> f64 {
    DISPLAY / (seconds * DISPLAY).ceil().max(1.0)
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let costs = shared.gather()?;
    let mut rows = Vec::new();
    let mut frames = Vec::new();
    for ((model, _, stand_in), printed) in MODELS.iter().zip(PRINTED) {
        let mesh = mesh(stand_in)?;
        for (side, printed) in SIDES.into_iter().zip(printed) {
            let cost = cost(CARD, &mesh, side as u32, &VARIANTS)?;
            rows.extend(passes(model, side, printed, (&cost, costs[OURS].seconds(side))));
            frames.push((*model, side, printed, cost));
        }
    }
    let mut rates: Vec<PaperRow> = frames.iter().map(|frame| rate(frame, &costs[OURS])).collect();
    rates.push(full_real_time(&rates[0]));
    let setting = |(at, (variant, cost)): (usize, (&Variant, &GatherCost))| {
        let mut values: Vec<f64> =
            frames.iter().map(|(_, side, _, frame)| locked(frame.frame(at, cost.seconds(*side)))).collect();
        values.push(values[0]);
        Setting { at: variant.name.to_owned(), values }
    };
    let settings = VARIANTS.iter().zip(costs).enumerate().map(setting).collect();
    Sweep { name: "Frames by what the text leaves open of pass 2", parameter: "variant", settings }.explain(&mut rates);
    rows.extend(rates);
    rows.push(figure_7()?);
    rows.push(links());
    let dolphin = |at: usize| number(1e3 / PRINTED[1][at].rate * PRINTED[1][at].shares[0] / 100.0, 1);
    let half = VARIANTS.iter().position(|variant| variant.fixed && variant.map == MapFormat::Fp16).unwrap_or(OURS);
    let dear = frames.first().map_or(1.0, |(.., cost)| cost.maps[half].levels / cost.maps[OURS].levels);
    let [width, height] = WINDOW.map(|pixels| pixels.to_string());
    Ok(EntryFindings {
        text: vec![
            Prose::new(HOW, [width, height, number(dear, 1)]),
            Prose::new(
                LOCK,
                [number(DISPLAY, 0), number(1e3 / DISPLAY, 1), number(DISPLAY, 0), dolphin(0), dolphin(1)],
            ),
            HOST.into(),
        ],
        rows,
        tables: vec![table(&frames, &costs[OURS]), variants(&frames, costs)],
        questions: vec![
            "the size of the window, the model of Figure 7, and the host that computed links with what it evaluated for each.",
        ],
        ..EntryFindings::default()
    })
}

fn mesh(stand_in: &'static str) -> Result<Mesh, ReproduceError> {
    let missing = || ReproduceError::Run { device: CARD.to_owned(), reason: format!("no stand-in `{stand_in}`") };
    meshes::build(stand_in).ok_or_else(missing)
}

/// Rows on the times of the passes of one frame: 1 and 3 always; 2 where Table 1's own entry does not judge it.
fn passes(
    model: &str,
    side: f64,
    PrintedFrame { rate, shares }: PrintedFrame,
    (cost, gather): (&FrameCost, f64),
) -> Vec<PaperRow> {
    let MapCost { light, levels } = cost.maps[OURS];
    let ours = [Some(light + levels), (side == SIDES[0]).then_some(gather), Some(cost.view)];
    let row = |(pass, (share, ours)): (usize, (f64, Option<f64>))| {
        let target = PaperFigure {
            origin: Origin::Implied(format!("{share} % of 1/{rate} s")),
            ..PaperFigure::printed(1e3 / rate * share / 100.0, 1, "ms", "table 1")
        };
        let ours = (1e3 * ours?, Standing::Predicted { from: "" });
        let what = format!("pass {pass} at {side} x {side}, {model}");
        Some(PaperRow::new(what, (CARD, Method::Pipeline), target, ours, Bound::PREDICTION))
    };
    (1..).zip(shares.into_iter().zip(ours)).filter_map(row).collect()
}

/// Inputs of the inferred refresh rate.
const DISPLAYED: &str = "the six frame rates, of which the display's was read off";

fn rate((model, side, printed, cost): &(&str, f64, PrintedFrame, FrameCost), gather: &GatherCost) -> PaperRow {
    let target = PaperFigure::printed(printed.rate, 2, "frames/s", "table 1");
    let ours = (locked(cost.frame(OURS, gather.seconds(*side))), Standing::Predicted { from: DISPLAYED });
    let what = format!("frames on a display at {side} x {side}, {model}");
    PaperRow::new(what, (CARD, Method::Pipeline), target, ours, Bound::PREDICTION)
}

/// Row on "Full real-time (61 Hz) performance": the first of the rates again.
fn full_real_time(first: &PaperRow) -> PaperRow {
    let target = PaperFigure::printed(61.0, 0, "Hz", "section 5");
    let ours = (first.ours, Standing::Predicted { from: DISPLAYED });
    PaperRow::new("full real-time performance, head", (CARD, Method::Pipeline), target, ours, Bound::PREDICTION)
}

/// Row on Figure 7: 40 frames per second are no integer fraction of the display's rate, so that the frame counts
/// without synchronisation, for the bunny at the smaller size.
fn figure_7() -> Result<PaperRow, ReproduceError> {
    let costs = all_costs(OTHER_CARD)?;
    let cost = cost(OTHER_CARD, &mesh(MODELS[2].2)?, SIDES[0] as u32, &VARIANTS[..=OURS])?;
    let target = PaperFigure::printed(FIGURE_7, 0, "frames/s", "figure 7");
    let ours = (1.0 / cost.frame(OURS, costs[OURS].seconds(SIDES[0])), Standing::Predicted { from: "" });
    let what = format!("frames at {0} x {0}, bunny, no display", SIDES[0]);
    Ok(PaperRow::new(what, (OTHER_CARD, Method::Pipeline), target, ours, Bound::PREDICTION))
}

/// Row on the time of links on a host.
fn links() -> PaperRow {
    let seconds = |evaluations: f64| evaluations * LINKS as f64 * SIDES[1] * SIDES[1] * EVALUATION_CLOCKS / HOST_HZ;
    let target = PaperFigure::printed(LINK_SECONDS, 0, "s", "section 4.3");
    let ours = (seconds(EVALUATIONS[0]), Standing::Predicted { from: "" });
    let what = format!("{LINKS} links at {0} x {0}, one evaluation each", SIDES[1]);
    let mut rows = [PaperRow::new(what, ("Athlon 2800+", Method::Host), target, ours, Bound::PREDICTION)];
    let setting = |evaluations: f64| Setting { at: number(evaluations, 0), values: vec![seconds(evaluations)] };
    let settings = EVALUATIONS.map(setting).to_vec();
    Sweep { name: "How much of an integral a link is", parameter: "evaluations", settings }.explain(&mut rows);
    let [row] = rows;
    row
}

/// Table of modelled and printed passes.
fn table(frames: &[(&str, f64, PrintedFrame, FrameCost)], gather: &GatherCost) -> Table {
    let mut table = Table::of(
        "A frame on the emulated card in ms, and its periods on the display; printed periods beside",
        "model atlas pass_1_ms levels_ms pass_2_ms pass_3_ms frame_ms frames_per_s periods printed_periods",
    );
    for (model, side, printed, cost) in frames {
        let gather = gather.seconds(*side);
        let frame = cost.frame(OURS, gather);
        let MapCost { light, levels } = cost.maps[OURS];
        let ms = |seconds: f64| Cell::measured(1e3 * seconds);
        table.push([
            (*model).into(),
            format!("{side} x {side}").into(),
            ms(light),
            ms(levels),
            ms(gather),
            ms(cost.view),
            ms(frame),
            Cell::measured(1.0 / frame),
            ((DISPLAY / locked(frame)).round() as u32).into(),
            ((DISPLAY / printed.rate).round() as u32).into(),
        ]);
    }
    table
}

/// Table of the first model's frames in each variant, as the sweep has them.
fn variants(frames: &[(&str, f64, PrintedFrame, FrameCost)], costs: &[GatherCost]) -> Table {
    let model = frames.first().map_or("", |frame| frame.0);
    let mut table = Table::of(
        format!("Frames of the {model} by what the text leaves open of pass 2, in ms, and their rates on the display"),
        "variant atlas pass_1_ms levels_ms pass_2_ms pass_3_ms frame_ms frames_per_s",
    );
    for (_, side, _, cost) in frames.iter().filter(|frame| frame.0 == model) {
        for (at, (variant, gather)) in VARIANTS.iter().zip(costs).enumerate() {
            let (MapCost { light, levels }, gather) = (cost.maps[at], gather.seconds(*side));
            let frame = cost.frame(at, gather);
            let ms = |seconds: f64| Cell::measured(1e3 * seconds);
            let head: [Cell; 2] = [variant.name.into(), format!("{side} x {side}").into()];
            let times = [light, levels, gather, cost.view, frame].map(ms);
            table.push(head.into_iter().chain(times).chain([Cell::measured(locked(frame))]));
        }
    }
    table
}
