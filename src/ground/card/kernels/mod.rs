//! The programs that draw a mesh with what its vertices hold.

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

#[cfg(test)]
mod tests {
    use refsim::device::Profile;

    use super::*;

    #[test]
    fn every_card_runs_what_its_languages_allow() {
        let in_ps_2_0 = [SHADE];
        for name in Profile::card_names() {
            let profile = Profile::named(name).expect("a card");
            let old = ["nv20", "nv25", "r200"].contains(&name);
            for kernel in FILES {
                let checked = kernel.checked(&profile);
                assert_eq!(checked.is_ok(), !old || !in_ps_2_0.contains(kernel), "{name}, {}", kernel.name);
            }
        }
    }
}
