//! Fixed-function OpenGL state that `!!ARBfp1.0` programs read (`state.light[0].position`), and fog options.
//!
//! Source: GL_ARB_fragment_program, tables of bindings (X.2.1 to X.2.8) and section "Fog Application Options".

use std::fmt;

use strum::{EnumString, IntoStaticStr};

use super::Span;

/// Number of lights in the state (`GL_MAX_LIGHTS`).
pub const MAX_LIGHTS: u16 = 8;
/// Number of texture units that have an environment color and a matrix.
pub const MAX_TEXTURE_UNITS: u16 = 8;
/// Number of matrices `state.matrix.program[#]` (`GL_MAX_PROGRAM_MATRICES_ARB`).
pub const MAX_PROGRAM_MATRICES: u16 = 8;

/// Side of a surface that a material applies to; front by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, EnumString, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the names in programs")]
pub enum MaterialFace {
    Front,
    Back,
}

/// Color component shared by lights, materials and their products.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, EnumString, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the names in programs")]
pub enum LightingColor {
    Ambient,
    Diffuse,
    Specular,
}

/// A matrix of the fixed-function pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum StateMatrix {
    /// `modelview`
    ModelView,
    /// `projection`
    Projection,
    /// `mvp`: projection times modelview.
    Mvp,
    /// `texture[#]`
    Texture(u8),
    /// `program[#]`
    Program(u8),
}

/// Form in which a matrix is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, EnumString, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum MatrixForm {
    /// The matrix itself.
    #[strum(disabled)]
    Plain,
    /// Its inverse.
    Inverse,
    /// Its transpose.
    Transpose,
    /// The transpose of its inverse.
    InvTrans,
}

/// A four-component item of state. Displayed as programs write it.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum StateBinding {
    /// `state.material.diffuse`
    Material(MaterialFace, LightingColor),
    /// `state.material.emission`
    Emission(MaterialFace),
    /// `state.material.shininess`: (s, 0, 0, 1)
    Shininess(MaterialFace),
    /// `state.light[#].diffuse`
    Light(u8, LightingColor),
    /// `state.light[#].position`
    LightPosition(u8),
    /// `state.light[#].attenuation`: constant, linear, quadratic, and the exponent of the spot
    LightAttenuation(u8),
    /// `state.light[#].spot.direction`: the direction, and the cosine of the cutoff angle
    SpotDirection(u8),
    /// `state.light[#].half`: the half vector for a light and a viewer at infinity; w is 1
    LightHalf(u8),
    /// `state.lightmodel.ambient`
    LightModelAmbient,
    /// `state.lightmodel.scenecolor`: emission plus ambient term; alpha is the alpha of the diffuse material
    SceneColor(MaterialFace),
    /// `state.lightprod[#].diffuse`: color of the light times color of the material; alpha is the material's
    LightProduct(u8, MaterialFace, LightingColor),
    /// `state.texenv[#].color`
    TextureEnvironment(u8),
    /// `state.fog.color`
    FogColor,
    /// `state.fog.params`: density, start, end, 1 / (end - start)
    FogParams,
    /// `state.fog.$factors`, an extension of this project: -1 / (end - start), end / (end - start), density / ln 2 and
    /// density / sqrt(ln 2); the factors used by the instructions of a fog option.
    FogFactors,
    /// `state.depth.range`: near, far, far - near, 1
    DepthRange,
    /// `state.matrix.mvp.inverse.row[#]`
    MatrixRow(StateMatrix, MatrixForm, u8),
}

impl fmt::Display for StateBinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |face: MaterialFace| if face == MaterialFace::Back { "back." } else { "" };
        let color = |color: LightingColor| -> &'static str { color.into() };
        f.write_str("state.")?;
        match *self {
            Self::Material(face, c) => write!(f, "material.{}{}", side(face), color(c)),
            Self::Emission(face) => write!(f, "material.{}emission", side(face)),
            Self::Shininess(face) => write!(f, "material.{}shininess", side(face)),
            Self::Light(n, c) => write!(f, "light[{n}].{}", color(c)),
            Self::LightPosition(n) => write!(f, "light[{n}].position"),
            Self::LightAttenuation(n) => write!(f, "light[{n}].attenuation"),
            Self::SpotDirection(n) => write!(f, "light[{n}].spot.direction"),
            Self::LightHalf(n) => write!(f, "light[{n}].half"),
            Self::LightModelAmbient => f.write_str("lightmodel.ambient"),
            Self::SceneColor(face) => write!(f, "lightmodel.{}scenecolor", side(face)),
            Self::LightProduct(n, face, c) => write!(f, "lightprod[{n}].{}{}", side(face), color(c)),
            Self::TextureEnvironment(n) => write!(f, "texenv[{n}].color"),
            Self::FogColor => f.write_str("fog.color"),
            Self::FogParams => f.write_str("fog.params"),
            Self::FogFactors => f.write_str("fog.$factors"),
            Self::DepthRange => f.write_str("depth.range"),
            Self::MatrixRow(matrix, form, row) => {
                match matrix {
                    StateMatrix::ModelView => f.write_str("matrix.modelview")?,
                    StateMatrix::Projection => f.write_str("matrix.projection")?,
                    StateMatrix::Mvp => f.write_str("matrix.mvp")?,
                    StateMatrix::Texture(n) => write!(f, "matrix.texture[{n}]")?,
                    StateMatrix::Program(n) => write!(f, "matrix.program[{n}]")?,
                }
                if form != MatrixForm::Plain {
                    let form: &'static str = form.into();
                    write!(f, ".{form}")?;
                }
                write!(f, ".row[{row}]")
            }
        }
    }
}

/// Fog equation: the blend factor f as a function of the fog coordinate `c`. The fragment's color has weight f, the fog
/// color 1 - f.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, EnumString, IntoStaticStr)]
pub enum FogMode {
    /// f = exp(-density c)
    #[strum(serialize = "ARB_fog_exp")]
    Exp,
    /// f = exp(-(density c)^2)
    #[strum(serialize = "ARB_fog_exp2")]
    Exp2,
    /// f = (end - c) / (end - start)
    #[strum(serialize = "ARB_fog_linear")]
    Linear,
}

impl FogMode {
    /// Every mode.
    pub const ALL: [Self; 3] = [Self::Exp, Self::Exp2, Self::Linear];

    /// The option in programs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// `OPTION ARB_fog_exp`: fog applied to the program's color output. [`crate::check::check`] appends the instructions
/// for it and removes the option.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FogOption {
    /// The fog equation.
    pub mode: FogMode,
    /// Location of the option in the program text.
    pub span: Span,
}
