//! Arithmetic as graph nodes, under the rules of a device.

use refsim_lanes::{RowSum, TRUE};

use super::formats::Formats;
use super::graph::{Arith, Graph, NodeId, NodeKind};
use crate::device::{AddMode, LrpMode, MadMode, PRODUCTS, Rules, SumRules};
use crate::isa::Version;
use crate::num::{self, DotOrder, Format, FormatKind, NumberOperation as Op, Rounding, Specials};

/// Four components.
pub(crate) type NodeVector = [NodeId; 4];

/// Builds nodes. Its methods are the operations of the instruction set in one format, with the rounding sequence given
/// by the rules.
pub(crate) struct GraphBuilder<'a> {
    pub(crate) graph: Graph,
    pub(crate) formats: Formats,
    pub(crate) rules: &'a Rules,
    /// `true` if zero times anything is zero in register arithmetic.
    legacy_zero: bool,
    is_pixel: bool,
}

impl<'a> GraphBuilder<'a> {
    pub(crate) fn new(formats: Formats, rules: &'a Rules, pixel: bool) -> Self {
        let legacy_zero = if pixel { rules.zero_times_anything } else { rules.vertex_zero_times_anything };
        Self { graph: Graph::new(formats.all(), !pixel), formats, rules, legacy_zero, is_pixel: pixel }
    }

    /// Creates a constant from a bit pattern of a format.
    pub(crate) fn pattern(&mut self, k: Arith, bits: u32) -> NodeId {
        let raw = self.formats.decode(k, bits);
        self.graph.constant(raw)
    }

    pub(crate) fn zero(&mut self) -> NodeId {
        self.graph.constant(0)
    }

    pub(crate) fn one(&mut self, k: Arith) -> NodeId {
        self.pattern(k, self.formats.format(k).one())
    }

    fn half(&mut self, k: Arith) -> NodeId {
        self.pattern(k, num::from_ratio(self.formats.format(k), false, 1, 2).bits)
    }

    pub(crate) fn compute(&mut self, k: Arith, code: Op, a: NodeId, b: NodeId, c: NodeId) -> NodeId {
        if let Some(known) = self.known_mask(k, code, a, b) {
            return known;
        }
        self.graph.node(NodeKind::Compute(k, code, [a, b, c]))
    }

    /// Simplifies an operation on masks that are constant or redundant; `None` if it cannot be simplified.
    fn known_mask(&mut self, k: Arith, code: Op, a: NodeId, b: NodeId) -> Option<NodeId> {
        let constant = |n: NodeId| match self.graph.kind(n) {
            NodeKind::Constant(raw) => Some(raw),
            _ => None,
        };
        match code {
            Op::Less | Op::LessEqual | Op::Equal => {
                let holds = self.formats.compares(k, code, constant(a)?, constant(b)?);
                Some(self.graph.constant(if holds { TRUE } else { 0 }))
            }
            Op::Or if constant(b) == Some(0) || self.graph.includes(a, b) => Some(a),
            Op::Or if constant(a) == Some(0) => Some(b),
            Op::And if constant(b) == Some(TRUE) => Some(a),
            Op::And if constant(a) == Some(TRUE) => Some(b),
            _ => None,
        }
    }

    pub(crate) fn unary(&mut self, k: Arith, code: Op, a: NodeId) -> NodeId {
        self.compute(k, code, a, a, a)
    }

    /// An operation whose second operand is an immediate.
    pub(crate) fn immediate(&mut self, k: Arith, code: Op, a: NodeId, word: u32) -> NodeId {
        let word = self.graph.constant(word);
        self.binary(k, code, a, word)
    }

    /// Inserts a part into a word at bit `bit`.
    pub(crate) fn join(&mut self, k: Arith, code: Op, word: NodeId, part: NodeId, bit: u32) -> NodeId {
        let bit = self.graph.constant(bit);
        self.compute(k, code, word, part, bit)
    }

    /// Multiplies by a power of two.
    pub(crate) fn scale(&mut self, k: Arith, a: NodeId, power: i8) -> NodeId {
        self.immediate(k, Op::Scale, a, i32::from(power).cast_unsigned())
    }

