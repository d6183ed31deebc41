//! Section 6.1: the read-back bottleneck, in numbers.

use refsim::device::Profile;

use super::{Findings, Modelled, Printed, ReproduceError, Row, figure, pipeline};
use crate::ray_engine::model::CostRates;

/// Bytes a ray: a triangle id; an id with three barycentric coordinates.
pub(super) const GAMMAS: [f64; 2] = [4.0, 16.0];
/// Triangles of the paper's example.
const TEN: f64 = 10.0;
/// In millions.
pub(super) const MEGA: f64 = 1e6;

/// The rates of equation 11 on a card: fill as measured, or implied, by the paper.
pub(super) fn rates(device: &str) -> Result<CostRates, ReproduceError> {
    let profile = Profile::named(device)?;
    let (rates, bus) = (&profile.rates, &profile.bus);
    Ok(CostRates {
        fill_pixels_per_s: figure(&profile, "rates.measured_fill_pixels_per_s", rates.measured_fill_pixels_per_s)?,
        readback_bytes_per_s: figure(&profile, "bus.readback_bytes_per_s", bus.readback_bytes_per_s)?,
    })
}

const fn printed(value: f64, decimals: usize, unit: &'static str) -> Printed {
    Printed { value, decimals, unit, place: "section 6.1" }
}

pub(super) fn findings() -> Result<Findings, ReproduceError> {
    let (geforce3, geforce4) = (rates("nv20")?, rates("nv25")?);
    let mut rows = Vec::new();
    for (gamma, value, decimals) in [(GAMMAS[0], 62.5, 1), (GAMMAS[1], 15.6, 1)] {
        rows.push(Row {
            what: format!("results read back, {gamma} B each"),
            device: "nv20",
            printed: printed(value, decimals, "M/s"),
            rates: Modelled::predicted(geforce3.results_per_s(gamma) / MEGA),
            pipeline: Modelled::predicted(pipeline::results_per_s("nv20", gamma)? / MEGA),
            note: String::new(),
        });
    }
    rows.push(Row {
        what: "fill rate, two textures a pixel".to_owned(),
        device: "nv20",
        printed: printed(390.0, 0, "M/s"),
        rates: Modelled::calibrated(geforce3.fill_pixels_per_s / MEGA, "this figure"),
        pipeline: Modelled::predicted(pipeline::dual_textured("nv20")?.pixels_per_s() / MEGA),
        note: String::new(),
    });
    rows.push(Row {
        what: "fill rate, two textures a pixel (implied by the 286 M/s below)".to_owned(),
        device: "nv25",
        printed: printed(527.3, 1, "M/s"),
        rates: Modelled::calibrated(geforce4.fill_pixels_per_s / MEGA, "286 M/s at ten triangles"),
        pipeline: Modelled::predicted(pipeline::dual_textured("nv25")?.pixels_per_s() / MEGA),
        note: String::new(),
    });
    rows.push(Row {
        what: "tests, ten triangles, 4 B a ray".to_owned(),
        device: "nv20",
        printed: printed(240.0, 0, "M/s"),
        rates: Modelled::predicted(geforce3.tests_per_s(TEN, GAMMAS[0]) / MEGA),
        pipeline: Modelled::predicted(pipeline::tests_per_s("nv20", TEN, GAMMAS[0])? / MEGA),
        note: String::new(),
    });
    rows.push(Row {
        what: "tests, ten triangles, 4 B a ray".to_owned(),
        device: "nv25",
        printed: printed(286.0, 0, "M/s"),
        rates: Modelled::calibrated(
            geforce4.tests_per_s(TEN, GAMMAS[0]) / MEGA,
            "this figure, by the implied fill rate",
        ),
        pipeline: Modelled::predicted(pipeline::tests_per_s("nv25", TEN, GAMMAS[0])? / MEGA),
        note: String::new(),
    });
    Ok(Findings {
        text: vec![
            "Equation 11 is seconds = T R / fill + R gamma / readback. The GeForce3's fill and read-back rates are printed; the \
             GeForce4's fill rate follows from its 286 M tests a second, if it reads back as fast as the GeForce3."
                .to_owned(),
            "The pipeline model knows neither fill rate. It draws screen-filling quads with two 32-bit textures of the screen's \
             size (nearest, each texel read once a quad), a depth test and depth and colour writes, and finds memory the \
             narrowest place: 20 bytes a pixel."
                .to_owned(),
        ],
        rows,
        tables: vec![pipeline::cost_table(&["nv20", "nv25"])?],
        charts: Vec::new(),
    })
}
