//! Published media: the twelve of Jensen, Marschner, Levoy and Hanrahan 2001, Figure 5, and the medium of this system's
//! paper, Figure 7, which is not one of the twelve.

use super::material::{Coefficients, Material};

/// Confidence in a published number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum FigureConfidence {
    /// Printed in the paper that is reproduced.
    Printed,
    /// Confirmed by several independent public copies of the table.
    Confirmed,
    /// Public copies differ; the source names the copy that is used, and the reason.
    Disputed,
    /// From memory of the table; no public copy was found.
    Unconfirmed,
    /// Not printed; chosen here.
    Assumed,
}

impl FigureConfidence {
    /// One word for tables.
    pub fn word(self) -> &'static str {
        self.into()
    }
}

/// A published number with its source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedFigure<T> {
    /// The number, or three numbers for red, green and blue.
    pub value: T,
    /// The publication.
    pub source: &'static str,
    /// Confidence in the number.
    pub confidence: FigureConfidence,
}

/// A medium as published.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedMaterial {
    /// Name in the publication.
    pub name: &'static str,
    /// sigma'_s per mm.
    pub sigma_s_prime: PublishedFigure<[f64; 3]>,
    /// sigma_a per mm.
    pub sigma_a: PublishedFigure<[f64; 3]>,
    /// The index of refraction.
    pub eta: PublishedFigure<f64>,
    /// The printed diffuse reflectance, to two digits.
    pub reflectance: Option<PublishedFigure<[f64; 3]>>,
}

impl PublishedMaterial {
    /// Coefficients and index.
    pub fn material(&self) -> Material {
        let [s, a] = [self.sigma_s_prime.value, self.sigma_a.value];
        let channels = [0, 1, 2].map(|c| Coefficients { sigma_s_prime: s[c], sigma_a: a[c] });
        Material { name: self.name.to_owned(), channels, eta: self.eta.value }
    }
}

/// The published medium with a name, regardless of case.
pub fn named(name: &str) -> Option<&'static PublishedMaterial> {
    MATERIALS.iter().find(|material| material.name.eq_ignore_ascii_case(name))
}

const COPIES: &str = "Jensen et al. 2001, Figure 5; equal in pbrt-v3 (src/core/medium.cpp), pbrt-v4 (media.cpp), \
                      Mitsuba 0.6 (src/medium/materials.h) and Yocto/GL";
const PBRT: &str = "Jensen et al. 2001, Figure 5; pbrt-v3, pbrt-v4 and Yocto/GL. Mitsuba 0.6 has a tenth of it in red, \
                    which would double the reflectance that is printed";
const INDEX: &str = "Jensen et al. 2001, section 5; Mitsuba 0.6 and TheBounty's exporter for Blender";
const BOUNTY: &str = "Jensen et al. 2001, Figure 5; TheBounty's exporter for Blender has it as the color of its preset";
const MARBLE: &str = "Jensen et al. 2001, Figure 5; TheBounty's exporter for Blender and 3Delight's manual, page 58";
const CREAM: &str = "Jensen et al. 2001, Figure 5; TheBounty's exporter for Blender has .987 in red";
const WHOLE_MILK: &str = "Jensen et al. 2001, Figure 5; TheBounty's exporter for Blender has .90 .88 .76";
const MEMORY: &str = "Jensen et al. 2001, Figure 5, from memory: no public copy was found";
const FIGURE_7: &str = "the paper's Figure 7, without a unit; per mm, as the table that its coefficients are from";

const fn figure<T: Copy>(value: T, source: &'static str, confidence: FigureConfidence) -> PublishedFigure<T> {
    PublishedFigure { value, source, confidence }
}

/// A row of the table of 2001, with flags for disputed absorption coefficients and reflectances.
const fn row(
    name: &'static str,
    sigma_s_prime: [f64; 3],
    sigma_a: [f64; 3],
    absorption: (&'static str, FigureConfidence),
    eta: f64,
    reflectance: [f64; 3],
    printed: (&'static str, FigureConfidence),
) -> PublishedMaterial {
    PublishedMaterial {
        name,
        sigma_s_prime: figure(sigma_s_prime, COPIES, FigureConfidence::Confirmed),
        sigma_a: figure(sigma_a, absorption.0, absorption.1),
        eta: figure(eta, INDEX, FigureConfidence::Confirmed),
        reflectance: Some(figure(reflectance, printed.0, printed.1)),
    }
}

const fn figure_7(name: &'static str, eta: f64, source: &'static str) -> PublishedMaterial {
    PublishedMaterial {
        name,
        sigma_s_prime: figure([2.21; 3], FIGURE_7, FigureConfidence::Printed),
        sigma_a: figure([0.0012; 3], FIGURE_7, FigureConfidence::Printed),
        eta: figure(eta, source, FigureConfidence::Assumed),
        reflectance: None,
    }
}

const AGREED: (&str, FigureConfidence) = (COPIES, FigureConfidence::Confirmed);
const TENTH: (&str, FigureConfidence) = (PBRT, FigureConfidence::Disputed);
const SEEN: (&str, FigureConfidence) = (BOUNTY, FigureConfidence::Confirmed);
const SEEN_TWICE: (&str, FigureConfidence) = (MARBLE, FigureConfidence::Confirmed);
const RECALLED: (&str, FigureConfidence) = (MEMORY, FigureConfidence::Unconfirmed);

/// All media; the twelve of 2001 are sorted by name.
#[rustfmt::skip]
pub const MATERIALS: [PublishedMaterial; 14] = [
    row("Apple", [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046], AGREED, 1.3, [0.85, 0.84, 0.53], RECALLED),
    row("Chicken1", [0.15, 0.21, 0.38], [0.015, 0.077, 0.19], TENTH, 1.3, [0.31, 0.15, 0.10], RECALLED),
    row("Chicken2", [0.19, 0.25, 0.32], [0.018, 0.088, 0.20], TENTH, 1.3, [0.32, 0.16, 0.10], RECALLED),
    row("Cream", [7.38, 5.47, 3.15], [0.0002, 0.0028, 0.0163], AGREED, 1.3, [0.98, 0.90, 0.73],
        (CREAM, FigureConfidence::Disputed)),
    row("Ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45], AGREED, 1.3, [0.16, 0.01, 0.00], SEEN),
    row("Marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071], AGREED, 1.5, [0.83, 0.79, 0.75], SEEN_TWICE),
    row("Potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12], AGREED, 1.3, [0.77, 0.62, 0.21], SEEN),
    row("Skimmilk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142], AGREED, 1.3, [0.81, 0.81, 0.69], SEEN),
    row("Skin1", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48], AGREED, 1.3, [0.44, 0.22, 0.13], SEEN),
    row("Skin2", [1.09, 1.59, 1.79], [0.013, 0.070, 0.145], AGREED, 1.3, [0.63, 0.44, 0.34], SEEN),
    row("Spectralon", [11.6, 20.4, 14.9], [0.0, 0.0, 0.0], AGREED, 1.3, [1.00, 1.00, 1.00], RECALLED),
    row("Wholemilk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014], AGREED, 1.3, [0.91, 0.88, 0.77],
        (WHOLE_MILK, FigureConfidence::Disputed)),
    figure_7("Figure7", 1.3, "not printed; that of all media but marble in the table of 2001"),
    figure_7("Figure7-marble", 1.5, "not printed; that of marble in the table of 2001, whose coefficients are near"),
];
