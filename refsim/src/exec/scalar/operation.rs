//! Arithmetic operations for one lane: map operands (after swizzle and source modifier) to a result (before shift,
//! saturation and write mask). Follows the instruction pages of the Direct3D shader assembly reference, and for
//! OpenGL's programs, where different, GL_NV_fragment_program and GL_ARB_fragment_program.

use super::alu::Alu;
use super::macros;
use super::registers::Components;
use crate::device::Rules;
use crate::isa::{Mask, Opcode, Version};
use crate::num::NumberOperation as Set;

/// Inputs of an operation other than its operands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    /// The language: some operations depend on it.
    pub(crate) version: Version,
    /// Bump matrix `M00 M01 M10 M11` of the destination's stage, in the format of the operation (`bem`).
    pub(crate) bump: [u32; 4],
    /// The needed components. Component-wise operations leave other components zero and raise no flags for them.
    pub(crate) mask: Mask,
}

/// Computes `opcode` on `s`; unused operands are zero.
///
/// Operations that need more than the values of their operands (`setp`, `mova`, the matrix products and
/// all texture and flow operations) are computed elsewhere; here they return zero.
pub(crate) fn compute(alu: &mut Alu<'_>, opcode: Opcode, s: &[Components; 3], context: &Context) -> Components {
    use Opcode::*;
    let [mut a, b, c] = *s;
    let Context { version, mask, .. } = *context;
    if opcode.ignores_sign(version) {
        a = a.map(|x| alu.abs(x));
    }
    match opcode {
        Mov => a,
        Add => each(mask, |i| alu.add(a[i], b[i])),
        Sub => each(mask, |i| alu.sub(a[i], b[i])),
        // The operands come from two lanes.
        Dsx | Dsy => each(mask, |i| alu.difference(a[i], b[i])),
        Mul => each(mask, |i| alu.mul(a[i], b[i])),
        Mad => each(mask, |i| alu.mad(a[i], b[i], c[i])),
        Lrp => each(mask, |i| alu.lrp(version, [a[i], b[i], c[i]])),
        Dp3 => [alu.dot(&a[..3], &b[..3]); 4],
        Dp4 => [alu.dot(&a, &b); 4],
        Dp2Add => {
            let dot = alu.dot(&a[..2], &b[..2]);
            [alu.add(dot, c[0]); 4]
        }
        Cnd => each(mask, |i| alu.cnd(a[i], b[i], c[i])),
        // ARB selects by `< 0`, Direct3D by `>= 0`; the results differ for NaN.
        Cmp if version == Version::ArbFp1_0 => each(mask, |i| if alu.less(a[i], 0) { b[i] } else { c[i] }),
        Cmp => each(mask, |i| alu.cmp(a[i], b[i], c[i])),
        Bem => macros::bem(alu, &a, &b, &context.bump),
        Abs => each(mask, |i| alu.abs(a[i])),
        Min if Rules::compares_in(version, &alu.format) => {
            each(mask, |i| if alu.less(b[i], a[i]) { b[i] } else { a[i] })
        }
        Max if Rules::compares_in(version, &alu.format) => {
            each(mask, |i| if alu.less(b[i], a[i]) { a[i] } else { b[i] })
        }
        Min => each(mask, |i| alu.min(a[i], b[i])),
        Max => each(mask, |i| alu.max(a[i], b[i])),
        Sge => each(mask, |i| alu.set(Set::SetLessEqual, b[i], a[i])),
        Slt => each(mask, |i| alu.set(Set::SetLess, a[i], b[i])),
        Frc => each(mask, |i| {
            let fraction = alu.frc(a[i]);
            match Rules::frc_instead_of_one(version, &alu.format) {
                Some(below) if alu.equal(fraction, alu.one()) => below,
                _ => fraction,
            }
        }),
        Rcp => [alu.rcp(a[0]); 4],
        Rsq => [alu.rsq(a[0]); 4],
        Exp => [alu.exp2(a[0]); 4],
        Log => [alu.log2(a[0]); 4],
        Pow => [macros::pow(alu, a[0], b[0]); 4],
        Expp if version == Version::Vs1_1 => macros::expp(alu, a[3]),
        Expp => [alu.exp2(a[3]); 4],
        Logp if version == Version::Vs1_1 => macros::logp(alu, a[3]),
        Logp => [alu.log2(a[3]); 4],
        Crs => macros::crs(alu, &a, &b),
        Nrm => macros::nrm(alu, &a),
        Sgn => each(mask, |i| macros::sgn(alu, a[i])),
        SinCos => macros::sincos(alu, a[0], &b, &c),
        Dst => [alu.one(), alu.mul(a[1], b[1]), a[2], b[3]],
        Lit => macros::lit(alu, version, &a),
        Flr => each(mask, |i| alu.floor(a[i])),
        Cos => [alu.cos(a[0]); 4],
        Sin => [alu.sin(a[0]); 4],
        Scs => [alu.cos(a[0]), alu.sin(a[0]), 0, 0],
        // A card's unit includes the fourth term in one sum.
        Dph if alu.by_card() => [alu.dot(&[a[0], a[1], a[2], alu.one()], &b); 4],
        Dph => {
            let dot = alu.dot(&a[..3], &b[..3]);
            [alu.add(dot, b[3]); 4]
        }
        Swz => a,
        Seq => each(mask, |i| alu.set(Set::SetEqual, a[i], b[i])),
        Sne => each(mask, |i| alu.set(Set::SetNotEqual, a[i], b[i])),
        Sgt => each(mask, |i| alu.set(Set::SetLess, b[i], a[i])),
        Sle => each(mask, |i| alu.set(Set::SetLessEqual, a[i], b[i])),
        Str => [alu.one(); 4],
        Rfl => macros::rfl(alu, &a, &b),
        X2d => macros::x2d(alu, &a, &b, &c),
        Sfl | Nop | Phase | Mova | M3x2 | M3x3 | M3x4 | M4x3 | M4x4 | Setp | Pk2h | Pk2us | Pk4b | Pk4ub | Up2h
        | Up2us | Up4b | Up4ub | Tex | TexCoord | TexKill | TexBem | TexBemL | TexReg2Ar | TexReg2Gb | TexReg2Rgb
        | TexM3x2Pad | TexM3x2Tex | TexM3x2Depth | TexM3x3Pad | TexM3x3Tex | TexM3x3Spec | TexM3x3VSpec | TexM3x3
        | TexDp3 | TexDp3Tex | TexLd | TexLdB | TexLdP | TexLdD | TexCrd | TexDepth | Kil | If | IfC | Else | EndIf
        | Rep | EndRep | Loop | EndLoop | Break | BreakC | BreakP | Call | CallNz | Label | Ret => [0; 4],
    }
}

/// Computes the components of `mask` by index; the others are zero.
pub(crate) fn each(mask: Mask, mut component: impl FnMut(usize) -> u32) -> Components {
    let mut vector = [0; 4];
    for i in mask.components() {
        vector[i] = component(i);
    }
    vector
}
