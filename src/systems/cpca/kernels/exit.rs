//! The pixel program of glossy transfer (section 6.2): exit radiance at the view vector, y(v_p) times e_p.
//!
//! - t0 on: e_p, four numbers per set; then the local view vector, of any length.
//! - s0 on: y in parabolic maps, four functions per map.

use std::fmt::Write as _;

use refsim::device::Profile;
use refsim::exec::CheckedProgram;

use crate::card::{KernelError, checked};

/// The sets of coordinates that ps_2_0 has.
const SETS: usize = 8;

/// The program for exit radiance with a number of registers of four coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ExitKernel {
    /// Sets of coordinates with coefficients, and maps.
    pub registers: usize,
}

impl ExitKernel {
    /// The most registers that can be interpolated beside the view vector.
    pub const MAX_REGISTERS: usize = SETS - 1;

    /// A name for messages.
    pub fn name(&self) -> String {
        format!("exit_{}", self.registers)
    }

    /// The program.
    pub fn text(&self) -> String {
        let view = format!("t{}", self.registers);
        let mut text = format!("ps_2_0\n; {}\ndef c0, 1, 0.5, 0.00000095367431640625, 0\n", self.name());
        for set in 0..self.registers {
            let _ = writeln!(text, "dcl t{set}\ndcl_2d s{set}");
        }
        let _ = write!(
            text,
            "dcl {view}.xyz\n; x and y over |v| + z, from [-1, 1] to [0, 1]\ndp3 r0.w, {view}, {view}\n\
             rsq r0.x, r0.w\nmad r0.x, r0.w, r0.x, {view}.z\nmax r0.x, r0.x, c0.z\nrcp r0.x, r0.x\n\
             mul r0.x, r0.x, c0.y\nmad r0.xy, {view}, r0.x, c0.y\n"
        );
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

    /// The program, accepted by a device.
    ///
    /// # Errors
    /// [`KernelError`] if it breaks a rule of the device.
    pub fn checked(&self, profile: &Profile) -> Result<CheckedProgram, KernelError> {
        checked(profile, format!("`{}`", self.name()), &self.text())
    }
}
