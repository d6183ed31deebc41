//! Programs without flow control written out as WGSL: a statement a value.

use super::lower::{Body, Lowered, Sink, Use};
use crate::exec::lower::{Arith, Detail, NodeId, NodeKind};
use crate::exec::wgsl::number::{NativeOperations, NumberMode, format_words, source_word};
use crate::num::{Format, NumberOperation};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A program written out as WGSL.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unrolled {
    /// `fn shade()` and what it needs besides the module's other parts.
    pub text: String,
    /// What the binding `code` holds from `q_code` on: constants, so that programs that differ in them alone have one text.
    pub words: Vec<u32>,
    /// Places where the text calls integer arithmetic.
    pub soft_calls: usize,
    /// Places where it reads textures.
    pub reads: usize,
}

/// The text of a straight program; `None` with flow control.
pub(super) fn unroll(program: &Lowered, mode: NumberMode, native: NativeOperations) -> Option<Unrolled> {
    let Body::Straight { sinks, fetches, cost } = &program.body else { return None };
    let native = if mode == NumberMode::Native { native } else { NativeOperations::empty() };
    // The first word stays zero.
    let mut writer = Writer { program, native, text: String::new(), words: vec![0], soft_calls: 0, reads: 0 };
    let live = program.graph.live(sinks.iter().flat_map(|s| s.nodes.iter().copied()));
    let needed: Vec<NodeId> = (0u32..).zip(&live).filter(|&(_, &live)| live).map(|(i, _)| NodeId(i)).collect();
    for &node in &needed {
        if let NodeKind::Constant(raw) = program.graph.kind(node) {
            let _ = writeln!(writer.text, "    let v{} = p_constant({}u);", node.0, writer.words.len());
            writer.words.push(raw);
        }
    }
    let table = writer.words.len();
    writer.words.extend(program.table.iter().flatten());
    for &node in &needed {
        writer.node(node, table);
    }
    for sink in sinks {
        writer.sink(sink);
    }
    let mut counts: BTreeMap<usize, u32> = BTreeMap::new();
    for &sampler in fetches {
        *counts.entry(sampler).or_default() += 1;
    }
    for (sampler, count) in counts {
        let _ = writeln!(writer.text, "    q_fetched[{sampler}] += {count}u * covered;");
    }
    let mut text = String::from(include_str!("rows.wgsl"));
    for k in [Arith::Main, Arith::Partial, Arith::Single, Arith::Wrapped, Arith::Half, Arith::Fixed] {
        let words = format_words(&program.formats.format(k)).map(|w| format!("{w}u")).join(", ");
        let _ = writeln!(text, "const {}: Format = Format({words});", name(k));
    }
    text.push_str(
        "\nfn shade() {\n    p_zeros = vec4<u32>(code[q_code]);\n    q_color = array<array<vec4<u32>, 4>, 4>();\n    q_killed = vec4<bool>(false);\n",
    );
    text.push_str("    q_depth_is_main = vec4<bool>(false);\n");
    text.push_str("    let covered = dot(select(vec4<u32>(0u), vec4<u32>(1u), q_covered), vec4<u32>(1u));\n");
    let _ = writeln!(text, "    q_executed = {cost}u * covered;");
    text.push_str(&writer.text);
    text.push_str("}\n");
    Some(Unrolled { text, words: writer.words, soft_calls: writer.soft_calls, reads: writer.reads })
}

struct Writer<'p> {
    program: &'p Lowered,
    native: NativeOperations,
    text: String,
    words: Vec<u32>,
    soft_calls: usize,
    reads: usize,
}

fn name(k: Arith) -> &'static str {
    match k {
        Arith::Main => "P_MAIN",
        Arith::Partial => "P_PARTIAL",
        Arith::Single => "P_SINGLE",
        Arith::Wrapped => "P_WRAPPED",
        Arith::Half => "P_HALF",
        Arith::Fixed => "P_FIXED",
    }
}

fn v(node: NodeId) -> String {
    format!("v{}", node.0)
}

