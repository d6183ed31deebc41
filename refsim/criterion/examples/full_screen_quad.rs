//! Fill rate of a GeForce3 in modelled time: `cargo run --release -p refsim-criterion --example full_screen_quad`.

use refsim::machine::{DrawCall, VertexSource};
use refsim::raster::{Primitive, full_screen_quad};
use refsim::{asm, check, device::Profile, exec::Constants, texture::TexelFormat};
use refsim_criterion::ModelledTime;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let card = Profile::named("nv20")?;
    let program = check::check(asm::assemble("ps_1_1\nmov r0, v0\n")?, &card)?;
    let (quad, constants) = (full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]), Constants::default());
    let time = ModelledTime::on_card(card, |machine| {
        let target = machine.create_target(TexelFormat::Bgra8, 256, 256)?;
        let source = VertexSource::Transformed(&quad);
        machine.draw(&DrawCall::new(source, Primitive::QuadList, &program, &constants, target))
    })?;
    ModelledTime::bench("nv20", "65536 fragments", 256 * 256, time);
    Ok(())
}
