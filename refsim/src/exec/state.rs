//! Fixed-function OpenGL state that `!!ARBfp1.0` reads as constants.
//!
//! Derived values (inverses, products, 1 / (end - start)) are computed by [`FixedFunctionState::value`], where cards
//! leave them to the driver: in double precision, in a fixed order, rounded once. Defaults: the OpenGL 1.4
//! specification, tables of state variables.

use crate::isa::{LightingColor, MAX_LIGHTS, MAX_PROGRAM_MATRICES, MAX_TEXTURE_UNITS, MaterialFace, StateBinding};
use crate::isa::{MatrixForm, StateMatrix};
use crate::num::{self, Format};

const ONE: u32 = 0x3f80_0000;
const BLACK: [u32; 4] = [0, 0, 0, ONE];
const WHITE: [u32; 4] = [ONE; 4];

/// State of `glMaterial`. Colors are red, green, blue, alpha; all numbers are single-precision patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaterialState {
    /// Ambient, diffuse and specular color.
    pub colors: [[u32; 4]; 3],
    /// Emitted light.
    pub emission: [u32; 4],
    /// Exponent of the specular highlight.
    pub shininess: u32,
}

impl Default for MaterialState {
    fn default() -> Self {
        let grey = |level: f32| [level, level, level, 1.0].map(f32::to_bits);
        Self { colors: [grey(0.2), grey(0.8), BLACK], emission: BLACK, shininess: 0 }
    }
}

/// State of `glLight`, single-precision patterns. Positions and directions are in eye space, as stored by the driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightState {
    /// Ambient, diffuse and specular color.
    pub colors: [[u32; 4]; 3],
    /// Position; a direction if w is 0.
    pub position: [u32; 4],
    /// Constant, linear and quadratic attenuation.
    pub attenuation: [u32; 3],
    /// Spot direction.
    pub spot_direction: [u32; 3],
    /// Spot exponent.
    pub spot_exponent: u32,
    /// Spot cutoff: half the cone angle in degrees, 0 to 90, or 180 for no spot.
    pub spot_cutoff: u32,
}

impl LightState {
    /// Default state of light `number`: light 0 is white, the others are black.
    pub fn new(number: usize) -> Self {
        let color = if number == 0 { WHITE } else { BLACK };
        Self {
            colors: [BLACK, color, color],
            position: [0, 0, ONE, 0],
            attenuation: [ONE, 0, 0],
            spot_direction: [0, 0, (-1.0_f32).to_bits()],
            spot_exponent: 0,
            spot_cutoff: 180.0_f32.to_bits(),
        }
    }
}

/// State of `glFog`, single-precision patterns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FogState {
    /// Color.
    pub color: [u32; 4],
    /// Density of exponential fog.
    pub density: u32,
    /// Start distance of linear fog.
    pub start: u32,
    /// End distance of linear fog, where it is opaque.
    pub end: u32,
}

/// A matrix by rows, for multiplication with column vectors; single-precision patterns.
pub type MatrixRows = [[u32; 4]; 4];

/// The complete state that `!!ARBfp1.0` can name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixedFunctionState {
    /// Front and back material.
    pub materials: [MaterialState; 2],
    /// Lights.
    pub lights: [LightState; MAX_LIGHTS as usize],
    /// Ambient light of the whole scene (`GL_LIGHT_MODEL_AMBIENT`).
    pub ambient: [u32; 4],
    /// Environment color of each texture unit (`GL_TEXTURE_ENV_COLOR`).
    pub texture_environment: [[u32; 4]; MAX_TEXTURE_UNITS as usize],
    /// Fog.
    pub fog: FogState,
    /// Window depth of the near and far plane.
    pub depth_range: [u32; 2],
    /// Transform from object space to eye space.
    pub modelview: MatrixRows,
    /// Transform from eye space to clip space.
    pub projection: MatrixRows,
    /// Texture coordinate transforms.
    pub texture: [MatrixRows; MAX_TEXTURE_UNITS as usize],
    /// Program matrices, for use by the application.
    pub program: [MatrixRows; MAX_PROGRAM_MATRICES as usize],
}

