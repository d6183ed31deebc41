//! Programs with a repeated part per light, because these languages have no loops; each copy reads its own constants.

use std::fmt::Write as _;

use refsim::asm::assemble;
use refsim::device::Profile;
use refsim::exec::CheckedProgram;
use refsim::isa::Instruction;

use crate::card::{KernelError, KernelText, checked};

/// A kernel with a part that is repeated for each light. The file is the program for one light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightKernel {
    /// The file.
    pub kernel: KernelText,
    /// Text before the number of a constant: `p[` or `c`.
    pub prefix: &'static str,
    /// The first constant of the first light.
    pub first: usize,
    /// Constants per light.
    pub step: usize,
}

impl LightKernel {
    /// The program for this number of lights.
    pub fn text(&self, lights: usize) -> String {
        let [head, body, tail] = self.parts();
        let mut text = head.to_owned();
        for light in 0..lights {
            self.push_moved(&mut text, body, light * self.step);
        }
        text + tail
    }

    /// The program for this number of lights, checked for a device.
    pub fn checked(&self, profile: &Profile, lights: usize) -> Result<CheckedProgram, KernelError> {
        let name = self.kernel.name;
        let name = if lights == 1 { format!("`{name}`") } else { format!("`{name}`, written out for {lights} lights") };
        checked(profile, name, &self.text(lights))
    }

    /// The maximum number of lights within these numbers of instruction slots and constants.
    pub fn most_lights(&self, slots: usize, constants: usize) -> usize {
        self.most_within([0, 1].map(|lights| self.slots(lights)), slots, constants)
    }

    /// Like [`Self::most_lights`], for a program of `none` slots without lights and `one` slots with one light.
    pub(super) fn most_within(&self, [none, one]: [usize; 2], slots: usize, constants: usize) -> usize {
        let by_length = slots.saturating_sub(none) / one.saturating_sub(none).max(1);
        by_length.min(constants.saturating_sub(self.first) / self.step)
    }

    fn slots(&self, lights: usize) -> usize {
        let Ok(program) = assemble(&self.text(lights)) else { return 0 };
        let slots = |instruction: &Instruction| instruction.opcode.info().slot_cost(program.version).total();
        program.instructions.iter().map(|instruction| usize::from(slots(instruction))).sum()
    }

    /// Text before, in and after the part for a light.
    fn parts(&self) -> [&'static str; 3] {
        let text = self.kernel.text;
        let after = |mark: &str| text.find(mark).map_or(text.len(), |at| at + mark.len());
        let (begin, end) = (after(" a light\n"), after(" end of a light\n"));
        let body = &text[begin..end];
        let body = &body[..body.trim_end().rfind('\n').map_or(0, |at| at + 1)];
        [&text[..begin], body, &text[begin + body.len()..]]
    }

    /// Appends a copy of `body` with the indices of the light's constants increased by `by`.
    fn push_moved(&self, text: &mut String, body: &str, by: usize) {
        let mut rest = body;
        while let Some(at) = rest.find(self.prefix) {
            let (before, found) = rest.split_at(at);
            let digits = &found[self.prefix.len()..];
            let length = digits.bytes().take_while(u8::is_ascii_digit).count();
            let word = before.ends_with(|c: char| c.is_ascii_alphanumeric());
            text.push_str(before);
            text.push_str(self.prefix);
            match digits[..length].parse::<usize>() {
                Ok(number) if !word && number >= self.first => {
                    let _ = write!(text, "{}", number + by);
                }
                _ => text.push_str(&digits[..length]),
            }
            rest = &digits[length..];
        }
        text.push_str(rest);
    }
}
