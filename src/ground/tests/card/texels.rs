use crossbar_ground::card::{Texels, new_target};
use refsim::device::Profile;
use refsim::machine::{Executor, ExecutorKind};
use refsim::texture::TexelFormat;

#[test]
fn floats_come_back_as_the_format_holds_them() {
    let card = Profile::named("ideal-fp32").expect("a device");
    let mut machine = Executor::from(ExecutorKind::Scalar).machine(card).expect("a machine");
    let texels = Texels::vector(vec![[1.0, -0.0, 1.0 / 3.0, 65504.0], [0.1, 2.0, 3.0, 4.0]]);
    for (format, expected) in [
        (TexelFormat::Rgba32f, texels.texels.clone()),
        (TexelFormat::Rgba16f, vec![[1.0, -0.0, 0.333_251_95, 65504.0], [0.099_975_586, 2.0, 3.0, 4.0]]),
        // Values that the card reads for components that the format lacks.
        (TexelFormat::R32f, vec![[1.0, 1.0, 1.0, 1.0], [0.1, 1.0, 1.0, 1.0]]),
    ] {
        let texture = texels.upload(&mut machine, format).expect("a texture");
        let back = Texels::read_back(&machine, texture).expect("its texels");
        assert_eq!(back, Texels { texels: expected, ..texels.clone() }, "{format:?}");
        let bits = |texels: &Texels| texels.texels.iter().map(|texel| texel.map(f32::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&back)[0][1] >> 31, u32::from(format != TexelFormat::R32f), "the sign of zero");
        let target = new_target(&mut machine, format, [2, 1]).expect("a target");
        assert_eq!(Texels::read_back(&machine, target).expect("zeros").texels[0][0], 0.0);
        let few = Texels { height: 2, ..texels.clone() };
        assert!(few.upload(&mut machine, format).is_err(), "too few texels");
        assert!(Texels::default().upload(&mut machine, format).is_err(), "none");
    }
}
