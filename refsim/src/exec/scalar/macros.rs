//! Operations that cards execute as several rounded steps. The documentation of each function states the sequence. This
//! project defines it, because no source describes the cards' sequences.

use super::alu::Alu;
use super::registers::Components;
use crate::isa::Version;
use crate::num::{self, NumberOperation as Op};

/// `bem`: `u' = (u + M00*r) + M10*g`, `v' = (v + M01*r) + M11*g`, each `+ M*x` a `mad` under the rules; z and w give 0.
///
/// `bump` is `[M00, M01, M10, M11]` of the destination's stage. Source: Direct3D, "bem - ps".
pub(super) fn bem(alu: &mut Alu<'_>, base: &Components, offset: &Components, bump: &[u32; 4]) -> Components {
    let mut row = |base: u32, m_r: u32, m_g: u32| {
        let first = alu.mad(m_r, offset[0], base);
        alu.mad(m_g, offset[1], first)
    };
    [row(base[0], bump[0], bump[2]), row(base[1], bump[1], bump[3]), 0, 0]
}

/// `pow`: `exp2(exponent * log2(base))` in three rounded steps, as the slot cost of 3 suggests and both OpenGL
/// extensions define; so `pow(0, 0)` is NaN. Sources: Direct3D, "pow - ps"; GL_NV_fragment_program 3.11.5.24.
pub(super) fn pow(alu: &mut Alu<'_>, base: u32, exponent: u32) -> u32 {
    let log = alu.log2(base);
    let product = alu.mul(exponent, log);
    alu.exp2(product)
}

/// `expp` of vs_1_1: `(exp2(floor w), w - floor w, exp2(w), 1)`, each rounded once. Source: Direct3D, "expp - vs",
/// whose third component has ten bits of precision. Vertex units of cards have an instruction of their own, with about
/// 11 bits.
pub(super) fn expp(alu: &mut Alu<'_>, w: u32) -> Components {
    let card = [Op::ExpFloor, Op::ExpFraction, Op::ExpPower].map(|operation| alu.card(operation, [w, 0, 0]));
    if let [Some(floor), Some(fraction), Some(power)] = card {
        return [floor, fraction, power, alu.one()];
    }
    let floor = alu.floor(w);
    [alu.exp2(floor), alu.frc(w), alu.exp2(w), alu.one()]
}

/// `logp` of vs_1_1: with `e = floor(log2 |w|)`, `(e, |w| * exp2(-e), log2 |w|, 1)`, each step rounded once; the
/// operand is a magnitude. For 0 the first and third component are `log2(0)` and the second is 1. Source: DirectX 8.1,
/// "logp" (vs_1_0 and vs_1_1). The Direct3D 9 page gives one value for all components, in every version.
///
/// Vertex units of cards have their own instruction.
pub(super) fn logp(alu: &mut Alu<'_>, magnitude: u32) -> Components {
    let operations = [Op::LogExponent, Op::LogMantissa, Op::LogPower];
    let card = operations.map(|operation| alu.card(operation, [magnitude, 0, 0]));
    if let [Some(exponent), Some(mantissa), Some(power)] = card {
        return [exponent, mantissa, power, alu.one()];
    }
    let log = alu.log2(magnitude);
    if alu.format.is_zero(magnitude) {
        return [log, alu.one(), log, alu.one()];
    }
    let exponent = alu.floor(log);
    let back = alu.neg(exponent);
    let scale = alu.exp2(back);
    [exponent, alu.mul(magnitude, scale), log, alu.one()]
}

/// `crs`: a product and a `mad` per component, `a.y*b.z + -(a.z*b.y)` and so on cyclically; w gives 0.
///
/// Source: Direct3D, "crs - ps" (two slots: `mul`, then `mad` with the negated product).
pub(super) fn crs(alu: &mut Alu<'_>, a: &Components, b: &Components) -> Components {
    let mut component = |i: usize, j: usize| {
        let product = alu.mul(a[j], b[i]);
        let negated = alu.neg(product);
        alu.mad(a[i], b[j], negated)
    };
    [component(1, 2), component(2, 0), component(0, 1), 0]
}

/// `nrm`: `d = dp3(a, a)`; `f = rsq(d)`, or the largest finite number if d is zero; then all four components are
/// multiplied by f.
///
/// Source: Direct3D, "nrm - ps" (the factor is `FLT_MAX` for a zero vector).
pub(super) fn nrm(alu: &mut Alu<'_>, a: &Components) -> Components {
    let d = alu.dot(&a[..3], &a[..3]);
    let factor = if alu.format.is_zero(d) { alu.format.max_finite() } else { alu.rsq(d) };
    [alu.mul(a[0], factor), alu.mul(a[1], factor), alu.mul(a[2], factor), alu.mul(a[3], factor)]
}

