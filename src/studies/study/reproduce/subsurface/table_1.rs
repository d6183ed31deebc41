//! Table 1: frames per second, and the shares of the passes.
//!
//! The frame rates are 60 divided by integers, to within two percent: they are synchronised to a display, so pass times
//! contain waits. Only pass 2 at 1024 x 1024 is longer than the possible wait, and it is the same for all three models.

use super::counts::MODELS;
use super::gather::{GatherCost, VARIANTS};
use super::{
    CARD, Contradiction, EntryFindings, LINKS, PaperRow, Shared, StudyError, drawn, ends, number, paragraph,
    printed_value,
};
use crate::report::{Cell, Table};

/// Cards timed in addition to the paper's.
const OTHER_CARDS: [&str; 3] = ["nv35", "fx5800", "nv30"];
/// Printed row of Table 1: frames per second, and the shares of the passes in percent.
#[derive(Clone, Copy, Debug)]
pub(super) struct PrintedFrame {
    pub(super) model: &'static str,
    /// Texels along a side.
    pub(super) side: f64,
    pub(super) rate: f64,
    pub(super) shares: [f64; 3],
}

impl PrintedFrame {
    /// All rows, model by model.
    pub(super) fn all() -> Result<Vec<Self>, StudyError> {
        let all = MODELS.iter().flat_map(|(model, _)| SIDES.map(|side| (*model, side)));
        all.map(|(model, side)| Self::named(model, side)).collect()
    }

    fn named(model: &'static str, side: f64) -> Result<Self, StudyError> {
        let share = |pass: usize| printed_value(&format!("subsurface/share-{model}-{side}-{pass}"));
        let rate = printed_value(&format!("subsurface/rate-{model}-{side}"))?;
        Ok(Self { model, side, rate, shares: [share(1)?, share(2)?, share(3)?] })
    }

    /// Number of display periods that the frame takes.
    pub(super) fn periods(&self) -> f64 {
        (DISPLAY / self.rate).round()
    }

    /// Milliseconds of pass number `pass`, from 1.
    pub(super) fn milliseconds(&self, pass: usize) -> f64 {
        1e3 / self.rate * self.shares[pass - 1] / 100.0
    }

    /// Name of the figure of a pass's time.
    pub(super) fn pass_id(&self, pass: usize) -> String {
        format!("subsurface/pass-{}-{}-{pass}", self.model, self.side)
    }
}

/// Refresh rate, in Hz, of the display to which the rates are synchronised.
pub(super) const DISPLAY: f64 = 60.0;
/// Maximum relative difference of a rate from a whole number of periods.
const LOCKED_WITHIN: f64 = 0.03;
/// Minimum sum of three shares, each rounded to a percent, that add up to a whole frame.
const ALL_BUT_ROUNDING: f64 = 98.5;
/// Texels along a side.
pub(super) const SIDES: [f64; 2] = [512.0, 1024.0];
const LOCKED: &str = "The six frame rates, multiplied by {}, are {} to {}: each is a whole fraction of the rate of a display of about {} Hz. So \
    frames wait for the display. Only the second pass at {} x {} shows the card's speed: it takes longest, and its time differs between models \
    by at most {} %.";
const OPEN: &str = "The paper states neither the format of the radiosity map nor which links were timed. The rows use \
    fixed links and an 8-bit map, because automatic mipmaps (section 4.2.2) need such a map on this card. The table \
    has every variant, for four cards of the time. The variants differ by a factor of {}.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let costs = shared.get::<Vec<GatherCost>>(CARD)?;
    let ms = |cost: &GatherCost| 1e3 * cost.seconds(SIDES[1]);
    let printed = PrintedFrame::all()?;
    let mut rows: Vec<PaperRow> = Vec::new();
    for frame in printed.iter().filter(|frame| frame.side == SIDES[1]) {
        rows.push(drawn(&frame.pass_id(2), CARD, ms(&costs[0]))?);
    }
    let [quickest, slowest] = ends(costs.iter().map(ms));
    let [low, high] = ends(rows.iter().map(|row| row.target.value));
    let ([periods, least, most], side) = (locked(&printed), SIDES[1]);
    let apart = (100.0 * (high / low - 1.0), 1);
    Ok(EntryFindings::new(
        [
            paragraph(LOCKED, &[&periods, &least, &most, &DISPLAY, &side, &side, &apart]),
            paragraph(OPEN, &[&(slowest / quickest, 1)]),
        ],
        rows,
        ["the format of the radiosity map, the choice of links, and whether waits for the display are in the times."],
        [variants(shared, &costs)?],
    ))
}

/// Contradiction of the passes' times by the display: frames take whole periods, and the passes' shares sum to the
/// frame, so the times contain waits. The computation uses only the paper's values.
pub(super) fn display_lock(printed: &[PrintedFrame]) -> Option<Contradiction> {
    let on_periods = printed.iter().all(|frame| (frame.periods() * frame.rate / DISPLAY - 1.0).abs() < LOCKED_WITHIN);
    let [least, _] = ends(printed.iter().map(|frame| frame.shares.iter().sum()));
    let without_waits = |frame: &&PrintedFrame| frame.side == SIDES[0];
    // The first pass draws the same vertices at both sizes, and at the larger size one level more.
    let shorter = printed.iter().filter(without_waits).find(|small| {
        let large = printed.iter().find(|frame| frame.model == small.model && frame.side == SIDES[1]);
        large.is_some_and(|large| large.milliseconds(1) < small.milliseconds(1) / 2.0)
    });
    let [factors, low, high] = locked(printed);
    let computation = format!(
        "the six frame rates, multiplied by {factors}, are {low} to {high}, so frames take whole periods of a display; the \
         shares of the passes sum to {} % of the frame or more, so the passes include waits{}",
        number(least, 0),
        shorter.map_or_else(String::new, |frame| format!(
            "; pass 1 of the {} takes more than twice as long at the smaller size",
            frame.model
        )),
    );
    Contradiction::if_holds(on_periods && least >= ALL_BUT_ROUNDING && shorter.is_some(), computation)
}

/// Numbers of periods as text, and the smallest and the largest product with the rates.
fn locked(printed: &[PrintedFrame]) -> [String; 3] {
    let factors: Vec<String> = printed.iter().map(|frame| number(frame.periods(), 0)).collect();
    let [least, most] = ends(printed.iter().map(|frame| frame.periods() * frame.rate));
    [factors.join(", "), number(least, 1), number(most, 1)]
}

/// Table of pass 2 at 1024 x 1024 for each variant on each card.
fn variants(shared: &Shared, costs: &[GatherCost]) -> Result<Table, StudyError> {
    let mut table = Table::of(
        "Pass 2 with 16 links at 1024 x 1024 in ms, by the pipeline model; the paper implies 55.2 to 56.4",
        "variant fx5900 nv35 fx5800 nv30 ns_per_link",
    );
    let others = OTHER_CARDS.map(|card| shared.get::<Vec<GatherCost>>(card));
    let others = others.into_iter().collect::<Result<Vec<_>, _>>()?;
    for (at, (variant, cost)) in VARIANTS.iter().zip(costs).enumerate() {
        let seconds = |cost: &GatherCost| cost.seconds(SIDES[1]);
        let per_link = seconds(cost) * 1e9 / (LINKS as f64 * SIDES[1] * SIDES[1]);
        let on_all = std::iter::once(cost).chain(others.iter().map(|costs| &costs[at]));
        let times = on_all.map(|cost| Cell::measured(1e3 * seconds(cost)));
        table.push(std::iter::once(Cell::from(variant.name)).chain(times).chain([Cell::measured(per_link)]));
    }
    Ok(table)
}
