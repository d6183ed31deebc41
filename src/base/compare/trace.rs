//! First difference of two traces of one pixel.

use refsim::{
    exec::Step,
    isa::{Mask, Opcode, Register, RegisterFile},
    machine::{FragmentTrace, PixelState},
    num::Format,
    output::{DepthFormat, FragmentFate},
    raster::Vertex,
    texture::TexelFormat,
};

use super::{
    number::{Compared, Number},
    operands::{Operand, operands},
    side::{TraceSide, component},
    surface::{compared_depths, differing_channels},
};

/// Formats of the render targets, equal on both sides.
#[derive(Clone, Copy, Debug)]
pub struct TargetFormats<'a> {
    /// Color targets.
    pub targets: &'a [TexelFormat],
    /// Depth buffer.
    pub depth: Option<DepthFormat>,
}

/// Identifies a fragment at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FragmentPass {
    /// Index of the fragment at the pixel, from 0.
    pub index: usize,
    /// Instance, from 0.
    pub instance: usize,
    /// Triangle within the instance, from 0.
    pub triangle: usize,
    /// Part of the clipped triangle, from 0.
    pub part: usize,
}

/// The stage of the pipeline at which the traces of a fragment first differ.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "left and right are the sides that are compared")]
pub enum TraceStage {
    /// Output of the vertex stage for a corner of the triangle, 0 to 2. [`first_difference`] ignores corners;
    /// [`differing_corner`] compares them.
    Vertex { corner: usize },
    /// The triangle covers the pixel on only one side, or the order differs, because of the vertex stage or triangle
    /// set-up. Gives the fragment of each side.
    Coverage { left: Option<FragmentPass>, right: Option<FragmentPass> },
    /// Interpolated values of the rasteriser.
    Input,
    /// An input register: the interpolated value converted to the register format.
    Delivered,
    /// Result of an instruction, by its index in the program.
    Instruction { index: usize },
    /// Write mask of an instruction: its predicate.
    Mask { index: usize, left: Mask, right: Mask },
    /// A branch: the index of the next instruction, `None` at the end of the program.
    Flow { left: Option<usize>, right: Option<usize> },
    /// Output of the program that is in no register: kill, depth, clamped color. `instruction` is the cause, if only
    /// one instruction is possible.
    Output { instruction: Option<usize> },
    /// Result of the alpha test or the depth test.
    Test { left: FragmentFate, right: FragmentFate },
    /// Stored value. The cause is quantisation, blending or masking, or the executor's trace differs from its draw.
    Merge,
}

/// The first difference of two traces.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceDifference {
    /// Fragment at which the traces differ.
    pub pass: FragmentPass,
    /// Number of fragments at the pixel, on the left and on the right.
    pub passes: [usize; 2],
    /// Stage at which they differ.
    pub stage: TraceStage,
    /// Values that differ at the stage, in the order of components.
    pub values: Vec<Compared>,
    /// Operands of the instruction, if [`Self::stage`] is an instruction.
    pub operands: Vec<Operand>,
    /// The fragment's first instruction that writes a different value, if `stage` is before all instructions.
    pub instruction: Option<Box<TraceDifference>>,
}

fn pass(index: usize, fragment: &FragmentTrace) -> FragmentPass {
    FragmentPass { index, instance: fragment.instance, triangle: fragment.triangle, part: fragment.part }
}

/// Finds the first difference between two traces of one pixel: the first differing pass, its first differing stage, and
/// the first step in it. `None` if the traces are equal. Arithmetic flags are not compared: a GPU has none.
pub fn first_difference(
    left: &TraceSide<'_>,
    right: &TraceSide<'_>,
    shape: &TargetFormats<'_>,
) -> Option<TraceDifference> {
    let count = left.fragments.len().max(right.fragments.len());
    (0..count).find_map(|index| {
        let sides = (left.fragments.get(index), right.fragments.get(index));
        let places = (sides.0.map(|f| pass(index, f)), sides.1.map(|f| pass(index, f)));
        let passes = [left.fragments.len(), right.fragments.len()];
        let found = |stage, values| TraceDifference {
            pass: places.0.or(places.1).unwrap_or(FragmentPass { index, instance: 0, triangle: 0, part: 0 }),
            passes,
            stage,
            values,
            operands: Vec::new(),
            instruction: None,
        };
        let (Some(a), Some(b)) = sides else {
            return Some(found(TraceStage::Coverage { left: places.0, right: places.1 }, Vec::new()));
        };
        if places.0 != places.1 {
            return Some(found(TraceStage::Coverage { left: places.0, right: places.1 }, Vec::new()));
        }
        let pair = Pair { left, right, a, b };
        let in_steps =
            || pair.steps().map(|(stage, values, operands)| TraceDifference { operands, ..found(stage, values) });
        if let Some((stage, values)) = pair.inputs() {
            return Some(TraceDifference { instruction: in_steps().map(Box::new), ..found(stage, values) });
        }
        in_steps().or_else(|| {
            let (stage, values) = pair.outputs().or_else(|| pair.stored(shape))?;
            Some(found(stage, values))
        })
    })
}

