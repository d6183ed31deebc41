//! Pass 3 (4.2.4): the fragment programs that draw the model.
//!
//! - TEX0: two places in the atlas, xy and zw, whose component-wise minimum is the fragment's place; TEX1: the face's
//!   bounds in the atlas, half a texel inside; TEX2: the normal; TEX3: the position; TEX4: direct light by vertex.
//! - sampler 0: scattered irradiance, a rectangle; sampler 1: transmittances by cosine, 1-D.
//! - `p[0]`: factor from scattered irradiance times transmittance (exact: half of it) to the picture; w: smallest
//!   squared distance to a light. `p[1]`: eye; w: smallest squared length. `p[2]`: exact: eta^2 - 1, eta^2, eta; table:
//!   scale and offset from cosine to coordinate; w: shininess. `p[3]`: ambient light. Per light: `p[4]` position (w 1)
//!   or direction to the light (w 0), `p[5]` attenuation k0, k1, k2, `p[6]` diffuse, `p[7]` specular.

use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use super::LightKernel;
use crate::card::{KernelError, KernelText, checked, instructions};

/// The Fresnel transmittance towards the eye.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EyeTransmittance {
    /// Computed by the program.
    #[default]
    Exact,
    /// Read from a 1-D texture by the cosine.
    Table,
}

/// The stage that computes direct light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DirectLight {
    /// No direct light.
    None,
    /// At the vertices, interpolated.
    #[default]
    ByVertex,
    /// At each fragment.
    ByFragment,
}

/// A fragment program of pass 3, for any number of lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct ViewKernel {
    /// Transmittance towards the eye.
    pub transmittance: EyeTransmittance,
    /// Direct light that is added.
    pub direct: DirectLight,
}

const PLACE: &str = "!!FP1.0
# the place, within the face's bounds
MINR R0.xy, f[TEX0], f[TEX0].zwzw;
MAXR R0.xy, R0, f[TEX1];
MINR R0.xy, R0, f[TEX1].zwzw;
# four texels around, none beyond the bounds
ADDR R0.xy, R0, {-0.5, -0.5}.xyxy;
FRCR R1.xy, R0;
ADDR R0.xy, R0, -R1;
ADDR R0, R0.xyxy, {0.5, 0.5, 1.5, 1.5};
MINR R0.zw, R0, f[TEX1];
TEX R2, R0, TEX0, RECT;
TEX R3, R0.zyzw, TEX0, RECT;
TEX R4, R0.xwzw, TEX0, RECT;
TEX R5, R0.zwzw, TEX0, RECT;
# between them: where all four are the same, so is what comes out
ADDR R3, R3, -R2;
MADR R2, R3, R1.x, R2;
ADDR R5, R5, -R4;
MADR R4, R5, R1.x, R4;
ADDR R4, R4, -R2;
MADR R2, R4, R1.y, R2;
";

const DIRECTIONS: &str = "# the unit normal
DP3R R3.w, f[TEX2], f[TEX2];
MAXR R3.w, R3.w, p[1].w;
RSQR R3.w, R3.w;
MULR R3.xyz, f[TEX2], R3.w;
# to the eye
MOVR R4, p[1];
ADDR R4.xyz, R4, -f[TEX3];
DP3R R4.w, R4, R4;
MAXR R4.w, R4.w, p[1].w;
RSQR R4.w, R4.w;
MULR R4.xyz, R4, R4.w;
";

const EXACT: &str = "# half the transmittance: c g (1/(c + g)^2 + (eta/(eta^2 c + g))^2), g = sqrt(eta^2 - 1 + c^2)
DP3R_SAT R5.x, R3, R4;
MADR R5.y, R5.x, R5.x, p[2].x;
RSQR R5.z, R5.y;
MULR R5.y, R5.y, R5.z;
ADDR R5.z, R5.x, R5.y;
MADR R5.w, R5.x, p[2].y, R5.y;
RCPR R5.z, R5.z;
RCPR R5.w, R5.w;
MULR R5.w, R5.w, p[2].z;
MULR R5.zw, R5, R5;
ADDR R5.z, R5.z, R5.w;
MULR R5.x, R5.x, R5.y;
MULR R5.x, R5.x, R5.z;
MULR R2.xyz, R2, R5.x;
";

