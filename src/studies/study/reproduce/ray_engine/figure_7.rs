//! Figure 7: tests per second by the number of triangles, and the minimum number for which a card is faster than the
//! host.

use super::equation_11::{CARDS, GAMMAS, MEGA, TEN, TEN_TRIANGLES, rates};
use super::{EntryFindings, Shared, StudyError, pipeline, printed_value};
use crate::ray_engine::model::CostRates;
use crate::report::{Cell, Chart, NamedChart, Series, Table};

const NAMES: [&str; 2] = ["GeForce3", "GeForce4 Ti4600"];
/// Maximum number of triangles in the plot.
const PLOTTED: u32 = 50;

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let mut limits = Table::of(
        "Break-even number of triangles T_min, by the host's tests per second",
        "device gamma_B half_rate_T T_min_20M T_min_40M T_min_80M T_min_200M",
    );
    // "Doubling the CPU numbers", and a faster host of later years.
    let most = printed_value("ray-engine/host-most")? * MEGA;
    let hosts = [printed_value("ray-engine/host-least")? * MEGA, most, 2.0 * most, 5.0 * most];
    let mut charts = Vec::new();
    for gamma in GAMMAS {
        let mut lines = Vec::new();
        for (device, title) in CARDS.into_iter().zip(NAMES) {
            let card = rates(device)?;
            let pipeline = pipeline_rates(device)?;
            let least = hosts.map(|host| card.least_triangles(host, gamma).into());
            limits.push(
                [device.into(), gamma.into(), Cell::measured(card.half_rate_triangles(gamma))].into_iter().chain(least),
            );
            lines.push(line(format!("{title}, equation 11"), &card, gamma));
            lines.push(line(format!("{title}, pipeline model"), &pipeline, gamma));
        }
        charts.push(chart(gamma, lines)?);
    }
    Ok(EntryFindings {
        text: vec![
            "In the paper's figure, rays return only an id; our charts also show rays that return barycentric coordinates. Only two points of the curves \
             are printed, at ten triangles; their rows are in the entry of section 6.1. T_min is the least number of triangles at which the card, by \
             equation 11, is not slower than the host. At half_rate_T triangles, drawing and read-back take equally long."
                .into(),
        ],
        tables: vec![limits],
        charts,
        ..EntryFindings::default()
    })
}

/// Equation 11 with the pipeline model's own fill and read-back rates.
fn pipeline_rates(device: &str) -> Result<CostRates, StudyError> {
    Ok(CostRates {
        fill_pixels_per_s: pipeline::dual_textured(device)?.pixels_per_s(),
        readback_bytes_per_s: pipeline::results_per_s(device, 1.0)?,
    })
}

fn line(label: String, card: &CostRates, gamma: f64) -> Series {
    let point = |t: u32| (f64::from(t), card.tests_per_s(f64::from(t), gamma) / MEGA);
    Series { label, points: std::iter::once((0.0, 0.0)).chain((1..=PLOTTED).map(point)).collect() }
}

fn chart(gamma: f64, lines: Vec<Series>) -> Result<NamedChart, StudyError> {
    // The text gives the points only for the id alone.
    let shown = if gamma == GAMMAS[0] { &TEN_TRIANGLES[..] } else { &[] };
    let points = shown.iter().map(|id| Ok((TEN, printed_value(id)?))).collect::<Result<_, StudyError>>()?;
    Ok(NamedChart {
        name: format!("ray-engine-figure-7-gamma-{gamma}"),
        chart: Chart {
            title: format!("Ray-triangle tests, {gamma} bytes read back per ray"),
            x: "triangles T".to_owned(),
            y: "M tests/s".to_owned(),
            lines,
            printed: vec![Series { label: "printed".to_owned(), points }],
            ..Chart::default()
        },
        caption: format!(
            "Figure 7 of the Ray Engine paper for {gamma} bytes per ray, by equation 11 and pipeline model."
        ),
    })
}