    pub(crate) fn binary(&mut self, k: Arith, code: Op, a: NodeId, b: NodeId) -> NodeId {
        self.compute(k, code, a, b, a)
    }

    /// Converts `a` from format `from` to `to`, rounded once.
    pub(crate) fn convert(&mut self, from: Arith, to: Arith, a: NodeId) -> NodeId {
        if self.formats.format(from) == self.formats.format(to) {
            return a;
        }
        // Single precision represents every number of a format with up to 24 significant bits, so the round trip
        // preserves the number, which also fits the format's wrapping variant. A normalized number becomes the nearest
        // single; only rounding to nearest restores it.
        let returns = |format: Format| match format.kind {
            FormatKind::Float { .. } => true,
            FormatKind::Fixed { .. } => format.width() <= 24,
            FormatKind::Normalized { .. } => matches!(format.rounding, Rounding::NearestEven | Rounding::NearestAway),
        };
        if let NodeKind::Convert(origin, Arith::Single, number) = self.graph.kind(a)
            && from == Arith::Single
            && (origin == to || (origin, to) == (Arith::Main, Arith::Wrapped))
            && returns(self.formats.format(origin))
            // Single precision preserves neither the subnormals nor every NaN of a card's words.
            && !self.graph.is_card(origin)
        {
            return number;
        }
        self.graph.node(NodeKind::Convert(from, to, a))
    }

    /// Operands of a product.
    fn factors(&mut self, k: Arith, a: NodeId, b: NodeId) -> (NodeId, NodeId) {
        if !self.legacy_zero || k == Arith::Single || self.graph.is_card(k) {
            return (a, b);
        }
        (self.binary(k, Op::Factor, a, b), self.binary(k, Op::Factor, b, a))
    }

    fn sums(&self, k: Arith) -> SumRules {
        let format = self.formats.format(k);
        if self.is_pixel && k != Arith::Single { self.rules.sums_in(format) } else { SumRules::plain(format) }
    }

    /// The format in which products are rounded.
    fn products(&self, k: Arith) -> Arith {
        let products = self.sums(k).products;
        if products == self.formats.format(k) { k } else { self.formats.arith_of(products) }
    }

    /// The sum computed by one adder.
    fn aligned(&mut self, k: Arith, bits: u8, addends: &[NodeId]) -> NodeId {
        let mut all = [addends[0]; 4];
        all[..addends.len()].copy_from_slice(addends);
        let bits = bits.min(num::ops::MAX_ALIGNED_BITS);
        self.graph.node(NodeKind::Sum(k, RowSum::Aligned { terms: addends.len() as u8, bits }, all))
    }

    pub(crate) fn add(&mut self, k: Arith, a: NodeId, b: NodeId) -> NodeId {
        match self.sums(k).add {
            AddMode::Rounded => self.binary(k, Op::Add, a, b),
            AddMode::Aligned(bits) => self.aligned(k, bits, &[a, b]),
        }
    }

    pub(crate) fn sub(&mut self, k: Arith, a: NodeId, b: NodeId) -> NodeId {
        match self.sums(k).add {
            AddMode::Rounded => self.binary(k, Op::Sub, a, b),
            AddMode::Aligned(bits) => {
                let negated = self.neg(k, b);
                self.aligned(k, bits, &[a, negated])
            }
        }
    }

    pub(crate) fn mul(&mut self, k: Arith, a: NodeId, b: NodeId) -> NodeId {
        let products = self.products(k);
        let (a, b) = self.factors(products, a, b);
        self.binary(products, Op::Mul, a, b)
    }

    pub(crate) fn div(&mut self, k: Arith, a: NodeId, b: NodeId) -> NodeId {
        self.binary(k, Op::Div, a, b)
    }

    pub(crate) fn neg(&mut self, k: Arith, a: NodeId) -> NodeId {
        self.unary(k, Op::Neg, a)
    }

    /// Multiply-add with product and sum rounded separately.
    fn mul_add(&mut self, k: Arith, a: NodeId, b: NodeId, c: NodeId) -> NodeId {
        if self.products(k) != k {
            let product = self.mul(k, a, b);
            return self.binary(k, Op::Add, product, c);
        }
        let (a, b) = self.factors(k, a, b);
        self.compute(k, Op::Mad, a, b, c)
    }