const TABLE: &str = "# the transmittance from a table
DP3R_SAT R5.x, R3, R4;
MADR R5.x, R5.x, p[2].x, p[2].y;
TEX R5, R5.x, TEX1, 1D;
MULR R2.xyz, R2, R5.x;
";

const LIGHTS: &str = "# direct light
MOVR R6, p[3];
MOVR R10.w, p[2];
# a light
MOVR R7, p[4];
MADR R7.xyz, f[TEX3], -R7.w, R7;
DP3R R7.w, R7, R7;
MAXR R7.w, R7.w, p[0].w;
RSQR R8.w, R7.w;
DSTR R9, R7.w, R8.w;
DP3R R9.w, R9, p[5];
RCPR R9.w, R9.w;
MULR R7.xyz, R7, R8.w;
ADDR R8.xyz, R7, R4;
DP3R R8.w, R8, R8;
MAXR R8.w, R8.w, p[1].w;
RSQR R8.w, R8.w;
DP3R R10.x, R3, R7;
DP3R R10.y, R3, R8;
MULR R10.y, R10.y, R8.w;
LITR R7, R10;
MULR R7.yz, R7, R9.w;
MADR R6.xyz, R7.y, p[6], R6;
MADR R6.xyz, R7.z, p[7], R6;
# end of a light
";

impl ViewKernel {
    /// All programs.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for transmittance in [EyeTransmittance::Exact, EyeTransmittance::Table] {
            let direct = [DirectLight::None, DirectLight::ByVertex, DirectLight::ByFragment];
            all.extend(direct.map(|direct| Self { transmittance, direct }));
        }
        all
    }

    /// A name for messages.
    pub fn name(&self) -> String {
        let transmittance = match self.transmittance {
            EyeTransmittance::Exact => "exact",
            EyeTransmittance::Table => "table",
        };
        let direct = match self.direct {
            DirectLight::None => "",
            DirectLight::ByVertex => "_by_vertex",
            DirectLight::ByFragment => "_by_fragment",
        };
        format!("view_{transmittance}{direct}")
    }

    /// The program for this number of lights computed at each fragment.
    pub fn text(&self, lights: usize) -> String {
        let by_fragment = self.direct == DirectLight::ByFragment;
        let mut text = [PLACE, DIRECTIONS].concat();
        text.push_str(match self.transmittance {
            EyeTransmittance::Exact => EXACT,
            EyeTransmittance::Table => TABLE,
        });
        if by_fragment {
            text.push_str(&LIGHT_PART.text(lights));
        }
        text.push_str("# the color\n");
        text.push_str(match self.direct {
            DirectLight::None => "MULR o[COLR].xyz, R2, p[0];\n",
            DirectLight::ByVertex => "MADR o[COLR].xyz, R2, p[0], f[TEX4];\n",
            DirectLight::ByFragment => "MADR o[COLR].xyz, R2, p[0], R6;\n",
        });
        text.push_str("MOVR o[COLR].w, {1}.x;\nEND\n");
        text
    }

    /// The maximum number of lights computed at each fragment within these instruction slots and constants.
    pub fn most_lights(&self, slots: usize, constants: usize) -> usize {
        LIGHT_PART.most_within([0, 1].map(|lights| instructions(&self.text(lights))), slots, constants)
    }

    /// The program for this number of lights computed at each fragment, checked for a device.
    pub fn checked(&self, profile: &Profile, lights: usize) -> Result<CheckedProgram, KernelError> {
        let name = self.name();
        let name = if self.direct == DirectLight::ByFragment {
            format!("`{name}`, written out for {lights} lights")
        } else {
            format!("`{name}`")
        };
        checked(profile, name, &self.text(lights))
    }
}

const LIGHT_PART: LightKernel =
    LightKernel { kernel: KernelText { name: "direct light", text: LIGHTS }, prefix: "p[", first: 4, step: 4 };
