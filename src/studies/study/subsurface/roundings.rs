//! Effect of the card's open rounding rules: each value of each rounding switch, over the same links.

use super::GatherWay;
use super::all_pairs::GatherError;
use super::no_card;
use super::way::{Scene, gathered, lit_card};
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::links::{Links, MeanWeighting};
use crate::subsurface::on_card::LinkTextures;

/// The switches that are about rounding.
const SWITCHES: [&str; 4] = ["rounding", "mad", "mipmap-rounding", "target-rounding"];

/// A way of gathering on a card of which one switch is set otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundingRow {
    /// The way.
    pub label: String,
    /// The switch.
    pub switch: String,
    /// Its other value.
    pub value: String,
    /// How far B is from that of the card as it was asked for.
    pub change: GatherError,
    /// The card against all pairs.
    pub error: Option<GatherError>,
}

/// A row for each other value of each switch of the card. `usual` is B of the card as it was asked for.
pub(super) fn roundings(
    scene: &Scene<'_>,
    way: GatherWay,
    (links, usual): (&Links, &[[f64; 3]]),
    progress: &mut ProgressFn<'_>,
) -> Result<Vec<RoundingRow>, StudyError> {
    let (parameters, label) = (scene.parameters, way.label(scene.parameters.options.side));
    let switches = parameters.profile.switches().iter().filter(|switch| SWITCHES.contains(&switch.name.as_str()));
    let others = switches.flat_map(|switch| {
        let values = switch.values.iter().filter(|value| **value != switch.current);
        values.map(|value| (switch.name.clone(), value.clone()))
    });
    let others: Vec<(String, String)> = others.collect();
    let textures = LinkTextures::new(links, scene.surface, MeanWeighting::Area);
    let mut rows = Vec::new();
    for (at, (switch, value)) in others.iter().enumerate() {
        progress(&format!("{switch}={value}: {label}"), at as u64, others.len() as u64);
        let mut profile = parameters.profile.clone();
        profile.set_switch(switch, value)?;
        let card = lit_card(scene, way, profile, &textures, false);
        let found = card.and_then(|card| gathered(&card)).map_err(no_card)?;
        rows.push(RoundingRow {
            label: label.clone(),
            switch: switch.clone(),
            value: value.clone(),
            change: GatherError::between(scene.atlas, &found, usual),
            error: scene.truth.map(|truth| GatherError::between(scene.atlas, &found, &truth.texels)),
        });
    }
    Ok(rows)
}
