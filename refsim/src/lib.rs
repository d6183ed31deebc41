//! `refsim`: a bit-exact emulator of the first programmable graphics cards.
//!
//! The input is a program text, textures, constants and triangles. The output is pictures with the bits of the card's
//! arithmetic, and counts from which a model derives the card's time:
//!
//! ```text
//!   program text                        vertices
//!        | asm                             | vertex program
//!   isa::Program                        raster: triangles to fragments
//!        | check, against a                |
//!        | device::Profile              exec: pixel program <--- texture
//!   Checked<Program> ------ machine ------>|
//!                                       output: tests, blending
//!   event: counts <------------------------+----> targets, depth buffer
//!        | timing
//!   durations, a timeline
//! ```
//!
//! [`num`] defines number formats and their arithmetic, which all other modules use. The crate is independent of
//! applications such as ray casting and radiosity.
//!
//! The same input and the same profile give the same bits, on every CPU, thread count, executor and build profile. Each
//! executor has its own arithmetic: the scalar executor computes in integers, one value at a time, following the
//! specifications; the batch executor uses the host's SIMD instructions; the wgpu executor (feature `wgpu`) computes in
//! WGSL. Tests compare them.
//!
//! # A draw
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
//! // A8R8G8B8: 1/4 doubled is 128/255, 1/2 doubled is 1, and 3/4 saturates.
//! assert_eq!(card.read_back(target)?.pixel(2, 1), Some([128.0 / 255.0, 1.0, 1.0, 1.0]));
//! # Ok(())
//! # }
//! ```
//!
//! The example `textured` of this crate binds a texture and a constant, and draws on three cards.
//!
//! # An operation
//!
//! Any number format, without a card: see [`num`].
//!
//! ```
//! use refsim::num::{Format, ops};
//!
//! let half: Format = "fp16".parse()?;
//! assert_eq!(ops::add(&half, 0x3c00, 0x4000).bits, 0x4200); // 1 + 2 = 3
//! let card: Format = "s3.12:rdn".parse()?;
//! assert_eq!(ops::mul(&card, 0x0001, 0x0800).bits, 0); // half of the smallest number is lost
//! # Ok::<(), refsim::num::FormatError>(())
//! ```
//!
//! # A mistake
//!
//! Errors of a program quote its line, even if `main` returns them:
//!
//! ```
//! let errors = refsim::asm::assemble("ps_1_4\nmov r0, r1\nmull r0, r0, r0\n").expect_err("a wrong name");
//! assert_eq!(errors.to_string(), "\
//! the program has a syntax error
//! line 3, column 1: unknown instruction: expected an instruction, found `mull`
//!     mull r0, r0, r0
//!     ^^^^
//!     help: did you mean `mul`?");
//! ```
//!
//! # Where next
//!
//! - [`machine`]: textures, targets, draws, read-back, traces of single pixels
//! - [`device`]: the cards, their figures with sources, and switches for what the sources leave open
//! - [`num`]: formats as strings, operations, flags
//! - [`timing`]: from a machine's log to clocks and a timeline; the crate `refsim-criterion` benchmarks in modelled
//!   time

pub mod asm;
pub mod check;
pub mod device;
pub mod event;
pub mod exec;
pub mod front;
pub mod isa;
pub mod machine;
pub mod output;
pub mod raster;
mod texel;
pub mod texture;
pub mod timing;

#[doc(inline)]
pub use refsim_lanes::num;
