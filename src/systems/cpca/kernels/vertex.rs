//! The vertex programs of section 6.2: they compute e_p = alpha M_0 l + w_1 M_1 l + w_2 M_2 l + ..., and the local view
//! vector.
//!
//! - v0: position, w = 1; v1.x: index of the first constant of the vertex's cluster, relative to
//!   [`VertexKernel::first`]; v1.y: alpha; v2 and up: weights, four per register; if glossy, then tangent and normal.
//! - c0 to c3: rows of the projection; if glossy, c4: the eye; then the products of a supercluster's clusters with the
//!   light, vector by vector.
//! - Output: if diffuse, the radiance; if glossy, e_p in oT0 and up, four numbers per set, then the local view vector.

use std::fmt::Write as _;

use refsim::isa::Version;

use crate::card::{TO_CLIP, WrittenKernel, local_view};

/// The output of a vertex program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VertexShading {
    /// Radiance in three channels, in the first set of texture coordinates.
    Diffuse,
    /// Radiance in the diffuse vertex color, which is clamped to [0, 1].
    DiffuseColor,
    /// Coefficients of exit radiance of one channel, and the local view vector.
    Glossy {
        /// Registers per vector: four coefficients each.
        registers: usize,
    },
}

/// A vertex program for clusters of n' vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VertexKernel {
    /// The output.
    pub shading: VertexShading,
    /// Number n' of representative vectors, without the mean.
    pub vectors: usize,
    /// [`Version::Vs2_0`] or [`Version::Vs1_1`].
    pub version: Version,
}

/// First attribute register of the weights.
const WEIGHTS: usize = 2;
const COMPONENTS: [char; 4] = ['x', 'y', 'z', 'w'];
const ATTRIBUTES: usize = 16;

impl VertexKernel {
    /// The index of the first constant with products.
    pub fn first(&self) -> usize {
        if self.glossy() { 5 } else { 4 }
    }

    /// Number of constants per vector.
    pub fn per_vector(&self) -> usize {
        if let VertexShading::Glossy { registers } = self.shading { registers } else { 1 }
    }

    /// Number of weight registers.
    pub fn weight_registers(&self) -> usize {
        self.vectors.div_ceil(4)
    }

    /// The attribute registers of tangent and normal.
    pub fn frame_registers(&self) -> [usize; 2] {
        [0, 1].map(|axis| WEIGHTS + self.weight_registers() + axis)
    }

    /// Number of vertex attributes.
    pub fn attributes(&self) -> usize {
        WEIGHTS + self.weight_registers() + if self.glossy() { 2 } else { 0 }
    }

    /// The largest number of vectors whose weights fit the attribute registers.
    pub fn most_vectors(&self) -> usize {
        4 * (ATTRIBUTES - WEIGHTS - if self.glossy() { 2 } else { 0 })
    }

    /// Number of instruction slots.
    pub fn slots(&self) -> usize {
        5 + if self.glossy() { 7 } else { 0 } + self.per_vector() * (self.vectors + 1)
    }

    fn glossy(&self) -> bool {
        matches!(self.shading, VertexShading::Glossy { .. })
    }

    /// Writes the weighted sum over vectors for one register.
    fn push_sum(&self, text: &mut String, register: usize, output: &str) {
        for vector in 0..=self.vectors {
            let into = if vector == self.vectors { output } else { "r3" };
            let constant = self.first() + vector * self.per_vector() + register;
            let _ = match vector.checked_sub(1) {
                None => writeln!(text, "mul {into}, v1.y, c[a0.x + {constant}]"),
                Some(weight) => {
                    let (attribute, component) = (WEIGHTS + weight / 4, COMPONENTS[weight % 4]);
                    writeln!(text, "mad {into}, v{attribute}.{component}, c[a0.x + {constant}], r3")
                }
            };
        }
    }
}

impl WrittenKernel for VertexKernel {
    fn name(&self) -> String {
        let what = match self.shading {
            VertexShading::Diffuse => "diffuse".to_owned(),
            VertexShading::DiffuseColor => "diffuse_color".to_owned(),
            VertexShading::Glossy { registers } => format!("glossy_{registers}"),
        };
        format!("{what}, {} vectors, {}", self.vectors, self.version)
    }

    fn text(&self) -> String {
        let [tangent, normal] = self.frame_registers();
        let mut text = format!("{}\n; {}\ndcl_position v0\n", self.version, self.name());
        for register in 0..=self.weight_registers() {
            let _ = writeln!(text, "dcl_texcoord{register} v{}", 1 + register);
        }
        if self.glossy() {
            let _ = writeln!(text, "dcl_tangent v{tangent}\ndcl_normal v{normal}");
        }
        text.push_str(TO_CLIP);
        if let VertexShading::Glossy { registers } = self.shading {
            text.push_str(&local_view(tangent, normal));
            let _ = write!(
                text,
                "dp3 oT{registers}.x, r0, r1\ndp3 oT{registers}.y, r0, r2\ndp3 oT{registers}.z, r0, v{normal}\n"
            );
        }
        let address = if self.version == Version::Vs1_1 { "mov" } else { "mova" };
        let _ = writeln!(text, "; the first constant of the cluster\n{address} a0.x, v1.x");
        for register in 0..self.per_vector() {
            let output = match self.shading {
                VertexShading::DiffuseColor => "oD0".to_owned(),
                VertexShading::Diffuse | VertexShading::Glossy { .. } => format!("oT{register}"),
            };
            self.push_sum(&mut text, register, &output);
        }
        text
    }
}
