//! Random programs that can be written in assembly, legal or not.
//!
//! The strategies are separate, so that a test can use a part: [`program`] (any version), [`program_of`],
//! [`instruction`], [`source`], [`destination`], [`register`].
#![allow(dead_code, reason = "shared by several test binaries, each of which takes what it needs")]

use proptest::{collection::vec, option, prelude::*, sample::select};
use refsim::isa::{
    Comparison, ConstantDef, ConstantValue, Declaration, Destination, DestinationRule, FragmentPart, Instruction, Mask,
    Modifier, Opcode, Predicate, Program, ProgramText, Register, RegisterFile, Relative, Source, Span, Swizzle, Usage,
    Version,
};

fn nowhere() -> Span {
    Span::default()
}

/// Mostly small register numbers, some beyond any version, some extreme.
fn index() -> impl Strategy<Value = u16> {
    prop_oneof![8 => 0u16..12, 1 => any::<u16>(), 1 => Just(u16::MAX)]
}

fn relative() -> impl Strategy<Value = Relative> {
    prop_oneof![(0u8..4).prop_map(Relative::Address), Just(Relative::Loop)]
}

/// Any register, relative addressing included.
pub(crate) fn register() -> impl Strategy<Value = Register> {
    (select(RegisterFile::DIRECT3D), index(), option::weighted(0.1, relative())).prop_map(|(file, index, relative)| {
        match file.is_unnumbered() {
            true => Register::new(file, 0),
            false => Register { file, index, relative },
        }
    })
}

/// Any swizzle, often the identity.
pub(crate) fn swizzle() -> impl Strategy<Value = Swizzle> {
    prop_oneof![
        Just(Swizzle::IDENTITY),
        (0u8..4).prop_map(Swizzle::replicate),
        prop::array::uniform4(0u8..4).prop_map(Swizzle),
    ]
}

/// Any source operand.
pub(crate) fn source() -> impl Strategy<Value = Source> {
    (register(), swizzle(), select(Modifier::DIRECT3D)).prop_map(|(register, swizzle, modifier)| Source {
        register,
        swizzle,
        modifier,
        span: nowhere(),
    })
}

/// Any destination of an instruction.
pub(crate) fn destination() -> impl Strategy<Value = Destination> {
    (register(), 1u8..16, -3i8..=3, any::<[bool; 2]>()).prop_map(
        |(register, mask, shift, [saturate, partial_precision])| Destination {
            register,
            mask: Mask(mask),
            shift,
            saturate,
            partial_precision,
            centroid: false,
            span: nowhere(),
        },
    )
}

fn predicate() -> impl Strategy<Value = Predicate> {
    (any::<bool>(), swizzle()).prop_map(|(not, swizzle)| Predicate { not, swizzle, span: nowhere() })
}

/// Any instruction that parses in `version`, including those of other versions, with any number of operands.
pub(crate) fn instruction(version: Version) -> impl Strategy<Value = Instruction> {
    (select(Opcode::ALL), 0usize..=4)
        .prop_flat_map(move |(opcode, foreign)| {
            let sources = opcode.info().source_count(version).map_or(foreign, usize::from);
            (
                Just(opcode),
                select(&Comparison::ALL[..]),
                destination(),
                vec(source(), sources),
                prop::bool::weighted(0.2),
                option::weighted(0.2, predicate()),
            )
        })
        .prop_map(|(opcode, comparison, destination, sources, coissue, predicate)| {
            let info = opcode.info();
            Instruction {
                opcode,
                comparison: info.comparison.then_some(comparison),
                destination: (info.destination != DestinationRule::None).then_some(destination),
                sources,
                coissue,
                predicate,
                fragment: FragmentPart::default(),
                format: None,
                span: nowhere(),
            }
        })
}

fn constant() -> impl Strategy<Value = ConstantDef> {
    let float = prop_oneof![
        any::<u32>(),
        any::<i8>().prop_map(|n| (f32::from(n) / 8.0).to_bits()),
        select(vec![0u32, 0x8000_0000, 1, 0x7f7f_ffff, 0x7f80_0000, 0x7fc0_0000, 0xff80_0000]),
    ];
    prop_oneof![
        (index(), prop::array::uniform4(float)).prop_map(|(n, v)| (RegisterFile::Constant, n, ConstantValue::Float(v))),
        (index(), any::<[i32; 4]>()).prop_map(|(n, v)| (RegisterFile::ConstantInt, n, ConstantValue::Int(v))),
        (index(), any::<bool>()).prop_map(|(n, v)| (RegisterFile::ConstantBool, n, ConstantValue::Bool(v))),
    ]
    .prop_map(|(file, index, value)| ConstantDef {
        register: Register::new(file, index),
        value,
        position: 0,
        span: nowhere(),
    })
}

fn usage() -> impl Strategy<Value = Usage> {
    let plain = vec![Usage::Plain, Usage::Sampler2d, Usage::SamplerCube, Usage::SamplerVolume];
    prop_oneof![select(plain), (select(&Usage::NUMBERED[..]), any::<u8>()).prop_map(|(numbered, n)| numbered(n)),]
}

fn declaration() -> impl Strategy<Value = Declaration> {
    (usage(), destination(), any::<bool>()).prop_map(|(usage, destination, centroid)| Declaration {
        usage,
        destination: Destination { shift: 0, saturate: false, centroid, ..destination },
        position: 0,
        span: nowhere(),
    })
}

/// `count` positions in ascending order, most of them 0.
fn positions(count: usize, last: usize) -> impl Strategy<Value = Vec<usize>> {
    vec(prop_oneof![3 => Just(0), 1 => 0..=last], count).prop_map(|mut positions| {
        positions.sort_unstable();
        positions
    })
}

/// Any program of `version`.
pub(crate) fn program_of(version: Version) -> impl Strategy<Value = Program> {
    (vec(instruction(version), 0..16), vec(constant(), 0..5), vec(declaration(), 0..5))
        .prop_flat_map(|(instructions, constants, declarations)| {
            let last = instructions.len();
            let places = (positions(constants.len(), last), positions(declarations.len(), last));
            (Just((instructions, constants, declarations)), places)
        })
        .prop_map(move |((instructions, mut constants, mut declarations), places)| {
            for (def, position) in constants.iter_mut().zip(places.0) {
                def.position = position;
            }
            for (dcl, position) in declarations.iter_mut().zip(places.1) {
                dcl.position = position;
            }
            Program {
                version,
                version_span: nowhere(),
                constants,
                declarations,
                instructions,
                parameters: Vec::new(),
                resources: std::collections::BTreeMap::new(),
                fog: None,
                text: ProgramText::default(),
            }
        })
}

/// Any program of any version.
pub(crate) fn program() -> impl Strategy<Value = Program> {
    select(&Version::ALL[..]).prop_flat_map(program_of)
}
