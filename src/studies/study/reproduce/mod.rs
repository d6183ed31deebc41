//! Reproduction of the papers' printed values: one file per entry, each a list of rows with tables and charts.
//!
//! The papers' values, their origins and the bounds of those that are judged are data, stated beforehand ([`papers`]).
//! Every row has one of them, and ours with the printed values that it depends on, which determine the verdict. A row
//! outside its bound counts as missed unless a sweep of the same run over something that the paper leaves open reaches
//! the printed value ([`Sweep`]), or the paper contradicts itself ([`Contradiction`]).
//!
//! Rows that depend on the size of models are those of recorded runs at full size ([`EntryRecord`]).

mod all_frequency;
mod bi_scale;
mod cpca;
mod entry;
mod equation_11;
mod error;
mod figure_7;
mod model_size;
mod overview;
mod paper;
mod pipeline;
mod prose;
#[cfg(test)]
mod quick_rows;
mod radeon_8500;
mod radiosity;
mod record;
pub mod report;
mod row;
mod schedule;
mod shared;
mod sky;
mod subsurface;
mod summary;
mod tables;
mod vertex_variant;

use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study};

use crate::study::StudyError;
pub use entry::{EntryChart, EntryFindings, ReproduceEntry, Reproduced};
use error::figure;
pub use model_size::ModelSize;
pub use paper::{Paper, papers, printed};
use paper::{row as paper_row, value as printed_value};
pub use pipeline::{DUAL_TEXTURED, screen_quad};
pub use prose::{Prose, number};
pub use record::{EntryRecord, RecordError, RecordMade, RecordStatus, SmokeRun, StaleRecord, recorded, sized};
pub use row::{
    Bound, Contradiction, Explanation, Judgement, Method, MissClass, Origin, PaperFigure, PaperRow, RowSource,
    RowVerdict, Setting, Standing, Sweep,
};
pub use schedule::reproduce;
pub use summary::ReproducedPaper;

/// Parameters of the study.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// Entries to reproduce.
    pub entries: Vec<ReproduceEntry>,
    /// Size of stand-in models.
    pub models: ModelSize,
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        Ok(report::findings(&reproduce(&self.entries, self.models, progress)?))
    }

    /// Entries choose their devices themselves, and nothing is random.
    fn provenance(&self, provenance: Provenance) -> Provenance {
        provenance
    }
}

