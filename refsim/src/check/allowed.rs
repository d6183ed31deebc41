//! Effective limits: the device's, the shader version's, or none.

use crate::device::Profile;
use crate::isa::{Stage, Version};

/// A limit that profiles can state. Variants correspond to the fields of [`crate::device::Limits`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Limit {
    TextureInstructions,
    ArithmeticInstructions,
    Instructions,
    Temporaries,
    Constants,
    TextureCoordinates,
    Samplers,
    ColorInputs,
    DependentReads,
    StaticFlowDepth,
    DynamicFlowDepth,
    LoopDepth,
    CallDepth,
    StaticFlowCount,
    /// Parameters that an OpenGL program binds.
    BoundParameters,
    /// Attributes that an OpenGL program binds.
    Attributes,
}

/// An effective limit, its origin (device or version), and its key in the profile.
#[derive(Clone, Debug)]
pub(super) struct Allowed {
    pub(super) value: u32,
    /// `` `r200` `` or `` `ps_1_4` ``
    pub(super) owner: String,
    pub(super) key: &'static str,
    /// `true` if the limit comes from the device, `false` if from the version.
    pub(super) by_device: bool,
}

impl Allowed {
    /// Help text that names the origin of the limit.
    pub(super) fn help(&self, advice: &str) -> String {
        let Self { key, owner, .. } = self;
        if self.by_device {
            format!("{advice}; the limit is `{key}` of profile {owner}")
        } else {
            format!("{advice}; {owner} has this limit on every card; `{key}` is unlimited only on `ideal-` devices")
        }
    }
}

impl Limit {
    /// The key in a profile, and the device's value. Limits of the pixel pipeline don't apply to vertex programs.
    fn of_device(self, profile: &Profile, stage: Stage) -> (&'static str, Option<u32>) {
        macro_rules! figure {
            ($name:ident) => {
                (concat!("limits.", stringify!($name)), profile.limits.$name)
            };
        }
        let (stages, (key, figure)) = match (self, stage) {
            (Self::Instructions, Stage::Vertex) => (stage, figure!(vertex_instructions)),
            (Self::Temporaries, Stage::Vertex) => (stage, figure!(vertex_temporaries)),
            (Self::Constants, Stage::Vertex) => (stage, figure!(vertex_constants)),
            (Self::StaticFlowCount, _) => (Stage::Vertex, figure!(static_flow_count)),
            (Self::TextureInstructions, _) => (Stage::Pixel, figure!(texture_instructions_per_phase)),
            (Self::ArithmeticInstructions, _) => (Stage::Pixel, figure!(arithmetic_instructions_per_phase)),
            (Self::Instructions, _) => (Stage::Pixel, figure!(instructions)),
            (Self::Temporaries, _) => (Stage::Pixel, figure!(temporaries)),
            (Self::Constants | Self::BoundParameters, _) => (Stage::Pixel, figure!(constants)),
            (Self::Attributes, _) => (Stage::Pixel, figure!(fragment_attributes)),
            (Self::TextureCoordinates, _) => (Stage::Pixel, figure!(texture_coordinates)),
            (Self::Samplers, _) => (Stage::Pixel, figure!(samplers)),
            (Self::ColorInputs, _) => (Stage::Pixel, figure!(color_inputs)),
            (Self::DependentReads, _) => (Stage::Pixel, figure!(dependent_reads)),
            (Self::StaticFlowDepth, _) => (Stage::Pixel, figure!(static_flow_depth)),
            (Self::DynamicFlowDepth, _) => (Stage::Pixel, figure!(dynamic_flow_depth)),
            (Self::LoopDepth, _) => (Stage::Pixel, figure!(loop_depth)),
            (Self::CallDepth, _) => (Stage::Pixel, figure!(call_depth)),
        };
        (key, figure.filter(|_| stages == stage))
    }

