//! Sources and destinations: swizzles, masks and modifiers.

use strum::VariantArray;

use super::{Register, Span};

/// Component selection: entry `i` is the register component (0 to 3) that lane `i` reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Swizzle(pub [u8; 4]);

impl Swizzle {
    /// `.xyzw`: no change; printed as nothing.
    pub const IDENTITY: Self = Self([0, 1, 2, 3]);

    /// All four lanes read the same component.
    pub const fn replicate(component: u8) -> Self {
        Self([component; 4])
    }

    /// The component that all lanes read, if they read the same one.
    pub fn replicated(self) -> Option<u8> {
        let first = self.0[0];
        self.0.iter().all(|&c| c == first).then_some(first)
    }
}

/// A write mask: bit `i` set means that component `i` is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mask(pub u8);

impl Mask {
    /// `.xyzw`; printed as nothing.
    pub const ALL: Self = Self(0b1111);
    /// `.rgb`
    pub const RGB: Self = Self(0b0111);
    /// `.a`
    pub const ALPHA: Self = Self(0b1000);

    /// Returns `true` if component `component` (0 to 3) is written.
    pub const fn contains(self, component: usize) -> bool {
        self.0 >> component & 1 == 1
    }

    /// The written components in ascending order.
    pub fn components(self) -> impl Iterator<Item = usize> {
        (0..4).filter(move |&c| self.contains(c))
    }
}

/// A source modifier; Direct3D's modifiers come before those that only OpenGL has. In the formulas, `x` is the value
/// after the swizzle; each step rounds once into the register format, and negation comes last.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, VariantArray)]
pub enum Modifier {
    /// `x`
    None,
    /// `-x`
    Negate,
    /// `1-x`: written as a prefix.
    Invert,
    /// `x_bias`: `x - 0.5`
    Bias,
    /// `-x_bias`
    BiasNegate,
    /// `x_bx2`: `2 (x - 0.5)`
    Bx2,
    /// `-x_bx2`
    Bx2Negate,
    /// `x_x2`: `2 x`
    X2,
    /// `-x_x2`
    X2Negate,
    /// `x_dz` (also `_db`): x and y divided by z
    Dz,
    /// `x_dw` (also `_da`): x and y divided by w
    Dw,
    /// `!p0` or `!b0`: logical not
    Not,
    /// `|x|`
    Absolute,
    /// `-|x|`
    AbsoluteNegate,
}

impl Modifier {
    /// The modifiers of Direct3D's programs.
    pub const DIRECT3D: &[Self] = Self::VARIANTS.split_at(12).0;
}

/// One source operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Source {
    /// The register read.
    pub register: Register,
    /// The component that each lane reads.
    pub swizzle: Swizzle,
    /// Modifier applied to the value before the operation.
    pub modifier: Modifier,
    /// Location in the program text.
    pub span: Span,
}

/// The destination operand, with the instruction's result modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Destination {
    /// The register written.
    pub register: Register,
    /// The components written.
    pub mask: Mask,
    /// `_x2 _x4 _x8` as 1, 2, 3 and `_d2 _d4 _d8` as -1, -2, -3: the result is multiplied by two to this power.
    pub shift: i8,
    /// `_sat`: the result is clamped to [0, 1], after the shift.
    pub saturate: bool,
    /// `_pp`: partial precision suffices.
    pub partial_precision: bool,
    /// `_centroid`: on declarations only; kept for printing.
    pub centroid: bool,
    /// Location in the program text.
    pub span: Span,
}

impl Destination {
    /// Components of a register, without modifiers.
    pub(crate) const fn new(register: Register, mask: Mask, span: Span) -> Self {
        Self { register, mask, shift: 0, saturate: false, partial_precision: false, centroid: false, span }
    }
}

/// `(p0.x)` or `(!p0)` before an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Predicate {
    /// `true` if the predicate is inverted.
    pub not: bool,
    /// The predicate component of each lane.
    pub swizzle: Swizzle,
    /// Location in the program text.
    pub span: Span,
}
