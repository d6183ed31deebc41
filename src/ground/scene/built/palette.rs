//! Materials of furniture.

use super::super::{Color, Material, Surface};
use super::parts::{MaterialId, Parts};

/// Materials of an office.
pub(super) struct Palette {
    pub(super) wood: MaterialId,
    pub(super) dark_wood: MaterialId,
    pub(super) metal: MaterialId,
    pub(super) black: MaterialId,
    pub(super) beige: MaterialId,
    pub(super) keys: MaterialId,
    pub(super) cloth: MaterialId,
    pub(super) paper: MaterialId,
    pub(super) screen: MaterialId,
    pub(super) china: MaterialId,
    pub(super) clay: MaterialId,
    pub(super) soil: MaterialId,
    pub(super) leaf: MaterialId,
    pub(super) white: MaterialId,
    pub(super) bulb: MaterialId,
    pub(super) tube: MaterialId,
    pub(super) covers: [MaterialId; 6],
}

impl Palette {
    /// Adds one of each material to a scene.
    pub(super) fn new(parts: &mut Parts) -> Self {
        let covers = [
            ("book-red", [0.46, 0.07, 0.06]),
            ("book-green", [0.09, 0.27, 0.12]),
            ("book-blue", [0.07, 0.13, 0.40]),
            ("book-ochre", [0.58, 0.38, 0.08]),
            ("book-black", [0.06, 0.06, 0.07]),
            ("book-cream", [0.70, 0.64, 0.48]),
        ];
        Self {
            wood: parts.paint("wood", [0.56, 0.37, 0.20]),
            dark_wood: parts.paint("dark-wood", [0.27, 0.15, 0.08]),
            metal: parts.material(glossy("metal", [0.22; 3], [0.45; 3], 40.0)),
            black: parts.paint("black", [0.05, 0.05, 0.055]),
            beige: parts.paint("beige", [0.62, 0.58, 0.48]),
            keys: parts.paint("keys", [0.72, 0.69, 0.60]),
            cloth: parts.paint("cloth", [0.10, 0.17, 0.34]),
            paper: parts.paint("paper", [0.82, 0.82, 0.79]),
            screen: parts.material(glossy("screen", [0.05, 0.09, 0.12], [0.12; 3], 120.0)),
            china: parts.material(glossy("china", [0.68, 0.66, 0.62], [0.1; 3], 80.0)),
            clay: parts.paint("clay", [0.55, 0.24, 0.13]),
            soil: parts.paint("soil", [0.10, 0.07, 0.05]),
            leaf: parts.paint("leaf", [0.10, 0.32, 0.07]),
            white: parts.paint("white", [0.78, 0.78, 0.75]),
            bulb: parts.material(lamp("bulb", [40.0, 33.0, 21.0])),
            tube: parts.material(lamp("tube", [20.0, 20.0, 18.6])),
            covers: covers.map(|(name, albedo)| parts.paint(name, albedo)),
        }
    }
}

pub(super) fn glossy(name: &str, albedo: Color, specular: Color, exponent: f32) -> Material {
    Material { name: name.into(), surface: Surface::Glossy { albedo, specular, exponent }, emission: [0.0; 3] }
}

/// Creates an emitting material that reflects nothing.
pub(super) fn lamp(name: &str, emission: Color) -> Material {
    Material { name: name.into(), surface: Surface::Diffuse { albedo: [0.0; 3] }, emission }
}
