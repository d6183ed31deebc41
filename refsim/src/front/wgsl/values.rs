//! Values as lists of scalars, and the layout of types in such lists.

use naga::{ArraySize, Handle, Module, Scalar, ScalarKind, Type, TypeInner};

use crate::isa::Register;

/// One scalar of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Component {
    /// A number known at translation: the bits of an IEEE single, which can represent every f16 too.
    Float(u32),
    /// A whole number known at translation.
    Int(i64),
    /// A condition known at translation.
    Bool(bool),
    /// A component of a register: a number, or a condition as 0 or 1.
    Place(Register, u8),
    /// A whole number that is not known at translation.
    Unknown,
}

/// A scalar, vector, matrix (column by column), array or structure, as a list of scalars.
pub(super) type Value = Vec<Component>;

/// Maximum number of scalars in one value.
pub(super) const MAX_SCALARS: usize = 4096;

/// The scalars of a type in order; `None` for types of other kinds, and for very large types.
pub(super) fn scalars(module: &Module, inner: &TypeInner) -> Option<Vec<Scalar>> {
    let of = |handle: &Handle<Type>| scalars(module, &module.types[*handle].inner);
    let list = match inner {
        TypeInner::Scalar(scalar) => vec![*scalar],
        TypeInner::Vector { size, scalar } => vec![*scalar; *size as usize],
        TypeInner::Matrix { columns, rows, scalar } => vec![*scalar; *columns as usize * *rows as usize],
        TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
            let one = of(base)?;
            let total = one.len().checked_mul(count.get() as usize).filter(|total| *total <= MAX_SCALARS)?;
            one.iter().cycle().take(total).copied().collect()
        }
        TypeInner::Struct { members, .. } => {
            let mut all = Vec::new();
            for member in members {
                all.extend(of(&member.ty)?);
                if all.len() > MAX_SCALARS {
                    return None;
                }
            }
            all
        }
        _ => return None,
    };
    Some(list)
}

/// Offset and length of element or member `index` in a value of the type; `None` if the index is out of range.
pub(super) fn part(module: &Module, inner: &TypeInner, index: usize) -> Option<(usize, usize)> {
    let count = |handle: Handle<Type>| Some(scalars(module, &module.types[handle].inner)?.len());
    match inner {
        TypeInner::Vector { size, .. } => (index < *size as usize).then_some((index, 1)),
        TypeInner::ValuePointer { size: Some(size), .. } => (index < *size as usize).then_some((index, 1)),
        TypeInner::Matrix { columns, rows, .. } => {
            let rows = *rows as usize;
            (index < *columns as usize).then_some((index * rows, rows))
        }
        TypeInner::Array { base, size: ArraySize::Constant(length), .. } => {
            let one = count(*base)?;
            (index < length.get() as usize).then_some((index * one, one))
        }
        TypeInner::Struct { members, .. } => {
            let before = members.iter().take(index).map(|member| count(member.ty)).sum::<Option<usize>>()?;
            Some((before, count(members.get(index)?.ty)?))
        }
        _ => None,
    }
}

/// The scalar type of a scalar, vector or matrix; `None` for other types.
pub(super) fn scalar(inner: &TypeInner) -> Option<Scalar> {
    match inner {
        TypeInner::Scalar(scalar) => Some(*scalar),
        TypeInner::Vector { scalar, .. } | TypeInner::Matrix { scalar, .. } => Some(*scalar),
        _ => None,
    }
}

/// Returns `true` for f16.
pub(super) fn is_half(scalar: Option<Scalar>) -> bool {
    scalar.is_some_and(|scalar| scalar.kind == ScalarKind::Float && scalar.width == 2)
}

pub(super) fn zero(scalar: &Scalar) -> Component {
    match scalar.kind {
        ScalarKind::Bool => Component::Bool(false),
        ScalarKind::Float | ScalarKind::AbstractFloat => Component::Float(0),
        _ => Component::Int(0),
    }
}
