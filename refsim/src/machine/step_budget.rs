//! Compares the pixel program of a call with the step budget of the device.

use super::{DrawCall, Machine};
use crate::exec::budget::enforced;
use crate::exec::{FlowMap, ResolvedConstants, program};
use crate::isa::Stage;

/// Classes of pixel programs by the step budget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StepBudget {
    /// Every fragment exceeds the budget: the program has no flow control and is too long. The scalar executor counts
    /// its steps.
    Exceeded,
    /// A fragment may exceed this budget.
    Enforced(u32),
    /// No fragment can exceed the budget.
    NeverExceeded,
}

impl Machine {
    /// Classifies the pixel program of a call by whether it can exceed the step budget.
    pub(super) fn step_budget(&self, call: &DrawCall<'_>) -> StepBudget {
        let (checked, source) = (call.pixel_program, program(call.pixel_program));
        let constants = ResolvedConstants::pixel(source, &self.profile.rules, call.pixel_constants);
        let budget = self.profile.limits.step_budget(Stage::Pixel);
        match enforced(source, &FlowMap::new(source), &constants, budget) {
            Some(budget) if checked.facts().has_flow => StepBudget::Enforced(budget),
            Some(_) => StepBudget::Exceeded,
            None => StepBudget::NeverExceeded,
        }
    }
}
