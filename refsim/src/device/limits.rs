//! Limits and speeds of a device, for `check` and the timing model.

use std::collections::BTreeMap;

use super::DeviceError;
use super::figure::Section;
use crate::isa::{Stage, Version};
use crate::texel::{DepthFormat, TexelFormat};

/// Step budget of devices that state none: the budget of GL_NV_vertex_program2, and Direct3D 9's minimum for `ps_3_0`
/// and `vs_3_0` (`MaxPShaderInstructionsExecuted`, `MaxVShaderInstructionsExecuted`).
pub const DEFAULT_STEP_BUDGET: u32 = 1 << 16;

/// Defines a structure of optional integer figures, which a profile section states under the field names.
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

            /// Mutable access to the figure with this name; `None` if there is no such figure. The inner option is
            /// `None` if the device does not state the figure.
            pub fn figure_mut(&mut self, name: &str) -> Option<&mut Option<$number>> {
                match name {
                    $(stringify!($field) => Some(&mut self.$field),)*
                    _ => None,
                }
            }

            /// The figure with this name; `None` if there is no such figure or the device does not state it.
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
    /// Limits of a device. Where a figure is absent, the shader version's limit applies.
    Limits: u32 {
        /// Texture instructions per phase (per program, in versions without phases).
        texture_instructions_per_phase,
        /// Arithmetic instruction slots per phase (per program, in versions without phases).
        arithmetic_instructions_per_phase,
        /// Total instruction slots of a pixel program.
        instructions,
        /// Instructions of an OpenGL fragment program.
        fragment_instructions,
        /// Host-set parameters of an OpenGL fragment program, per kind; in `!!ARBfp1.0` all bound parameters together.
        fragment_parameters,
        /// Temporaries of an `!!ARBfp1.0` program, if different from `temporaries`.
        fragment_temporaries,
        /// Attributes that an `!!ARBfp1.0` program binds.
        fragment_attributes,
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
        /// Maximum length of a chain of dependent texture reads.
        dependent_reads,
        /// Nesting of `if b#`.
        static_flow_depth,
        /// Nesting of flow control that depends on a computed value.
        dynamic_flow_depth,
        /// Nesting of `rep` and `loop`.
        loop_depth,
        /// Nesting of calls.
        call_depth,
        /// Number of `if b#`, `else`, `rep`, `loop`, `call` and `callnz` in a vertex program.
        static_flow_count,
        /// Instruction slots of a vertex program.
        vertex_instructions,
        /// Temporaries `r#` of a vertex program.
        vertex_temporaries,
        /// Constants `c#` of a vertex program.
        vertex_constants,
        /// Step budget: instructions that a pixel program may execute per fragment.
        pixel_step_budget,
        /// Step budget: instructions that a vertex program may execute per vertex.
        vertex_step_budget,
        /// Colour targets per draw.
        render_targets,
        /// Maximum width and height of a texture, in texels.
        max_texture_size,
        /// Maximum width, height and depth of a volume texture, in texels.
        max_volume_size,
        /// Maximum width and height of a render target, in pixels.
        max_target_size,
        /// Magnitude up to which pixel registers are guaranteed to hold numbers (`PixelShader1xMaxValue`).
        register_magnitude,
    }
    extra {
        /// The shader versions that the device runs.
        versions: Vec<Version>,
        /// `true` if the limits of the shader version apply in addition to the device's limits; `false` for `ideal-`
        /// devices.
        version_limits: bool,
        /// The supported texture formats.
        texture_formats: Vec<TexelFormat>,
        /// The supported colour target formats.
        target_formats: Vec<TexelFormat>,
        /// The supported depth formats.
        depth_formats: Vec<DepthFormat>,
        /// `true` if float textures can be filtered.
        float_filtering: bool,
        /// `true` if float textures can have mip maps.
        float_mipmaps: bool,
        /// `true` if blending into float targets is supported.
        float_blending: bool,
    }
}

