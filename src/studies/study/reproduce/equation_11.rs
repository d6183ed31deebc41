//! Section 6.1: the read-back bottleneck, in numbers.

use refsim::device::Profile;

use super::pipeline::model;
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Standing, figure, number,
    pipeline,
};
use crate::ray_engine::model::CostRates;

/// Bytes read back per ray: a triangle id; an id with three barycentric coordinates.
pub(super) const GAMMAS: [f64; 2] = [4.0, 16.0];
/// Number of triangles in the paper's example.
pub(super) const TEN: f64 = 10.0;
/// Printed millions of tests per second at ten triangles, in the text under figure 7.
pub(super) const TEN_TRIANGLES: [(&str, f64); 2] = [("nv20", 240.0), ("nv25", 286.0)];
/// Numbers per million.
pub(super) const MEGA: f64 = 1e6;

/// Rates of equation 11 on a card, with the fill rate measured in the paper, or implied by it.
pub(super) fn rates(device: &str) -> Result<CostRates, ReproduceError> {
    let profile = Profile::named(device)?;
    let (rates, bus) = (&profile.rates, &profile.bus);
    Ok(CostRates {
        fill_pixels_per_s: figure(&profile, "rates.measured_fill_pixels_per_s", rates.measured_fill_pixels_per_s)?,
        readback_bytes_per_s: figure(&profile, "bus.readback_bytes_per_s", bus.readback_bytes_per_s)?,
    })
}

const PLACE: &str = "section 6.1";
const READ_BACK: &str = "250 MB/s (read-back)";
const RATES: &str = "390 M/s (fill rate), 250 MB/s (read-back)";
/// Derivation of the GeForce4's fill rate.
const IMPLIED: &str = "equation 11 solved for the fill rate: T / (T / 286 M/s - gamma / 250 MB/s), T = 10, gamma = 4 B, if it reads back like a GeForce3";

pub(super) fn findings() -> Result<EntryFindings, ReproduceError> {
    let mut rows = Vec::new();
    for (gamma, value) in GAMMAS.into_iter().zip([62.5, 15.6]) {
        rows.extend(read_back(gamma, PaperFigure::printed(value, 1, "M/s", PLACE))?);
    }
    rows.extend(fill("nv20", PaperFigure::printed(390.0, 0, "M/s", PLACE), "this figure")?);
    let [_, ti4600] = TEN_TRIANGLES;
    let implied = CostRates::implied_fill(ti4600.1 * MEGA, TEN, GAMMAS[0], rates("nv25")?.readback_bytes_per_s) / MEGA;
    let implied =
        PaperFigure { origin: Origin::Implied(IMPLIED.to_owned()), ..PaperFigure::printed(implied, 1, "M/s", PLACE) };
    rows.extend(fill("nv25", implied, "286 M/s at ten triangles, which implies it")?);
    for (device, value) in TEN_TRIANGLES {
        rows.extend(ten_triangles(device, PaperFigure::printed(value, 0, "M/s", PLACE))?);
    }
    let pixel = pipeline::dual_textured("nv20")?;
    let bytes =
        model("nv20")?.clocks(&pixel.record).traffic.total() as f64 / pixel.record.counts.fragments.generated as f64;
    Ok(EntryFindings {
        text: vec![
            "Equation 11 is seconds = T R / fill + R gamma / readback. The GeForce3's fill and read-back rates are printed; the \
             GeForce4's fill rate follows from its tests a second at ten triangles, if it reads back as fast as the GeForce3."
                .into(),
            Prose::new(
                "The pipeline model knows neither fill rate, but reads back at the printed rate. It draws screen-filling quads with two textures of \
                 the screen's size (each texel read once a quad), a depth test and depth and colour writes, and finds {} the \
                 narrowest place: {} bytes a pixel.",
                [pixel.cost.bottleneck.to_string(), number(bytes, 0)],
            ),
        ],
        rows,
        tables: vec![pipeline::cost_table(&["nv20", "nv25"])?],
        ..EntryFindings::default()
    })
}

/// Rows on read-back: the equation's quotient of printed values, and the pipeline's bus, which has the printed rate.
fn read_back(gamma: f64, target: PaperFigure) -> Result<[PaperRow; 2], ReproduceError> {
    let what = format!("results read back, {gamma} B each");
    let equation = (rates("nv20")?.results_per_s(gamma) / MEGA, Standing::Predicted { from: READ_BACK });
    let pipeline = (pipeline::results_per_s("nv20", gamma)? / MEGA, Standing::Calibrated { on: READ_BACK });
    Ok([
        PaperRow::new(what.clone(), ("nv20", Method::Equation), target.clone(), equation, Bound::Print),
        PaperRow::new(what, ("nv20", Method::Pipeline), target, pipeline, Bound::PREDICTION),
    ])
}

/// Rows on the fill rate: the equation's input, and the pipeline's prediction.
fn fill(device: &'static str, target: PaperFigure, on: &'static str) -> Result<[PaperRow; 2], ReproduceError> {
    let what = "fill rate, two textures a pixel";
    let equation = (rates(device)?.fill_pixels_per_s / MEGA, Standing::Calibrated { on });
    let pipeline = (pipeline::dual_textured(device)?.pixels_per_s() / MEGA, Standing::Predicted { from: "" });
    Ok([
        PaperRow::new(what, (device, Method::Equation), target.clone(), equation, Bound::Print),
        PaperRow::new(what, (device, Method::Pipeline), target, pipeline, Bound::PREDICTION),
    ])
}

/// Rows on ten triangles: equation 11 on both cards, the GeForce4's with the fill rate implied by this value; and the
/// pipeline.
fn ten_triangles(device: &'static str, target: PaperFigure) -> Result<[PaperRow; 2], ReproduceError> {
    let what = "tests, ten triangles, 4 B a ray";
    let standing = if device == "nv20" {
        Standing::Predicted { from: RATES }
    } else {
        Standing::Calibrated { on: "this figure, by the fill rate that it implies" }
    };
    let equation = (rates(device)?.tests_per_s(TEN, GAMMAS[0]) / MEGA, standing);
    let pipeline = pipeline::tests_per_s(device, TEN, GAMMAS[0])? / MEGA;
    let pipeline = (pipeline, Standing::Predicted { from: READ_BACK });
    Ok([
        PaperRow::new(what, (device, Method::Equation), target.clone(), equation, Bound::Print),
        PaperRow::new(what, (device, Method::Pipeline), target, pipeline, Bound::PREDICTION),
    ])
}
