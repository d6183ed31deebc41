//! Operand components that an operation reads; used by the checker, the executors and the timing model.

use super::{Mask, Opcode, Version};

impl Opcode {
    /// Returns `true` if the operation reads one component per operand and replicates the result to all components.
    pub const fn is_scalar(self) -> bool {
        matches!(self, Self::Rcp | Self::Rsq | Self::Exp | Self::Log | Self::Expp | Self::Logp | Self::Pow)
            || matches!(self, Self::Cos | Self::Sin | Self::Scs)
            || matches!(self, Self::Up2h | Self::Up2us | Self::Up4b | Self::Up4ub)
    }

    /// Returns `true` if the language takes the magnitude of the operation's first operand: Direct3D in `rsq`, `log`,
    /// `logp` and `pow` (pages of these instructions), GL_ARB_fragment_program in `RSQ`.
    pub const fn ignores_sign(self, version: Version) -> bool {
        match version {
            Version::Fp1_0 => false,
            Version::ArbFp1_0 => matches!(self, Self::Rsq),
            _ => matches!(self, Self::Rsq | Self::Log | Self::Logp | Self::Pow),
        }
    }

    /// The lanes of source `index`, before swizzling, that an arithmetic operation reads to write the components
    /// `written`.
    pub fn lanes_read(self, index: usize, written: Mask) -> Mask {
        let lanes = match (self, index) {
            (Self::Dp3 | Self::Crs | Self::Rfl | Self::M3x2 | Self::M3x3 | Self::M3x4, _) | (Self::Dph, 0) => 0b0111,
            (Self::Nrm, _) => 0b0111 | written.0 & 0b1000,
            (Self::Dp4 | Self::Dph | Self::M4x3 | Self::M4x4 | Self::X2d, _) => 0b1111,
            (Self::Dp2Add, 0 | 1) | (Self::Bem, 1) | (Self::Pk2h | Self::Pk2us, _) => 0b0011,
            (Self::Dp2Add, _) | (Self::SinCos, 0) | (Self::IfC | Self::BreakC, _) => 0b0001,
            (Self::SinCos | Self::Pk4b | Self::Pk4ub, _) => 0b1111,
            (Self::Sgn, 1 | 2) => 0,
            (Self::Dst, 0) => written.0 & 0b0110,
            (Self::Dst, _) => written.0 & 0b1010,
            (Self::Lit, _) => 0b1011,
            (Self::Expp | Self::Logp, _) => 0b1000,
            (opcode, _) if opcode.is_scalar() => 0b0001,
            _ => written.0,
        };
        Mask(lanes)
    }
}
