//! Options of `crossbar radiosity`.

use std::str::FromStr;

use crate::cli::number;
use crate::radiosity::solve::{Solver, UnknownSolver};
use crate::scene::Color;

/// On the card, or a solver of the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SolverArg {
    Card,
    Host(Solver),
}

impl FromStr for SolverArg {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        if name == "card" {
            return Ok(Self::Card);
        }
        name.parse()
            .map(Self::Host)
            .map_err(|e: UnknownSolver| e.to_string().replacen("expected ", "expected `card`, ", 1))
    }
}

/// A color for a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MaterialColor {
    pub(super) material: String,
    pub(super) rgb: Color,
}

/// `light=17,12,4`
pub(super) fn light_of(text: &str) -> Result<MaterialColor, String> {
    let color = color_of(text)?;
    let shines = color.rgb.iter().all(|&c| c >= 0.0);
    if shines { Ok(color) } else { Err(format!("expected radiances of at least 0, found `{text}`")) }
}

/// `wall=0.7,0.7,0.6`
pub(super) fn paint_of(text: &str) -> Result<MaterialColor, String> {
    let color = color_of(text)?;
    let reflects = color.rgb.iter().all(|c| (0.0..1.0).contains(c));
    if reflects { Ok(color) } else { Err(format!("expected reflectances of at least 0 and below 1, found `{text}`")) }
}

fn color_of(text: &str) -> Result<MaterialColor, String> {
    let wrong = || format!("expected MATERIAL=R,G,B as in light=17,12,4; found `{text}`");
    let (material, channels) = text.split_once('=').ok_or_else(wrong)?;
    let rgb = number::three(channels, "R,G,B")?;
    Ok(MaterialColor { material: material.to_owned(), rgb })
}
