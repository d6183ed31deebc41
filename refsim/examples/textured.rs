//! A checkerboard, filtered, times a constant, on three cards: one program, one set of inputs, other bits and other
//! times.
//!
//! `cargo run -p refsim --example textured`
#![expect(clippy::print_stdout, reason = "an example shows what it found")]

use refsim::asm::assemble;
use refsim::check::check;
use refsim::device::Profile;
use refsim::exec::Constants;
use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
use refsim::raster::{Primitive, full_screen_quad};
use refsim::texture::{Filter, Image, SamplerState, TexelFormat};
use refsim::timing::replay::{Options, replay};
use refsim::timing::{Level, Model};

const PROGRAM: &str = "
ps_1_1
tex t0              // the checkerboard
mul r0, t0, c0      // times the constant
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for name in ["nv20", "r200", "r300"] {
        let card = Profile::named(name)?;
        // A mistake in the text, or a rule of the card that it breaks, ends the program with line and advice.
        let program = check(assemble(PROGRAM)?, &card)?;
        let model = Model::new(Level::Pipeline, &card)?;
        let mut machine = Machine::new(card, ExecutorKind::Batch);
        machine.record(true);

        let mut board = Image::new_2d(TexelFormat::Bgra8, 8, 8)?;
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
            let color: u128 = if (x + y) % 2 == 0 { 0xffff_ffff } else { 0xff00_40c0 };
            board.set_raw(0, 0, y, x, color);
        }
        let board = machine.create_texture(board)?;
        let target = machine.create_target(TexelFormat::Bgra8, 64, 64)?;

        let tint = [1.0, 0.7, 0.3, 1.0f32].map(f32::to_bits);
        let constants = Constants { float: vec![tint], ..Constants::default() };
        let quad = full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]);
        let linear = SamplerState { min: Filter::Linear, mag: Filter::Linear, ..SamplerState::NEAREST_CLAMP };
        let call = DrawCall::new(VertexSource::Transformed(&quad), Primitive::QuadList, &program, &constants, target)
            .with_texture(0, board, linear);
        machine.draw(&call)?;

        let pixel = machine.read_back(target)?.pixel(21, 30).ok_or("the target has this pixel")?;
        let run = replay(&machine.take_log(), &model, &Options::default())?;
        let microseconds = run.timeline.makespan().seconds() * 1e6;
        println!("{name}: pixel (21, 30) is {:?} of 255, {microseconds:.2} us", pixel.map(|channel| channel * 255.0));
    }
    Ok(())
}
