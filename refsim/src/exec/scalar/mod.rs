//! The reference executor: one value at a time, in integer arithmetic, in the order of the specifications.
//!
//! - `interpreter`: executes programs on four lanes in lockstep; `flow`: flow control by lane masks.
//! - `operation`, `macros`: arithmetic operations; `texture`: texture instructions.
//! - `registers`: reads and writes of registers; `alu`: arithmetic under the device's rules.
//! - `fragment`, `fragment_state`, `fragment_texture`: instructions of OpenGL fragment programs, in three precisions.
//! - `prepared`: per-draw preparation; `pixel`, `vertex`, `tile`: entry points.
//!
//! The order within an instruction is Direct3D's: swizzle, source modifier, operation, shift, saturation, write mask.
//! Behaviour that cards leave undefined is defined here: unwritten registers and alpha after `phase` are zero, a
//! constant outside its file is zero, an unbound sampler reads (0, 0, 0, 1), a loop makes at most 255 iterations, and a
//! call that leads backward is skipped.

mod alu;
mod depth_and_kill;
mod flow;
mod fragment;
mod fragment_state;
mod fragment_texture;
mod interpreter;
mod macros;
mod operation;
mod pack;
mod pixel;
mod prepared;
mod registers;
mod texture;
mod tile;
mod vertex;

pub use pixel::PixelProgram;
pub use tile::ScalarTiles;
pub use vertex::{VertexProgram, VertexResult};

use crate::isa::Opcode;
use crate::num::{Format, Unpacked, ops, unpack};

/// Converts a number for `a0`: rounded to nearest even (`mova`), or down (`mov` in vs_1_1), and saturated to 32 bits.
/// NaN gives 0.
fn address_value(format: Format, opcode: Opcode, bits: u32) -> i32 {
    let rounded = match opcode {
        Opcode::Mova => ops::round_to_int_with(format, bits, crate::num::Rounding::NearestEven, false),
        _ => ops::floor(format, bits),
    };
    match unpack(&format, rounded.bits) {
        Unpacked::Nan { .. } => 0,
        Unpacked::Inf { sign } => {
            if sign {
                i32::MIN
            } else {
                i32::MAX
            }
        }
        Unpacked::Finite { sign, sig, exp, den } => {
            // `sig` is an integer: bits below the point are zero. If a normalized format ends before the next integer,
            // its largest number represents that integer, and is truncated here.
            let sig = sig / u64::from(den);
            let magnitude = match exp {
                0.. if sig == 0 => 0,
                0..=40 => i128::from(sig) << exp,
                41.. => i128::MAX,
                _ => i128::from(sig.checked_shr(exp.unsigned_abs()).unwrap_or(0)),
            };
            let value = if sign { -magnitude } else { magnitude };
            value.clamp(i32::MIN.into(), i32::MAX.into()) as i32
        }
    }
}
