//! The fill rate of a GeForce3, in its own time: `cargo run --release -p refsim-criterion --example full_screen_quad`.

use criterion::Throughput;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::raster::{PixelCenter, Primitive, full_screen_quad};
use refsim::timing::{Level, Model};
use refsim::{asm, check, device::Profile, exec::Constants, texture::TexelFormat};
use refsim_criterion::ModelledTime;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let card = Profile::named("nv20")?;
    let model = Model::new(Level::Pipeline, &card)?;
    let program = check::check(asm::assemble("ps_1_1\nmov r0, v0\n")?, &card)?;
    let mut machine = Machine::new(card, ExecutorKind::Batch);
    let target = machine.create_target(TexelFormat::Bgra8, 256, 256)?;
    let (quad, constants) = (full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]), Constants::default());
    let source = VertexSource::Transformed(&quad);
    let mut call = DrawCall::new(source, Primitive::QuadList, &program, &constants, target);
    call.center = PixelCenter::OpenGl;
    machine.record(true);
    machine.draw(&call)?;
    let time = ModelledTime::of(&machine.take_log(), &model, &Default::default())?;

    let mut criterion = ModelledTime::criterion();
    let mut group = criterion.benchmark_group("nv20");
    group.throughput(Throughput::Elements(256 * 256));
    group.bench_function("65536 fragments", |bencher| bencher.iter_custom(|n| ModelledTime::repeat(time, n)));
    group.finish();
    Ok(())
}
