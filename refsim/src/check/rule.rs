//! Tables of the rules and warnings: the name, code and sentence of each.

use strum::VariantArray;

macro_rules! rules {
    ($(#[$doc:meta])* $Id:ident: $($name:ident $code:ident $text:literal;)*) => {
        $(#[$doc])*
        #[allow(rustdoc::broken_intra_doc_links, reason = "o[COLH] is a register, not a link")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, VariantArray)]
        pub enum $Id {
            $(
                #[doc = concat!(stringify!($code), ": ", $text)]
                $name
            ),*
        }

        impl $Id {
            /// All variants, in the order of the codes.
            pub const ALL: &'static [Self] = Self::VARIANTS;

            /// The code in messages and documents.
            pub const fn code(self) -> &'static str {
                match self { $(Self::$name => stringify!($code)),* }
            }

            /// The sentence in messages and documents.
            pub const fn text(self) -> &'static str {
                match self { $(Self::$name => $text),* }
            }
        }

        impl std::fmt::Display for $Id {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.code())
            }
        }
    };
}

rules! {
    /// A rule of the checker, named after its violation or its subject. V01 to V46 are rules of Direct3D and the cards,
    /// V47 to V59 are further requirements of the executors, and rules from V60 on are OpenGL's.
    RuleId:
    UnsupportedVersion V01 "the device runs the program's version";
    MisplacedDefinition V02 "constants are defined before the first instruction, once each";
    UnsupportedInstruction V03 "the version has the instruction";
    TooManyInstructions V04 "the program fits into the instruction slots";
    TextureAfterArithmetic V05 "texture instructions come before arithmetic ones in every phase (ps_1_x)";
    RepeatedPhase V06 "there is one phase marker at most";
    NoSuchRegister V07 "the version and the device have the register";
    TooManyReads V08 "an instruction reads no more different registers of a register file than the file has read ports";
    TooManyPairReads V09 "a co-issued pair reads at most three different registers of a register file";
    MalformedPair V10 "a co-issued pair is one instruction writing within .rgb and one writing .a, neither of them dp4 (ps_1_x)";
    UnwrittenRead V11 "components are written before they are read; alpha is undefined after a phase marker";
    UnwrittenResult V12 "the program writes all of r0 (ps_1_x)";
    InvalidDestination V13 "the destination can be written by the instruction";
    InvalidMask V14 "the version and the instruction allow the write mask";
    InvalidSwizzle V15 "the version allows the selector or swizzle";
    InvalidSourceModifier V16 "the version allows the source modifier there";
    InvalidInstructionModifier V17 "the version and the instruction allow the instruction modifier";
    CndCondition V18 "cnd compares r0.a (ps_1_1 to 1_3)";
    CmpOrDp4 V19 "at most three cmp, none onto its own source, and at most four dp4 (ps_1_2, ps_1_3)";
    Dp3Mask V20 "dp3 writes .rgb or .rgba (ps_1_1 to 1_3)";
    ColorReadInPhase1 V21 "colours v# are read in phase 2 only (ps_1_4)";
    AddressPhase V22 "a texture address in r# was computed in phase 1 and is used in phase 2 (ps_1_4)";
    MixedSelectors V23 "all reads of a t# choose .xyz or all choose .xyw (ps_1_4)";
    DivideModifier V24 "_dz is only used on the r# of texld, at most twice per program; _dw only on t#.xyw (ps_1_4)";
    TextureLoadMask V25 "texcrd writes .rgb, or .rg with _dw; texld writes all components (ps_1_4)";
    TexDepth V26 "the operand of texdepth is r5; texdepth is in phase 2, and r5 is not used after it (ps_1_4)";
    Bem V27 "bem is used once, in phase 1, not co-issued, and writes .rg (ps_1_4)";
    ArithmeticReadsCoordinates V28 "arithmetic reads no t# (ps_1_4)";
    TextureSource V29 "texld, texcrd and texkill read t#, or in phase 2 r# (ps_1_4)";
    LoadedTwice V30 "no register is loaded twice in a phase (ps_1_4)";
    TextureChain V31 "texture instructions read results of earlier stages only, and pads come in order (ps_1_1 to 1_3)";
    BumpMapReused V32 "a register that texbem or texbeml read is not read again (ps_1_1 to 1_3)";
    ExpandModifier V33 "_bx2 is only used on texture instructions that can expand (ps_1_1 to 1_3)";
    ShiftedResult V34 "results are not shifted (ps_2_0 and up)";
    OnlyNegation V35 "negation is the only source modifier (ps_2_0 and up)";
    OutputWrite V36 "outputs are written once each by a plain mov of all components, from oC0 without gaps (ps_2_0 and up)";
    Declaration V37 "inputs and samplers are declared, once each, before the first instruction (ps_2_0 and up)";
    DependentReads V38 "chains of dependent texture reads are no longer than allowed (ps_2_0, ps_2_b)";
    TooManyConstants V39 "an instruction reads at most two constants (ps_2_0 and up)";
    TextureReadOperands V40 "texture reads have plain coordinates and a sampler, and write all components (ps_2_0 and up)";
    TexKillOperand V41 "the operand of texkill is a whole r# or t# (ps_2_0 and up)";
    ScalarSource V42 "scalar instructions read one component";
    SinCosOperands V43 "sincos writes .x, .y or .xy and reads one component and two different constants";
    Dp2AddSource V44 "the addend of dp2add is one component";
    RelativeAddress V45 "relative addresses are used only in vertex programs, and only for constants";
    InvalidSaturate V46 "frc and sincos are not saturated (ps_2_0 and up)";
    Operands V47 "the instruction has its operands, of files that it can read";
    UnwrittenPosition V48 "the program writes all of oPos (vertex)";
    UnsetAddress V49 "a0 and aL are set before they are used in an address (vertex)";
    MatrixRows V50 "the rows of a matrix exist, without swizzle or negation";
    AttributeDeclaration V51 "attributes are declared, once each, before the first instruction (vertex)";
    UnclosedBlock V52 "blocks close in the order in which they were opened";
    NestingDepth V53 "flow control is nested no deeper than allowed";
    Subroutines V54 "subroutines follow the main program, end with ret and call only later ones";
    FlowOperands V55 "flow control has valid operands and is in a valid place";
    DivergentGradient V56 "gradients are not taken where fragments may diverge";
    PredicateUse V57 "p0 is set before it is used, and only instructions that can have a predicate have one (ps_2_a)";
    FogAndPointSizeMask V58 "oFog and oPts are written through .x (vertex)";
    MacroOperands V59 "instructions of several steps do not overwrite their own sources, and have the required mask";
    InvalidSuffix V60 "the instruction can have its suffixes (!!FP1.0)";
    PackedPrecision V61 "packed words are of full precision (!!FP1.0)";
    TooManyOperandReads V62 "an instruction reads one attribute and one constant at most (!!FP1.0)";
    FragmentOutputs V63 "the program writes colour, in only one precision, or depth, through z (OpenGL)";
    ImageUnitTarget V64 "an image unit is read as one kind of texture (OpenGL)";
    RegisterWeight V65 "all registers together weigh at most 64: R# and outputs 2, H# and o[COLH] 1 (!!FP1.0)";
    Indirections V66 "chains of dependent texture reads are no longer than allowed (!!ARBfp1.0)";
    TooManyResources V67 "temporaries, parameters and attributes, used or not, fit the device (!!ARBfp1.0)";
}

rules! {
    /// A warning about legal code that does not do what its text suggests.
    WarningId:
    ClampedConstant W01 "constants of ps_1_x are clamped to -1 to 1";
    FogIsNotBlended W02 "oFog does not cause fog: fixed-function fog is not emulated";
    PointsAreNotDrawn W03 "oPts has no effect: points are not drawn";
}
