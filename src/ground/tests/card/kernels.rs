use crossbar_ground::card::kernels::{FILES, SHADE};
use refsim::device::Profile;

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
