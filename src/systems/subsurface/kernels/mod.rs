//! The programs of the three passes: files, and generated programs that depend on links, lights or options.

mod gather;
mod repeated;
mod view;

use refsim::device::Limits;

use crate::card::kernels;
pub use gather::{GatherKernel, LinkLayout, MapTexture};
pub use repeated::LightKernel;
pub use view::{DirectLight, EyeTransmittance, ViewKernel};

kernels! {
    /// All program files of this folder; those that compute lights contain the code for one light.
    FILES:
    LIGHT_VERTICES "light_vertices.vsa"
    LIT "lit.fp"
    LIT_NEXT "lit_next.fp"
    LIGHT_TEXELS "light_texels.fp"
    LIGHT_TEXELS_NEXT "light_texels_next.fp"
    MEAN "mean.fp"
    COPY "copy.fp"
    VIEW "view.vsa"
    VIEW_LIT "view_lit.vsa"
}

/// Program of pass 1 at vertices.
pub const VERTEX_LIGHTS: LightKernel = LightKernel { kernel: LIGHT_VERTICES, prefix: "c", first: 3, step: 3 };
/// Programs of pass 1 at texels: for the first pass over lights, and for later passes.
pub const TEXEL_LIGHTS: [LightKernel; 2] = [
    LightKernel { kernel: LIGHT_TEXELS, prefix: "p[", first: 2, step: 3 },
    LightKernel { kernel: LIGHT_TEXELS_NEXT, prefix: "p[", first: 2, step: 3 },
];
/// Direct light at vertices in pass 3.
pub const VIEW_LIGHTS: LightKernel = LightKernel { kernel: VIEW_LIT, prefix: "c", first: 7, step: 4 };

/// Instruction slots and constants of a device's vertex programs; typical numbers if it states no limit.
pub(super) fn vertex_room(limits: &Limits) -> [usize; 2] {
    [limits.vertex_instructions.unwrap_or(256) as usize, limits.vertex_constants.unwrap_or(256) as usize]
}

/// Instruction slots and constants of a device's fragment programs; typical numbers if it states no limit.
pub(super) fn fragment_room(limits: &Limits) -> [usize; 2] {
    [limits.fragment_instructions.unwrap_or(1024) as usize, limits.fragment_parameters.unwrap_or(64) as usize]
}

/// All programs by name: files, and generated programs for some numbers of links or lights.
pub fn programs() -> Vec<(String, String)> {
    let files = FILES.iter().map(|file| (file.name.to_owned(), file.text.to_owned()));
    let lights = [VERTEX_LIGHTS, TEXEL_LIGHTS[0], TEXEL_LIGHTS[1], VIEW_LIGHTS];
    let lights = lights.into_iter().map(|kernel| (format!("{}, 3 lights", kernel.kernel.name), kernel.text(3)));
    let gathers = GatherKernel::all()
        .into_iter()
        .flat_map(|kernel| [1, 6].map(|links| (format!("{}, {links} links", kernel.name()), kernel.text(links))));
    let views = ViewKernel::all().into_iter().map(|kernel| (kernel.name(), kernel.text(2)));
    files.chain(lights).chain(gathers).chain(views).collect()
}
