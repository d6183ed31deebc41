//! `refsim`: a bit-exact emulator of the first programmable graphics cards.
//!
//! [`asm`] parses the assembly languages of the period into an [`isa::Program`]. [`check`](mod@check) validates it
//! against a [`device::Profile`], which holds a card's limits and arithmetic, and returns a [`check::Checked`] program
//! or all rules that it violates. A [`machine::Machine`] owns textures and render targets and executes draw calls:
//! vertices through a vertex program, [`raster`] from triangles to fragments, [`exec`] for the pixel program,
//! [`output`] for tests and blending. [`texture`] defines texels and sampling, [`num`] number formats and arithmetic;
//! [`event`] counts the work of a draw, and [`timing`] derives durations from it. The crate is independent of what is
//! drawn: ray casting, radiosity and transfer are implemented in the crate above.
//!
//! The same input and the same profile give the same bits, on every CPU, thread count, executor and build profile. The
//! executors compute them by different means: the scalar one in integers, one value at a time, following the
//! specifications; the batch one with the host's SIMD instructions; a third, with the feature `wgpu`, in WGSL. Tests
//! compare them.
//!
//! A full-screen quad on a Radeon 8500 that doubles a colour, in 16-bit fixed point:
//!
//! ```
//! use refsim::exec::Constants;
//! use refsim::machine::{DrawCall, ExecutorKind, Machine, VertexSource};
//! use refsim::raster::{PixelCenter, Primitive, full_screen_quad};
//! use refsim::texture::TexelFormat;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let r200 = refsim::device::Profile::named("r200")?;
//! let program = refsim::check::check(refsim::asm::assemble("ps_1_4\nmov_x2 r0, v0\n")?, &r200)?;
//!
//! let mut card = Machine::new(r200, ExecutorKind::Scalar);
//! let target = card.create_target(TexelFormat::Bgra8, 4, 4)?;
//! let mut quad = full_screen_quad(|u, v| [[u, v, 0.0, 1.0]]);
//! quad.iter_mut().for_each(|vertex| vertex.colors[0] = [0.25, 0.5, 0.75, 1.0].map(f32::to_bits));
//! let constants = Constants::default();
//! let vertices = VertexSource::Transformed(&quad);
//! let mut call = DrawCall::new(vertices, Primitive::QuadList, &program, &constants, target);
//! call.center = PixelCenter::OpenGl;
//!
//! let events = card.draw(&call)?;
//! assert_eq!(events.fragments.passed, 16);
//! // A8R8G8B8: a quarter doubled is 128/255, a half 1, three quarters saturate.
//! assert_eq!(card.read_back(target)?.pixel(2, 1), Some([128.0 / 255.0, 1.0, 1.0, 1.0]));
//! # Ok(())
//! # }
//! ```

pub mod asm;
pub mod check;
pub mod device;
pub mod event;
pub mod exec;
pub mod isa;
pub mod machine;
pub mod num;
pub mod output;
pub mod raster;
pub mod texture;
pub mod timing;
