//! Layout of the trace kernel's data: textures, copies of the pixels' targets, and records.

use super::memory::Memory;
use super::{DrawCall, Machine, MachineError, PixelState};
use crate::device::Profile;
use crate::event::SAMPLERS;
use crate::exec::wgsl::follow::{HEAD, JOB_WORDS, STEP_WORDS};
use crate::exec::wgsl::kernel::{DepthPlace, DrawState, DrawWords};
use crate::exec::wgsl::parts::Parts;
use crate::exec::wgsl::program::{Microcode, PixelShader};
use crate::exec::wgsl::target::TargetPlace;
use crate::exec::wgsl::texture;
use crate::exec::{PixelBindings, SamplerBinding, colors_written, inputs_read, program};
use crate::output::{MAX_TARGETS, OutputRules};
use crate::raster::TriangleSetup;
use crate::texture::{Image, Region, SampleRules, TextureKind};

/// Maximum number of input registers recorded before the steps.
const INPUTS: usize = 12;

/// The buffer in which the kernels keep textures, targets and records.
pub(super) trait VideoMemory {
    /// Allocates words; returns the first word's index.
    fn allocate(&mut self, words: usize) -> Result<usize, MachineError>;

    /// Ensures that texture `number` is in the buffer; returns its first word's index.
    fn place_texture(&mut self, number: usize, image: &Image) -> Result<usize, MachineError>;
}

/// Parameters of a draw for the kernels, with targets in the buffer.
pub(super) fn draw_words(
    profile: &Profile,
    call: &DrawCall<'_>,
    targets: [Option<TargetPlace>; MAX_TARGETS],
    depth: Option<DepthPlace>,
) -> DrawWords {
    let source = program(call.pixel_program);
    DrawWords::new(&DrawState {
        program: source,
        rules: &profile.rules,
        output: &call.output_state(),
        output_rules: &OutputRules::from(&profile.rules),
        components: inputs_read(source),
        written: colors_written(source),
        targets,
        depth,
    })
}

/// The pixel program of a draw, encoded for the kernels.
pub(super) struct EncodedProgram {
    pub(super) code: Microcode,
    pub(super) samplers: Vec<u32>,
    /// Parts of the kernel that the draw uses.
    pub(super) parts: Parts,
}

impl EncodedProgram {
    /// Encodes program and samplers, and places the textures that they read.
    pub(super) fn new(
        video: &mut impl VideoMemory,
        memory: &Memory,
        profile: &Profile,
        call: &DrawCall<'_>,
        words: &mut DrawWords,
        traced: bool,
    ) -> Result<Self, MachineError> {
        let rules = SampleRules::from(&profile.rules);
        let (bump, projections) = (call.bump, call.projections);
        let mut bindings = PixelBindings { bump, projections, ..PixelBindings::new(call.pixel_constants) };
        let mut samplers = Vec::with_capacity(SAMPLERS * texture::SAMPLER_WORDS);
        for (slot, bound) in bindings.samplers.iter_mut().zip(&call.samplers) {
            let mut first = 0;
            if let Some(bound) = bound {
                let image = memory.current(bound.texture)?;
                first = video.place_texture(bound.texture.0, image)?;
                *slot = Some(SamplerBinding { image, state: bound.state });
            }
            samplers.extend(texture::sampler_words(slot.as_ref(), &rules, first as u32));
        }
        let shader = PixelShader::new(call.pixel_program, &profile.rules, &bindings, traced)?;
        let code = shader.microcode(Some(words.interpolation()))?;
        let mut parts = words.parts_with(&code);
        for &sampler in &code.samplers {
            texture::parts(&samplers[sampler * texture::SAMPLER_WORDS..], &mut parts);
        }
        Ok(Self { code, samplers, parts })
    }
}

pub(super) struct TraceLayout {
    pub(super) words: DrawWords,
    /// Copies of the targets with one row: one column per traced pixel.
    colors: Vec<(usize, Image)>,
    /// First word of the copy of the depth buffer.
    depth: Option<usize>,
    /// First word of the records.
    pub(super) records: usize,
    /// Capacity of a record, in steps.
    pub(super) room: usize,
}

impl TraceLayout {
    /// Allocates the memory of a trace of this many pixels.
    pub(super) fn new(
        video: &mut impl VideoMemory,
        machine: &Machine,
        call: &DrawCall<'_>,
        pixels: usize,
    ) -> Result<(Self, EncodedProgram), MachineError> {
        let (memory, profile) = (&machine.memory, &machine.profile);
        let width = pixels as u32;
        let (mut targets, mut colors) = ([None; MAX_TARGETS], Vec::new());
        for (slot, &id) in targets.iter_mut().zip(&call.targets) {
            let format = memory.texture(id)?.format();
            let image = Image::new(format, TextureKind::Rectangle, [width, 1, 1], 1)?;
            let base = video.allocate(texture::image_size(&image))?;
            *slot = Some(TargetPlace { format, base: base as u32, width });
            colors.push((base, image));
        }
        let mut depth = None;
        if let Some(id) = call.depth_buffer {
            let base = video.allocate(width as usize)?;
            depth = Some(DepthPlace { format: memory.depth(id)?.format(), base: base as u32, width });
        }
        let room = program(call.pixel_program).instructions.len() + INPUTS;
        let mut words = draw_words(profile, call, targets, depth);
        let encoded = EncodedProgram::new(video, memory, profile, call, &mut words, true)?;
        let records = video.allocate(pixels * (HEAD + STEP_WORDS * room))?;
        let depth = depth.map(|place| place.base as usize);
        Ok((Self { words, colors, depth, records, room }, encoded))
    }

    /// Contents of the pixels' targets, as words; each entry starts with its first word's index in video memory.
    pub(super) fn contents(&self, states: &[PixelState]) -> Vec<(usize, Vec<u32>)> {
        let mut all = Vec::new();
        for (i, (base, image)) in self.colors.iter().enumerate() {
            let mut image = image.clone();
            for (x, state) in (0u32..).zip(states) {
                image.set_raw(0, 0, 0, x, state.colors[i].unwrap_or_default());
            }
            all.push((*base, texture::image_words(&image)));
        }
        if let Some(base) = self.depth {
            all.push((base, states.iter().map(|state| state.depth.unwrap_or_default()).collect()));
        }
        all
    }
}

/// The words of `tiles` for pixels, each with its triangles.
pub(super) fn job_words(pixels: &[(u32, u32)], setups: &[TriangleSetup]) -> Vec<u32> {
    let (mut told, mut lists) = (Vec::new(), Vec::new());
    for &(x, y) in pixels {
        let near = (0u32..).zip(setups).filter(|(_, setup)| {
            let inside = setup.bounds.intersect(Region { x, y, width: 1, height: 1 });
            inside.width > 0 && inside.height > 0
        });
        let first = lists.len();
        lists.extend(near.map(|(index, _)| index));
        told.extend([x, y, (JOB_WORDS * pixels.len() + first) as u32, (lists.len() - first) as u32]);
    }
    told.append(&mut lists);
    told
}
