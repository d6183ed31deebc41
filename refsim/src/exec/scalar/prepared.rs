//! Per-draw preparation: constants, jump targets, bindings, and inputs read.

use super::alu::Alu;
use crate::device::Rules;
use crate::exec::budget::enforced;
use crate::exec::{
    BumpStage, Constants, FlowMap, PixelBindings, Projection, ResolvedConstants, SamplerBinding, inputs_read,
};
use crate::isa::{Program, RegisterFile, Stage};
use crate::num::{Format, ops};
use crate::raster::ComponentMask;
use crate::texture::SampleRules;

pub(crate) struct Prepared<'a> {
    pub(crate) program: &'a Program,
    pub(crate) rules: &'a Rules,
    pub(crate) flow: FlowMap,
    pub(crate) constants: ResolvedConstants,
    /// Format of registers and arithmetic.
    pub(crate) format: Format,
    pub(crate) sample_rules: SampleRules,
    pub(crate) reads: ComponentMask,
    /// The step budget, if the program may exceed it.
    pub(crate) budget: Option<u32>,
    bindings: Option<PixelBindings<'a>>,
}

impl<'a> Prepared<'a> {
    pub(crate) fn pixel(program: &'a Program, rules: &'a Rules, bindings: &PixelBindings<'a>) -> Self {
        Self {
            program,
            rules,
            flow: FlowMap::new(program),
            constants: ResolvedConstants::pixel(program, rules, bindings.constants),
            format: rules.format,
            sample_rules: rules.into(),
            reads: inputs_read(program),
            budget: None,
            bindings: Some(*bindings),
        }
    }

    pub(crate) fn vertex(program: &'a Program, rules: &'a Rules, constants: &Constants) -> Self {
        Self {
            program,
            rules,
            flow: FlowMap::new(program),
            constants: ResolvedConstants::vertex(program, rules, constants),
            format: rules.vertex_format,
            sample_rules: rules.into(),
            reads: ComponentMask::NONE,
            budget: None,
            bindings: None,
        }
    }

    pub(crate) fn set_budget(&mut self, budget: u32) {
        self.budget = enforced(self.program, &self.flow, &self.constants, budget);
    }

    /// Arithmetic of the program's stage in `format`.
    pub(crate) fn alu(&self, format: Format) -> Alu<'a> {
        if self.is_pixel() { Alu::new(self.rules, format) } else { Alu::vertex(self.rules, format) }
    }

    /// Format of the values that instructions write to a register file, if different from the register format.
    pub(crate) fn written(&self, file: RegisterFile) -> Option<Format> {
        self.rules.storage.written(file).filter(|_| self.is_pixel())
    }

    pub(crate) fn is_pixel(&self) -> bool {
        self.program.version.stage() == Stage::Pixel
    }

    pub(crate) fn sampler(&self, stage: usize) -> Option<&SamplerBinding<'a>> {
        self.bindings.as_ref()?.samplers.get(stage)?.as_ref()
    }

    pub(crate) fn projection(&self, stage: u16) -> Projection {
        self.bindings.as_ref().and_then(|b| b.projections.get(usize::from(stage))).copied().unwrap_or_default()
    }

    /// Bump state of a stage; zero by default.
    pub(crate) fn bump(&self, stage: u16) -> BumpStage {
        self.bindings.as_ref().and_then(|b| b.bump.get(usize::from(stage))).copied().unwrap_or_default()
    }

    /// Bump matrix of a stage in the register format.
    pub(crate) fn bump_in_format(&self, stage: u16) -> [u32; 4] {
        self.bump(stage).matrix.map(|x| ops::convert(&Format::FP32, self.format, x).bits)
    }
}
