//! The opcode table: for each operation its mnemonic, its operands, the versions that have it, and its cost in
//! instruction slots.
//!
//! The assembler, the printer, the checker, the executors and the timing model all read this one table. Sources: the
//! Direct3D 9 shader assembly reference, pages "Instructions ps_1_X", "ps_2_0", "ps_2_x", "vs_1_1" and "vs_2_0";
//! GL_NV_fragment_program and GL_ARB_fragment_program, whose spellings are in `fragment`.

use super::Version;

/// Class of an operation, for the rules on order, slots and modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OpcodeClass {
    /// Computes on registers; counts against the arithmetic slots.
    Arithmetic,
    /// Reads coordinates or texels, kills, or replaces depth; counts against the texture slots.
    Texture,
    /// Branches, loops, calls, and the instructions that delimit them.
    Flow,
    /// `phase` and `nop`-like markers that do nothing at run time.
    Marker,
}

/// Role of an operation's first operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DestinationRule {
    /// No destination operand.
    None,
    /// The first operand is written.
    Write,
    /// The first operand has the syntax of a destination, but is only read (`texkill`).
    Read,
}

/// Kind of the values that an operation writes to a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ResultKind {
    /// Nothing: flow control, kills, depth, and matrix rows for a later texture read.
    None,
    /// Numbers of the register format, or an address or comparison masks derived from such numbers.
    Numbers,
    /// A texel.
    Texel,
    /// Words of packed numbers, or numbers unpacked from one.
    Packed,
}

/// Cost of an instruction in slots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct SlotCost {
    /// Texture instruction slots.
    pub texture: u16,
    /// Arithmetic instruction slots (the only kind that vertex versions have).
    pub arithmetic: u16,
}

impl SlotCost {
    /// Slots of both kinds.
    pub const fn total(self) -> u16 {
        self.texture + self.arithmetic
    }
}

/// One row of the opcode table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpInfo {
    /// The operation.
    pub opcode: Opcode,
    /// The mnemonic, without modifiers and comparison suffix.
    pub mnemonic: &'static str,
    /// Its class.
    pub class: OpcodeClass,
    /// Role of the first operand.
    pub destination: DestinationRule,
    /// Kind of the results.
    pub result: ResultKind,
    /// `true` if the mnemonic has a comparison suffix (`_gt _lt _ge _le _eq _ne`).
    pub comparison: bool,
    /// Source operands by version, in the order of [`Version`]; `None` where the version lacks the operation.
    sources: [Option<u8>; VERSIONS],
    /// Slots by version, in the order of [`Version`].
    slots: [u16; VERSIONS],
}

impl OpInfo {
    /// Returns `true` if `version` has the operation.
    pub const fn available(&self, version: Version) -> bool {
        self.sources[version as usize].is_some()
    }

    /// Number of source operands of the operation in `version`; `None` if the version lacks it.
    ///
    /// `texkill`'s operand counts as destination ([`DestinationRule::Read`]), not as source.
    pub const fn source_count(&self, version: Version) -> Option<u8> {
        self.sources[version as usize]
    }

    /// Slots of the operation in `version`, before adjustments for co-issue, predication and texture type.
    pub const fn slot_cost(&self, version: Version) -> SlotCost {
        let n = self.slots[version as usize];
        match self.class {
            OpcodeClass::Texture if n > 0 && matches!(self.opcode, Opcode::TexBemL) => {
                SlotCost { texture: n, arithmetic: 1 }
            }
            OpcodeClass::Texture => SlotCost { texture: n, arithmetic: 0 },
            _ => SlotCost { texture: 0, arithmetic: n },
        }
    }
}

/// Number of columns of the table.
const VERSIONS: usize = Version::ALL.len() + Version::FRAGMENT.len();

/// `-` in the table below: not available.
const NA: (Option<u8>, u16) = (None, 0);
/// A cell of the table: number of sources and number of slots.
const fn c(sources: u8, slots: u16) -> (Option<u8>, u16) {
    (Some(sources), slots)
}

