//! The list of entries, and the timed work of each system for benches.

use strum::VariantArray as _;

use super::{
    Paper, ReproduceEntry, StudyError, TimedWork, all_frequency, bi_scale, cpca, radiosity, ray_engine, subsurface,
};
use crate::names::did_you_mean;

/// Entries, each with its paper, code, name and title; `recorded` if a file of `src/studies/records` has its record.
macro_rules! entries {
    ($($paper:ident $work:path, $id:literal $($recorded:ident)?, $title:literal;)*) => {
        &[$(ReproduceEntry {
            paper: Paper::$paper,
            id: $id,
            title: $title,
            work: $work,
            record: record!($id $($recorded)?),
        }),*]
    };
}

macro_rules! record {
    ($id:literal) => {
        None
    };
    ($id:literal recorded) => {
        Some(include_str!(concat!("../../records/", $id, ".toml")))
    };
}

/// All entries, in the order of the papers.
pub const ENTRIES: &[ReproduceEntry] = entries! {
    RayEngine ray_engine::radeon_8500::findings, "ray-engine-radeon-8500",
        "114 M tests per second on a Radeon 8500 (Ray Engine, section 4.4)";
    RayEngine ray_engine::vertex_variant::findings, "ray-engine-vertex-variant",
        "4.1 M tests per second in a vertex program (Ray Engine, section 3.4)";
    RayEngine ray_engine::block_shapes::findings, "ray-engine-block-shapes",
        "Texture-cache misses by shape of a block of rays (Ray Engine, section 5.3)";
    RayEngine ray_engine::equation_11::findings, "ray-engine-equation-11",
        "Fill and read-back rates, with worked examples (Ray Engine, section 6.1)";
    RayEngine ray_engine::figure_1::findings, "ray-engine-figure-1",
        "Reflections by environment map and by ray casting (Ray Engine, figure 1)";
    RayEngine ray_engine::figure_7::findings, "ray-engine-figure-7",
        "Tests per second by number of triangles (Ray Engine, figure 7)";
    RayEngine ray_engine::table_1::findings, "ray-engine-tables-1-2",
        "Rays per second in five scenes, and the share of rays on the card (Ray Engine, tables 1 and 2)";
    RayEngine ray_engine::tables::table_3, "ray-engine-table-3",
        "Speed-ups with a card, asynchronous read-back, or an infinitely fast card (Ray Engine, table 3)";
    RayEngine ray_engine::tables::table_4, "ray-engine-table-4",
        "Speed-up by triangles per GPU cell (Ray Engine, table 4)";
    RayEngine ray_engine::tables::table_5, "ray-engine-table-5", "Speed-up by rays per pass (Ray Engine, table 5)";
    Radiosity radiosity::figure_3::findings, "radiosity-figure-3",
        "Residual of Jacobi and Gauss-Seidel by iteration (radiosity, figure 3)";
    Radiosity radiosity::rates::findings, "radiosity-rates",
        "29.7 iterations/s and 141 MFLOP/s on a GeForce FX 5900 Ultra (radiosity, section 3.1)";
    Radiosity radiosity::figure_4::findings, "radiosity-figure-4",
        "Iteration time by matrix size, on card and host (radiosity, figure 4)";
    Subsurface subsurface::counts::findings, "subsurface-counts",
        "Nodes, lookups, textures and instructions (subsurface scattering, sections 2.3 and 4.2)";
    Subsurface subsurface::table_1::findings, "subsurface-table-1",
        "Time of pass 2, and frame rates locked to a display (subsurface scattering, table 1)";
    Subsurface subsurface::frames::findings, "subsurface-frames",
        "Times of passes, displayed frame rates, and 9 s to compute links (subsurface scattering, sections 4.3 and 5, table 1, figure 7)";
    Cpca cpca::appendix::findings, "cpca-appendix", "Errors of projections onto the hemisphere (CPCA, appendix)";
    Cpca cpca::section_6, "cpca-section-6", "Storage, registers and host work of compressed transfer (CPCA, section 6)";
    Cpca cpca::figure_2::findings, "cpca-figure-2" recorded, "Squared error by storage (CPCA, figure 2)";
    Cpca cpca::figure_3::findings, "cpca-figures-3-4" recorded,
        "Static, iterative and adaptive compression (CPCA, figures 3 and 4)";
    Cpca cpca::figure_6::findings, "cpca-figure-6" recorded, "Light of order 10 on two polygons (CPCA, figure 6)";
    Cpca cpca::figure_7::findings, "cpca-figure-7" recorded,
        "Projections of exit radiance under colored lights (CPCA, figure 7)";
    Cpca cpca::figure_8::findings, "cpca-figure-8" recorded,
        "Frame rates of glossy Phong models on two cards (CPCA, figure 8)";
    Cpca cpca::figure_9::findings, "cpca-figure-9" recorded,
        "Glossy plus subsurface transfer in two environments (CPCA, figure 9)";
    Cpca cpca::figure_10::findings, "cpca-figure-10" recorded,
        "Principal components, vector quantization, and both (CPCA, figure 10)";
    Cpca cpca::figure_11::findings, "cpca-figure-11" recorded,
        "Error and frame rate by vectors per cluster (CPCA, figure 11)";
    Cpca cpca::table_1::findings, "cpca-table-1" recorded, "Errors and frame rates of seven signals (CPCA, table 1)";
    Cpca cpca::coherence::findings, "cpca-coherence" recorded, "Overdraw of clusters (CPCA, table of section 7)";
    AllFrequency all_frequency::counts::findings, "all-frequency-counts",
        "Sizes, segments, and the part of Table 1 that follows from sizes (all-frequency transfer, sections 1 and 4 to 7)";
    AllFrequency all_frequency::factors::findings, "all-frequency-factors",
        "Errors of reflectance factors and of spherical harmonics (all-frequency transfer, section 3)";
    AllFrequency all_frequency::figures::findings, "all-frequency-figures" recorded,
        "Harmonics, terms, representatives, truncation and frame rates (all-frequency transfer, figures 1, 2 and 5 to 7)";
    AllFrequency all_frequency::table_1::findings, "all-frequency-table-1" recorded,
        "Size and error after clustering and coding (all-frequency transfer, table 1)";
    BiScale bi_scale::counts, "bi-scale-counts",
        "Sizes of matrices and biclusters (bi-scale transfer, sections III and IV, tables I and II)";
    BiScale bi_scale::figure_8::findings, "bi-scale-figure-8" recorded,
        "Cost of more local directions (bi-scale transfer, figure 8)";
    BiScale bi_scale::figures::findings, "bi-scale-figures" recorded,
        "Transfer compared with ray casting; errors by cause (bi-scale transfer, figures 1 and 5)";
    BiScale bi_scale::frames::findings, "bi-scale-frames",
        "Frame rates for new views and new light (bi-scale transfer, tables I and II)";
    BiScale bi_scale::table_1::findings, "bi-scale-table-1" recorded,
        "Biclusters of an armor, a chair and a temple (bi-scale transfer, table I)";
    BiScale bi_scale::table_2::findings, "bi-scale-table-2" recorded,
        "Biclusters of bunnies (bi-scale transfer, table II)";
    BiScale bi_scale::figure_6::findings, "bi-scale-figure-6" recorded,
        "Biclusters of a chair, and the size of its transfer in other formats (bi-scale transfer, figure 6)";
};

