//! How the number library calls the operations of the batch executor's graph.

use crate::exec::batch::ops::Code;
use crate::exec::wgsl::number::Operation;

/// What an operation has besides values: the operand after them.
pub(super) fn immediate(code: Code) -> Option<u32> {
    match code {
        Code::Scale(shift) => Some(i32::from(shift).cast_unsigned()),
        Code::JoinPattern(bit) | Code::JoinShort(bit) | Code::JoinByte(bit) | Code::JoinSignedByte(bit) => {
            Some(bit.into())
        }
        Code::SplitPattern(bit) | Code::SplitShort(bit) | Code::SplitByte(bit) | Code::SplitSignedByte(bit) => {
            Some(bit.into())
        }
        _ => None,
    }
}

/// The number library's name for a plain operation.
pub(super) fn operation(code: Code) -> Option<Operation> {
    Some(match code {
        Code::Add => Operation::Add,
        Code::Sub => Operation::Sub,
        Code::Mul => Operation::Mul,
        Code::Div => Operation::Div,
        Code::Mad => Operation::Mad,
        Code::FusedMad => Operation::FusedMad,
        Code::Min => Operation::Min,
        Code::Max => Operation::Max,
        Code::Neg => Operation::Neg,
        Code::Abs => Operation::Abs,
        Code::Floor => Operation::Floor,
        Code::Frc => Operation::Frc,
        Code::Rcp => Operation::Rcp,
        Code::Rsq => Operation::Rsq,
        Code::Exp2 => Operation::Exp2,
        Code::Log2 => Operation::Log2,
        Code::Scale(_) => Operation::Scale,
        Code::Saturate => Operation::Saturate,
        Code::Factor => Operation::Factor,
        Code::SelectNonNegative => Operation::SelectNonNegative,
        Code::SelectAboveHalf => Operation::SelectAboveHalf,
        Code::Less => Operation::Less,
        Code::LessEqual => Operation::LessEqual,
        Code::Equal => Operation::Equal,
        Code::AddressFloor => Operation::AddressFloor,
        Code::AddressNearest => Operation::AddressNearest,
        Code::JoinPattern(_) => Operation::JoinPattern,
        Code::JoinShort(_) => Operation::JoinShort,
        Code::JoinByte(_) => Operation::JoinByte,
        Code::JoinSignedByte(_) => Operation::JoinSignedByte,
        Code::SplitPattern(_) => Operation::SplitPattern,
        Code::SplitShort(_) => Operation::SplitShort,
        Code::SplitByte(_) => Operation::SplitByte,
        Code::SplitSignedByte(_) => Operation::SplitSignedByte,
        Code::ToBits => Operation::Encode,
        Code::FromBits => Operation::Decode,
        _ => return None,
    })
}
