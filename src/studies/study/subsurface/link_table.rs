//! Links as a table: where a texel gathers from, and how much.

use super::{GatherWay, Parameters};
use crate::atlas::Atlas;
use crate::report::{Cell, Table};
use crate::study::StudyError;
use crate::subsurface::factor::ClusterId;
use crate::subsurface::links::Links;

/// The most rows: 16 links of 128 x 128 texels.
const MAX_ROWS: u64 = 1 << 18;

/// A link of a texel.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkRow {
    /// The choice of links.
    pub links: String,
    /// Column and row of the texel.
    pub texel: [u32; 2],
    /// The cluster that it leads to.
    pub cluster: ClusterId,
    /// Factors, F_iC of equation 10: red, green and blue. A scalar factor serves all three.
    pub factor: [f64; 3],
    /// Distance in mm between the mean points of texel and cluster.
    pub distance: f64,
}

/// Checks the number of rows of all ways before links are computed.
pub(super) fn require_rows(parameters: &Parameters) -> Result<(), StudyError> {
    let texels = match parameters.options.probes.len() {
        0 => u64::from(parameters.options.side).pow(2),
        probes => probes as u64,
    };
    let ways = parameters.ways.iter().enumerate();
    let first = ways.filter(|(at, way)| !parameters.ways[..*at].iter().any(|other| other.has_links_of(way)));
    let per_texel: u64 = first.map(|(_, way)| way.choice.per_texel(parameters.options.side)).sum();
    let rows = texels.saturating_mul(per_texel);
    if parameters.options.link_table && rows > MAX_ROWS {
        let what = format!("expected at most {MAX_ROWS} links to list, found {rows}");
        let help = "name texels by `--probe`, or ask for fewer `--links` or a smaller `--atlas`";
        return Err(StudyError::new("subsurface::link_rows", what).with_help(help));
    }
    Ok(())
}

/// The links of the probes' texels, or of all if there are no probes. Adaptive links that a texel does not use have the
/// factor 0 and are left out.
pub(super) fn rows(
    atlas: &Atlas,
    (parameters, way): (&Parameters, GatherWay),
    links: &Links,
    probe_texels: &[usize],
) -> Vec<LinkRow> {
    let (name, side) = (way.links_label(parameters.options.side), atlas.side());
    let of_texel = |texel: usize| {
        let at = [texel as u32 % side, texel as u32 / side];
        let row = |(cluster, factors): (ClusterId, &[f32])| {
            let ClusterId { level, y, x } = cluster;
            let factor = [0, 1, 2].map(|channel: usize| f64::from(factors[channel % factors.len()]));
            let apart = atlas.cluster(level, x, y).point - atlas.texels()[texel].point;
            let distance = apart.length() * parameters.options.mm_per_unit;
            LinkRow { links: name.clone(), texel: at, cluster, factor, distance }
        };
        links.of(at).filter(|(_, factors)| factors.iter().any(|&factor| factor > 0.0)).map(row).collect::<Vec<_>>()
    };
    match probe_texels {
        [] => (0..atlas.texels().len()).flat_map(of_texel).collect(),
        probes => probes.iter().copied().flat_map(of_texel).collect(),
    }
}

/// The table of all links.
pub(super) fn table(links: &[LinkRow]) -> Table {
    let mut table = Table::of(
        "Links: clusters by level, 0 the finest, column and row; factors; distances between mean points",
        "links texel_x texel_y level cluster_x cluster_y factor_r factor_g factor_b distance_mm",
    );
    for LinkRow { links, texel, cluster, factor, distance } in links {
        let places = [texel[0], texel[1], cluster.level, cluster.x, cluster.y].map(Cell::from);
        let numbers = factor.iter().chain([distance]).map(|&value| Cell::from(value));
        table.push([Cell::from(links.as_str())].into_iter().chain(places).chain(numbers));
    }
    table
}