/// All entries, in the order of the papers.
pub const ENTRIES: &[ReproduceEntry] = &[
    ReproduceEntry {
        id: "radeon-8500",
        title: "114 M tests a second on a Radeon 8500 (Ray Engine, section 4.4)",
        work: |_| radeon_8500::findings(),
    },
    ReproduceEntry {
        id: "vertex-variant",
        title: "4.1 M tests a second in a vertex program (Ray Engine, section 3.4)",
        work: |_| vertex_variant::findings(),
    },
    ReproduceEntry {
        id: "equation-11",
        title: "Fill rate, read-back and their worked numbers (Ray Engine, section 6.1)",
        work: |_| equation_11::findings(),
    },
    ReproduceEntry {
        id: "figure-7",
        title: "Tests a second by the number of triangles (Ray Engine, figure 7)",
        work: |_| figure_7::findings(),
    },
    ReproduceEntry {
        id: "ray-engine-tables-1-2",
        title: "Rays a second of five scenes, and the share of them on the card (Ray Engine, tables 1 and 2)",
        work: tables::table_1,
    },
    ReproduceEntry {
        id: "ray-engine-table-3",
        title: "What the card, asynchronous read-back and an infinitely fast card bring (Ray Engine, table 3)",
        work: tables::table_3,
    },
    ReproduceEntry {
        id: "ray-engine-table-4",
        title: "The number of triangles that go to the card (Ray Engine, table 4)",
        work: tables::table_4,
    },
    ReproduceEntry {
        id: "ray-engine-table-5",
        title: "The number of rays that go to the card (Ray Engine, table 5)",
        work: tables::table_5,
    },
    ReproduceEntry {
        id: "radiosity-figure-3",
        title: "Jacobi and Gauss-Seidel, residual by iteration (radiosity, figure 3)",
        work: |_| radiosity::figure_3(),
    },
    ReproduceEntry {
        id: "radiosity-rates",
        title: "29.7 iterations and 141 MFLOP a second on a GeForce FX 5900 Ultra (radiosity, section 3.1)",
        work: |_| radiosity::rates(),
    },
    ReproduceEntry {
        id: "radiosity-figure-4",
        title: "The time of an iteration by the size of the matrix, on card and host (radiosity, figure 4)",
        work: |_| radiosity::figure_4(),
    },
    ReproduceEntry {
        id: "subsurface-counts",
        title: "Nodes, lookups, textures and instructions (subsurface scattering, sections 2.3 and 4.2)",
        work: subsurface::counts,
    },
    ReproduceEntry {
        id: "subsurface-table-1",
        title: "The time of pass 2, and frames locked to a display (subsurface scattering, table 1)",
        work: subsurface::table_1,
    },
    ReproduceEntry {
        id: "subsurface-frames",
        title: "Passes 1 and 3, frames on a display, 40 frames a second, nine seconds of links (subsurface scattering, sections 4.3 and 5, table 1, figure 7)",
        work: subsurface::frames,
    },
    ReproduceEntry {
        id: "cpca-appendix",
        title: "How wrong projections onto the hemisphere are (CPCA, appendix)",
        work: |_| cpca::appendix(),
    },
    ReproduceEntry {
        id: "cpca-section-6",
        title: "Numbers, registers and host work of compressed transfer (CPCA, section 6)",
        work: |_| cpca::section_6(),
    },
    ReproduceEntry { id: "cpca-figure-2", title: "Squared error by storage (CPCA, figure 2)", work: cpca::figure_2 },
    ReproduceEntry {
        id: "cpca-figures-3-4",
        title: "Static, iterative and adaptive compression (CPCA, figures 3 and 4)",
        work: cpca::figure_3,
    },
    ReproduceEntry {
        id: "cpca-figure-6",
        title: "Light of order 10 on two polygons (CPCA, figure 6)",
        work: cpca::figure_6,
    },
    ReproduceEntry {
        id: "cpca-figure-7",
        title: "Projections of exit radiance under colored lights (CPCA, figure 7)",
        work: cpca::figure_7,
    },
    ReproduceEntry {
        id: "cpca-figure-8",
        title: "Glossy Phong models, their speed and that of a newer card (CPCA, figure 8)",
        work: cpca::figure_8,
    },
    ReproduceEntry {
        id: "cpca-figure-9",
        title: "A sum of transfer in two environments (CPCA, figure 9)",
        work: cpca::figure_9,
    },
    ReproduceEntry {
        id: "cpca-figure-10",
        title: "Principal components, vector quantization, and both (CPCA, figure 10)",
        work: cpca::figure_10,
    },
    ReproduceEntry {
        id: "cpca-figure-11",
        title: "The number of vectors per cluster (CPCA, figure 11)",
        work: cpca::figure_11,
    },
    ReproduceEntry {
        id: "cpca-table-1",
        title: "Errors and frame rates of seven signals (CPCA, table 1)",
        work: cpca::table_1,
    },
    ReproduceEntry {
        id: "cpca-coherence",
        title: "Overdraw of clusters (CPCA, figure 5 and the table of section 7)",
        work: cpca::coherence,
    },
    ReproduceEntry {
        id: "all-frequency-counts",
        title: "Sizes, segments, equation 12 and what of Table 1 follows from sizes (all-frequency transfer, sections 1 and 4 to 7)",
        work: |_| all_frequency::counts(),
    },
    ReproduceEntry {
        id: "all-frequency-factors",
        title: "Errors of reflectance factors beside spherical harmonics (all-frequency transfer, section 3)",
        work: all_frequency::factors,
    },
    ReproduceEntry {
        id: "all-frequency-figures",
        title: "Baselines, terms, clusters, representatives, truncation and frame rates (all-frequency transfer, figures 1, 2 and 4 to 7)",
        work: all_frequency::figures,
    },
    ReproduceEntry {
        id: "all-frequency-table-1",
        title: "What clusters and codes leave of transfer (all-frequency transfer, table 1)",
        work: all_frequency::table_1,
    },
    ReproduceEntry {
        id: "bi-scale-counts",
        title: "Sizes of matrices and of biclusters (bi-scale transfer, sections III and IV, tables I and II)",
        work: |_| bi_scale::counts(),
    },
    ReproduceEntry {
        id: "bi-scale-figure-8",
        title: "More local directions (bi-scale transfer, figure 8)",
        work: bi_scale::figure_8,
    },
    ReproduceEntry {
        id: "bi-scale-figures",
        title: "Pictures by transfer and by rays, errors by cause (bi-scale transfer, figures 1, 3 and 5 to 8)",
        work: bi_scale::figures,
    },
    ReproduceEntry {
        id: "bi-scale-frames",
        title: "Frame rates, views alone and light too (bi-scale transfer, tables I and II)",
        work: bi_scale::frames,
    },
    ReproduceEntry {
        id: "bi-scale-table-1",
        title: "Biclusters of an armor, a chair and a temple (bi-scale transfer, table I)",
        work: bi_scale::table_1,
    },
    ReproduceEntry {
        id: "bi-scale-table-2",
        title: "Biclusters of bunnies (bi-scale transfer, table II)",
        work: bi_scale::table_2,
    },
    ReproduceEntry {
        id: "bi-scale-figure-6",
        title: "Biclusters beside clusters of rows, wavelets, harmonics and what is rejected (bi-scale transfer, sections II and IV-A, figure 6)",
        work: bi_scale::figure_6,
    },
];

/// Names of the entries.
pub fn names() -> Vec<&'static str> {
    ENTRIES.iter().map(|entry| entry.id).collect()
}

/// Returns the entries with these names, in the order of [`ENTRIES`]; all entries for no names.
///
/// # Errors
/// If no entry has a name.
pub fn choose(wanted: &[String]) -> Result<Vec<ReproduceEntry>, StudyError> {
    if let Some(found) = wanted.iter().find(|name| !names().contains(&name.as_str())) {
        return Err(error::unknown(found, &names()));
    }
    let chosen = |entry: &&ReproduceEntry| wanted.is_empty() || wanted.iter().any(|name| name == entry.id);
    Ok(ENTRIES.iter().filter(chosen).copied().collect())
}
