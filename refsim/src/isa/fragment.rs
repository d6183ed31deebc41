//! Syntax that only OpenGL fragment programs have: precision suffixes, condition codes, texture targets, mnemonics.
//!
//! Sources: the extension specifications GL_NV_fragment_program (`!!FP1.0`) and GL_ARB_fragment_program (`!!ARBfp1.0`).
//! Their operations are in the opcode table; `R#` is [`super::RegisterFile::Temp`], `f[COL#]` is `v#`, `f[TEX#]` is
//! `t#`, `o[COLR]` is `oC0`, `o[DEPR]` is `oDepth`, and every constant is a `c#`.

use strum::{EnumString, IntoStaticStr};

use super::{Opcode, Span, Swizzle};

/// The first `c#` of ARB's `program.env`; `p[0]` and `program.local[0]` are `c0`.
pub const FIRST_ENVIRONMENT: u16 = 256;
/// The first `c#` of constants that the host sets by name.
pub const FIRST_NAMED: u16 = 512;
/// The first `c#` of literals.
pub const FIRST_LITERAL: u16 = 1024;

/// Precision suffix of an instruction: the format in which it computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Precision {
    /// `R`: the format of `R#`, fp32 on the cards.
    Full,
    /// `H`: the format of `H#`, fp16.
    Half,
    /// `X`: fx12, fixed point from -2 to 2047/1024.
    Fixed,
}

impl Precision {
    /// Every precision.
    pub const ALL: [Self; 3] = [Self::Full, Self::Half, Self::Fixed];

    /// The letter after the mnemonic.
    pub const fn letter(self) -> char {
        match self {
            Self::Full => 'R',
            Self::Half => 'H',
            Self::Fixed => 'X',
        }
    }
}

/// Test of a condition code: less than, equal to or greater than zero, or unordered (NaN).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, EnumString, IntoStaticStr)]
#[strum(serialize_all = "UPPERCASE")]
#[expect(missing_docs, reason = "the variants are the names in programs")]
pub enum ConditionTest {
    Eq,
    /// Equal or greater.
    Ge,
    Gt,
    /// Less or equal.
    Le,
    Lt,
    /// Not equal; also unordered.
    Ne,
    /// Always.
    Tr,
    /// Never.
    Fl,
}

impl ConditionTest {
    /// Every test.
    pub const ALL: [Self; 8] = [Self::Eq, Self::Ge, Self::Gt, Self::Le, Self::Lt, Self::Ne, Self::Tr, Self::Fl];

    /// The name in programs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A condition: `(GT.x)` after a destination, or the operand of `KIL`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Condition {
    /// The test that must hold.
    pub test: ConditionTest,
    /// The condition code that each component tests.
    pub swizzle: Swizzle,
    /// Location in the program text.
    pub span: Span,
}

/// The texture target of a fetch.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, EnumString, IntoStaticStr)]
#[strum(serialize_all = "UPPERCASE")]
#[expect(missing_docs, reason = "the variants are the names in programs")]
pub enum TextureTarget {
    #[strum(serialize = "1D")]
    D1,
    #[strum(serialize = "2D")]
    D2,
    #[strum(serialize = "3D")]
    D3,
    Cube,
    Rect,
}

impl TextureTarget {
    /// Every target.
    pub const ALL: [Self; 5] = [Self::D1, Self::D2, Self::D3, Self::Cube, Self::Rect];

    /// The name in programs.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Parts of an instruction that only OpenGL fragment programs have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct FragmentPart {
    /// Format of the operation; `None`: the format of the destination.
    pub precision: Option<Precision>,
    /// `C`: the instruction updates the condition codes.
    pub updates: bool,
    /// The condition under which components are written, or fragments killed.
    pub condition: Option<Condition>,
    /// Texture target of a fetch.
    pub target: Option<TextureTarget>,
    /// `SWZ`: bit `i` negates component `i`; swizzle entries 4 and 5 mean the constants 0 and 1.
    pub negate: u8,
}

/// OpenGL mnemonic of an operation, and the suffixes that `!!FP1.0` allows on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spelling {
    /// The operation.
    pub opcode: Opcode,
    /// The OpenGL mnemonic.
    pub name: &'static str,
    /// `true` if the suffixes R and H are allowed.
    pub floats: bool,
    /// `true` if the suffix X is allowed.
    pub fixed: bool,
    /// `true` if the suffixes C and `_SAT` are allowed.
    pub result: bool,
}

/// The instruction tables of the two extensions. The columns state the allowed suffixes: R and H; X; C and `_SAT`.
macro_rules! spellings {
    ($($opcode:ident $name:literal $floats:literal $fixed:literal $result:literal)*) => {
        &[$(Spelling {
            opcode: Opcode::$opcode,
            name: $name,
            floats: $floats,
            fixed: $fixed,
            result: $result,
        }),*]
    };
}

#[rustfmt::skip]
const SPELLINGS: &[Spelling] = spellings! {
//  opcode name    R, H  X     C, SAT
    Abs    "ABS"   true  true  true
    Add    "ADD"   true  true  true
    Cmp    "CMP"   true  true  true
    Cos    "COS"   true  false true
    Dsx    "DDX"   true  false true
    Dsy    "DDY"   true  false true
    Dp3    "DP3"   true  true  true
    Dp4    "DP4"   true  true  true
    Dph    "DPH"   true  true  true
    Dst    "DST"   true  false true
    Exp    "EX2"   true  false true
    Flr    "FLR"   true  true  true
    Frc    "FRC"   true  true  true
    Kil    "KIL"   false false false
    Log    "LG2"   true  false true
    Lit    "LIT"   true  false true
    Lrp    "LRP"   true  true  true
    Mad    "MAD"   true  true  true
    Max    "MAX"   true  true  true
    Min    "MIN"   true  true  true
    Mov    "MOV"   true  true  true
    Mul    "MUL"   true  true  true
    Pk2h   "PK2H"  false false false
    Pk2us  "PK2US" false false false
    Pk4b   "PK4B"  false false false
    Pk4ub  "PK4UB" false false false
    Pow    "POW"   true  false true
    Rcp    "RCP"   true  false true
    Rfl    "RFL"   true  false true
    Rsq    "RSQ"   true  false true
    Scs    "SCS"   true  false true
    Seq    "SEQ"   true  true  true
    Sfl    "SFL"   true  true  true
    Sge    "SGE"   true  true  true
    Sgt    "SGT"   true  true  true
    Sin    "SIN"   true  false true
    Sle    "SLE"   true  true  true
    Slt    "SLT"   true  true  true
    Sne    "SNE"   true  true  true
    Str    "STR"   true  true  true
    Sub    "SUB"   true  true  true
    Swz    "SWZ"   true  true  true
    TexLd  "TEX"   false false true
    TexLdB "TXB"   false false true
    TexLdD "TXD"   false false true
    TexLdP "TXP"   false false true
    Up2h   "UP2H"  false false true
    Up2us  "UP2US" false false true
    Up4b   "UP4B"  false false true
    Up4ub  "UP4UB" false false true
    X2d    "X2D"   true  false true
    Crs    "XPD"   true  true  true
};

impl Spelling {
    /// Every spelling, by name.
    pub const ALL: &'static [Self] = SPELLINGS;

    /// Returns the OpenGL mnemonic of the operation; `None` if only Direct3D has it.
    pub fn of(opcode: Opcode) -> Option<&'static Self> {
        SPELLINGS.iter().find(|s| s.opcode == opcode)
    }
}
