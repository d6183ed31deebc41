//! Whole frames: passes 1 and 3 in addition to pass 2, with stand-ins for the paper's models; the frame rate on a
//! display; and the time to compute links.
//!
//! Passes 1 and 3 draw the model, so the stand-ins have the face counts of the paper's models. Pass 2 is timed by
//! [`super::gather`]. The paper does not print the window's size; ours has as many pixels as the smaller atlas has
//! texels.

use refsim::device::Profile;
use refsim::texture::TexelFormat;
use refsim::timing::Picoseconds;

use super::counts::{MODELS, mesh};
use super::gather::{self, GatherCost, VARIANTS, loaded};
use super::table_1::{DISPLAY, PrintedFrame, SIDES, display_lock};
use super::{
    CARD, Dependence, EntryFindings, LINKS, Method, PaperRow, RunResult, Shared, StudyError, TimedWork, drawn, no_time,
    paper_row, paragraph,
};
use crate::atlas::Atlas;
use crate::card::MeshView;
use crate::geom::Mesh;
use crate::report::{Cell, Table};
use crate::scene::Camera;
use crate::subsurface::kernels::{DirectLight, EyeTransmittance, ViewKernel};
use crate::subsurface::on_card::{CardModel, Light, View, pass_times};

/// Card of Figure 7.
const OTHER_CARD: &str = "fx5800";
/// Clocks per evaluation of R_d on the host of section 3: two exponentials, two square roots and two quotients in
/// sequence, 95, 27 and 20 clocks each, from memory of the manufacturer's optimisation guide. A guess.
const EVALUATION_CLOCKS: f64 = 2.0 * (95.0 + 27.0 + 20.0);
/// Clock of this host in Hz (Tom's Hardware).
const HOST_HZ: f64 = 2.083e9;
const HOW: &str = "Passes 1 and 3 are drawn with stand-in models that have the paper's face counts. Light is computed per vertex, as in the paper; the \
    transmittance towards the eye is read from a texture. The window has {} x {} pixels; the paper does not give its size. Links are fixed, and the map \
    has 8-bit texels, whose mip levels the card generates.";
const LOCK: &str = "A display of {} Hz shows a finished frame at its next refresh, so a frame takes a whole number of periods of {} ms. The modelled \
    rates are {} Hz divided by the number of periods that the three passes and the map's levels need. The printed shares include the waits, so the \
    printed times of passes are upper bounds, above all for the shorter passes: the dolphin's first pass takes {} ms in print with the smaller atlas, \
    but {} ms with the larger one.";
const HOST: &str = "The time to compute links is that of one evaluation of R_d per link on the host of section 3; the \
    paper does not say which host computed links. The cost of an evaluation is our guess.";

const QUESTION: &str =
    "the size of the window, the model of Figure 7, the host that computed links, and what it evaluated per link.";

/// Index in [`VARIANTS`] of the rows' variant: fixed links and an 8-bit map.
const OURS: usize = 0;

/// Frames per second on a display with vertical synchronisation, for frames of `seconds` seconds.
fn locked(seconds: f64) -> f64 {
    DISPLAY / (seconds * DISPLAY).ceil().max(1.0)
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let costs = shared.get::<Vec<GatherCost>>(CARD)?;
    let printed = PrintedFrame::all()?;
    let (mut rows, mut frames) = (Vec::new(), Vec::new());
    for (model, stand_in) in MODELS {
        let mesh = mesh(stand_in)?;
        for frame in printed.iter().filter(|frame| frame.model == model) {
            let cost = cost(CARD, &mesh, frame.side as u32)?;
            for row in passes(frame, (&cost, costs[OURS].seconds(frame.side)))? {
                rows.push(row.contradicted(display_lock(&printed)));
            }
            frames.push((*frame, cost));
        }
    }
    let rates: Vec<PaperRow> = frames.iter().map(|frame| rate(frame, &costs[OURS])).collect::<Result<_, _>>()?;
    rows.extend(rates);
    rows.push(dominance(&frames, &costs[OURS])?);
    rows.push(figure_7()?);
    let seconds = LINKS as f64 * SIDES[1] * SIDES[1] * EVALUATION_CLOCKS / HOST_HZ;
    let predicted = (seconds, Dependence::Predicted { from: "" });
    rows.push(paper_row("subsurface/link-time", ("Athlon 2800+", Method::Host), predicted)?);
    let dolphin = |at: usize| (printed[2 + at].milliseconds(1), 1);
    Ok(EntryFindings::new(
        [
            paragraph(HOW, &[&WINDOW[0], &WINDOW[1]]),
            paragraph(LOCK, &[&DISPLAY, &(1e3 / DISPLAY, 1), &DISPLAY, &dolphin(0), &dolphin(1)]),
            HOST.into(),
        ],
        rows,
        [QUESTION],
        [table(&frames, &costs[OURS])],
    ))
}

/// Rows for the times of passes 1 and 3 of a frame, and of pass 2 unless the entry of Table 1 judges it.
fn passes(printed: &PrintedFrame, (cost, gather): (&FrameCost, f64)) -> Result<Vec<PaperRow>, StudyError> {
    let gather = (printed.side == SIDES[0]).then_some(gather);
    let ours = [Some(cost.light + cost.levels), gather, Some(cost.view)];
    let judged = (1..).zip(ours).filter_map(|(pass, seconds)| Some((pass, seconds?)));
    judged.map(|(pass, seconds)| drawn(&printed.pass_id(pass), CARD, 1e3 * seconds)).collect()
}

/// Printed values that determined the refresh rate.
const DISPLAYED: &str = "the six frame rates, from which the display's rate was read off";

