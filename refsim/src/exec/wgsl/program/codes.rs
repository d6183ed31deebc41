//! How the number library calls the operations of the batch executor's graph.

use crate::exec::lower::NodeOperation;
use crate::exec::wgsl::number::Operation;

/// What an operation has besides values: the operand after them.
pub(super) fn immediate(code: NodeOperation) -> Option<u32> {
    match code {
        NodeOperation::Scale(shift) => Some(i32::from(shift).cast_unsigned()),
        NodeOperation::JoinPattern(bit)
        | NodeOperation::JoinShort(bit)
        | NodeOperation::JoinByte(bit)
        | NodeOperation::JoinSignedByte(bit) => Some(bit.into()),
        NodeOperation::SplitPattern(bit)
        | NodeOperation::SplitShort(bit)
        | NodeOperation::SplitByte(bit)
        | NodeOperation::SplitSignedByte(bit) => Some(bit.into()),
        _ => None,
    }
}

/// The number library's name for a plain operation.
pub(super) fn operation(code: NodeOperation) -> Option<Operation> {
    Some(match code {
        NodeOperation::Add => Operation::Add,
        NodeOperation::Sub => Operation::Sub,
        NodeOperation::Mul => Operation::Mul,
        NodeOperation::Div => Operation::Div,
        NodeOperation::Mad => Operation::Mad,
        NodeOperation::FusedMad => Operation::FusedMad,
        NodeOperation::Min => Operation::Min,
        NodeOperation::Max => Operation::Max,
        NodeOperation::Neg => Operation::Neg,
        NodeOperation::Abs => Operation::Abs,
        NodeOperation::Floor => Operation::Floor,
        NodeOperation::Frc => Operation::Frc,
        NodeOperation::Rcp => Operation::Rcp,
        NodeOperation::Rsq => Operation::Rsq,
        NodeOperation::Exp2 => Operation::Exp2,
        NodeOperation::Log2 => Operation::Log2,
        NodeOperation::Scale(_) => Operation::Scale,
        NodeOperation::Saturate => Operation::Saturate,
        NodeOperation::Factor => Operation::Factor,
        NodeOperation::SelectNonNegative => Operation::SelectNonNegative,
        NodeOperation::SelectAboveHalf => Operation::SelectAboveHalf,
        NodeOperation::Less => Operation::Less,
        NodeOperation::LessEqual => Operation::LessEqual,
        NodeOperation::Equal => Operation::Equal,
        NodeOperation::AddressFloor => Operation::AddressFloor,
        NodeOperation::AddressNearest => Operation::AddressNearest,
        NodeOperation::JoinPattern(_) => Operation::JoinPattern,
        NodeOperation::JoinShort(_) => Operation::JoinShort,
        NodeOperation::JoinByte(_) => Operation::JoinByte,
        NodeOperation::JoinSignedByte(_) => Operation::JoinSignedByte,
        NodeOperation::SplitPattern(_) => Operation::SplitPattern,
        NodeOperation::SplitShort(_) => Operation::SplitShort,
        NodeOperation::SplitByte(_) => Operation::SplitByte,
        NodeOperation::SplitSignedByte(_) => Operation::SplitSignedByte,
        NodeOperation::ToBits => Operation::Encode,
        NodeOperation::FromBits => Operation::Decode,
        _ => return None,
    })
}