impl Default for FixedFunctionState {
    fn default() -> Self {
        let identity = [[ONE, 0, 0, 0], [0, ONE, 0, 0], [0, 0, ONE, 0], [0, 0, 0, ONE]];
        Self {
            materials: [MaterialState::default(); 2],
            lights: std::array::from_fn(LightState::new),
            ambient: MaterialState::default().colors[0],
            texture_environment: [[0; 4]; MAX_TEXTURE_UNITS as usize],
            fog: FogState { color: [0; 4], density: ONE, start: 0, end: ONE },
            depth_range: [0, ONE],
            modelview: identity,
            projection: identity,
            texture: [identity; MAX_TEXTURE_UNITS as usize],
            program: [identity; MAX_PROGRAM_MATRICES as usize],
        }
    }
}

impl FixedFunctionState {
    /// The value of `binding`, as single-precision patterns. Indices beyond the state are clamped to the last index.
    ///
    /// Cases that OpenGL leaves undefined follow IEEE arithmetic: the inverse of a singular matrix, 1 / (end - start)
    /// with equal ends, and the half vector of a light without direction contain infinities or NaN.
    pub fn value(&self, binding: StateBinding) -> [u32; 4] {
        let light = |n: u8| &self.lights[usize::from(n).min(self.lights.len() - 1)];
        match binding {
            StateBinding::Material(face, color) => self.material(face).colors[place(color)],
            StateBinding::Emission(face) => self.material(face).emission,
            StateBinding::Shininess(face) => [self.material(face).shininess, 0, 0, ONE],
            StateBinding::Light(n, color) => light(n).colors[place(color)],
            StateBinding::LightPosition(n) => light(n).position,
            StateBinding::LightAttenuation(n) => with_fourth(light(n).attenuation, light(n).spot_exponent),
            StateBinding::SpotDirection(n) => with_fourth(light(n).spot_direction, cosine(light(n).spot_cutoff)),
            StateBinding::LightHalf(n) => half_vector(light(n).position),
            StateBinding::LightModelAmbient => self.ambient,
            StateBinding::SceneColor(face) => self.scene_color(self.material(face)),
            StateBinding::LightProduct(n, face, color) => {
                let (light, material) = (light(n).colors[place(color)], self.material(face).colors[place(color)]);
                let product = |c: usize| single(double(light[c]) * double(material[c]));
                [product(0), product(1), product(2), material[3]]
            }
            StateBinding::TextureEnvironment(n) => {
                self.texture_environment[usize::from(n).min(self.texture_environment.len() - 1)]
            }
            StateBinding::FogColor => self.fog.color,
            StateBinding::FogParams => {
                [self.fog.density, self.fog.start, self.fog.end, single(1.0 / self.fog_distance())]
            }
            StateBinding::FogFactors => self.fog_factors(),
            StateBinding::DepthRange => {
                let [near, far] = self.depth_range;
                [near, far, single(double(far) - double(near)), ONE]
            }
            StateBinding::MatrixRow(matrix, form, row) => {
                let matrix = formed(self.matrix(matrix), form);
                matrix[usize::from(row & 3)].map(single)
            }
        }
    }

    fn material(&self, face: MaterialFace) -> &MaterialState {
        match face {
            MaterialFace::Front => &self.materials[0],
            MaterialFace::Back => &self.materials[1],
        }
    }

    /// Scene ambient times material ambient, plus emission.
    fn scene_color(&self, material: &MaterialState) -> [u32; 4] {
        let [ambient, diffuse, _] = material.colors;
        let sum = |c: usize| single(double(self.ambient[c]) * double(ambient[c]) + double(material.emission[c]));
        [sum(0), sum(1), sum(2), diffuse[3]]
    }

    fn fog_distance(&self) -> f64 {
        double(self.fog.end) - double(self.fog.start)
    }

