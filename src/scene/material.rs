//! What surfaces do with light. Colours are linear red, green, blue; reflectances lie in [0, 1] a channel.

/// A linear colour: red, green, blue.
pub type Color = [f32; 3];

/// How a surface scatters.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Lambert: the same radiance in all directions. Both sides of a triangle scatter.
    Diffuse {
        /// Reflectance.
        albedo: Color,
    },
    /// A diffuse part and a lobe around the mirror direction (Phong's, normalised after Lafortune and Willems, 1994).
    Glossy {
        /// Reflectance of the diffuse part.
        albedo: Color,
        /// Reflectance of the lobe at normal incidence. Sum with `albedo` at most 1 per channel, so that no energy is
        /// made.
        specular: Color,
        /// Phong's exponent, above 0.
        exponent: f32,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflectance.
        reflectance: Color,
    },
    /// A smooth dielectric boundary, air in front and glass behind: reflects and refracts by Fresnel's equations.
    Glass {
        /// Index of refraction of what lies behind the front face, above 0.
        index: f32,
        /// What passes of the refracted light at each crossing.
        transmittance: Color,
    },
}

/// A named surface, with the light that it sends out by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name, without white space: that of the MTL file.
    pub name: String,
    /// How it scatters.
    pub surface: Surface,
    /// Radiance sent out by front faces, the same in all directions; zero for what does not shine.
    pub emission: Color,
}

impl Material {
    /// A Lambert surface that does not shine.
    pub fn diffuse(name: impl Into<String>, albedo: Color) -> Self {
        Self { name: name.into(), surface: Surface::Diffuse { albedo }, emission: [0.0; 3] }
    }

    /// Whether it sends out light.
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&channel| channel > 0.0)
    }
}
