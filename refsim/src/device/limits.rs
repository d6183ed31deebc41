//! What a device allows and how fast it is: the figures behind `check` and the timing model.

use std::collections::BTreeMap;

use super::DeviceError;
use super::figure::Section;
use crate::isa::{Stage, Version};

/// The step budget of devices that state none: what GL_NV_vertex_program2 has, and the least that Direct3D 9 asks of
/// `ps_3_0` and `vs_3_0` (`MaxPShaderInstructionsExecuted`, `MaxVShaderInstructionsExecuted`).
pub const DEFAULT_STEP_BUDGET: u32 = 1 << 16;

/// A structure of optional whole-number figures that is read from the section of the same field names.
macro_rules! figures {
    ($(#[$meta:meta])* $name:ident : $number:ty { $($(#[$doc:meta])* $field:ident),* $(,)? }
     $(extra { $($(#[$extra_doc:meta])* $extra:ident : $extra_type:ty),* $(,)? })?) => {
        $(#[$meta])*
        #[derive(Clone, Debug, Default, PartialEq, Eq)]
        pub struct $name {
            $($(#[$doc])* pub $field: Option<$number>,)*
            $($($(#[$extra_doc])* pub $extra: $extra_type,)*)?
        }

        impl $name {
            #[allow(clippy::needless_update, reason = "some of the structures have no further fields")]
            pub(super) fn read(section: &mut Section<'_>) -> Result<Self, DeviceError> {
                Ok(Self { $($field: section.number(stringify!($field))?,)* ..Self::default() })
            }

            /// The figure of this name, to be changed; `None` if there is no such figure. The inner `None`: the device
            /// does not state it.
            pub fn figure_mut(&mut self, name: &str) -> Option<&mut Option<$number>> {
                match name {
                    $(stringify!($field) => Some(&mut self.$field),)*
                    _ => None,
                }
            }

            /// The figure of this name; `None` if there is no such figure or the device does not state it.
            pub fn figure(&self, name: &str) -> Option<$number> {
                match name {
                    $(stringify!($field) => self.$field,)*
                    _ => None,
                }
            }
        }
    };
}

figures! {
    /// What a device allows. A figure that is absent leaves the limit to the shader version.
    Limits: u32 {
        /// Texture instructions in a phase (in the program, where the version has no phases).
        texture_instructions_per_phase,
        /// Arithmetic instruction slots in a phase (in the program, where the version has no phases).
        arithmetic_instructions_per_phase,
        /// Instruction slots of a pixel program in all.
        instructions,
        /// Instructions of an OpenGL fragment program.
        fragment_instructions,
        /// Parameters of an OpenGL fragment program that the host sets, of each kind.
        fragment_parameters,
        /// Temporaries `r#` of a pixel program.
        temporaries,
        /// Constants `c#` of a pixel program.
        constants,
        /// Coordinate sets `t#`.
        texture_coordinates,
        /// Samplers `s#` (stages in ps_1_x).
        samplers,
        /// Colours `v#` of a pixel program.
        color_inputs,
        /// Levels of texture reads that depend on one another.
        dependent_reads,
        /// Nesting of `if b#`.
        static_flow_depth,
        /// Nesting of flow that a computed value decides.
        dynamic_flow_depth,
        /// Nesting of `rep` and `loop`.
        loop_depth,
        /// Nesting of calls.
        call_depth,
        /// `if b#`, `else`, `rep`, `loop`, `call` and `callnz` in a vertex program.
        static_flow_count,
        /// Instruction slots of a vertex program.
        vertex_instructions,
        /// Temporaries `r#` of a vertex program.
        vertex_temporaries,
        /// Constants `c#` of a vertex program.
        vertex_constants,
        /// Instructions that a pixel program may execute per fragment: its step budget.
        pixel_step_budget,
        /// Instructions that a vertex program may execute per vertex.
        vertex_step_budget,
        /// Colour targets of a draw.
        render_targets,
        /// Largest width and height of a texture, in texels.
        max_texture_size,
        /// Largest width, height and depth of a volume texture, in texels.
        max_volume_size,
        /// Largest width and height of a render target, in pixels.
        max_target_size,
        /// Magnitude that a pixel register holds at least (`PixelShader1xMaxValue`).
        register_magnitude,
    }
    extra {
        /// The shader versions that the device runs.
        versions: Vec<Version>,
        /// Whether the limits of the shader version hold beside those of the device; false for `ideal-` devices.
        version_limits: bool,
        /// Names of the texel formats that textures can have (`crate::texture::TexelFormat` knows them).
        texture_formats: Vec<String>,
        /// Names of the texel formats that colour targets can have.
        target_formats: Vec<String>,
        /// Names of the depth formats.
        depth_formats: Vec<String>,
        /// Whether float textures can be filtered.
        float_filtering: bool,
        /// Whether float textures can have mip maps.
        float_mipmaps: bool,
        /// Whether float targets can be blended into.
        float_blending: bool,
    }
}

impl Limits {
    /// The step budget of a stage; [`DEFAULT_STEP_BUDGET`] where the device states none.
    pub fn step_budget(&self, stage: Stage) -> u32 {
        let own = match stage {
            Stage::Pixel => self.pixel_step_budget,
            Stage::Vertex => self.vertex_step_budget,
        };
        own.unwrap_or(DEFAULT_STEP_BUDGET)
    }

    /// Sets the step budgets of both stages.
    pub fn set_step_budget(&mut self, steps: u32) {
        self.pixel_step_budget = Some(steps);
        self.vertex_step_budget = Some(steps);
    }
}

figures! {
    /// How fast a device is. The timing model reads these; values never depend on them.
    Rates: u64 {
        /// Core clock, in Hz.
        core_clock_hz,
        /// Clock of the shader units where they have their own, in Hz.
        shader_clock_hz,
        /// Memory clock, in Hz; data move on both edges.
        memory_clock_hz,
        /// Width of the memory bus, in bits.
        memory_bus_bits,
        /// Peak memory bandwidth, in bytes per second.
        memory_bytes_per_s,
        /// Pixel pipelines (scalar processors on a unified card).
        pixel_pipes,
        /// Texture units of each pipeline.
        texture_units_per_pipe,
        /// Texture units in all, where they belong to no pipeline.
        texture_units,
        /// Pixels that the raster back end can finish in a clock.
        raster_pixels_per_clock,
        /// Pixels without colour (depth or stencil only) in a clock.
        depth_only_pixels_per_clock,
        /// Peak fill rate, in pixels per second.
        fill_pixels_per_s,
        /// Peak texture rate, in texels per second.
        fill_texels_per_s,
        /// Fill rate that a paper measured with its own program, in pixels per second.
        measured_fill_pixels_per_s,
        /// Vertex units.
        vertex_units,
        /// Vertices per second, peak.
        vertices_per_s,
        /// Pairs of one colour and one alpha instruction that a pipeline issues in a clock.
        alu_pairs_per_clock,
        /// Texture reads that a pipeline issues in a clock.
        texture_reads_per_clock,
        /// Texture reads whose coordinates the program computed, that a pipeline issues in a clock.
        dependent_reads_per_clock,
        /// Bytes of one texel that a texture unit delivers in a clock: a larger texel takes more clocks.
        texel_bytes_per_clock,
        /// Clocks of a texture read that filters between two mip levels.
        trilinear_clocks,
        /// 1 if a pipeline that reads a texture cannot do arithmetic in that clock, 0 if both go on side by side.
        texture_blocks_arithmetic,
        /// Units for fixed point (X of `!!FP1.0`) behind the float unit of a pipeline: each does one operation per
        /// clock, or two multiplications.
        fixed_units,
        /// 1 if neighbours of ps_2_x that write colour and alpha apart are issued as pairs, 0 if not.
        automatic_pairs,
        /// Registers that can be live without slowing the pipelines, in fp32.
        full_speed_registers,
        /// Clocks that every two fp32 registers beyond [`Self::full_speed_registers`] add, in percent.
        register_step_percent,
        /// Clocks of a vertex unit for one instruction slot.
        vertex_clocks_per_slot,
        /// Clocks of triangle set-up for one triangle.
        setup_clocks_per_triangle,
        /// Clocks from the first stage of the pipeline to the last: what it takes to fill and drain.
        pipeline_clocks,
        /// Clocks of the command processor for one draw.
        draw_clocks,
        /// Clocks of the command processor for one piece of state.
        state_clocks,
        /// Clocks of the command processor for one constant register of four numbers.
        constant_clocks,
        /// Vertices that stay finished for the triangles that follow: the first in goes out first.
        vertex_cache_entries,
        /// Share of the peak memory bandwidth that is reached, in percent.
        memory_efficiency_percent,
        /// Size of the texture cache, in bytes.
        texture_cache_bytes,
        /// Size of a line of the texture cache, in bytes.
        texture_cache_line_bytes,
        /// Lines among which an address can choose.
        texture_cache_ways,
        /// 1 if textures lie in tiles, 0 if row by row.
        textures_tiled,
        /// Ray-triangle tests per second that a paper measured.
        measured_tests_per_s,
        /// Ray-triangle tests per second that a paper measured on the vertex units.
        measured_vertex_tests_per_s,
    }
    extra {
        /// Clocks of an instruction in one pipeline by mnemonic; 1 where it is not listed.
        instruction_clocks: BTreeMap<String, u32>,
    }
}

figures! {
    /// The way between the host and the card.
    Bus: u64 {
        /// Nominal bandwidth, in bytes per second.
        nominal_bytes_per_s,
        /// Upload to the card, in bytes per second.
        upload_bytes_per_s,
        /// Read-back from the card, in bytes per second.
        readback_bytes_per_s,
        /// From the start of an upload to its first byte, in nanoseconds.
        upload_latency_ns,
        /// From the start of a read-back to its first byte, in nanoseconds.
        readback_latency_ns,
    }
    extra {
        /// Name of the bus, `AGP 4x` for example.
        kind: String,
    }
}