impl Limits {
    /// Step budget of a stage; [`DEFAULT_STEP_BUDGET`] if the device does not state it.
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
    /// Speeds of a device, for the timing model. Results never depend on them.
    Rates: u64 {
        /// Core clock, in Hz.
        core_clock_hz,
        /// Clock of the shader units if it differs from the core clock, in Hz.
        shader_clock_hz,
        /// Memory clock, in Hz (double data rate).
        memory_clock_hz,
        /// Width of the memory bus, in bits.
        memory_bus_bits,
        /// Peak memory bandwidth, in bytes per second.
        memory_bytes_per_s,
        /// Pixel pipelines (scalar processors on a unified card).
        pixel_pipes,
        /// Texture units per pipeline.
        texture_units_per_pipe,
        /// Total texture units, if they are not tied to pipelines.
        texture_units,
        /// Pixels per clock of the raster back end.
        raster_pixels_per_clock,
        /// Pixels per clock without colour (depth or stencil only).
        depth_only_pixels_per_clock,
        /// Peak fill rate, in pixels per second.
        fill_pixels_per_s,
        /// Peak texture rate, in texels per second.
        fill_texels_per_s,
        /// Fill rate measured by a paper with its own program, in pixels per second.
        measured_fill_pixels_per_s,
        /// Vertex units.
        vertex_units,
        /// Peak vertex rate, in vertices per second.
        vertices_per_s,
        /// Pairs of one colour and one alpha instruction that a pipeline issues per clock.
        alu_pairs_per_clock,
        /// Texture reads that a pipeline issues per clock.
        texture_reads_per_clock,
        /// Dependent texture reads (computed coordinates) that a pipeline issues per clock.
        dependent_reads_per_clock,
        /// Bytes of a texel that a texture unit delivers per clock; larger texels take more clocks.
        texel_bytes_per_clock,
        /// Clocks per trilinear texture read.
        trilinear_clocks,
        /// 1 if a pipeline cannot do arithmetic in the clock of a texture read, 0 if both run in parallel.
        texture_blocks_arithmetic,
        /// Fixed-point units (suffix X of `!!FP1.0`) behind the float unit of a pipeline: each performs one operation,
        /// or two multiplications, per clock.
        fixed_units,
        /// 1 if adjacent ps_2_x instructions that write colour and alpha separately are issued as pairs, 0 if not.
        automatic_pairs,
        /// Number of live fp32 registers up to which pipelines run at full speed.
        full_speed_registers,
        /// Slowdown per two fp32 registers beyond [`Self::full_speed_registers`], in percent of the clocks.
        register_step_percent,
        /// Clocks of a vertex unit per instruction slot.
        vertex_clocks_per_slot,
        /// Clocks of triangle set-up per triangle.
        setup_clocks_per_triangle,
        /// Pipeline latency: clocks from the first stage to the last, to fill and drain.
        pipeline_clocks,
        /// Clocks of the command processor per draw.
        draw_clocks,
        /// Clocks of the command processor per state change.
        state_clocks,
        /// Clocks of the command processor per constant register of four numbers.
        constant_clocks,
        /// Entries of the post-transform vertex cache (first in, first out).
        vertex_cache_entries,
        /// Attainable share of the peak memory bandwidth, in percent.
        memory_efficiency_percent,
        /// Size of the texture cache, in bytes.
        texture_cache_bytes,
        /// Line size of the texture cache, in bytes.
        texture_cache_line_bytes,
        /// Associativity of the texture cache.
        texture_cache_ways,
        /// 1 if textures are stored in tiles, 0 if row by row.
        textures_tiled,
        /// Ray-triangle tests per second, measured by a paper.
        measured_tests_per_s,
        /// Ray-triangle tests per second on the vertex units, measured by a paper.
        measured_vertex_tests_per_s,
    }
    extra {
        /// Clocks per instruction in one pipeline, by mnemonic; 1 if not listed.
        instruction_clocks: BTreeMap<String, u32>,
    }
}

figures! {
    /// Connection between the host and the card.
    Bus: u64 {
        /// Nominal bandwidth, in bytes per second.
        nominal_bytes_per_s,
        /// Upload to the card, in bytes per second.
        upload_bytes_per_s,
        /// Read-back from the card, in bytes per second.
        readback_bytes_per_s,
        /// Upload latency to the first byte, in nanoseconds.
        upload_latency_ns,
        /// Read-back latency to the first byte, in nanoseconds.
        readback_latency_ns,
    }
    extra {
        /// Name of the bus, `AGP 4x` for example.
        kind: String,
    }
}
