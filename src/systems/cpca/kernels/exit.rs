//! The pixel program of glossy transfer (section 6.2): exit radiance at the view vector, y(v_p) times e_p.
//!
//! - t0 and up: e_p, four numbers per set; then the local view vector, of any length.
//! - s0 and up: y in parabolic maps, four functions per map.

use std::fmt::Write as _;

use crate::card::{PARABOLIC, WrittenKernel, parabolic};

/// Number of coordinate sets in ps_2_0.
const SETS: usize = 8;

/// The program for exit radiance, with four coefficients per register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ExitKernel {
    /// Sets of coordinates with coefficients, and maps.
    pub registers: usize,
}

impl ExitKernel {
    /// Maximum number of registers that can be interpolated besides the view vector.
    pub const MAX_REGISTERS: usize = SETS - 1;
}

impl WrittenKernel for ExitKernel {
    fn name(&self) -> String {
        format!("exit_{}", self.registers)
    }

    fn text(&self) -> String {
        let view = format!("t{}", self.registers);
        let mut text = format!("ps_2_0\n; {}\n{PARABOLIC}", self.name());
        for set in 0..self.registers {
            let _ = writeln!(text, "dcl t{set}\ndcl_2d s{set}");
        }
        let _ = writeln!(text, "dcl {view}.xyz");
        text.push_str(&parabolic(&view));
        for map in 0..self.registers {
            let _ = writeln!(text, "texld r{}, r0, s{map}", 2 + map);
        }
        text.push_str("mul r1, r2, t0\n");
        for map in 1..self.registers {
            let _ = writeln!(text, "mad r1, r{}, t{map}, r1", 2 + map);
        }
        text.push_str("dp4 r1, r1, c0.x\nmov oC0, r1\n");
        text
    }
}