    /// Multiply-add under the rules, or by a card's unit.
    pub(crate) fn mad(&mut self, k: Arith, a: NodeId, b: NodeId, c: NodeId) -> NodeId {
        if self.graph.is_card(k) {
            return self.compute(k, Op::Mad, a, b, c);
        }
        let SumRules { mad, add, .. } = self.sums(k);
        match mad {
            MadMode::TwoRoundings if add == AddMode::Rounded => self.mul_add(k, a, b, c),
            MadMode::TwoRoundings => {
                let product = self.mul(k, a, b);
                self.add(k, product, c)
            }
            MadMode::ProductCut => {
                let (a, b) = self.factors(k, a, b);
                self.graph.node(NodeKind::Sum(k, RowSum::ProductCut, [a, b, c, c]))
            }
            MadMode::Fused => {
                let (a, b) = self.factors(k, a, b);
                self.compute(k, Op::FusedMad, a, b, c)
            }
        }
    }

    /// Rounds a number of format `from` to a storage's format, if it has one, and converts it back.
    pub(crate) fn stored(&mut self, from: Arith, storage: Option<Format>, x: NodeId) -> NodeId {
        let Some(storage) = storage else { return x };
        let storage = self.formats.arith_of(storage);
        let narrowed = self.convert(from, storage, x);
        self.convert(storage, from, narrowed)
    }

    /// Dot product of the first `terms` components, 1 to 4.
    pub(crate) fn dot(&mut self, k: Arith, terms: usize, a: &[NodeId], b: &[NodeId]) -> NodeId {
        if let Some(accumulator) = self.accumulator(k) {
            return self.accumulated(k, accumulator, terms, (a, b));
        }
        let order = if self.graph.is_card(k) { DotOrder::Exact } else { self.sums(k).dot };
        match order {
            DotOrder::Sequential => {
                let mut sum = self.mul(k, a[0], b[0]);
                for i in 1..terms {
                    sum = self.mul_add(k, a[i], b[i], sum);
                }
                sum
            }
            DotOrder::Tree => {
                let products = (0..terms).map(|i| self.mul(k, a[i], b[i])).collect();
                self.tree(k, products)
            }
            DotOrder::Aligned(bits) => {
                let products: Vec<NodeId> = (0..terms).map(|i| self.mul(k, a[i], b[i])).collect();
                self.aligned(k, bits, &products)
            }
            DotOrder::Exact => {
                let zero = self.zero();
                let (mut left, mut right) = ([zero; 4], [zero; 4]);
                for i in 0..terms {
                    (left[i], right[i]) = self.factors(k, a[i], b[i]);
                }
                self.graph.node(NodeKind::Dot(k, terms as u8, left, right))
            }
        }
    }

    /// Sums neighbours in pairs, then the sums in pairs, and so on.
    fn tree(&mut self, k: Arith, mut level: Vec<NodeId>) -> NodeId {
        while level.len() > 1 {
            let pair = |p: &[NodeId]| if p.len() == 2 { self.binary(k, Op::Add, p[0], p[1]) } else { p[0] };
            level = level.chunks(2).map(pair).collect();
        }
        level[0]
    }

    /// The accumulator of dot products of pixel arithmetic in a format.
    fn accumulator(&self, k: Arith) -> Option<Format> {
        let has_one = self.is_pixel && k != Arith::Single;
        self.rules.accumulator_of(self.formats.format(k)).filter(|_| has_one)
    }

