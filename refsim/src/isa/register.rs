//! Registers and register files.

use std::fmt;

use strum::VariantArray;

/// A register file. Direct3D's files come first, then the files that only OpenGL has. Each variant's comment starts
/// with the spelling in programs.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, VariantArray)]
pub enum RegisterFile {
    /// `r#`: temporaries.
    Temp,
    /// `v#`: colours in a pixel program, vertex attributes in a vertex program.
    Input,
    /// `t#`: texture coordinates (and, in ps_1_1 to 1_3, texture results).
    Texture,
    /// `c#`: constants.
    Constant,
    /// `i#`: integer constants.
    ConstantInt,
    /// `b#`: boolean constants.
    ConstantBool,
    /// `s#`: samplers.
    Sampler,
    /// `a0`: the vertex program's address register.
    Address,
    /// `aL`: the loop counter.
    Loop,
    /// `p0`: the predicate register.
    Predicate,
    /// `l#`: subroutine labels.
    Label,
    /// `oC#`: colour outputs of ps_2_0 and up.
    ColorOut,
    /// `oDepth`: depth output of ps_2_0 and up.
    DepthOut,
    /// `oPos`: clip-space position of a vertex.
    PositionOut,
    /// `oFog`: fog factor of a vertex.
    FogOut,
    /// `oPts`: point size of a vertex.
    PointSizeOut,
    /// `oD#`: colours of a vertex.
    DiffuseOut,
    /// `oT#`: texture coordinates of a vertex.
    TexCoordOut,
    /// `H#`: half precision temporaries of an OpenGL fragment program, in which `R#` are [`Self::Temp`].
    Half,
    /// `f[FOGC]`: the fog coordinate in x, then 0, 0, 0; `fragment.fogcoord`: 0, 0, 1.
    FogIn,
    /// `f[WPOS]`: the window position of the fragment: x, y, depth, 1/w.
    WindowPosition,
    /// `o[COLH]`: the colour in half precision.
    HalfColorOut,
    /// `RC`: full-precision discard register; for instructions that only update the condition codes.
    Discard,
    /// `HC`: half-precision discard register.
    HalfDiscard,
}

impl RegisterFile {
    /// The register files of Direct3D programs.
    pub const DIRECT3D: &[Self] = Self::VARIANTS.split_at(18).0;

    /// The prefix of the file's registers in program text.
    pub const fn prefix(self) -> &'static str {
        match self {
            Self::Temp => "r",
            Self::Input => "v",
            Self::Texture => "t",
            Self::Constant => "c",
            Self::ConstantInt => "i",
            Self::ConstantBool => "b",
            Self::Sampler => "s",
            Self::Address => "a",
            Self::Loop => "aL",
            Self::Predicate => "p",
            Self::Label => "l",
            Self::ColorOut => "oC",
            Self::DepthOut => "oDepth",
            Self::PositionOut => "oPos",
            Self::FogOut => "oFog",
            Self::PointSizeOut => "oPts",
            Self::DiffuseOut => "oD",
            Self::TexCoordOut => "oT",
            Self::Half => "H",
            Self::FogIn => "fog",
            Self::WindowPosition => "wpos",
            Self::HalfColorOut => "oColh",
            Self::Discard => "RC",
            Self::HalfDiscard => "HC",
        }
    }

    /// Returns `true` if the file has a single register, written without a number.
    pub const fn is_unnumbered(self) -> bool {
        let vertex = matches!(self, Self::PositionOut | Self::FogOut | Self::PointSizeOut);
        let fragment = matches!(self, Self::FogIn | Self::WindowPosition | Self::HalfColorOut);
        let discard = matches!(self, Self::Discard | Self::HalfDiscard);
        vertex || fragment || discard || matches!(self, Self::Loop | Self::DepthOut)
    }

    /// Returns `true` if the file's registers have one component.
    pub const fn is_scalar(self) -> bool {
        matches!(self, Self::Loop | Self::FogOut | Self::PointSizeOut | Self::DepthOut)
    }

    /// Returns `true` if the file's registers hold half-precision numbers.
    pub const fn is_half(self) -> bool {
        matches!(self, Self::Half | Self::HalfColorOut | Self::HalfDiscard)
    }
}

/// Relative addressing of a constant: `c[a0.x + 3]` or `c[aL + 3]`. The constant part is the register's index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Relative {
    /// Through a component (0 to 3 for x to w) of `a0`.
    Address(u8),
    /// Through the loop counter `aL`.
    Loop,
}

/// A reference to a register in an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Register {
    /// The file.
    pub file: RegisterFile,
    /// The register's number in its file; 0 for unnumbered registers.
    pub index: u16,
    /// Relative addressing: the value added to the number at run time.
    pub relative: Option<Relative>,
}

impl Register {
    /// A register without relative addressing.
    pub const fn new(file: RegisterFile, index: u16) -> Self {
        Self { file, index, relative: None }
    }
}

impl fmt::Display for Register {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.relative {
            None if self.file.is_unnumbered() => f.write_str(self.file.prefix()),
            None => write!(f, "{}{}", self.file.prefix(), self.index),
            Some(Relative::Address(component)) => {
                let name = ['x', 'y', 'z', 'w'][usize::from(component & 3)];
                write!(f, "{}[a0.{name} + {}]", self.file.prefix(), self.index)
            }
            Some(Relative::Loop) => write!(f, "{}[aL + {}]", self.file.prefix(), self.index),
        }
    }
}
