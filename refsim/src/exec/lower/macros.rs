//! Operations of several rounded steps, as graph nodes. The scalar executor documents the sequences.

use super::arith::{GraphBuilder, NodeVector};
use super::graph::{Arith, NodeId, NodeKind};
use crate::device::Rules;
use crate::isa::{Opcode, Version};
use crate::num::{self, NumberOperation as Op};

impl GraphBuilder<'_> {
    /// The result of an arithmetic instruction, as the version's language defines it; missing operands are zeros.
    pub(crate) fn operation(
        &mut self,
        k: Arith,
        (opcode, version): (Opcode, Version),
        s: &[NodeVector; 3],
        bump: &NodeVector,
    ) -> NodeVector {
        use Opcode::*;
        let [mut a, b, c] = *s;
        if opcode.ignores_sign(version) {
            a = a.map(|x| self.unary(k, Op::Abs, x));
        }
        match opcode {
            Mov => a,
            Add => std::array::from_fn(|i| self.add(k, a[i], b[i])),
            Sub => std::array::from_fn(|i| self.sub(k, a[i], b[i])),
            Mul => std::array::from_fn(|i| self.mul(k, a[i], b[i])),
            Mad => std::array::from_fn(|i| self.mad(k, a[i], b[i], c[i])),
            Lrp => std::array::from_fn(|i| self.lrp(k, version, [a[i], b[i], c[i]])),
            Dp3 => [self.dot(k, 3, &a, &b); 4],
            Dp4 => [self.dot(k, 4, &a, &b); 4],
            Dp2Add => {
                let dot = self.dot(k, 2, &a, &b);
                [self.add(k, dot, c[0]); 4]
            }
            Cnd => std::array::from_fn(|i| self.compute(k, Op::SelectAboveHalf, a[i], b[i], c[i])),
            Cmp if version == Version::ArbFp1_0 => std::array::from_fn(|i| {
                let zero = self.zero();
                let below = self.holds(k, Op::Less, a[i], zero);
                self.select(below, b[i], c[i])
            }),
            Cmp => std::array::from_fn(|i| self.compute(k, Op::SelectNonNegative, a[i], b[i], c[i])),
            Bem => self.bem(k, &a, &b, bump),
            Abs => a.map(|x| self.unary(k, Op::Abs, x)),
            Min | Max if Rules::compares_in(version, &self.formats.format(k)) => std::array::from_fn(|i| {
                let above = self.holds(k, Op::Less, b[i], a[i]);
                let (yes, no) = if opcode == Max { (a[i], b[i]) } else { (b[i], a[i]) };
                self.select(above, yes, no)
            }),
            Min => std::array::from_fn(|i| self.binary(k, Op::Min, a[i], b[i])),
            Max => std::array::from_fn(|i| self.binary(k, Op::Max, a[i], b[i])),
            Dsx | Dsy => a.map(|x| self.graph.node(NodeKind::Difference(k, opcode == Dsy, x))),
            Sge => std::array::from_fn(|i| self.set(k, Op::SetLessEqual, b[i], a[i])),
            Slt => std::array::from_fn(|i| self.set(k, Op::SetLess, a[i], b[i])),
            Frc => a.map(|x| {
                let fraction = self.unary(k, Op::Frc, x);
                let Some(below) = Rules::frc_instead_of_one(version, &self.formats.format(k)) else { return fraction };
                let (one, below) = (self.one(k), self.pattern(k, below));
                let rounded = self.holds(k, Op::Equal, fraction, one);
                self.select(rounded, below, fraction)
            }),
            Rcp => [self.unary(k, Op::Rcp, a[0]); 4],
            Rsq => [self.unary(k, Op::Rsq, a[0]); 4],
            Exp => [self.unary(k, Op::Exp2, a[0]); 4],
            Log => [self.unary(k, Op::Log2, a[0]); 4],
            Pow => [self.pow(k, a[0], b[0]); 4],
            Expp if version == Version::Vs1_1 && self.is_vertex_unit(k) => {
                let [x, y, z] = [Op::ExpFloor, Op::ExpFraction, Op::ExpPower].map(|code| self.unary(k, code, a[3]));
                [x, y, z, self.one(k)]
            }
            Expp if version == Version::Vs1_1 => {
                let floor = self.unary(k, Op::Floor, a[3]);
                let [x, y, z] =
                    [(Op::Exp2, floor), (Op::Frc, a[3]), (Op::Exp2, a[3])].map(|(code, n)| self.unary(k, code, n));
                [x, y, z, self.one(k)]
            }
            Expp => [self.unary(k, Op::Exp2, a[3]); 4],
            Logp if version == Version::Vs1_1 => self.logp(k, a[3]),
            Logp => [self.unary(k, Op::Log2, a[3]); 4],
            Crs => self.crs(k, &a, &b),
            Nrm => self.nrm(k, &a),
            Sgn => a.map(|x| self.sgn(k, x)),
            SinCos => self.sincos(k, a[0], &b, &c),
            Dst => [self.one(k), self.mul(k, a[1], b[1]), a[2], b[3]],
            Lit => self.lit(k, version, &a),
            Flr => a.map(|x| self.unary(k, Op::Floor, x)),
            Cos => [self.circle(k, false, a[0]); 4],
            Sin => [self.circle(k, true, a[0]); 4],
            Scs => [self.circle(k, false, a[0]), self.circle(k, true, a[0]), self.zero(), self.zero()],
            Dph if self.graph.is_card(k) => {
                let one = self.one(k);
                [self.dot(k, 4, &[a[0], a[1], a[2], one], &b); 4]
            }
            Dph => {
                let dot = self.dot(k, 3, &a, &b);
                [self.add(k, dot, b[3]); 4]
            }
            Swz => a,
            Seq => std::array::from_fn(|i| self.set(k, Op::SetEqual, a[i], b[i])),
            Sne => std::array::from_fn(|i| self.set(k, Op::SetNotEqual, a[i], b[i])),
            Sgt => std::array::from_fn(|i| self.set(k, Op::SetLess, b[i], a[i])),
            Sle => std::array::from_fn(|i| self.set(k, Op::SetLessEqual, a[i], b[i])),
            Str => [self.one(k); 4],
            Rfl => self.rfl(k, &a, &b),
            X2d => self.x2d(k, &a, &b, &c),
            Sfl | Nop | Phase | Mova | M3x2 | M3x3 | M3x4 | M4x3 | M4x4 | Setp | Pk2h | Pk2us | Pk4b | Pk4ub | Up2h
            | Up2us | Up4b | Up4ub | Tex | TexCoord | TexKill | TexBem | TexBemL | TexReg2Ar | TexReg2Gb
            | TexReg2Rgb | TexM3x2Pad | TexM3x2Tex | TexM3x2Depth | TexM3x3Pad | TexM3x3Tex | TexM3x3Spec
            | TexM3x3VSpec | TexM3x3 | TexDp3 | TexDp3Tex | TexLd | TexLdB | TexLdP | TexLdD | TexCrd | TexDepth
            | Kil | If | IfC | Else | EndIf | Rep | EndRep | Loop | EndLoop | Break | BreakC | BreakP | Call
            | CallNz | Label | Ret => [self.zero(); 4],
        }
    }

    /// One if a comparison holds, else zero. A card's unit has its own operation, which may give NaN.
    fn set(&mut self, k: Arith, code: Op, a: NodeId, b: NodeId) -> NodeId {
        if self.graph.is_card(k) {
            return self.binary(k, code, a, b);
        }
        let (one, zero) = (self.one(k), self.zero());
        let (holds, yes, no) = match code {
            Op::SetLess => (Op::Less, one, zero),
            Op::SetLessEqual => (Op::LessEqual, one, zero),
            Op::SetEqual => (Op::Equal, one, zero),
            _ => (Op::Equal, zero, one),
        };
        let holds = self.holds(k, holds, a, b);
        self.select(holds, yes, no)
    }

    /// Returns `true` for a vertex unit, which has single operations for results that are otherwise computed in several
    /// steps.
    fn is_vertex_unit(&self, k: Arith) -> bool {
        self.formats.format(k).unit.is_vertex_unit()
    }

    fn bem(&mut self, k: Arith, base: &NodeVector, offset: &NodeVector, m: &NodeVector) -> NodeVector {
        let mut row = |base: NodeId, r: NodeId, g: NodeId| {
            let first = self.mad(k, r, offset[0], base);
            self.mad(k, g, offset[1], first)
        };
        let (u, v) = (row(base[0], m[0], m[2]), row(base[1], m[1], m[3]));
        [u, v, self.zero(), self.zero()]
    }

    fn pow(&mut self, k: Arith, base: NodeId, exponent: NodeId) -> NodeId {
        let log = self.unary(k, Op::Log2, base);
        let product = self.mul(k, exponent, log);
        self.unary(k, Op::Exp2, product)
    }

    fn logp(&mut self, k: Arith, magnitude: NodeId) -> NodeVector {
        if self.is_vertex_unit(k) {
            let parts = [Op::LogExponent, Op::LogMantissa, Op::LogPower];
            let [x, y, z] = parts.map(|code| self.unary(k, code, magnitude));
            return [x, y, z, self.one(k)];
        }
        let log = self.unary(k, Op::Log2, magnitude);
        let exponent = self.unary(k, Op::Floor, log);
        let back = self.neg(k, exponent);
        let scale = self.unary(k, Op::Exp2, back);
        let mantissa = self.mul(k, magnitude, scale);
        let (zero, one) = (self.zero(), self.one(k));
        let is_zero = self.holds(k, Op::Equal, magnitude, zero);
        [self.select(is_zero, log, exponent), self.select(is_zero, one, mantissa), log, one]
    }

    fn crs(&mut self, k: Arith, a: &NodeVector, b: &NodeVector) -> NodeVector {
        let mut component = |i: usize, j: usize| {
            let product = self.mul(k, a[j], b[i]);
            let negated = self.neg(k, product);
            self.mad(k, a[i], b[j], negated)
        };
        let (x, y, z) = (component(1, 2), component(2, 0), component(0, 1));
        [x, y, z, self.zero()]
    }

    fn nrm(&mut self, k: Arith, a: &NodeVector) -> NodeVector {
        let d = self.dot(k, 3, a, a);
        let zero = self.zero();
        let is_zero = self.holds(k, Op::Equal, d, zero);
        let largest = self.pattern(k, self.formats.format(k).max_finite());
        let root = self.unary(k, Op::Rsq, d);
        let factor = self.select(is_zero, largest, root);
        a.map(|x| self.mul(k, x, factor))
    }

    fn sgn(&mut self, k: Arith, a: NodeId) -> NodeId {
        if self.is_vertex_unit(k) {
            return self.unary(k, Op::Sign, a);
        }
        let (zero, one) = (self.zero(), self.one(k));
        let minus = self.neg(k, one);
        let below = self.holds(k, Op::Less, a, zero);
        let is_zero = self.holds(k, Op::Equal, a, zero);
        let rest = self.select(is_zero, zero, one);
        self.select(below, minus, rest)
    }

    fn sincos(&mut self, k: Arith, x: NodeId, p: &NodeVector, r: &NodeVector) -> NodeVector {
        let q = self.mul(k, x, x);
        let mut s = self.mad(k, q, p[0], p[3]);
        s = self.mad(k, s, q, r[0]);
        s = self.mad(k, s, q, r[3]);
        s = self.mul(k, s, x);
        let mut c = self.mad(k, q, p[1], p[2]);
        c = self.mad(k, c, q, r[1]);
        c = self.mad(k, c, q, r[2]);
        let t = self.mul(k, s, c);
        let sine = self.add(k, t, t);
        let u = self.mul(k, s, s);
        let twice = self.add(k, u, u);
        [self.sub(k, r[2], twice), sine, self.zero(), self.zero()]
    }

    fn circle(&mut self, k: Arith, sine: bool, angle: NodeId) -> NodeId {
        self.graph.node(NodeKind::Circle(k, sine, angle))
    }

    fn rfl(&mut self, k: Arith, axis: &NodeVector, direction: &NodeVector) -> NodeVector {
        let along = self.dot(k, 3, axis, direction);
        let twice = self.add(k, along, along);
        let square = self.dot(k, 3, axis, axis);
        let q = self.div(k, twice, square);
        let mut component = |i: usize| {
            let product = self.mul(k, q, axis[i]);
            self.sub(k, product, direction[i])
        };
        let (x, y, z) = (component(0), component(1), component(2));
        [x, y, z, self.zero()]
    }

    fn x2d(&mut self, k: Arith, a: &NodeVector, b: &NodeVector, c: &NodeVector) -> NodeVector {
        let mut row = |base: NodeId, i: usize| {
            let first = self.mad(k, b[0], c[i], base);
            self.mad(k, b[1], c[i + 1], first)
        };
        let (x, y) = (row(a[0], 0), row(a[1], 2));
        [x, y, x, y]
    }

    fn lit(&mut self, k: Arith, version: Version, a: &NodeVector) -> NodeVector {
        let [x, y, _, w] = *a;
        let (zero, one) = (self.zero(), self.one(k));
        if self.is_vertex_unit(k) {
            let specular = self.compute(k, Op::LitSpecular, x, y, w);
            return [one, self.unary(k, Op::LitDiffuse, x), specular, one];
        }
        let exponent = if version == Version::Fp1_0 { w } else { self.held_exponent(k, w) };
        let lit = self.holds(k, Op::Less, zero, x);
        if !version.is_fragment_program() {
            let shines = self.holds(k, Op::Less, zero, y);
            let both = self.binary(Arith::Single, Op::And, lit, shines);
            let power = self.pow(k, y, exponent);
            return [one, self.select(lit, x, zero), self.select(both, power, zero), one];
        }
        let [x, y] = [x, y].map(|n| {
            let below = self.holds(k, Op::Less, n, zero);
            self.select(below, zero, n)
        });
        let mut power = self.pow(k, y, exponent);
        if version == Version::ArbFp1_0 {
            let [base, exponent] = [y, exponent].map(|n| self.holds(k, Op::Equal, n, zero));
            let unit = self.binary(Arith::Single, Op::And, base, exponent);
            power = self.select(unit, one, power);
        }
        [one, x, self.select(lit, power, zero), one]
    }

    /// Clamps a number to +-32767/256; NaN is unchanged.
    fn held_exponent(&mut self, k: Arith, w: NodeId) -> NodeId {
        let limit_bits = num::from_ratio(self.formats.format(k), false, 32767, 256).bits;
        let limit = self.pattern(k, limit_bits);
        let lowest = self.neg(k, limit);
        let (below, above) = (self.holds(k, Op::Less, w, lowest), self.holds(k, Op::Less, limit, w));
        let upper = self.select(above, limit, w);
        self.select(below, lowest, upper)
    }
}