impl Writer<'_> {
    /// Whether values of this format are the device's own floats.
    fn is_native(&self, k: Arith) -> bool {
        !self.native.is_empty() && self.program.formats.format(k) == Format::FP32
    }

    fn soft(&mut self, operation: NumberOperation, k: Arith, args: [&str; 3]) -> String {
        self.soft_calls += 1;
        format!("p_alu({}, {}, {})", operation.constant(), name(k), args.join(", "))
    }

    fn node(&mut self, node: NodeId, table: usize) {
        let value = match self.program.graph.kind(node) {
            NodeKind::Constant(_) | NodeKind::Held(_) => return,
            NodeKind::Circle(k, sine, a) => {
                let operation = if sine { NumberOperation::Sin } else { NumberOperation::Cos };
                self.soft(operation, k, [&v(a), &v(a), &v(a)])
            }
            NodeKind::Input(component) => format!("q_input[{component}]"),
            NodeKind::Texel(fetch, component) => format!("t{}[{component}]", fetch.0),
            NodeKind::Compute(k, code, args) => self.compute(k, code, args),
            NodeKind::Difference(k, down, a) => self.difference(k, down, &v(a)),
            NodeKind::Dot(k, terms, a, b) => {
                self.soft_calls += 1;
                let [a, b] = [a, b].map(|x| {
                    let rows =
                        (0..4).map(|i| if i < usize::from(terms) { v(x[i]) } else { "vec4<u32>(0u)".to_owned() });
                    format!("array<vec4<u32>, 4>({})", rows.collect::<Vec<_>>().join(", "))
                });
                format!("p_dot({}, {terms}u, {a}, {b})", name(k))
            }
            NodeKind::Convert(from, into, a) => {
                let source = format!("vec4<u32>({}u)", source_word(&self.program.formats.format(from)));
                self.soft(NumberOperation::Convert, into, [&v(a), &source, &source])
            }
            NodeKind::Steps(steps, a) => {
                let steps = format!("vec4<u32>({steps}u)");
                self.soft(NumberOperation::Steps, Arith::Main, [&v(a), &steps, &steps])
            }
            NodeKind::Relative(base, component, a) => {
                let count = self.program.table.len();
                format!("p_relative({table}u, {count}, {base}, {component}u, {})", v(a))
            }
            NodeKind::Fetch(sampler, coordinates, detail) => {
                let call = self.fetch(sampler, coordinates, detail);
                let _ = writeln!(self.text, "    let t{} = {call};", node.0);
                return;
            }
        };
        let _ = writeln!(self.text, "    let v{} = {value};", node.0);
    }

    fn fetch(&mut self, sampler: u8, coordinates: [NodeId; 4], detail: Detail) -> String {
        self.reads += 1;
        let zero = "vec4<u32>(0u)".to_owned();
        let (number, bias, gradients) = match detail {
            Detail::Implicit => (0, zero, String::new()),
            Detail::Biased(bias) => (1, v(bias), String::new()),
            Detail::Gradients(x, y) => (2, zero, x.iter().chain(&y).map(|&n| v(n)).collect::<Vec<_>>().join(", ")),
        };
        let coordinates = coordinates.map(v).join(", ");
        format!("texture_read({sampler}u, {coordinates}, {number}u, {bias}, array<vec4<u32>, 8>({gradients}), q_run)")
    }

    fn compute(&mut self, k: Arith, code: NumberOperation, args: [NodeId; 3]) -> String {
        let [a, b, c] = args.map(v);
        match code {
            NumberOperation::And => return format!("{a} & {b}"),
            NumberOperation::Or => return format!("{a} | {b}"),
            NumberOperation::AndNot => return format!("{b} & ~{a}"),
            NumberOperation::Select => return format!("p_select({a}, {b}, {c})"),
            _ => {}
        }
        if let Some(native) = self.own(k, code, args) {
            return native;
        }
        let args = [&a, &b, &c];
        self.soft(code, k, std::array::from_fn(|i| if i < code.operands() { args[i].as_str() } else { &a }))
    }

    fn difference(&mut self, k: Arith, down: bool, a: &str) -> String {
        let [upper, lower] = if down { [".xyxy", ".zwzw"] } else { [".xxzz", ".yyww"] }.map(|of| format!("{a}{of}"));
        if self.is_native(k) && self.native.contains(NativeOperations::ADD) {
            return format!("p_sub({lower}, {upper})");
        }
        self.soft(NumberOperation::Sub, k, [&lower, &upper, a])
    }

    /// An operation in the device's own single precision, if it is exact there.
    fn own(&self, k: Arith, code: NumberOperation, args: [NodeId; 3]) -> Option<String> {
        let [a, b, c] = args.map(v);
        if !self.is_native(k) {
            return None;
        }
        let has = |flags: NativeOperations| self.native.contains(flags);
        let (add, multiply) = (has(NativeOperations::ADD), has(NativeOperations::MUL));
        let floor = has(NativeOperations::FLOOR);
        Some(match code {
            NumberOperation::Add if add => format!("p_add({a}, {b})"),
            NumberOperation::Sub if add => format!("p_sub({a}, {b})"),
            NumberOperation::Mul if multiply => format!("p_mul({a}, {b})"),
            NumberOperation::Mad if add && multiply => format!("p_add(p_mul({a}, {b}), {c})"),
            NumberOperation::Div if has(NativeOperations::DIV) => format!("p_div({a}, {b})"),
            NumberOperation::Rcp if has(NativeOperations::DIV) => format!("p_div(vec4<u32>(0x3f800000u), {a})"),
            NumberOperation::Floor if floor => format!("p_floor({a})"),
            NumberOperation::Frc if floor && add => format!("p_sub({a}, p_floor({a}))"),
            NumberOperation::Scale if multiply => match self.program.graph.kind(args[1]) {
                NodeKind::Constant(power) => format!("p_mul({a}, vec4<u32>({}u))", (127 + power.cast_signed()) << 23),
                _ => return None,
            },
            NumberOperation::Min => format!("p_min({a}, {b})"),
            NumberOperation::Max => format!("p_max({a}, {b})"),
            NumberOperation::Neg => format!("p_neg({a})"),
            NumberOperation::Abs => format!("p_abs({a})"),
            NumberOperation::Saturate => format!("p_saturate({a})"),
            NumberOperation::Factor => format!("p_factor({a}, {b})"),
            NumberOperation::SelectNonNegative => format!("p_non_negative({a}, {b}, {c})"),
            NumberOperation::SelectAboveHalf => format!("p_above_half({a}, {b}, {c})"),
            NumberOperation::Less => format!("p_less({a}, {b})"),
            NumberOperation::LessEqual => format!("p_less_equal({a}, {b})"),
            NumberOperation::Equal => format!("p_equal({a}, {b})"),
            _ => return None,
        })
    }

    /// A value on its way out, with the one NaN.
    fn clean(&self, k: Arith, node: NodeId) -> String {
        if self.is_native(k) { format!("p_clean({})", v(node)) } else { v(node) }
    }

    fn sink(&mut self, sink: &Sink) {
        let Some(&node) = sink.nodes.first() else { return };
        let _ = match sink.what {
            Use::Color(target, c) => {
                writeln!(self.text, "    q_color[{target}][{c}] = {};", self.clean(Arith::Main, node))
            }
            Use::Killed => writeln!(self.text, "    q_killed = {} != vec4<u32>(0u);", v(node)),
            Use::Depth(k) => {
                let is_main = k == Arith::Main;
                let value = self.clean(k, node);
                writeln!(self.text, "    q_depth = {value};\n    q_depth_is_main = vec4<bool>({is_main});")
            }
            Use::Output(word) => writeln!(self.text, "    output_put({word}u, {});", self.clean(Arith::Single, node)),
            // Programs that are followed run on the machine; the others belong to flow control.
            Use::Trace(..) | Use::Merge(_) | Use::Move(_) | Use::Condition => Ok(()),
        };
    }
}
