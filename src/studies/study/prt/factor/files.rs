//! G, F and the singular values as files.

use std::fmt::Write as _;

use glam::DVec3;

use crate::all_frequency::factor::{Factorization, ProductFactors};
use crate::io::{NumberTable, write_npy};
use crate::report::{Findings, not_encoded};
use crate::sphere::ParabolicMap;
use crate::study::StudyError;

/// Stores tables with a row per texel: as text with the texel's direction, and as f32 arrays without it.
pub(super) fn keep(found: &mut Findings, all: &Factorization, factors: &ProductFactors) -> Result<(), StudyError> {
    let mut values = "singular_value\n".to_owned();
    for value in all.singular_values() {
        // Writing to a string cannot fail.
        let _ = writeln!(values, "{value:e}");
    }
    found.keep_file("singular_values.csv", values.into_bytes());
    let terms = factors.terms();
    let sides = [
        ("view_factors", "g", factors.view_map(), ProductFactors::view_texel as fn(&ProductFactors, usize) -> &[f64]),
        ("light_factors", "f", factors.light_map(), ProductFactors::light_texel),
    ];
    for (name, letter, map, texel) in sides {
        let mut text = "x,y,z".to_owned();
        (1..=terms).for_each(|k| _ = write!(text, ",{letter}{k}"));
        text.push('\n');
        let mut numbers = Vec::with_capacity(map.texels() * terms);
        for at in 0..map.texels() {
            let DVec3 { x, y, z } = direction(map, at);
            _ = write!(text, "{x:e},{y:e},{z:e}");
            texel(factors, at).iter().for_each(|value| _ = write!(text, ",{value:e}"));
            text.push('\n');
            numbers.extend(texel(factors, at).iter().map(|&value| value as f32));
        }
        found.keep_file(format!("{name}.csv"), text.into_bytes());
        let mut bytes = Vec::new();
        write_npy(&NumberTable { columns: terms, values: numbers }, &mut bytes)
            .map_err(|reason| not_encoded("NPY", reason))?;
        found.keep_file(format!("{name}.npy"), bytes);
    }
    Ok(())
}

fn direction(map: ParabolicMap, texel: usize) -> DVec3 {
    map.direction(texel % map.side(), texel / map.side())
}
