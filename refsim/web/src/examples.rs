//! Programs to begin with, one per language.

use serde::Serialize;

/// A program with a device that runs it.
#[derive(Debug, Serialize)]
pub(crate) struct Example {
    pub(crate) title: &'static str,
    pub(crate) device: &'static str,
    pub(crate) text: &'static str,
    /// A device to compare with.
    pub(crate) other: Option<OtherDevice>,
}

/// A device by its name.
#[derive(Debug, Serialize)]
pub(crate) struct OtherDevice {
    pub(crate) device: &'static str,
}

pub(crate) const EXAMPLES: [Example; 4] = [
    Example {
        title: "ps_1_4: a texture times a color",
        device: "r200",
        text: "ps_1_4\n\
               ; the checkerboard times the interpolated color, less a quarter, twice\n\
               def c0, 0.25, 0.25, 0.25, 0\n\
               texld r0, t0\n\
               mul r0, r0, v0\n\
               sub_x2_sat r0, r0, c0\n",
        other: Some(OtherDevice { device: "r300" }),
    },
    Example {
        title: "!!FP1.0: a dome under a light",
        device: "nv35",
        text: "!!FP1.0\n\
               # the normals' lengths are lost in 8 bits\n\
               TEX R0, f[TEX0], TEX2, 2D;\n\
               ADDR R0, R0, R0;\n\
               ADDR R0.xyz, R0, -{1}.x;\n\
               DP3R R1.x, R0, R0;\n\
               RSQR R1.x, R1.x;\n\
               MULR R0.xyz, R0, R1.x;\n\
               DP3R_SAT R1, R0, {0.5, 0.5, 0.70710678, 0};\n\
               MULR o[COLR], R1, f[COL0];\n\
               END\n",
        other: None,
    },
    Example {
        title: "!!ARBfp1.0: waves around the center",
        device: "r300",
        text: "!!ARBfp1.0\n\
               TEMP r;\n\
               # distance from the center, by 9\n\
               DP3 r.x, fragment.texcoord[1], fragment.texcoord[1];\n\
               RSQ r.y, r.x;\n\
               MUL r.x, r.x, r.y;\n\
               MUL r.x, r.x, 9.0;\n\
               SIN r.x, r.x;\n\
               MAD result.color, r.x, 0.5, 0.5;\n\
               END\n",
        other: None,
    },
    Example {
        title: "WGSL: a highlight (GGX), beside all in f16",
        device: "ideal-fp32",
        text: "const roughness = 0.3;\n\
               @fragment\n\
               fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n\
               \x20   let xy = uv * 1.8 - vec2f(0.9);\n\
               \x20   let n = vec3f(xy, sqrt(max(1.0 - dot(xy, xy), 0.01)));\n\
               \x20   let h = normalize(vec3f(0.4, 0.3, 1.8));\n\
               \x20   let alpha2 = roughness * roughness * roughness * roughness;\n\
               \x20   let n_dot_h = max(dot(n, h), 0.0);\n\
               \x20   let d = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;\n\
               \x20   return vec4f(vec3f(min(alpha2 / (3.14159265 * d * d) * 0.02, 1.0)), 1.0);\n\
               }\n",
        other: Some(OtherDevice { device: "ideal-fp16" }),
    },
];