    /// Uses e^-x = 2^(-x / ln 2) and e^-(x^2) = 2^-((x / sqrt(ln 2))^2).
    fn fog_factors(&self) -> [u32; 4] {
        let (density, end) = (double(self.fog.density), double(self.fog.end));
        let ln_2 = std::f64::consts::LN_2;
        [-1.0 / self.fog_distance(), end / self.fog_distance(), density / ln_2, density / ln_2.sqrt()].map(single)
    }

    fn matrix(&self, matrix: StateMatrix) -> [[f64; 4]; 4] {
        let number = |n: u8, all: &[MatrixRows; 8]| all[usize::from(n) & 7];
        let rows = match matrix {
            StateMatrix::ModelView => self.modelview,
            StateMatrix::Projection => self.projection,
            StateMatrix::Texture(n) => number(n, &self.texture),
            StateMatrix::Program(n) => number(n, &self.program),
            StateMatrix::Mvp => {
                let (a, b) = (self.projection.map(|r| r.map(double)), self.modelview.map(|r| r.map(double)));
                return a.map(|row| {
                    let entry = |c: usize| row[0] * b[0][c] + row[1] * b[1][c] + row[2] * b[2][c] + row[3] * b[3][c];
                    [entry(0), entry(1), entry(2), entry(3)]
                });
            }
        };
        rows.map(|row| row.map(double))
    }
}

fn place(color: LightingColor) -> usize {
    match color {
        LightingColor::Ambient => 0,
        LightingColor::Diffuse => 1,
        LightingColor::Specular => 2,
    }
}

fn with_fourth([x, y, z]: [u32; 3], w: u32) -> [u32; 4] {
    [x, y, z, w]
}

fn double(bits: u32) -> f64 {
    num::to_f64(&Format::FP32, bits)
}

/// Rounds to nearest even; any NaN becomes the positive quiet NaN.
fn single(value: f64) -> u32 {
    if value.is_nan() { 0x7fc0_0000 } else { (value as f32).to_bits() }
}

/// Cosine of an angle in degrees, with an error below 6e-8.
fn cosine(degrees: u32) -> u32 {
    let radians = single(double(degrees) * (std::f64::consts::PI / 180.0));
    num::ops::cos(Format::FP32, radians).bits
}

/// Half vector between the direction to a light and (0, 0, 1), the direction to a viewer at infinity.
fn half_vector(position: [u32; 4]) -> [u32; 4] {
    let normalized = |[x, y, z]: [f64; 3]| {
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    };
    let [x, y, z] = normalized([position[0], position[1], position[2]].map(double));
    with_fourth(normalized([x, y, z + 1.0]).map(single), ONE)
}

fn formed(matrix: [[f64; 4]; 4], form: MatrixForm) -> [[f64; 4]; 4] {
    let transposed = |m: [[f64; 4]; 4]| std::array::from_fn(|r| std::array::from_fn(|c| m[c][r]));
    match form {
        MatrixForm::Plain => matrix,
        MatrixForm::Transpose => transposed(matrix),
        MatrixForm::Inverse => inverse(&matrix),
        MatrixForm::InvTrans => transposed(inverse(&matrix)),
    }
}

/// Inverse as the adjugate divided by the determinant.
fn inverse(m: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    let cofactor = |row: usize, column: usize| {
        let other = |skipped: usize| -> [usize; 3] { std::array::from_fn(|i| i + usize::from(i >= skipped)) };
        let ([a, b, c], [x, y, z]) = (other(row), other(column));
        let minor = m[a][x] * (m[b][y] * m[c][z] - m[b][z] * m[c][y])
            - m[a][y] * (m[b][x] * m[c][z] - m[b][z] * m[c][x])
            + m[a][z] * (m[b][x] * m[c][y] - m[b][y] * m[c][x]);
        if (row + column).is_multiple_of(2) { minor } else { -minor }
    };
    let cofactors: [[f64; 4]; 4] = std::array::from_fn(|r| std::array::from_fn(|c| cofactor(r, c)));
    let determinant = (0..4).map(|c| m[0][c] * cofactors[0][c]).fold(0.0, |sum, term| sum + term);
    std::array::from_fn(|r| std::array::from_fn(|c| cofactors[c][r] / determinant))
}
