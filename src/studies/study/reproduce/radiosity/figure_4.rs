//! Figure 4: the time of an iteration by the size of the matrix, on the card and on the host.

use super::{CARD, EntryFindings, PATCHES, PrintedRates, Shared, Storage, StudyError, host, iteration, printed_value};
use crate::elementary::ln;
use crate::radiosity::packing::Packing;
use crate::report::{Chart, NamedChart, Scale, Series};
use crate::study::reproduce::{Dependence, Method, number, paper_row, paragraph};

/// Numbers of patches; the card of the paper had textures of at most 2048 texels per side.
const SIZES: [u32; 7] = [128, 256, 384, 512, 1024, 1540, 2048];

/// Milliseconds per iteration at one size.
struct Point {
    patches: u32,
    rgb: f64,
    luminance: f64,
    host: f64,
}

impl Point {
    fn at(patches: u32) -> Result<Self, StudyError> {
        let card = |packing| Ok::<f64, StudyError>(1e3 / iteration(patches, packing, Storage::Fp32)?.per_s);
        Ok(Self {
            patches,
            rgb: card(Packing::Rgb)?,
            luminance: card(Packing::Luminance)?,
            host: 1e3 * host::iteration(patches)?,
        })
    }

    fn elements(&self) -> f64 {
        f64::from(self.patches) * f64::from(self.patches)
    }
}

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let points = SIZES.into_iter().map(Point::at).collect::<Result<Vec<_>, _>>()?;
    // "We believe the GPU curve overtakes the CPU curve for matrices larger than 2000 elements".
    let largest = &points[points.len() - 1];
    let ours = (largest.host / largest.rgb, Dependence::Predicted { from: "40 iterations/s of the host" });
    let row = paper_row("radiosity/host-over-card", (CARD, Method::Pipeline), ours)?;
    let line = |label: &str, of: fn(&Point) -> f64| Series {
        label: label.to_owned(),
        points: std::iter::once((0.0, 0.0)).chain(points.iter().map(|p| (p.elements() / 1e6, of(p)))).collect(),
    };
    let size = f64::from(PATCHES) * f64::from(PATCHES) / 1e6;
    let printed = PrintedRates::both()?;
    let stated = |(label, rates): (&str, &PrintedRates)| Series {
        label: label.to_owned(),
        points: vec![(size, 1e3 / rates.per_s)],
    };
    let chart = Chart {
        title: "Iteration time by matrix size".to_owned(),
        x: "M elements, N x N".to_owned(),
        y: "ms".to_owned(),
        // On linear axes, all but the largest sizes would be in one corner.
        x_scale: Scale::Logarithmic,
        y_scale: Scale::Logarithmic,
        lines: vec![
            line("nv35, one texel per element", |p| p.rgb),
            line("nv35, four elements per texel", |p| p.luminance),
            line("Athlon 2800+, Gauss-Seidel", |p| p.host),
        ],
        printed: ["printed: nv35", "printed: Athlon 2800+"].into_iter().zip(&printed).map(stated).collect(),
        ..Chart::default()
    };
    Ok(EntryFindings {
        text: text(&points, &printed)?,
        rows: vec![row],
        questions: vec![
            "why the host's time would grow faster than the number of bytes that it reads, as the authors' estimate requires.",
        ],
        charts: vec![NamedChart {
            name: "radiosity-figure-4".into(),
            chart,
            caption: "Figure 4 of the radiosity paper. Only the printed rates are known; they are shown at the inferred number of patches. The \
                      card's time is linear in the number of matrix elements; the host's curve bends upward where the matrix exceeds its cache."
                .into(),
        }],
        ..EntryFindings::default()
    })
}

/// Number of patches from which the host is slower, interpolated linearly between two of the sizes.
fn crossing(points: &[Point], card: fn(&Point) -> f64) -> Option<f64> {
    let ahead = |p: &Point| p.host / card(p) - 1.0;
    points.windows(2).find(|two| ahead(&two[0]) < 0.0 && ahead(&two[1]) >= 0.0).map(|two| {
        let share = ahead(&two[0]) / (ahead(&two[0]) - ahead(&two[1]));
        f64::from(two[0].patches) + share * f64::from(two[1].patches - two[0].patches)
    })
}
const HOW: &str = "The paper prints no points of the figure, only the rates in the text. The card's times come from \
    the pipeline model. The host's times follow from its clock, its cache and its printed rate: each element costs an \
    addition that waits for the previous addition and, if the matrix exceeds the cache, a share of a cache line from \
    memory.";
const BELIEF: &str = "In this model the card overtakes the host {} with one texel per element, and {} with four elements per texel. The authors \
    expect this above {} patches. For that, by their printed rates, the host's time would have to grow with the power {} of the number of patches, \
    from {} patches to that number: faster than the number of bytes that the host reads.";

fn text(points: &[Point], [card, host]: &[PrintedRates; 2]) -> Result<Vec<String>, StudyError> {
    let believed = printed_value("radiosity/crossing")?;
    let largest = points.last().map_or(0, |point| point.patches);
    let said = |card: fn(&Point) -> f64| match crossing(points, card) {
        Some(patches) => format!("at about {} patches", number(patches, 0)),
        None => format!("at no size up to {largest} patches"),
    };
    // From the printed rates: the exponent by which the host's time must grow to equal the card's at the crossing of
    // the curves.
    let n = believed / f64::from(PATCHES);
    let needed = ln(host.per_s / card.per_s * n * n) / ln(n);
    let (rgb, luminance) = (said(|p| p.rgb), said(|p| p.luminance));
    Ok(vec![HOW.into(), paragraph(BELIEF, &[&rgb, &luminance, &believed, &(needed, 1), &PATCHES])])
}
