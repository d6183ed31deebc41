//! The list of entries.

use super::Paper::{AllFrequency, BiScale, Cpca, Radiosity, RayEngine, Subsurface};
use super::error::unknown;
use super::{ReproduceEntry, StudyError, all_frequency, bi_scale, cpca, radiosity, ray_engine, subsurface};

/// All entries, in the order of the papers.
pub const ENTRIES: &[ReproduceEntry] = &[
    RayEngine.entry(
        "ray-engine-radeon-8500",
        "114 M tests per second on a Radeon 8500 (Ray Engine, section 4.4)",
        ray_engine::radeon_8500::findings,
    ),
    RayEngine.entry(
        "ray-engine-vertex-variant",
        "4.1 M tests per second in a vertex program (Ray Engine, section 3.4)",
        ray_engine::vertex_variant::findings,
    ),
    RayEngine.entry(
        "ray-engine-block-shapes",
        "Texture-cache misses by shape of a block of rays (Ray Engine, section 5.3)",
        ray_engine::block_shapes::findings,
    ),
    RayEngine.entry(
        "ray-engine-equation-11",
        "Fill and read-back rates, with worked examples (Ray Engine, section 6.1)",
        ray_engine::equation_11::findings,
    ),
    RayEngine.entry(
        "ray-engine-figure-1",
        "Reflections by environment map and by ray casting (Ray Engine, figure 1)",
        ray_engine::figure_1::findings,
    ),
    RayEngine.entry(
        "ray-engine-figure-7",
        "Tests per second by number of triangles (Ray Engine, figure 7)",
        ray_engine::figure_7::findings,
    ),
    RayEngine.entry(
        "ray-engine-tables-1-2",
        "Rays per second in five scenes, and the card's share (Ray Engine, tables 1 and 2)",
        ray_engine::table_1::findings,
    ),
    RayEngine.entry(
        "ray-engine-table-3",
        "Speed-ups by card, asynchronous read-back, infinitely fast card (Ray Engine, table 3)",
        ray_engine::table_3::findings,
    ),
    RayEngine.entry(
        "ray-engine-table-4",
        "Speed-up by triangles per GPU cell (Ray Engine, table 4)",
        ray_engine::table_4::findings,
    ),
    RayEngine.entry(
        "ray-engine-table-5",
        "Speed-up by rays per pass (Ray Engine, table 5)",
        ray_engine::table_5::findings,
    ),
    Radiosity.entry(
        "radiosity-figure-3",
        "Jacobi and Gauss-Seidel, residual by iteration (radiosity, figure 3)",
        radiosity::figure_3::findings,
    ),
    Radiosity.entry(
        "radiosity-rates",
        "29.7 iterations/s and 141 MFLOP/s on a GeForce FX 5900 Ultra (radiosity, section 3.1)",
        radiosity::rates::findings,
    ),
    Radiosity.entry(
        "radiosity-figure-4",
        "Iteration time by matrix size, on card and host (radiosity, figure 4)",
        radiosity::figure_4::findings,
    ),
    Subsurface.entry(
        "subsurface-counts",
        "Nodes, lookups, textures and instructions (subsurface scattering, sections 2.3 and 4.2)",
        subsurface::counts::findings,
    ),
    Subsurface.entry(
        "subsurface-table-1",
        "Time of pass 2, and frame rates locked to a display (subsurface scattering, table 1)",
        subsurface::table_1::findings,
    ),
    Subsurface.entry(
        "subsurface-frames",
        "Passes 1 and 3, displayed frames, 40 frames per second, 9 s for links (subsurface scattering, sections 4.3 and 5, table 1, figure 7)",
        subsurface::frames::findings,
    ),
    Cpca.entry("cpca-appendix", "Errors of projections onto the hemisphere (CPCA, appendix)", cpca::appendix::findings),
    Cpca.entry(
        "cpca-section-6",
        "Storage, registers and host work of compressed transfer (CPCA, section 6)",
        cpca::section_6::findings,
    ),
    Cpca.entry("cpca-figure-2", "Squared error by storage (CPCA, figure 2)", cpca::figure_2::findings)
        .recorded(include_str!("../../records/cpca-figure-2.toml")),
    Cpca.entry(
        "cpca-figures-3-4",
        "Static, iterative and adaptive compression (CPCA, figures 3 and 4)",
        cpca::figure_3::findings,
    )
    .recorded(include_str!("../../records/cpca-figures-3-4.toml")),
    Cpca.entry("cpca-figure-6", "Light of order 10 on two polygons (CPCA, figure 6)", cpca::figure_6::findings)
        .recorded(include_str!("../../records/cpca-figure-6.toml")),
    Cpca.entry(
        "cpca-figure-7",
        "Projections of exit radiance under colored lights (CPCA, figure 7)",
        cpca::figure_7::findings,
    )
    .recorded(include_str!("../../records/cpca-figure-7.toml")),
    Cpca.entry(
        "cpca-figure-8",
        "Frame rates of glossy Phong models on two cards (CPCA, figure 8)",
        cpca::figure_8::findings,
    )
    .recorded(include_str!("../../records/cpca-figure-8.toml")),
    Cpca.entry(
        "cpca-figure-9",
        "Glossy plus subsurface transfer in two environments (CPCA, figure 9)",
        cpca::figure_9::findings,
    )
    .recorded(include_str!("../../records/cpca-figure-9.toml")),
    Cpca.entry(
        "cpca-figure-10",
        "Principal components, vector quantization, and both (CPCA, figure 10)",
        cpca::figure_10::findings,
    )
    .recorded(include_str!("../../records/cpca-figure-10.toml")),
    Cpca.entry(
        "cpca-figure-11",
        "Error and frame rate by vectors per cluster (CPCA, figure 11)",
        cpca::figure_11::findings,
    )
    .recorded(include_str!("../../records/cpca-figure-11.toml")),
    Cpca.entry("cpca-table-1", "Errors and frame rates of seven signals (CPCA, table 1)", cpca::table_1::findings)
        .recorded(include_str!("../../records/cpca-table-1.toml")),
    Cpca.entry("cpca-coherence", "Overdraw of clusters (CPCA, table of section 7)", cpca::coherence::findings)
        .recorded(include_str!("../../records/cpca-coherence.toml")),
    AllFrequency.entry(
        "all-frequency-counts",
        "Sizes, segments, equation 12 and Table 1 from sizes alone (all-frequency transfer, sections 1 and 4 to 7)",
        all_frequency::counts::findings,
    ),
    AllFrequency.entry(
        "all-frequency-factors",
        "Errors of reflectance factors and of spherical harmonics (all-frequency transfer, section 3)",
        all_frequency::factors::findings,
    ),
    AllFrequency
        .entry(
            "all-frequency-figures",
            "Harmonics, terms, representatives, truncation and frame rates \
         (all-frequency transfer, figures 1, 2 and 5 to 7)",
            all_frequency::figures::findings,
        )
        .recorded(include_str!("../../records/all-frequency-figures.toml")),
    AllFrequency
        .entry(
            "all-frequency-table-1",
            "Size and error after clustering and coding (all-frequency transfer, table 1)",
            all_frequency::table_1::findings,
        )
        .recorded(include_str!("../../records/all-frequency-table-1.toml")),
    BiScale.entry(
        "bi-scale-counts",
        "Sizes of matrices and biclusters (bi-scale transfer, sections III and IV, tables I and II)",
        bi_scale::counts::findings,
    ),
    BiScale
        .entry(
            "bi-scale-figure-8",
            "Cost of more local directions (bi-scale transfer, figure 8)",
            bi_scale::figure_8::findings,
        )
        .recorded(include_str!("../../records/bi-scale-figure-8.toml")),
    BiScale
        .entry(
            "bi-scale-figures",
            "Transfer compared with ray casting, errors by cause (bi-scale transfer, figures 1 and 5)",
            bi_scale::figures::findings,
        )
        .recorded(include_str!("../../records/bi-scale-figures.toml")),
    BiScale.entry(
        "bi-scale-frames",
        "Frame rates for new views and new light (bi-scale transfer, tables I and II)",
        bi_scale::frames::findings,
    ),
    BiScale
        .entry(
            "bi-scale-table-1",
            "Biclusters of an armor, a chair and a temple (bi-scale transfer, table I)",
            bi_scale::table_1::findings,
        )
        .recorded(include_str!("../../records/bi-scale-table-1.toml")),
    BiScale
        .entry("bi-scale-table-2", "Biclusters of bunnies (bi-scale transfer, table II)", bi_scale::table_2::findings)
        .recorded(include_str!("../../records/bi-scale-table-2.toml")),
    BiScale
        .entry(
            "bi-scale-figure-6",
            "Biclusters of a chair, and bytes of other ways to store its transfer (bi-scale transfer, figure 6)",
            bi_scale::figure_6::findings,
        )
        .recorded(include_str!("../../records/bi-scale-figure-6.toml")),
];

/// Returns the entries with these names, and the entries of papers with these names, in the order of [`ENTRIES`]; all
/// entries if there are no names. Fails if a name is neither a paper's nor an entry's.
pub fn choose(wanted: &[String]) -> Result<Vec<ReproduceEntry>, StudyError> {
    let names = |name: &String, entry: &ReproduceEntry| [entry.id, entry.paper.id()].contains(&name.as_str());
    if let Some(found) = wanted.iter().find(|name| !ENTRIES.iter().any(|entry| names(name, entry))) {
        return Err(unknown(found, &ENTRIES.iter().map(|entry| entry.id).collect::<Vec<_>>()));
    }
    let chosen = |entry: &&ReproduceEntry| wanted.is_empty() || wanted.iter().any(|name| names(name, entry));
    Ok(ENTRIES.iter().filter(chosen).copied().collect())
}