    /// Dot product with sums in an accumulator. If the accumulator cannot represent all operands, products are first
    /// rounded to odd ([`PRODUCTS`]), so that the second rounding equals a rounding of the exact product.
    fn accumulated(&mut self, k: Arith, accumulator: Format, terms: usize, (a, b): (&[NodeId], &[NodeId])) -> NodeId {
        let to = self.formats.arith_of(accumulator);
        let rounded_in = self.products(to);
        let holds = accumulator.holds(self.formats.format(k));
        let products = if holds { to } else { self.formats.arith_of(PRODUCTS) };
        let zero = self.zero();
        let (mut left, mut right) = ([zero; 4], [zero; 4]);
        for i in 0..terms {
            let (x, y) = self.factors(k, a[i], b[i]);
            (left[i], right[i]) = (self.convert(k, products, x), self.convert(k, products, y));
        }
        let order = self.sums(to).dot;
        if order == DotOrder::Exact {
            let sum = self.graph.node(NodeKind::Dot(products, terms as u8, left, right));
            let rounded = self.convert(products, to, sum);
            return self.convert(to, k, rounded);
        }
        let mut rounded = Vec::with_capacity(terms);
        for i in 0..terms {
            let product = self.binary(if holds { rounded_in } else { products }, Op::Mul, left[i], right[i]);
            rounded.push(if holds { product } else { self.convert(products, rounded_in, product) });
        }
        let sum = match order {
            DotOrder::Tree => self.tree(to, rounded),
            DotOrder::Aligned(bits) => self.aligned(to, bits, &rounded),
            _ => {
                let first = rounded[0];
                rounded.into_iter().skip(1).fold(first, |sum, product| self.binary(to, Op::Add, sum, product))
            }
        };
        self.convert(to, k, sum)
    }

    pub(crate) fn lrp(&mut self, k: Arith, version: Version, [factor, a, b]: [NodeId; 3]) -> NodeId {
        match self.rules.lrp_in(version) {
            LrpMode::SubMulAdd => {
                let difference = self.sub(k, a, b);
                self.mad(k, factor, difference, b)
            }
            LrpMode::TwoProducts => {
                let first = self.mul(k, factor, a);
                let one = self.one(k);
                let rest = self.sub(k, one, factor);
                let second = self.mul(k, rest, b);
                self.add(k, first, second)
            }
        }
    }

    /// `_SAT` of OpenGL's programs, which keeps a NaN.
    pub(crate) fn saturate_number(&mut self, k: Arith, x: NodeId) -> NodeId {
        let (zero, clamped) = (self.zero(), self.unary(k, Op::Saturate, x));
        if self.formats.format(k).specials == Specials::Nv {
            return clamped;
        }
        let (above, rest) = (self.holds(k, Op::Less, zero, x), self.holds(k, Op::LessEqual, x, zero));
        let otherwise = self.select(rest, clamped, x);
        self.select(above, clamped, otherwise)
    }

    /// `condition ? a : b`, where `condition` is a mask.
    pub(crate) fn select(&mut self, condition: NodeId, a: NodeId, b: NodeId) -> NodeId {
        self.compute(Arith::Single, Op::Select, condition, a, b)
    }

    /// Mask of a comparison of two operands in format `k`.
    pub(crate) fn holds(&mut self, k: Arith, code: Op, a: NodeId, b: NodeId) -> NodeId {
        self.binary(k, code, a, b)
    }

    /// Applies a source modifier to a component.
    pub(crate) fn modified(&mut self, k: Arith, modifier: crate::isa::Modifier, x: NodeId) -> NodeId {
        use crate::isa::Modifier as M;
        let biased = |maker: &mut Self| {
            let half = maker.half(k);
            maker.sub(k, x, half)
        };
        match modifier {
            M::None | M::Dz | M::Dw | M::Not => x,
            M::Negate => self.neg(k, x),
            M::Absolute => self.unary(k, Op::Abs, x),
            M::AbsoluteNegate => {
                let magnitude = self.unary(k, Op::Abs, x);
                self.neg(k, magnitude)
            }
            M::Invert => {
                let one = self.one(k);
                self.sub(k, one, x)
            }
            M::Bias => biased(self),
            M::BiasNegate => {
                let b = biased(self);
                self.neg(k, b)
            }
            M::Bx2 => {
                let b = biased(self);
                self.scale(k, b, 1)
            }
            M::Bx2Negate => {
                let b = biased(self);
                let doubled = self.scale(k, b, 1);
                self.neg(k, doubled)
            }
            M::X2 => self.scale(k, x, 1),
            M::X2Negate => {
                let doubled = self.scale(k, x, 1);
                self.neg(k, doubled)
            }
        }
    }
}
