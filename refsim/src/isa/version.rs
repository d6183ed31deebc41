//! Shader versions.

use std::{fmt, str::FromStr};

/// Programmable pipeline stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Runs once per vertex.
    Vertex,
    /// Runs once per fragment.
    Pixel,
}

/// A shader version, named by the first token of a program.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the variants are the version tokens")]
pub enum Version {
    Ps1_1,
    Ps1_2,
    Ps1_3,
    Ps1_4,
    Ps2_0,
    /// The NV3x flavour of `ps_2_x`.
    Ps2A,
    /// The R4xx flavour of `ps_2_x`.
    Ps2B,
    Vs1_1,
    Vs2_0,
    /// GL_NV_fragment_program, `!!FP1.0`.
    Fp1_0,
    /// GL_ARB_fragment_program, `!!ARBfp1.0`.
    ArbFp1_0,
}

impl Version {
    /// Every version of Direct3D, in the order of the enumeration.
    pub const ALL: [Self; 9] = [
        Self::Ps1_1,
        Self::Ps1_2,
        Self::Ps1_3,
        Self::Ps1_4,
        Self::Ps2_0,
        Self::Ps2A,
        Self::Ps2B,
        Self::Vs1_1,
        Self::Vs2_0,
    ];

    /// OpenGL's fragment programs; the enumeration lists them after the versions of [`Self::ALL`].
    pub const FRAGMENT: [Self; 2] = [Self::Fp1_0, Self::ArbFp1_0];

    /// The version token in a program, for example `ps_1_4`.
    pub const fn token(self) -> &'static str {
        match self {
            Self::Ps1_1 => "ps_1_1",
            Self::Ps1_2 => "ps_1_2",
            Self::Ps1_3 => "ps_1_3",
            Self::Ps1_4 => "ps_1_4",
            Self::Ps2_0 => "ps_2_0",
            Self::Ps2A => "ps_2_a",
            Self::Ps2B => "ps_2_b",
            Self::Vs1_1 => "vs_1_1",
            Self::Vs2_0 => "vs_2_0",
            Self::Fp1_0 => "!!FP1.0",
            Self::ArbFp1_0 => "!!ARBfp1.0",
        }
    }

    /// The stage that programs of this version run on.
    pub const fn stage(self) -> Stage {
        match self {
            Self::Vs1_1 | Self::Vs2_0 => Stage::Vertex,
            _ => Stage::Pixel,
        }
    }

    /// Returns `true` for `ps_1_1` to `ps_1_3`, whose texture instructions are tied to stages.
    pub const fn is_ps_1_1_to_1_3(self) -> bool {
        matches!(self, Self::Ps1_1 | Self::Ps1_2 | Self::Ps1_3)
    }

    /// Returns `true` for `ps_1_1` to `ps_1_4`.
    pub const fn is_ps_1_x(self) -> bool {
        self.is_ps_1_1_to_1_3() || matches!(self, Self::Ps1_4)
    }

    /// Returns `true` for `ps_2_0`, `ps_2_a` and `ps_2_b`.
    pub const fn is_ps_2(self) -> bool {
        matches!(self, Self::Ps2_0 | Self::Ps2A | Self::Ps2B)
    }

    /// Returns `true` for OpenGL's fragment programs.
    pub const fn is_fragment_program(self) -> bool {
        matches!(self, Self::Fp1_0 | Self::ArbFp1_0)
    }

    /// Returns `true` if arithmetic instructions can read the interpolated coordinates `t#` directly.
    pub const fn reads_coordinates(self) -> bool {
        self.is_ps_2() || self.is_fragment_program()
    }

    /// Returns `true` for the extended `ps_2_x` versions.
    pub const fn is_ps_2_x(self) -> bool {
        matches!(self, Self::Ps2A | Self::Ps2B)
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.token())
    }
}

/// Error: the text is not a version token.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown shader version `{0}`; expected one of ps_1_1 ps_1_2 ps_1_3 ps_1_4 ps_2_0 ps_2_a ps_2_b vs_1_1 vs_2_0")]
pub struct UnknownVersion(pub String);

impl FromStr for Version {
    type Err = UnknownVersion;

    /// Accepts Direct3D's tokens in either case, with `_` or `.` between the parts (`ps.1.4` was the DirectX 8
    /// spelling).
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Some(version) = Self::FRAGMENT.into_iter().find(|v| v.token() == text) {
            return Ok(version);
        }
        let token = text.to_ascii_lowercase().replace('.', "_");
        Self::ALL.into_iter().find(|v| v.token() == token).ok_or_else(|| UnknownVersion(text.to_owned()))
    }
}