    /// The version's limit. Source: Direct3D 9, pages "Registers" and "Instructions" of each version, and the page on
    /// flow control nesting limits.
    #[rustfmt::skip]
    fn of_version(self, version: Version) -> Option<u32> {
        use Version::{ArbFp1_0, Fp1_0, Ps1_1, Ps1_2, Ps1_3, Ps1_4, Ps2_0, Ps2A, Ps2B, Vs1_1, Vs2_0};
        Some(match (self, version) {
            (Self::TextureInstructions, Ps1_1 | Ps1_2 | Ps1_3) => 4,
            (Self::TextureInstructions, Ps1_4) => 6,
            (Self::TextureInstructions, Ps2_0) => 32,
            (Self::ArithmeticInstructions, Ps1_1 | Ps1_2 | Ps1_3 | Ps1_4) => 8,
            (Self::ArithmeticInstructions, Ps2_0) => 64,
            (Self::Instructions, Ps1_1 | Ps1_2 | Ps1_3) => 12,
            (Self::Instructions, Ps2_0) => 96,
            (Self::Instructions, Ps2A | Ps2B) => 512,
            (Self::Instructions, Vs1_1) => 128,
            (Self::Instructions, Vs2_0) => 256,
            (Self::Temporaries, Ps1_1 | Ps1_2 | Ps1_3) => 2,
            (Self::Temporaries, Ps1_4) => 6,
            (Self::Temporaries, Ps2_0 | Vs1_1 | Vs2_0) => 12,
            (Self::Temporaries, Ps2A | Ps2B) => 32,
            (Self::Constants, Ps1_1 | Ps1_2 | Ps1_3 | Ps1_4) => 8,
            (Self::Constants, Ps2_0 | Ps2A | Ps2B) => 32,
            (Self::Constants, Vs1_1) => 96,
            (Self::Constants, Vs2_0) => 256,
            (Self::TextureCoordinates | Self::Samplers, Ps1_1 | Ps1_2 | Ps1_3) => 4,
            (Self::TextureCoordinates | Self::Samplers, Ps1_4) => 6,
            (Self::TextureCoordinates, Ps2_0 | Ps2A | Ps2B) => 8,
            (Self::Samplers, Ps2_0 | Ps2A | Ps2B) => 16,
            (Self::ColorInputs, v) if v.stage() == Stage::Pixel => 2,
            (Self::DependentReads, Ps2_0 | Ps2B) => 4,
            (Self::StaticFlowDepth | Self::DynamicFlowDepth, Ps2A | Ps2B) => 24,
            (Self::LoopDepth | Self::CallDepth, Ps2A | Ps2B) => 4,
            (Self::LoopDepth | Self::CallDepth, Vs2_0) => 1,
            (Self::StaticFlowCount, Vs2_0) => 16,
            // Minimum limits of GL_ARB_fragment_program (section 3.11.3.6) and of GL_NV_fragment_program.
            (Self::Temporaries, ArbFp1_0) => 16,
            (Self::BoundParameters, ArbFp1_0) => 24,
            (Self::Attributes, ArbFp1_0) => 10,
            (Self::Instructions, Fp1_0) => 1024,
            (Self::Constants, Fp1_0) => 64,
            (Self::TextureCoordinates, Fp1_0 | ArbFp1_0) => 8,
            (Self::Samplers, Fp1_0 | ArbFp1_0) => 16,
            _ => return None,
        })
    }

    /// Limits of the emulator itself, from the size of the executors' register files; they apply to ideal devices too.
    fn of_emulator(self, stage: Stage) -> Option<u32> {
        match (self, stage) {
            (Self::Temporaries, _) => Some(32),
            (Self::Constants, _) => Some(256),
            (Self::TextureCoordinates, _) => Some(8),
            (Self::Samplers, _) => Some(16),
            (Self::ColorInputs, _) => Some(2),
            _ => None,
        }
    }

    /// The limit of an OpenGL program: the device's limit if stated, else the extension's minimum.
    fn of_fragment(self, profile: &Profile, version: Version) -> Option<Allowed> {
        let l = &profile.limits;
        let arb = version == Version::ArbFp1_0;
        let (key, device) = match self {
            Self::Instructions => ("limits.fragment_instructions", l.fragment_instructions),
            Self::Constants => ("limits.fragment_parameters", l.fragment_parameters),
            Self::BoundParameters if l.fragment_parameters.is_some() => {
                ("limits.fragment_parameters", l.fragment_parameters)
            }
            Self::Temporaries if l.fragment_temporaries.is_some() => {
                ("limits.fragment_temporaries", l.fragment_temporaries)
            }
            Self::TextureInstructions | Self::ArithmeticInstructions | Self::DependentReads if !arb => return None,
            _ => self.of_device(profile, Stage::Pixel),
        };
        if let Some(value) = device {
            return Some(Allowed { value, owner: format!("`{}`", profile.name), key, by_device: true });
        }
        let value =
            if profile.limits.version_limits { self.of_version(version) } else { self.of_emulator(Stage::Pixel) }?;
        Some(Allowed { value, owner: format!("`{}`", version.token()), key, by_device: false })
    }

    /// The effective limit for programs of `version` on the device; `None`: no limit.
    ///
    /// This is the smaller of the device's and the version's limit. The limits that `ps_2_x` leaves to the device
    /// (slots, temporaries, nesting) are the device's.
    pub(super) fn allowed(self, profile: &Profile, version: Version) -> Option<Allowed> {
        let stage = version.stage();
        if version.is_fragment_program() {
            return self.of_fragment(profile, version);
        }
        let (key, device) = self.of_device(profile, stage);
        let by = |value, owner: &str, by_device| Allowed { value, owner: format!("`{owner}`"), key, by_device };
        if !profile.limits.version_limits {
            let value = device.or_else(|| self.of_emulator(stage))?;
            return Some(by(value, &profile.name, true));
        }
        let of_version = self.of_version(version);
        let left_to_device = version.is_ps_2_x()
            && matches!(
                self,
                Self::Instructions
                    | Self::Temporaries
                    | Self::StaticFlowDepth
                    | Self::DynamicFlowDepth
                    | Self::LoopDepth
                    | Self::CallDepth
            );
        // A device's limit applies only if the version has one too: ps_1_4 has phases instead of a limit of dependent
        // reads.
        match (device, of_version) {
            (Some(d), Some(v)) if d <= v || left_to_device => Some(by(d, &profile.name, true)),
            (_, Some(v)) => Some(by(v, version.token(), false)),
            (_, None) => None,
        }
    }
}