const fn split(cells: [(Option<u8>, u16); VERSIONS]) -> ([Option<u8>; VERSIONS], [u16; VERSIONS]) {
    let mut sources = [None; VERSIONS];
    let mut slots = [0; VERSIONS];
    let mut i = 0;
    while i < VERSIONS {
        sources[i] = cells[i].0;
        slots[i] = cells[i].1;
        i += 1;
    }
    (sources, slots)
}

macro_rules! opcodes {
    ($($variant:ident $mnemonic:literal $class:ident $dest:ident $result:ident $comparison:literal [$($cell:expr),* $(,)?])*) => {
        /// An operation; the table in this file describes it.
        #[non_exhaustive]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[expect(missing_docs, reason = "the variants are the mnemonics")]
        pub enum Opcode { $($variant),* }

        impl Opcode {
            /// Every operation, in the order of the table.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// The operation's row of the table.
            pub const fn info(self) -> &'static OpInfo {
                match self {
                    $(Self::$variant => {
                        const CELLS: ([Option<u8>; VERSIONS], [u16; VERSIONS]) = split([$($cell),*]);
                        const INFO: OpInfo = OpInfo {
                            opcode: Opcode::$variant,
                            mnemonic: $mnemonic,
                            class: OpcodeClass::$class,
                            destination: DestinationRule::$dest,
                            result: ResultKind::$result,
                            comparison: $comparison,
                            sources: CELLS.0,
                            slots: CELLS.1,
                        };
                        &INFO
                    })*
                }
            }
        }
    };
}