/// Returns the first corner of a triangle that differs, and the differing values.
pub fn differing_corner(left: &[Vertex; 3], right: &[Vertex; 3]) -> Option<(usize, Vec<Compared>)> {
    let differing = |a: &Vertex, b: &Vertex| {
        let vectors = |v: &Vertex| {
            let colors = (0..2).map(|n| (format!("oD{n}"), v.colors[n]));
            let sets = (0..8).map(|n| (format!("oT{n}"), v.texcoords[n]));
            let vectors = [("oPos".to_owned(), v.position)].into_iter().chain(colors).chain(sets);
            let mut components: Vec<(String, u32)> = vectors
                .flat_map(|(name, vector)| {
                    ['x', 'y', 'z', 'w'].into_iter().zip(vector).map(move |(c, bits)| (format!("{name}.{c}"), bits))
                })
                .collect();
            components.push(("oFog".to_owned(), v.fog));
            components
        };
        unequal(vectors(a).into_iter().zip(vectors(b)).map(|((name, a), (_, b))| (name, single(a), single(b))))
    };
    left.iter().zip(right).enumerate().find_map(|(corner, (a, b))| {
        let values: Vec<Compared> = differing(a, b);
        (!values.is_empty()).then_some((corner, values))
    })
}

fn single(bits: u32) -> Number {
    Number { format: Format::FP32, bits }
}

/// The named pairs of numbers that are not equal.
fn unequal(pairs: impl Iterator<Item = (String, Number, Number)>) -> Vec<Compared> {
    pairs.filter(|(_, a, b)| !a.equals(b)).map(|(name, a, b)| Compared::registers(name, &a, &b)).collect()
}

struct Pair<'a> {
    left: &'a TraceSide<'a>,
    right: &'a TraceSide<'a>,
    a: &'a FragmentTrace,
    b: &'a FragmentTrace,
}

