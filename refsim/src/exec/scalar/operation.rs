//! Arithmetic operations for one lane: map operands (after swizzle and source modifier) to a result (before shift,
//! saturation and write mask). Follows the instruction pages of the Direct3D shader assembly reference, and where they
//! differ the sections of GL_NV_fragment_program and GL_ARB_fragment_program.

use super::alu::Alu;
use super::macros;
use super::registers::Components;
use crate::device::Rules;
use crate::isa::{Mask, Opcode, Version};

/// Inputs of an operation besides its operands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Context {
    /// The language: some operations differ from one to another.
    pub(crate) version: Version,
    /// Bump matrix `M00 M01 M10 M11` of the destination's stage, in the format of the operation (`bem`).
    pub(crate) bump: [u32; 4],
    /// The components needed. Component-wise operations leave the others zero and raise no flags for them.
    pub(crate) mask: Mask,
}

/// Computes `opcode` on `s`; unused operands are zero.
///
/// Operations that need more than the values of their operands (`dsx`, `dsy`, `setp`, `mova`, the matrix products and
/// all texture and flow operations) are computed elsewhere; here they return zero.
pub(crate) fn compute(alu: &mut Alu<'_>, opcode: Opcode, s: &[Components; 3], context: &Context) -> Components {
    let [mut a, b, c] = *s;
    let Context { version, mask, .. } = *context;
    if opcode.ignores_sign(version) {
        a = a.map(|x| alu.abs(x));
    }
    match opcode {
        Opcode::Mov => a,
        Opcode::Add => each(mask, |i| alu.add(a[i], b[i])),
        Opcode::Sub => each(mask, |i| alu.sub(a[i], b[i])),
        Opcode::Mul => each(mask, |i| alu.mul(a[i], b[i])),
        Opcode::Mad => each(mask, |i| alu.mad(a[i], b[i], c[i])),
        Opcode::Lrp => each(mask, |i| alu.lrp(version, [a[i], b[i], c[i]])),
        Opcode::Dp3 => [alu.dot(&a[..3], &b[..3]); 4],
        Opcode::Dp4 => [alu.dot(&a, &b); 4],
        Opcode::Dp2Add => {
            let dot = alu.dot(&a[..2], &b[..2]);
            [alu.add(dot, c[0]); 4]
        }
        Opcode::Cnd => each(mask, |i| alu.cnd(a[i], b[i], c[i])),
        Opcode::Cmp => each(mask, |i| alu.cmp(a[i], b[i], c[i])),
        Opcode::Bem => macros::bem(alu, &a, &b, &context.bump),
        Opcode::Abs => each(mask, |i| alu.abs(a[i])),
        Opcode::Min if Rules::compares_in(version, &alu.format) => {
            each(mask, |i| if alu.less(b[i], a[i]) { b[i] } else { a[i] })
        }
        Opcode::Max if Rules::compares_in(version, &alu.format) => {
            each(mask, |i| if alu.less(b[i], a[i]) { a[i] } else { b[i] })
        }
        Opcode::Min => each(mask, |i| alu.min(a[i], b[i])),
        Opcode::Max => each(mask, |i| alu.max(a[i], b[i])),
        Opcode::Sge => each(mask, |i| if alu.less_or_equal(b[i], a[i]) { alu.one() } else { 0 }),
        Opcode::Slt => each(mask, |i| if alu.less(a[i], b[i]) { alu.one() } else { 0 }),
        Opcode::Frc => each(mask, |i| {
            let fraction = alu.frc(a[i]);
            match Rules::frc_instead_of_one(version, &alu.format) {
                Some(below) if alu.equal(fraction, alu.one()) => below,
                _ => fraction,
            }
        }),
        Opcode::Rcp => [alu.rcp(a[0]); 4],
        Opcode::Rsq => [alu.rsq(a[0]); 4],
        Opcode::Exp => [alu.exp2(a[0]); 4],
        Opcode::Log => [alu.log2(a[0]); 4],
        Opcode::Pow => [macros::pow(alu, a[0], b[0]); 4],
        Opcode::Expp if version == Version::Vs1_1 => macros::expp(alu, a[3]),
        Opcode::Expp => [alu.exp2(a[3]); 4],
        Opcode::Logp if version == Version::Vs1_1 => macros::logp(alu, a[3]),
        Opcode::Logp => [alu.log2(a[3]); 4],
        Opcode::Crs => macros::crs(alu, &a, &b),
        Opcode::Nrm => macros::nrm(alu, &a),
        Opcode::Sgn => each(mask, |i| macros::sgn(alu, a[i])),
        Opcode::SinCos => macros::sincos(alu, a[0], &b, &c),
        Opcode::Dst => [alu.one(), alu.mul(a[1], b[1]), a[2], b[3]],
        Opcode::Lit => macros::lit(alu, version, &a),
        Opcode::Flr => each(mask, |i| alu.floor(a[i])),
        Opcode::Cos => [alu.cos(a[0]); 4],
        Opcode::Sin => [alu.sin(a[0]); 4],
        Opcode::Scs => [alu.cos(a[0]), alu.sin(a[0]), 0, 0],
        Opcode::Dph => {
            let dot = alu.dot(&a[..3], &b[..3]);
            [alu.add(dot, b[3]); 4]
        }
        Opcode::Swz => a,
        Opcode::Seq => each(mask, |i| if alu.equal(a[i], b[i]) { alu.one() } else { 0 }),
        Opcode::Sne => each(mask, |i| if alu.equal(a[i], b[i]) { 0 } else { alu.one() }),
        Opcode::Sgt => each(mask, |i| if alu.less(b[i], a[i]) { alu.one() } else { 0 }),
        Opcode::Sle => each(mask, |i| if alu.less_or_equal(a[i], b[i]) { alu.one() } else { 0 }),
        Opcode::Str => [alu.one(); 4],
        Opcode::Sfl => [0; 4],
        Opcode::Rfl => macros::rfl(alu, &a, &b),
        Opcode::X2d => macros::x2d(alu, &a, &b, &c),
        _ => [0; 4],
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::Profile;
    use crate::isa::OpcodeClass;

    /// An operation in the opcode table that `compute` lacks would silently return zero.
    #[test]
    fn every_arithmetic_operation_is_here_or_elsewhere() {
        const ELSEWHERE: [Opcode; 4] = [Opcode::Mova, Opcode::Dsx, Opcode::Dsy, Opcode::Setp];
        let profile = Profile::named("ideal-fp32").expect("a device");
        let operands = [[1.5, 2.5, 0.75, 3.0], [1.5, 0.5, 4.0, 2.0], [0.25, 1.25, 2.0, 0.5]];
        let operands = operands.map(|operand: [f32; 4]| operand.map(f32::to_bits));
        for &opcode in Opcode::ALL.iter().filter(|opcode| opcode.info().class == OpcodeClass::Arithmetic) {
            let mut alu = Alu::new(&profile.rules, profile.rules.format);
            let context = Context { version: Version::Vs2_0, bump: [0x3f80_0000; 4], mask: Mask::ALL };
            let found = compute(&mut alu, opcode, &operands, &context);
            let packing = ["pk", "up"].iter().any(|start| opcode.info().mnemonic.starts_with(start));
            let elsewhere = ELSEWHERE.contains(&opcode) || opcode.matrix().is_some() || packing;
            // Set on false is zero by definition.
            assert_eq!(found == [0; 4], elsewhere || opcode == Opcode::Sfl, "{opcode:?}");
        }
    }
}
