//! Programs that draw a mesh with per-vertex data.

use super::kernels;

kernels! {
    /// Every file of this folder.
    FILES:
    COLOR "color.vsa"
    DEPTH "depth.vsa"
    FLOAT_COLOR "float_color.vsa"
    SHADE "shade.psa"
    SHADE_COLOR "shade_color.psa"
}