/// Returns the entries with these names, and the entries of papers with these names, in the order of [`ENTRIES`]; all
/// entries if there are no names. Fails if a name is neither a paper's nor an entry's.
pub fn choose(wanted: &[String]) -> Result<Vec<ReproduceEntry>, StudyError> {
    let names = |name: &String, entry: &ReproduceEntry| [entry.id, entry.paper.id()].contains(&name.as_str());
    if let Some(found) = wanted.iter().find(|name| !ENTRIES.iter().any(|entry| names(name, entry))) {
        let papers: Vec<&str> = Paper::VARIANTS.iter().map(|paper| paper.id()).collect();
        let known = papers.iter().copied().chain(ENTRIES.iter().map(|entry| entry.id));
        let help = format!("{}`crossbar reproduce --list` describes the entries", did_you_mean(found, known));
        let what = format!("expected the name of a paper ({}) or of an entry, found `{found}`", papers.join(", "));
        return Err(StudyError::new("reproduce::unknown", what).with_help(help));
    }
    let chosen = |entry: &&ReproduceEntry| wanted.is_empty() || wanted.iter().any(|name| names(name, entry));
    Ok(ENTRIES.iter().filter(chosen).copied().collect())
}

/// Returns the modelled times of work that rows judge, for benches: intersections of the Ray Engine's kernels, a Jacobi
/// iteration, the three passes of subsurface scattering, and frames of the systems of compressed transfer. Fails if a
/// card rejects the work.
pub fn timed() -> Result<Vec<TimedWork>, StudyError> {
    let mut all = ray_engine::radeon_8500::timed_tests()?;
    all.push(radiosity::timed()?);
    all.extend(subsurface::frames::timed()?);
    all.extend([cpca::timed()?, all_frequency::figures::timed()?, bi_scale::frames::timed()?]);
    Ok(all)
}