impl Pair<'_> {
    fn registers(&self, name: impl Fn(usize) -> String, a: [u32; 4], b: [u32; 4], mask: Mask) -> Vec<Compared> {
        let [left, right] = [self.left, self.right].map(|side| move |bits| Number { format: side.format, bits });
        unequal(mask.components().map(|c| (name(c), left(a[c]), right(b[c]))))
    }

    fn inputs(&self) -> Option<(TraceStage, Vec<Compared>)> {
        let (a, b) = (&self.a.shading.input, &self.b.shading.input);
        let vectors = a.t.iter().zip(&b.t).enumerate().map(|(n, v)| (RegisterFile::Texture, n, v));
        let vectors = vectors.chain(a.v.iter().zip(&b.v).enumerate().map(|(n, v)| (RegisterFile::Input, n, v)));
        let vectors = vectors.chain([(RegisterFile::WindowPosition, 0, (&a.position, &b.position))]);
        let program = self.left.program;
        let pairs = vectors
            .flat_map(|(file, n, (a, b))| {
                let register = Register::new(file, n as u16);
                (0..4).map(move |c| (component(program, &register, c), single(a[c]), single(b[c])))
            })
            .chain([("fog".to_owned(), single(a.fog), single(b.fog))])
            .chain([("depth".to_owned(), single(a.depth), single(b.depth))]);
        let mut values = unequal(pairs);
        if !values.is_empty() {
            return Some((TraceStage::Input, values));
        }
        for ((register, a), (_, b)) in self.a.shading.delivered.iter().zip(&self.b.shading.delivered) {
            values.extend(self.registers(|c| component(self.left.program, register, c), *a, *b, Mask::ALL));
        }
        (!values.is_empty()).then_some((TraceStage::Delivered, values))
    }

    fn steps(&self) -> Option<(TraceStage, Vec<Compared>, Vec<Operand>)> {
        let (a, b) = (&self.a.shading.steps, &self.b.shading.steps);
        (0..a.len().max(b.len())).find_map(|k| {
            let (x, y) = match (a.get(k), b.get(k)) {
                (Some(x), Some(y)) if x.instruction == y.instruction => (x, y),
                (x, y) => {
                    let [left, right] = [x, y].map(|step| step.map(|step| step.instruction));
                    return Some((TraceStage::Flow { left, right }, Vec::new(), Vec::new()));
                }
            };
            let index = x.instruction;
            if x.mask != y.mask {
                return Some((TraceStage::Mask { index, left: x.mask, right: y.mask }, Vec::new(), Vec::new()));
            }
            let values = self.written(x, y);
            let read = || operands((self.left, self.a), (self.right, self.b), k);
            (!values.is_empty()).then(|| (TraceStage::Instruction { index }, values, read()))
        })
    }

    fn written(&self, x: &Step, y: &Step) -> Vec<Compared> {
        let Some(destination) = self.left.program.instructions.get(x.instruction).and_then(|i| i.destination) else {
            return Vec::new();
        };
        let register = &destination.register;
        if register.file == RegisterFile::Predicate {
            let differing = x.mask.components().filter(|&c| x.value[c] != y.value[c]);
            return differing
                .map(|c| Compared::truths(component(self.left.program, register, c), x.value[c] != 0, y.value[c] != 0))
                .collect();
        }
        self.registers(|c| component(self.left.program, register, c), x.value, y.value, x.mask)
    }

    fn outputs(&self) -> Option<(TraceStage, Vec<Compared>)> {
        let (a, b) = (&self.a.shading.output, &self.b.shading.output);
        if a.killed != b.killed {
            let instruction = self.only(&[Opcode::TexKill]);
            return Some((TraceStage::Output { instruction }, vec![Compared::truths("killed", a.killed, b.killed)]));
        }
        let depths = [a.depth, b.depth].map(|d| d.map(|d| Number { format: d.format, bits: d.bits }));
        match depths {
            [Some(x), Some(y)] if !x.equals(&y) => {
                let instruction = self.only(&[Opcode::TexDepth, Opcode::TexM3x2Depth]);
                return Some((TraceStage::Output { instruction }, vec![Compared::registers("depth", &x, &y)]));
            }
            [Some(_), None] | [None, Some(_)] => {
                let has = depths.map(|d| d.is_some());
                let values = vec![Compared::truths("decides its depth", has[0], has[1])];
                return Some((TraceStage::Output { instruction: None }, values));
            }
            _ => {}
        }
        let colors = a.colors.iter().zip(&b.colors).enumerate();
        let values: Vec<Compared> = colors
            .flat_map(|(n, (a, b))| {
                let register = Register::new(RegisterFile::ColorOut, n as u16);
                self.registers(|c| component(self.left.program, &register, c), *a, *b, Mask::ALL)
            })
            .collect();
        (!values.is_empty()).then_some((TraceStage::Output { instruction: None }, values))
    }

    /// Returns the executed instruction with one of these opcodes; `None` unless there is exactly one.
    fn only(&self, opcodes: &[Opcode]) -> Option<usize> {
        let instructions = &self.left.program.instructions;
        let mut ran = self.a.shading.steps.iter().map(|step| step.instruction);
        let mut found = ran.by_ref().filter(|&i| instructions.get(i).is_some_and(|i| opcodes.contains(&i.opcode)));
        let first = found.next()?;
        found.all(|i| i == first).then_some(first)
    }

    fn stored(&self, shape: &TargetFormats<'_>) -> Option<(TraceStage, Vec<Compared>)> {
        let (left, right) = (self.a.shading.fate, self.b.shading.fate);
        let values = differing_states(&self.a.after, &self.b.after, shape);
        if left != right {
            return Some((TraceStage::Test { left, right }, values));
        }
        (!values.is_empty()).then_some((TraceStage::Merge, values))
    }
}

fn differing_states(a: &PixelState, b: &PixelState, shape: &TargetFormats<'_>) -> Vec<Compared> {
    let mut values = Vec::new();
    for (n, (format, (a, b))) in shape.targets.iter().zip(a.colors.iter().zip(&b.colors)).enumerate() {
        let channels = differing_channels(format.record().stored(), a.unwrap_or_default(), b.unwrap_or_default());
        values.extend(
            channels.map(|(name, channel, a, b)| Compared::channels(format!("target {n} {name}"), channel, a, b)),
        );
    }
    if let (Some(format), Some(a), Some(b)) = (shape.depth, a.depth, b.depth)
        && a != b
    {
        values.push(compared_depths("depth", format, a, b));
    }
    values
}
