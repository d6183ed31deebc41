//! Materials: scattering and emission of surfaces. Colours are linear red, green, blue; reflectances lie in [0, 1] per
//! channel.

/// Linear colour: red, green, blue.
pub type Color = [f32; 3];

/// Scattering model of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Lambert: equal radiance in all directions. Both sides of a triangle scatter.
    Diffuse {
        /// Reflectance.
        albedo: Color,
    },
    /// A diffuse part and a lobe around the mirror direction (Phong's, normalised after Lafortune and Willems, 1994).
    Glossy {
        /// Reflectance of the diffuse part.
        albedo: Color,
        /// Reflectance of the lobe at normal incidence. Its sum with `albedo` is at most 1 per channel, which conserves
        /// energy.
        specular: Color,
        /// Phong exponent, above 0.
        exponent: f32,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflectance.
        reflectance: Color,
    },
    /// A smooth dielectric boundary that reflects and refracts by Fresnel's equations, with air in front and glass
    /// behind.
    Glass {
        /// Index of refraction behind the front face, above 0.
        index: f32,
        /// Transmittance of refracted light at each crossing.
        transmittance: Color,
    },
}

/// Named surface with its emission.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name, as in the MTL file.
    pub name: String,
    /// Scattering model.
    pub surface: Surface,
    /// Radiance emitted by front faces, equal in all directions; zero for a surface that does not emit.
    pub emission: Color,
}

impl Material {
    /// Creates a Lambert surface without emission.
    pub fn diffuse(name: impl Into<String>, albedo: Color) -> Self {
        Self { name: name.into(), surface: Surface::Diffuse { albedo }, emission: [0.0; 3] }
    }

    /// Returns `true` if the material emits light.
    pub fn emits(&self) -> bool {
        self.emission.iter().any(|&channel| channel > 0.0)
    }
}
