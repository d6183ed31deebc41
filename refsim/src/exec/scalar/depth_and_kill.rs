//! Texture instructions that affect the fragment as a whole: `texdepth` and `texkill`.

use super::interpreter::Interpreter;
use crate::device::{TexdepthDenominator, TexkillComponents};
use crate::exec::Observer;
use crate::isa::{Destination, Instruction, RegisterFile};

impl<O: Observer> Interpreter<'_, '_, O> {
    /// `texdepth`: the depth becomes `r / g` of the register (always r5), rounded into the register format, or 1.0 if g
    /// is zero. With [`TexdepthDenominator::Min1`] the divisor is at most 1.
    pub(super) fn texdepth(&mut self, at: usize, destination: &Destination) {
        for lane in self.active_lanes() {
            let register = usize::from(destination.register.index);
            let [r, g, ..] = self.lanes[lane].temp.get(register).copied().unwrap_or_default();
            let divisor = match self.prepared.rules.texdepth_denominator {
                TexdepthDenominator::Raw => g,
                TexdepthDenominator::Min1 => self.full.min(g, self.full.one()),
            };
            let depth = if self.full.format.is_zero(divisor) { self.full.one() } else { self.full.div(r, divisor) };
            self.depth[lane] = Some((self.prepared.format, depth));
            self.notify(at, lane, None);
        }
    }

    /// `texkill`: kills the fragment if a component is below zero (-0 and NaN are not). ps_1_x tests three components,
    /// of `t#` as interpolated; ps_2_x tests three or four, according to the rules, in the register format.
    pub(super) fn texkill(&mut self, at: usize, instruction: &Instruction, destination: &Destination) {
        let version = self.prepared.program.version;
        let four = version.is_ps_2() && self.prepared.rules.texkill_components == TexkillComponents::Four;
        let count = if four { 4 } else { 3 };
        let register = &destination.register;
        for lane in self.active_lanes() {
            let interpolated = version.is_ps_1_x() && register.file == RegisterFile::Texture;
            let value = if interpolated {
                self.coordinate_set(lane, register.index)
            } else {
                self.lanes[lane].value(register, &self.prepared.constants, 0)
            };
            let mut below = false;
            for (i, &x) in value.iter().enumerate().take(count) {
                let allowed = instruction
                    .predicate
                    .is_none_or(|p| self.lanes[lane].predicate[usize::from(p.swizzle.0[i] & 3)] != p.not);
                let unit = if interpolated { &self.address } else { &self.full };
                below |= allowed && unit.less(x, 0);
            }
            self.killed |= u8::from(below) << lane;
            self.notify(at, lane, None);
        }
    }
}
