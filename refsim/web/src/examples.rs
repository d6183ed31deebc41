//! Example programs and shaders.

use serde::Serialize;

/// A program with a device that runs it.
#[derive(Debug, Serialize)]
pub(crate) struct Example {
    pub(crate) title: &'static str,
    pub(crate) device: &'static str,
    pub(crate) text: &'static str,
}

pub(crate) const EXAMPLES: [Example; 3] = [
    Example {
        title: "ps_1_4: a texture times a color",
        device: "r200",
        text: "ps_1_4\n\
               ; the checkerboard times the interpolated color, less a quarter, twice\n\
               def c0, 0.25, 0.25, 0.25, 0\n\
               texld r0, t0\n\
               mul r0, r0, v0\n\
               sub_x2_sat r0, r0, c0\n",
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
    },
];

/// A shader and the values of its uniforms.
#[cfg(feature = "wgsl")]
#[derive(Debug, Serialize)]
pub(crate) struct ShaderExample {
    pub(crate) title: &'static str,
    pub(crate) text: &'static str,
    pub(crate) uniforms: &'static [(&'static str, &'static [f32])],
}

#[cfg(feature = "wgsl")]
macro_rules! shader {
    ($name:literal, $title:literal $(, $uniform:literal = $value:expr)*) => {
        ShaderExample {
            title: $title,
            text: include_str!(concat!("../../../docs/examples/wgsl/", $name, ".wgsl")),
            uniforms: &[$(($uniform, &$value)),*],
        }
    };
}

/// The shaders of docs/wgsl.md that read no texture.
#[cfg(feature = "wgsl")]
pub(crate) const SHADERS: [ShaderExample; 10] = [
    shader!("ggx", "ggx: a highlight", "roughness" = [0.3]),
    shader!("dither", "dither: a dark gradient", "levels" = [255.0]),
    shader!("fresnel", "fresnel: reflectance of a sphere", "f0" = [0.04, 0.3, 0.9]),
    shader!("gamma", "gamma: sRGB decoded and encoded"),
    shader!("noise", "noise: three octaves", "scale" = [5.0]),
    shader!("parallax", "parallax: relief by eight steps", "view" = [0.3, 0.2, 0.9], "depth" = [0.2]),
    shader!("rounded_box", "rounded_box: a distance", "box.half_size" = [24.0, 16.0], "box.radius" = [6.0]),
    shader!("shadow", "shadow: bias by the slope", "bias" = [1.0], "texels" = [24.0]),
    shader!(
        "skin",
        "skin: a face between two bones",
        "bones.first[0]" = [1.0, 0.0, 0.0],
        "bones.first[1]" = [0.0, 1.0, 0.0],
        "bones.first[2]" = [0.0, 0.0, 1.0],
        "bones.second[0]" = [0.8, 0.6, 0.0],
        "bones.second[1]" = [-0.6, 0.8, 0.0],
        "bones.second[2]" = [0.0, 0.0, 1.0]
    ),
    shader!("tone_map", "tone_map: twelve stops", "exposure" = [1.0]),
];
