//! Counts of section 4: nodes, interactions, lookups, textures, instructions, samplers.

use super::gather::{EIGHT, GatherCost, VARIANTS, Variant};
use super::{
    CARD, Dependence, EntryFindings, LINKS, Method, RunResult, Setting, Shared, StudyError, Sweep, paper_row,
    paragraph, solved,
};
use crate::atlas::Atlas;
use crate::geom::Mesh;
use crate::report::Table;
use crate::scene::built::meshes;

/// Models of Table 1, and our stand-ins with as many faces.
pub(super) const MODELS: [(&str, &str); 3] =
    [("head", "stand-in-head"), ("dolphin", "stand-in-dolphin"), ("bunny", "stanford-bunny")];
const HOW: &str = "Texture lookups per texel are counted while our programs are drawn: {} fixed links take {} lookups, adaptive links {}. Adaptive \
    links need one sampler more than the card has, so a second pass reads the sum of the first pass. If the link textures are tiles of a larger \
    texture, a single pass suffices, with {} lookups. The paper does not say how its card stored the links. The clustering is our own, since \
    another paper describes the authors'. Its required result, a binary tree with one leaf per face, is counted on stand-ins with as many faces as \
    the paper's models.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let costs = shared.get::<Vec<GatherCost>>(CARD)?;
    let [fixed, adaptive] = [true, false].map(|is_fixed| {
        let found = VARIANTS.iter().zip(costs.iter()).find(|(variant, _)| variant.fixed == is_fixed);
        found.map_or(f64::NAN, |(_, cost)| cost.lookups)
    });
    let lookups = |id: &str, ours: f64| paper_row(id, (CARD, Method::Pipeline), (ours, Dependence::Counted));
    // A texel of fixed links holds the factors of four links.
    let layout = [LINKS as f64 * 1.25; 2];
    let of_fixed =
        lookups("subsurface/lookups-fixed", fixed)?.confined(layout, "the program uses the paper's layout of links");
    let mut rows = vec![of_fixed, lookups("subsurface/lookups-adaptive", adaptive)?];
    // The same links on the same map, in their own textures and as tiles.
    let same = VARIANTS.iter().zip(costs.iter()).filter(|(variant, _)| !variant.fixed && variant.map == EIGHT);
    let setting = |(variant, cost): (&Variant, &GatherCost)| {
        let at = if variant.tiles.is_some() { "tiles" } else { "separate" };
        Setting { at: at.to_owned(), values: vec![cost.lookups] }
    };
    let held =
        Sweep { name: "storage of 16 adaptive links", parameter: "textures", settings: same.map(setting).collect() };
    held.explain(&mut rows[1..]);
    let tiled = held.settings.last().map_or(f64::NAN, |setting| setting.values[0]);
    let held = held.table("Lookups by storage of adaptive links", &rows[1..], (None, |value| value));
    for (model, stand_in) in MODELS {
        let mesh = mesh(stand_in)?;
        let atlas = Atlas::new(&mesh, 512).on(CARD)?;
        let row = solved(&format!("subsurface/nodes-{model}"), atlas.tree().nodes().len() as f64)?;
        let nodes = (2 * mesh.len() - 1) as f64;
        rows.push(row.confined([nodes; 2], "every binary tree of T leaves has 2 T - 1 nodes"));
    }
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&LINKS, &fixed, &adaptive, &tiled])],
        rows,
        ["the authors' clustering of faces, and which of the two kinds of links was timed."],
        [programs(&costs), held],
    ))
}

pub(super) fn mesh(stand_in: &'static str) -> Result<Mesh, StudyError> {
    meshes::build(stand_in).ok_or_else(|| format!("no stand-in `{stand_in}`")).on(CARD)
}

/// Table of instructions and samplers of each variant, compared with the card's limits of 1024 and 16.
fn programs(costs: &[GatherCost]) -> Table {
    let mut table = Table::of("Programs of pass 2 for 16 links", "variant passes instructions samplers");
    for (variant, cost) in VARIANTS.iter().zip(costs) {
        table.push([variant.name.into(), cost.programs.into(), cost.instructions.into(), cost.samplers.into()]);
    }
    table
}