fn rate((printed, cost): &(PrintedFrame, FrameCost), gather: &GatherCost) -> Result<PaperRow, StudyError> {
    let ours = (locked(cost.frame(gather.seconds(printed.side))), Dependence::Calibrated { on: DISPLAYED });
    paper_row(&format!("subsurface/rate-{}-{}", printed.model, printed.side), (CARD, Method::Pipeline), ours)
}

/// Times of the three passes of the head at the smaller size.
pub(in crate::study::reproduce) fn timed() -> Result<[TimedWork; 3], StudyError> {
    let cost = cost(CARD, &mesh(MODELS[0].1)?, SIDES[0] as u32)?;
    let gather = gather::cost(CARD, VARIANTS[OURS])?.seconds(SIDES[0]);
    let pass = |id, seconds: f64| TimedWork::new(id, CARD, Picoseconds((1e12 * seconds).round() as u64));
    Ok([
        pass("subsurface/pass-head-512-1", cost.light + cost.levels)?,
        pass("subsurface/pass-head-512-2", gather)?,
        pass("subsurface/pass-head-512-3", cost.view)?,
    ])
}

/// Row for the time of pass 2 at the larger size relative to the other passes, for each model.
fn dominance(frames: &[(PrintedFrame, FrameCost)], gather: &GatherCost) -> Result<PaperRow, StudyError> {
    let large = frames.iter().filter(|(printed, _)| printed.side == SIDES[1]);
    let mut ratios = large.map(|(printed, cost)| gather.seconds(printed.side) / cost.frame(0.0));
    let ours = ratios.next().unwrap_or(f64::NAN);
    Ok(drawn("subsurface/pass-2-dominates", CARD, ours)?.with_readings(ratios))
}

/// Row for Figure 7: 40 frames per second are not an integer fraction of the display's rate, so the row is for a frame
/// without synchronisation, of the bunny at the smaller size.
fn figure_7() -> Result<PaperRow, StudyError> {
    let gather = gather::cost(OTHER_CARD, VARIANTS[OURS])?;
    let cost = cost(OTHER_CARD, &mesh(MODELS[2].1)?, SIDES[0] as u32)?;
    drawn("subsurface/figure-7", OTHER_CARD, 1.0 / cost.frame(gather.seconds(SIDES[0])))
}

fn table(frames: &[(PrintedFrame, FrameCost)], gather: &GatherCost) -> Table {
    let mut table = Table::of(
        "Frame times on the emulated card in ms, and display periods per frame, ours and printed",
        "model atlas pass_1_ms levels_ms pass_2_ms pass_3_ms frame_ms frames_per_s periods printed_periods",
    );
    for (printed, cost) in frames {
        let gather = gather.seconds(printed.side);
        let frame = cost.frame(gather);
        let ms = |seconds: f64| Cell::measured(1e3 * seconds);
        table.push([
            printed.model.into(),
            format!("{0} x {0}", printed.side).into(),
            ms(cost.light),
            ms(cost.levels),
            ms(gather),
            ms(cost.view),
            ms(frame),
            Cell::measured(1.0 / frame),
            ((DISPLAY / locked(frame)).round() as u32).into(),
            (printed.periods() as u32).into(),
        ]);
    }
    table
}

/// Size of the window in pixels. The paper does not state it.
pub(super) const WINDOW: [u32; 2] = [512, 512];

/// Modelled seconds of the passes of a frame, without pass 2: pass 1, the map's levels, and pass 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameCost {
    pub(super) light: f64,
    pub(super) levels: f64,
    pub(super) view: f64,
}

impl FrameCost {
    /// Total seconds of a frame, with its pass 2.
    pub(super) fn frame(&self, gather: f64) -> f64 {
        self.light + self.levels + gather + self.view
    }
}

/// Cost of a model's frame on a card, with fixed links and an 8-bit map.
pub(super) fn cost(card: &'static str, mesh: &Mesh, side: u32) -> Result<FrameCost, StudyError> {
    let profile = Profile::named(card)?;
    let atlas = Atlas::new(mesh, side).on(card)?;
    let kernel = ViewKernel { transmittance: EyeTransmittance::Table, direct: DirectLight::ByVertex };
    let shown = MeshView { format: TexelFormat::Bgra8, ..camera(mesh).on(card)?.into() };
    let shown = View { kernel, diffuse: [0.1; 3], ..View::scattered(shown) };
    let sun = Light::Directional { towards: [1.0, -2.0, 3.0], irradiance: [1.0; 3] };
    // Pass 3 begins with the state that pass 2 leaves.
    let mut machine = loaded(profile.clone(), CardModel::new(&atlas), VARIANTS[0]).on(card)?;
    machine.record(true);
    machine.light(&[sun]).on(card)?;
    machine.view_texels(&shown).on(card)?;
    let [light, levels, _, view] =
        pass_times(&profile, &machine.take_log()).map_err(no_time)?.map(|pass| pass.time.seconds());
    Ok(FrameCost { light, levels, view })
}

/// Camera whose window is filled by the bounding sphere of a mesh.
fn camera(mesh: &Mesh) -> Result<Camera, Box<dyn std::error::Error + Send + Sync>> {
    let [low, high] = mesh.bounds().ok_or("a mesh without faces")?;
    let middle = [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0);
    let radius =
        [0, 1, 2].map(|i| f64::from(high[i] - low[i]) / 2.0).iter().map(|half| half * half).sum::<f64>().sqrt();
    // Half the height of the window is a quarter of its distance.
    let distance = radius * 17.0_f64.sqrt();
    let eye = [middle[0], middle[1] - distance as f32, middle[2]];
    Ok(Camera::new(eye, middle, [0.0, 0.0, 1.0], 0.25, WINDOW[0], WINDOW[1])?)
}
