//! Section 6.1: figures of the read-back bottleneck.

use refsim::device::Profile;

use super::pipeline::model;
use super::{Dependence, EntryFindings, Method, Shared, StudyError, figure, paper_row, paragraph, pipeline, printed};
use crate::ray_engine::model::CostRates;
use crate::report::{Cell, Table};

/// Bytes read back per ray: a triangle id, or an id with three barycentric coordinates.
pub(super) const GAMMAS: [f64; 2] = [4.0, 16.0];
/// Number of triangles in the paper's example.
pub(super) const TEN: f64 = 10.0;
/// Cards of the paper: GeForce3 and GeForce4 Ti4600.
pub(super) const CARDS: [&str; 2] = ["nv20", "nv25"];
/// Printed millions of tests per second with ten triangles, in the text under Figure 7, by card.
pub(super) const TEN_TRIANGLES: [&str; 2] = ["ray-engine/ten-triangles-geforce3", "ray-engine/ten-triangles-geforce4"];
pub(super) const MEGA: f64 = 1e6;

/// Rates of equation 11 on a card, with the fill rate that the paper measured or implies.
pub(super) fn rates(device: &str) -> Result<CostRates, StudyError> {
    let profile = Profile::named(device)?;
    let (rates, bus) = (&profile.rates, &profile.bus);
    Ok(CostRates {
        fill_pixels_per_s: figure(&profile, "rates.measured_fill_pixels_per_s", rates.measured_fill_pixels_per_s)?,
        readback_bytes_per_s: figure(&profile, "bus.readback_bytes_per_s", bus.readback_bytes_per_s)?,
    })
}

const READ_BACK: &str = "250 MB/s (read-back)";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let mut worked = Table::of(
        "Worked examples, in millions of results or pixels per second",
        "figure device printed equation pipeline",
    );
    let mut rows = Vec::new();
    for (id, gamma) in ["ray-engine/results-4", "ray-engine/results-16"].into_iter().zip(GAMMAS) {
        let equation = rates("nv20")?.results_per_s(gamma) / MEGA;
        worked.push(line(id, "nv20", [equation, pipeline::results_per_s("nv20", gamma)? / MEGA])?);
    }
    for (id, device) in ["ray-engine/fill-geforce3", "ray-engine/fill-geforce4"].into_iter().zip(CARDS) {
        let drawn = pipeline::dual_textured(device)?.pixels_per_s() / MEGA;
        worked.push(line(id, device, [rates(device)?.fill_pixels_per_s / MEGA, drawn])?);
        if device == "nv20" {
            rows.push(super::drawn(id, device, drawn)?);
        }
    }
    for (device, id) in CARDS.into_iter().zip(TEN_TRIANGLES) {
        let drawn = pipeline::tests_per_s(device, TEN, GAMMAS[0])? / MEGA;
        worked.push(line(id, device, [rates(device)?.tests_per_s(TEN, GAMMAS[0]) / MEGA, drawn])?);
        rows.push(paper_row(id, (device, Method::Pipeline), (drawn, Dependence::Predicted { from: READ_BACK }))?);
    }
    let pixel = pipeline::dual_textured("nv20")?;
    let bytes =
        model("nv20")?.clocks(&pixel.record).traffic.total() as f64 / pixel.record.counts.fragments.generated as f64;
    Ok(EntryFindings::new(
        [
            "Equation 11: R rays and T triangles take T R / fill + R gamma / readback seconds, with gamma bytes per ray. The paper prints the \
             GeForce3's fill and read-back rates. The GeForce4's fill rate follows from its tests per second at ten triangles, if it reads back as fast \
             as the GeForce3. Each printed figure has one row: our value comes from the pipeline model if the figure can be drawn, and from the \
             equation if the figure is a quotient of printed values. The table has both."
                .into(),
            paragraph(
                "The pipeline model uses neither of the fill rates, but reads back at the printed rate. It draws \
                 screen-filling quads with two textures of the screen's size (each texel is read once per quad), a \
                 depth test, and depth and colour writes. The bottleneck of such a draw is {}: {} bytes per pixel.",
                &[&pixel.cost.bottleneck.to_string(), &bytes],
            ),
        ],
        rows,
        [],
        [worked],
    ))
}

/// Row for a printed figure, with the values from the equation and from the pipeline model.
fn line(id: &str, device: &str, ours: [f64; 2]) -> Result<[Cell; 5], StudyError> {
    let figure = printed(id)?;
    let [equation, pipeline] = ours.map(|value| figure.beside(value));
    Ok([figure.what.as_str().into(), device.into(), figure.cell(), equation, pipeline])
}
