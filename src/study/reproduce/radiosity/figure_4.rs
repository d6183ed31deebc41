//! Figure 4: the time of an iteration by the size of the matrix, on the card and on the host.

use super::{Findings, PATCHES, ReproduceError, Storage, host, iteration};
use crate::geom::elementary::ln;
use crate::radiosity::packing::Packing;
use crate::report::{Cell, Chart, Line, Scale, Table};
use crate::study::reproduce::NamedChart;

/// Sizes; the card of the paper had textures of at most 2048 texels a side.
const SIZES: [u32; 7] = [128, 256, 384, 512, 1024, 1540, 2048];

/// Milliseconds of an iteration of some size.
struct Point {
    patches: u32,
    rgb: f64,
    luminance: f64,
    host: f64,
}

impl Point {
    fn at(patches: u32) -> Result<Self, ReproduceError> {
        let card = |packing| Ok::<f64, ReproduceError>(1e3 / iteration(patches, packing, Storage::Fp32)?.per_s);
        Ok(Self {
            patches,
            rgb: card(Packing::Rgb)?,
            luminance: card(Packing::Luminance)?,
            host: 1e3 * host::iteration(patches),
        })
    }

    fn elements(&self) -> f64 {
        f64::from(self.patches) * f64::from(self.patches)
    }

    /// Nanoseconds an element of the matrix.
    fn each(&self, ms: f64) -> f64 {
        ms * 1e6 / self.elements()
    }
}

pub(in crate::study::reproduce) fn findings() -> Result<Findings, ReproduceError> {
    let points = SIZES.into_iter().map(Point::at).collect::<Result<Vec<_>, _>>()?;
    let line = |label: &str, of: fn(&Point) -> f64| Line {
        label: label.to_owned(),
        points: std::iter::once((0.0, 0.0)).chain(points.iter().map(|p| (p.elements() / 1e6, of(p)))).collect(),
    };
    let chart = Chart {
        title: "An iteration by the size of the matrix".to_owned(),
        x: "M elements, N x N".to_owned(),
        y: "ms".to_owned(),
        y_scale: Scale::Linear,
        lines: vec![
            line("nv35, one texel an element", |p| p.rgb),
            line("nv35, four elements a texel", |p| p.luminance),
            line("Athlon 2800+, Gauss-Seidel", |p| p.host),
        ],
    };
    Ok(Findings {
        text: text(&points),
        rows: Vec::new(),
        tables: vec![table(&points)],
        charts: vec![NamedChart {
            name: "radiosity-figure-4",
            chart,
            caption: "Figure 4 of the radiosity paper: the card's time is a straight line over the elements of the matrix, the host's bends \
                      upward where the matrix leaves its cache."
                .to_owned(),
        }],
    })
}

fn table(points: &[Point]) -> Table {
    let mut table = Table::new(
        "Milliseconds of an iteration, and nanoseconds an element",
        &["patches", "rgb_ms", "rgb_ns", "luminance_ms", "luminance_ns", "host_ms", "host_ns", "host_over_rgb"],
    );
    let rounded = |x: f64| Cell::Real((x * 1000.0).round() / 1000.0);
    for p in points {
        table.push([
            p.patches.into(),
            rounded(p.rgb),
            rounded(p.each(p.rgb)),
            rounded(p.luminance),
            rounded(p.each(p.luminance)),
            rounded(p.host),
            rounded(p.each(p.host)),
            rounded(p.host / p.rgb),
        ]);
    }
    table
}

/// Where the host falls behind, between two of the sizes, by a straight line between them.
fn crossing(points: &[Point], card: fn(&Point) -> f64) -> Option<f64> {
    let ahead = |p: &Point| p.host / card(p) - 1.0;
    points.windows(2).find(|two| ahead(&two[0]) < 0.0 && ahead(&two[1]) >= 0.0).map(|two| {
        let share = ahead(&two[0]) / (ahead(&two[0]) - ahead(&two[1]));
        f64::from(two[0].patches) + share * f64::from(two[1].patches - two[0].patches)
    })
}

fn text(points: &[Point]) -> Vec<String> {
    let said = |packing: &str, card: fn(&Point) -> f64| match crossing(points, card) {
        Some(patches) => format!("with {packing} the card overtakes the host at about {patches:.0} patches"),
        None => format!("with {packing} the card does not overtake the host up to 2048 patches"),
    };
    // From the printed rates: how fast the host's time has to grow to be the card's at 2000 patches.
    let n = 2000.0 / f64::from(PATCHES);
    let needed = ln(40.0 / 29.7 * n * n) / ln(n);
    vec![
        "The figure's points are not printed, so no row is judged. The card's times are the pipeline model's. The host's follow from its \
         clock, its cache and the one printed rate: an element costs an addition that waits for the last, and a share of a cache line \
         where the matrix does not fit."
            .to_owned(),
        format!(
            "In this model {}, and {}. The authors believe that it happens above 2000; from their printed rates the host's time would have to \
             grow with the {needed:.1}th power of N between {PATCHES} and 2000, faster than the bytes that it reads. A cache that is \
             too small does not do that; what does, they do not say.",
            said("one texel an element", |p| p.rgb),
            said("four elements a texel", |p| p.luminance),
        ),
    ]
}