/// `sgn`: -1 below zero, 0 for zeros, and 1 otherwise (including NaN). Source: Direct3D, "sgn - vs". Vertex units of
/// cards have their own instruction.
pub(super) fn sgn(alu: &mut Alu<'_>, a: u32) -> u32 {
    if let Some(sign) = alu.card(Op::Sign, [a, 0, 0]) {
        return sign;
    }
    if alu.less(a, 0) {
        alu.neg(alu.one())
    } else if alu.equal(a, 0) {
        0
    } else {
        alu.one()
    }
}

/// `sincos`: `(cos x, sin x, 0, 0)` by Taylor series of the half angle. The coefficients are the two constant operands
/// (`D3DSINCOSCONST1` and `2`), rounded into the register format.
///
/// With `q = x*x`, where every `+` is a `mad` under the rules, and every other `*` is a `mul`:
/// `s = (((q*p.x + p.w)*q + r.x)*q + r.w) * x` (sin x/2), `c = ((q*p.y + p.z)*q + r.y)*q + r.z` (cos x/2),
/// `sin = t + t` with `t = s*c`, `cos = r.z - (u + u)` with `u = s*s`. Source: Direct3D, "sincos - ps".
pub(super) fn sincos(alu: &mut Alu<'_>, x: u32, p: &Components, r: &Components) -> Components {
    let q = alu.mul(x, x);
    let mut s = alu.mad(q, p[0], p[3]);
    s = alu.mad(s, q, r[0]);
    s = alu.mad(s, q, r[3]);
    s = alu.mul(s, x);
    let mut c = alu.mad(q, p[1], p[2]);
    c = alu.mad(c, q, r[1]);
    c = alu.mad(c, q, r[2]);
    let t = alu.mul(s, c);
    let sine = alu.add(t, t);
    let u = alu.mul(s, s);
    let twice = alu.add(u, u);
    [alu.sub(r[2], twice), sine, 0, 0]
}

/// `lit`: with x and y clamped to 0 from below, `(1, x, x > 0 ? y^w : 0, 1)`, the power as in [`pow`].
///
/// Direct3D clamps w to +-127.9961 (32767/256) and gives 0 for the power of 0. GL_ARB_fragment_program clamps w, and
/// `0^0` is 1. GL_NV_fragment_program does neither. Clamps keep a NaN; OpenGL's clamps also keep -0. Sources: Direct3D,
/// "lit - vs"; section 3.11.5.13 of both extensions.
///
/// Vertex units of cards have their own instruction.
pub(super) fn lit(alu: &mut Alu<'_>, version: Version, a: &Components) -> Components {
    let [mut x, mut y, _, mut w] = *a;
    let card = [alu.card(Op::LitDiffuse, [x, 0, 0]), alu.card(Op::LitSpecular, [x, y, w])];
    if let [Some(diffuse), Some(specular)] = card {
        return [alu.one(), diffuse, specular, alu.one()];
    }
    if version != Version::Fp1_0 {
        let limit = num::from_ratio(alu.format, false, 32767, 256).bits;
        let lowest = alu.neg(limit);
        w = if alu.less(w, lowest) {
            lowest
        } else if alu.less(limit, w) {
            limit
        } else {
            w
        };
    }
    let (lit, shines) = (alu.less(0, x), alu.less(0, y));
    if !version.is_fragment_program() {
        let specular = if lit && shines { pow(alu, y, w) } else { 0 };
        return [alu.one(), if lit { x } else { 0 }, specular, alu.one()];
    }
    for n in [&mut x, &mut y] {
        *n = if alu.less(*n, 0) { 0 } else { *n };
    }
    let unit = version == Version::ArbFp1_0 && alu.equal(y, 0) && alu.equal(w, 0);
    let specular = match (lit, unit) {
        (true, false) => pow(alu, y, w),
        (true, true) => alu.one(),
        (false, _) => 0,
    };
    [alu.one(), x, specular, alu.one()]
}

/// `RFL`: the direction `d` reflected about the axis `a`: `q = (a.d + a.d) / (a.a)`, then `q * a - d` with a product
/// and a difference per component; w is 0 and not written. Source: GL_NV_fragment_program.
pub(super) fn rfl(alu: &mut Alu<'_>, axis: &Components, direction: &Components) -> Components {
    let along = alu.dot(&axis[..3], &direction[..3]);
    let twice = alu.add(along, along);
    let square = alu.dot(&axis[..3], &axis[..3]);
    let q = alu.div(twice, square);
    let mut component = |i: usize| {
        let product = alu.mul(q, axis[i]);
        alu.sub(product, direction[i])
    };
    [component(0), component(1), component(2), 0]
}

/// `X2D`: a point displaced by a transformed vector: `(a.x + b.x*c.x) + b.y*c.y` in x and z, the same with `a.y`, `c.z`
/// and `c.w` in y and w. Each step is a `mad` under the rules. Source: GL_NV_fragment_program.
pub(super) fn x2d(alu: &mut Alu<'_>, a: &Components, b: &Components, c: &Components) -> Components {
    let mut row = |base: u32, i: usize| {
        let first = alu.mad(b[0], c[i], base);
        alu.mad(b[1], c[i + 1], first)
    };
    let (x, y) = (row(a[0], 0), row(a[1], 2));
    [x, y, x, y]
}