#[rustfmt::skip]
opcodes! {
// variant      mnemonic       class      dest  result  cmp    ps_1_1   ps_1_2   ps_1_3   ps_1_4   ps_2_0   ps_2_a   ps_2_b
// vs_1_1   vs_2_0   FP1.0    ARBfp1.0
    Nop          "nop"          Marker     None  None    false [c(0,0),  c(0,0),  c(0,0),  c(0,0),  c(0,1),  c(0,1),  c(0,1),  c(0,1),  c(0,1),  NA,      NA]
    Phase        "phase"        Marker     None  None    false [NA,      NA,      NA,      c(0,0),  NA,      NA,      NA,      NA,      NA,      NA,      NA]
    Mov          "mov"          Arithmetic Write Numbers false [c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1)]
    Mova         "mova"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA,      NA]
    Add          "add"          Arithmetic Write Numbers false [c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Sub          "sub"          Arithmetic Write Numbers false [c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Mul          "mul"          Arithmetic Write Numbers false [c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Mad          "mad"          Arithmetic Write Numbers false [c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,1)]
    Lrp          "lrp"          Arithmetic Write Numbers false [c(3,1),  c(3,1),  c(3,1),  c(3,1),  c(3,2),  c(3,2),  c(3,2),  NA,      c(3,2),  c(3,1),  c(3,1)]
    Dp3          "dp3"          Arithmetic Write Numbers false [c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Dp4          "dp4"          Arithmetic Write Numbers false [NA,      c(2,2),  c(2,2),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Dp2Add       "dp2add"       Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(3,2),  c(3,2),  c(3,2),  NA,      NA,      NA,      NA]
    Cnd          "cnd"          Arithmetic Write Numbers false [c(3,1),  c(3,1),  c(3,1),  c(3,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA]
    Cmp          "cmp"          Arithmetic Write Numbers false [NA,      c(3,2),  c(3,2),  c(3,1),  c(3,1),  c(3,1),  c(3,1),  NA,      NA,      NA,      c(3,1)]
    Bem          "bem"          Arithmetic Write Numbers false [NA,      NA,      NA,      c(2,2),  NA,      NA,      NA,      NA,      NA,      NA,      NA]
    Abs          "abs"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  NA,      c(1,1),  NA,      c(1,1)]
    Min          "min"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Max          "max"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Frc          "frc"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  c(1,3),  c(1,1),  c(1,1),  c(1,1)]
    Rcp          "rcp"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1)]
    Rsq          "rsq"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1),  c(1,1)]
    Exp          "exp"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  c(1,10), c(1,1),  c(1,1),  c(1,1)]
    Log          "log"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  c(1,1),  c(1,10), c(1,1),  c(1,1),  c(1,1)]
    Expp         "expp"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  NA,      NA]
    Logp         "logp"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,1),  NA,      NA]
    Pow          "pow"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,3),  c(2,3),  c(2,3),  NA,      c(2,3),  c(2,1),  c(2,1)]
    Crs          "crs"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,2),  c(2,2),  c(2,2),  NA,      c(2,2),  NA,      c(2,1)]
    Nrm          "nrm"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(1,3),  c(1,3),  c(1,3),  NA,      c(1,3),  NA,      NA]
    Sgn          "sgn"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(3,3),  NA,      NA]
    SinCos       "sincos"       Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(3,8),  c(3,8),  c(3,8),  NA,      c(3,8),  NA,      NA]
    Sge          "sge"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Slt          "slt"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Dst          "dst"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  c(2,1),  c(2,1),  c(2,1)]
    Lit          "lit"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,3),  c(1,1),  c(1,1)]
    M3x2         "m3x2"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,2),  c(2,2),  c(2,2),  c(2,2),  c(2,2),  NA,      NA]
    M3x3         "m3x3"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,3),  c(2,3),  c(2,3),  c(2,3),  c(2,3),  NA,      NA]
    M3x4         "m3x4"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,4),  c(2,4),  c(2,4),  c(2,4),  c(2,4),  NA,      NA]
    M4x3         "m4x3"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,3),  c(2,3),  c(2,3),  c(2,3),  c(2,3),  NA,      NA]
    M4x4         "m4x4"         Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      c(2,4),  c(2,4),  c(2,4),  c(2,4),  c(2,4),  NA,      NA]
    Dsx          "dsx"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      c(1,2),  NA,      NA,      NA,      c(1,1),  NA]
    Dsy          "dsy"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      c(1,2),  NA,      NA,      NA,      c(1,1),  NA]
    Setp         "setp"         Arithmetic Write Numbers true  [NA,      NA,      NA,      NA,      NA,      c(2,1),  NA,      NA,      NA,      NA,      NA]
    Tex          "tex"          Texture    Write Texel   false [c(0,1),  c(0,1),  c(0,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexCoord     "texcoord"     Texture    Write Numbers false [c(0,1),  c(0,1),  c(0,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexKill      "texkill"      Texture    Read  None    false [c(0,1),  c(0,1),  c(0,1),  c(0,1),  c(0,1),  c(0,2),  c(0,2),  NA,      NA,      NA,      NA]
    TexBem       "texbem"       Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexBemL      "texbeml"      Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexReg2Ar    "texreg2ar"    Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexReg2Gb    "texreg2gb"    Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexReg2Rgb   "texreg2rgb"   Texture    Write Texel   false [NA,      c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x2Pad   "texm3x2pad"   Texture    Write None    false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x2Tex   "texm3x2tex"   Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x2Depth "texm3x2depth" Texture    Write None    false [NA,      NA,      c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x3Pad   "texm3x3pad"   Texture    Write None    false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x3Tex   "texm3x3tex"   Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x3Spec  "texm3x3spec"  Texture    Write Texel   false [c(2,1),  c(2,1),  c(2,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x3VSpec "texm3x3vspec" Texture    Write Texel   false [c(1,1),  c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexM3x3      "texm3x3"      Texture    Write Numbers false [NA,      c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexDp3       "texdp3"       Texture    Write Numbers false [NA,      c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexDp3Tex    "texdp3tex"    Texture    Write Texel   false [NA,      c(1,1),  c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexLd        "texld"        Texture    Write Texel   false [NA,      NA,      NA,      c(1,1),  c(2,1),  c(2,1),  c(2,1),  NA,      NA,      c(2,1),  c(2,1)]
    TexLdB       "texldb"       Texture    Write Texel   false [NA,      NA,      NA,      NA,      c(2,1),  c(2,6),  c(2,6),  NA,      NA,      NA,      c(2,1)]
    TexLdP       "texldp"       Texture    Write Texel   false [NA,      NA,      NA,      NA,      c(2,1),  c(2,3),  c(2,3),  NA,      NA,      c(2,1),  c(2,1)]
    TexLdD       "texldd"       Texture    Write Texel   false [NA,      NA,      NA,      NA,      NA,      c(4,3),  NA,      NA,      NA,      c(4,1),  NA]
    TexCrd       "texcrd"       Texture    Write Numbers false [NA,      NA,      NA,      c(1,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA]
    TexDepth     "texdepth"     Texture    Write None    false [NA,      NA,      NA,      c(0,1),  NA,      NA,      NA,      NA,      NA,      NA,      NA]
    Flr          "flr"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,1)]
    Cos          "cos"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,1)]
    Sin          "sin"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  c(1,1)]
    Scs          "scs"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1)]
    Dph          "dph"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1)]
    Swz          "swz"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1)]
    Seq          "seq"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Sgt          "sgt"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Sle          "sle"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Sne          "sne"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Str          "str"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Sfl          "sfl"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    Rfl          "rfl"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,1),  NA]
    X2d          "x2d"          Arithmetic Write Numbers false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(3,1),  NA]
    Pk2h         "pk2h"         Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Pk2us        "pk2us"        Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Pk4b         "pk4b"         Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Pk4ub        "pk4ub"        Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Up2h         "up2h"         Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Up2us        "up2us"        Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Up4b         "up4b"         Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Up4ub        "up4ub"        Arithmetic Write Packed  false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(1,1),  NA]
    Kil          "kil"          Texture    None  None    false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(0,1),  c(1,1)]
    If           "if"           Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(1,3),  NA,      NA,      c(1,3),  NA,      NA]
    IfC          "if"           Flow       None  None    true  [NA,      NA,      NA,      NA,      NA,      c(2,3),  NA,      NA,      NA,      NA,      NA]
    Else         "else"         Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(0,1),  NA,      NA,      c(0,1),  NA,      NA]
    EndIf        "endif"        Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(0,1),  NA,      NA,      c(0,1),  NA,      NA]
    Rep          "rep"          Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(1,3),  NA,      NA,      c(1,3),  NA,      NA]
    EndRep       "endrep"       Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(0,2),  NA,      NA,      c(0,2),  NA,      NA]
    Loop         "loop"         Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(2,3),  NA,      NA]
    EndLoop      "endloop"      Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      NA,      NA,      NA,      c(0,2),  NA,      NA]
    Break        "break"        Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(0,1),  NA,      NA,      NA,      NA,      NA]
    BreakC       "break"        Flow       None  None    true  [NA,      NA,      NA,      NA,      NA,      c(2,3),  NA,      NA,      NA,      NA,      NA]
    BreakP       "breakp"       Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(1,3),  NA,      NA,      NA,      NA,      NA]
    Call         "call"         Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(1,2),  NA,      NA,      c(1,2),  NA,      NA]
    CallNz       "callnz"       Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(2,3),  NA,      NA,      c(2,3),  NA,      NA]
    Label        "label"        Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(1,0),  NA,      NA,      c(1,0),  NA,      NA]
    Ret          "ret"          Flow       None  None    false [NA,      NA,      NA,      NA,      NA,      c(0,1),  NA,      NA,      c(0,1),  NA,      NA]
}

impl Opcode {
    /// For matrix products: the number of rows (consecutive constants, starting at the named constant), and the number
    /// of terms of each row's dot product.
    pub const fn matrix(self) -> Option<(u16, usize)> {
        match self {
            Self::M3x2 => Some((2, 3)),
            Self::M3x3 => Some((3, 3)),
            Self::M3x4 => Some((4, 3)),
            Self::M4x3 => Some((3, 4)),
            Self::M4x4 => Some((4, 4)),
            _ => None,
        }
    }
}

/// The comparison of `if_`, `break_` and `setp_`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the suffixes")]
pub enum Comparison {
    Gt,
    Lt,
    Ge,
    Le,
    Eq,
    Ne,
}

impl Comparison {
    /// Every comparison.
    pub const ALL: [Self; 6] = [Self::Gt, Self::Lt, Self::Ge, Self::Le, Self::Eq, Self::Ne];

    /// The suffix, without the underscore.
    pub fn suffix(self) -> &'static str {
        self.into()
    }
}
