//! The programs of the three passes: files where a program is one text, and text written here where the links, the
//! lights or the options decide.

mod gather;
mod repeated;
mod view;

use crate::card::kernels;
pub use gather::{GatherKernel, LinkLayout, MapTexture};
pub use repeated::LightKernel;
pub use view::{DirectLight, EyeTransmittance, ViewKernel};

kernels! {
    /// Every file of this folder; those with lights have one.
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

/// Pass 1 at vertices.
pub const VERTEX_LIGHTS: LightKernel = LightKernel { kernel: LIGHT_VERTICES, prefix: "c", first: 3, step: 3 };
/// Pass 1 at texels: the first pass over lights, and later ones.
pub const TEXEL_LIGHTS: [LightKernel; 2] = [
    LightKernel { kernel: LIGHT_TEXELS, prefix: "p[", first: 2, step: 3 },
    LightKernel { kernel: LIGHT_TEXELS_NEXT, prefix: "p[", first: 2, step: 3 },
];
/// Direct light at vertices in pass 3.
pub const VIEW_LIGHTS: LightKernel = LightKernel { kernel: VIEW_LIT, prefix: "c", first: 7, step: 4 };

/// Every program that there is, by name: files, and those written here for a few links or lights.
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

#[cfg(test)]
mod tests {
    use super::*;
    use refsim::device::Profile;
    use refsim::isa::Version;

    #[test]
    fn every_program_runs_on_every_geforce_fx() {
        let names = Profile::card_names().into_iter().chain(Profile::variant_names());
        let profiles = names.map(|name| Profile::named(name).expect("a device"));
        let cards: Vec<Profile> = profiles.filter(|p| p.limits.versions.contains(&Version::Fp1_0)).collect();
        assert!(cards.len() >= 4, "two cards and their variants");
        for profile in cards {
            for (name, text) in programs() {
                crate::card::checked(&profile, name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
            }
        }
    }

    #[test]
    fn a_file_is_the_program_for_one_light() {
        for kernel in [VERTEX_LIGHTS, TEXEL_LIGHTS[0], TEXEL_LIGHTS[1], VIEW_LIGHTS] {
            assert_eq!(kernel.text(1), kernel.kernel.text);
            let two = kernel.text(2);
            let last = kernel.first + 2 * kernel.step - 1;
            assert!(two.contains(&format!("{}{last}", kernel.prefix)), "{two}");
        }
    }

    /// Four links share a texture of factors: 1.25 lookups per link. Adaptive links take two.
    #[test]
    fn sixteen_links_fit_as_the_paper_has_them() {
        let nv35 = Profile::named("nv35").expect("a card");
        let kernel = |layout, map, rgb| GatherKernel { layout, rgb, map, half: false, continues: false, tiles: 1 };
        let fixed = kernel(LinkLayout::Fixed, MapTexture::Leveled, false);
        assert_eq!((fixed.instructions(16), fixed.samplers(16)), (37, 5));
        let rgb = kernel(LinkLayout::Fixed, MapTexture::Leveled, true);
        assert_eq!((rgb.instructions(16), rgb.samplers(16)), (53, 13));
        let adaptive = kernel(LinkLayout::Adaptive, MapTexture::Leveled, false);
        assert_eq!((adaptive.instructions(16), adaptive.samplers(16)), (49, 17));
        assert!(adaptive.checked(&nv35, 15).is_ok());
        let refused = adaptive.checked(&nv35, 16).expect_err("17 samplers").to_string();
        assert!(refused.contains("TEX16"), "{refused}");
        // Sixteen textures as tiles of one: an addition for each but the first, and one pass.
        let tiled = GatherKernel { tiles: 4, ..adaptive };
        assert_eq!((tiled.instructions(16), tiled.samplers(16), tiled.constants(16)), (49 + 15, 2, 1 + 15));
        assert!(tiled.checked(&nv35, 16).is_ok());
        for kernel in GatherKernel::all() {
            let most = (1..=64).rev().find(|&n| kernel.samplers(n) <= 16 && kernel.constants(n) <= 64).expect("one");
            let program = kernel.checked(&nv35, most).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(program.instructions.len(), kernel.instructions(most), "{}", kernel.name());
        }
    }

    #[test]
    fn the_most_lights_are_what_the_card_takes() {
        let nv35 = Profile::named("nv35").expect("a card");
        for (kernel, instructions, constants) in [
            (VERTEX_LIGHTS, 256, 256),
            (VIEW_LIGHTS, 256, 256),
            (TEXEL_LIGHTS[0], 1024, 64),
            (TEXEL_LIGHTS[1], 1024, 64),
        ] {
            let most = kernel.most_lights(instructions, constants);
            kernel.checked(&nv35, most).unwrap_or_else(|e| panic!("{e}"));
            assert!(kernel.checked(&nv35, most + 1).is_err(), "{}: {most} is not the most", kernel.kernel.name);
        }
    }
}
