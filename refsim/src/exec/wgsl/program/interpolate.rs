//! Interpolation as microcode, so that its arithmetic is compiled once for interpolation and program.

use super::assembler::{Assembler, INPUT, NONE, SETUP};
use super::operations as op;
use crate::exec::wgsl::number::source_word;
use crate::num::{Format, NumberOperation};
use crate::raster::POSITION_COMPONENT;

/// Indices of formats in the draw.
const SINGLE: u32 = 2;
const ITERATOR: u32 = 4;
/// Offsets in a set-up, in words.
const AREA: u16 = 21;
const FLAGS: u16 = 26;
const RECIPROCAL_W: u16 = 27;
const DEPTH: u16 = 30;
const CONSTANT: u16 = 33;
/// Offset of the planes of components, three words each.
pub(crate) const PLANES: u16 = 35;
/// Bits of the flags: no perspective; constant depth; all components constant.
const IS_AFFINE: u32 = 0;
const DEPTH_IS_CONSTANT: u32 = 1;
const ALL_IS_CONSTANT: u32 = 2;
/// Rows of the edge functions of corners 1 and 2, after the components.
const EDGES: [u16; 2] = [INPUT + 45, INPUT + 46];

/// Components to be interpolated for a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interpolation {
    /// The components, in the order of their planes in a set-up.
    pub components: Vec<usize>,
    /// The iterator format.
    pub iterator: Format,
}

impl Interpolation {
    /// The component 1 / w, which is linear in screen space; it follows the other components of the window position.
    pub(crate) const RECIPROCAL: usize = POSITION_COMPONENT + 3;
}

impl Assembler<'_> {
    /// Emits interpolation with the operations of [`crate::raster`].
    pub(super) fn interpolate(&mut self, interpolation: &Interpolation) {
        let single = interpolation.iterator == Format::FP32;
        let iterator = if single { SINGLE } else { ITERATOR };
        self.parts.add_if(!single, "HAS_FORMATS");
        self.parts.add_format(&interpolation.iterator);
        let linear = self.registers();
        let perspective = self.registers();
        let weights = if single { perspective } else { self.registers() };
        let scratch = self.registers();

        let constant = self.unless(FLAGS, ALL_IS_CONSTANT);
        for (to, edge) in linear.into_iter().zip(EDGES) {
            self.number(NumberOperation::Div, SINGLE, to, [edge, SETUP + AREA]);
        }
        for (to, from) in perspective.into_iter().zip(linear) {
            self.copy(to, from);
        }
        let affine = self.unless(FLAGS, IS_AFFINE);
        self.perspective(linear, perspective, scratch[0]);
        self.land(affine);
        if !single {
            let source = self.constant(source_word(&Format::FP32));
            for (to, from) in weights.into_iter().zip(perspective) {
                self.number(NumberOperation::Convert, ITERATOR, to, [from, source]);
            }
        }
        self.land(constant);

        let depth = INPUT + POSITION_COMPONENT as u16 + 2;
        self.copy(depth, SETUP + DEPTH);
        let constant = self.unless(FLAGS, DEPTH_IS_CONSTANT);
        self.along(depth, DEPTH, linear, SINGLE, scratch);
        self.land(constant);
        for (plane, &component) in (0..).map(|i| PLANES + 3 * i).zip(&interpolation.components) {
            let to = INPUT + component as u16;
            self.copy(to, SETUP + plane);
            let constant = self.unless(CONSTANT + component as u16 / 32, component as u32 % 32);
            if component == Interpolation::RECIPROCAL {
                self.along(to, plane, linear, SINGLE, scratch);
            } else {
                self.along(to, plane, weights, iterator, scratch);
                if !single {
                    let source = self.constant(source_word(&interpolation.iterator));
                    self.number(NumberOperation::Convert, SINGLE, to, [to, source]);
                }
            }
            self.land(constant);
        }
    }

    /// Emits perspective-correct weights from screen-space weights.
    fn perspective(&mut self, [l1, l2]: [u16; 2], [p1, p2]: [u16; 2], sum: u16) {
        let one = self.constant(Format::FP32.one());
        let [w0, w1, w2] = [0, 1, 2].map(|corner| SETUP + RECIPROCAL_W + corner);
        for (operation, to, operands) in [
            (NumberOperation::Sub, sum, [one, l1]),
            (NumberOperation::Sub, sum, [sum, l2]),
            (NumberOperation::Mul, sum, [sum, w0]),
            (NumberOperation::Mul, p1, [l1, w1]),
            (NumberOperation::Mul, p2, [l2, w2]),
            (NumberOperation::Add, sum, [sum, p1]),
            (NumberOperation::Add, sum, [sum, p2]),
            (NumberOperation::Div, p1, [p1, sum]),
            (NumberOperation::Div, p2, [p2, sum]),
        ] {
            self.number(operation, SINGLE, to, operands);
        }
    }

    /// `(base + l1 * d1) + l2 * d2`
    fn along(&mut self, to: u16, plane: u16, [l1, l2]: [u16; 2], format: u32, [a, b]: [u16; 2]) {
        let [base, d1, d2] = [0, 1, 2].map(|word| SETUP + plane + word);
        self.number(NumberOperation::Mul, format, a, [l1, d1]);
        self.number(NumberOperation::Add, format, a, [base, a]);
        self.number(NumberOperation::Mul, format, b, [l2, d2]);
        self.number(NumberOperation::Add, format, to, [a, b]);
    }

    fn number(&mut self, operation: NumberOperation, format: u32, to: u16, [a, b]: [u16; 2]) {
        self.parts.add_operation(operation);
        self.emit(op::ALU, format << 24 | operation.word() << 16, to, [a, b, a]);
    }

    fn copy(&mut self, to: u16, from: u16) {
        self.emit(op::COPY, 0, to, [from; 3]);
    }

    /// Emits a jump that is taken if a bit of a set-up word is 1; its target is set by `land`.
    fn unless(&mut self, word: u16, bit: u32) -> usize {
        self.push(op::UNLESS, bit << 8 | u32::from(word) << 16);
        self.words.push(NONE.into());
        self.words.len() - 1
    }

    fn land(&mut self, from: usize) {
        self.words[from] = self.words.len() as u32;
    }

    fn registers(&mut self) -> [u16; 2] {
        self.next += 2;
        [self.next - 2, self.next - 1].map(|slot| slot as u16)
    }
}
