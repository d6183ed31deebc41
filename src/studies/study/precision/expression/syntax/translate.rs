//! From trees of FPCore to expressions.

use std::ops::Range;
use std::sync::Arc;

use super::text::{MAX_DEPTH, Tree};
use super::{ExpressionError, numbers};
use crate::report::SourceText;
use crate::study::precision::expression::graph::{Expression, Graph, Node, NumberComparison, Operation};
use crate::study::precision::expression::real::{Constant, Function};

/// Maximum number of operations.
const MAX_NODES: usize = 20_000;

/// Unsupported operators of FPCore, with the reasons.
const REFUSED: [(&str, &str); 6] = [
    ("!", "the studied format applies to every operation, so annotations of single operations have no meaning"),
    ("while while* for for*", "loops are not supported: expressions are straight-line"),
    ("tensor tensor* array ref dim size", "tensors are not supported"),
    ("erf erfc tgamma lgamma", "the study cannot compute bounds of this function over the reals"),
    ("floor ceil trunc round nearbyint fmod remainder fdim copysign", "functions with jumps are not supported"),
    ("isfinite isinf isnan isnormal signbit INFINITY NAN", "it is not defined over the reals"),
];

/// Translates `(FPCore NAME? (ARGUMENTS) PROPERTIES... BODY)`.
pub(super) fn core(tree: &Tree, source: &Arc<SourceText>) -> Result<Expression, ExpressionError> {
    let mut items = &tree.list().unwrap_or_default()[1..];
    let fail = |message: &str, place| ExpressionError::new(source, message, place);
    let mut name = None;
    if let [Tree::Atom(symbol, _), rest @ ..] = items {
        (name, items) = (Some(symbol.clone()), rest);
    }
    let [Tree::List(arguments, _), properties @ .., body] = items else {
        return Err(fail("expected `(FPCore (ARGUMENTS) ... BODY)`", tree.place()));
    };
    let named = |argument: &Tree| match argument.atom() {
        Some(name) => Ok(name.to_owned()),
        None => {
            Err(fail("expected the name of an argument; annotations and tensors are not supported", argument.place()))
        }
    };
    let variables = arguments.iter().map(named).collect::<Result<Vec<String>, _>>()?;
    if let Some(again) = (1..variables.len()).find(|&index| variables[..index].contains(&variables[index])) {
        let message = format!("expected each argument once, found `{}` again", variables[again]);
        return Err(fail(&message, arguments[again].place()));
    }
    let (mut preconditions, mut spec) = (Vec::new(), None);
    for pair in properties.chunks(2) {
        let (Tree::Atom(key, _), Some(value)) = (&pair[0], pair.get(1)) else {
            return Err(fail("expected `:NAME VALUE`", pair[0].place()));
        };
        match key.as_str() {
            ":name" => name = value.atom().map(|name| name.trim_start_matches('"').to_owned()),
            ":pre" => preconditions.push(GraphBuilder::graph(source, &variables, value, true)?),
            ":spec" => spec = Some(GraphBuilder::graph(source, &variables, value, false)?),
            _ if key.starts_with(':') => {}
            _ => return Err(fail("expected `:NAME VALUE`", pair[0].place())),
        }
    }
    let body = GraphBuilder::graph(source, &variables, body, false)?;
    let name = name.unwrap_or_else(|| format!("line {}", source.line_of(tree.place().start) + 1));
    Ok(Expression { source: Arc::clone(source), name, variables, body, spec, preconditions })
}

/// Translates a formula; its variables are the names that it uses.
pub(in crate::study::precision::expression) fn formula(
    source: &Arc<SourceText>,
) -> Result<Expression, ExpressionError> {
    let tree = super::infix::parse(source)?;
    let mut variables = Vec::new();
    free_names(&tree, source, &mut variables)?;
    let body = GraphBuilder::graph(source, &variables, &tree, false)?;
    let name = source.text().trim().to_owned();
    Ok(Expression { source: Arc::clone(source), name, variables, body, spec: None, preconditions: Vec::new() })
}

/// Precondition that variables lie within bounds: `x=-1..1`.
pub(in crate::study::precision::expression) fn bounds(
    ranges: &[String],
    variables: &[String],
) -> Result<Option<Graph>, ExpressionError> {
    let mut nodes: Vec<Tree> = vec![Tree::Atom("and".into(), 0..0)];
    let mut bounded = Vec::new();
    for range in ranges {
        let source = Arc::new(SourceText::new("--range", range.clone()));
        let fail = |message: String| ExpressionError::new(&source, message, 0..range.len());
        let parts = range.split_once('=').and_then(|(name, ends)| Some((name.trim(), ends.split_once("..")?)));
        let Some((name, (low, high))) = parts else {
            return Err(fail(format!("expected a range as `x=-1..1`, found `{range}`")));
        };
        if !variables.iter().any(|variable| variable == name) {
            let known = variables.join(", ");
            return Err(fail(format!("expected one of the variables {known}, found `{name}`")));
        }
        if bounded.contains(&name) {
            return Err(fail(format!("expected one range of `{name}`, found another")));
        }
        bounded.push(name);
        let ends = [low.trim(), high.trim()];
        let [Some((n, d)), Some((other, by))] = ends.map(numbers::parse) else {
            return Err(fail(format!("expected two numbers, found `{low}..{high}`")));
        };
        if n * by > other * d {
            return Err(fail(format!("expected the smaller number first, found `{low}..{high}`")));
        }
        let words = ["<=", ends[0], name, ends[1]].map(|word| Tree::Atom(word.to_owned(), 0..0));
        nodes.push(Tree::List(words.to_vec(), 0..0));
    }
    let source = Arc::new(SourceText::new("--range", ranges.join(" ")));
    let all = Tree::List(nodes, 0..0);
    (!ranges.is_empty()).then(|| GraphBuilder::graph(&source, variables, &all, true)).transpose()
}

/// Adds the names of a formula that are neither numbers nor constants. A name that differs from a constant's only in
/// case is refused.
fn free_names(tree: &Tree, source: &Arc<SourceText>, names: &mut Vec<String>) -> Result<(), ExpressionError> {
    let (name, place) = match tree {
        Tree::List(items, _) => return items.iter().skip(1).try_for_each(|item| free_names(item, source, names)),
        Tree::Atom(name, place) => (name, place.clone()),
    };
    let is_constant = |name: &str| Constant::named(name).is_some() || name == "TRUE" || name == "FALSE";
    if is_constant(name) || !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
        return Ok(());
    }
    match name.to_uppercase().as_str() {
        "INF" | "INFINITY" | "NAN" => {
            Err(ExpressionError::new(source, format!("`{name}`: it is not defined over the reals"), place))
        }
        upper if is_constant(upper) => {
            let message = format!("`{name}`: write `{upper}` for the constant, or give the variable another name");
            Err(ExpressionError::new(source, message, place))
        }
        _ => {
            if !names.contains(name) {
                names.push(name.clone());
            }
            Ok(())
        }
    }
}

struct GraphBuilder<'a> {
    source: &'a Arc<SourceText>,
    nodes: Vec<Node>,
    /// Names in scope; later ones hide earlier ones.
    scope: Vec<(String, usize)>,
    depth: usize,
}

impl<'a> GraphBuilder<'a> {
    fn graph(
        source: &'a Arc<SourceText>,
        variables: &[String],
        tree: &Tree,
        is_truth: bool,
    ) -> Result<Graph, ExpressionError> {
        let mut translator = Self { source, nodes: Vec::new(), scope: Vec::new(), depth: 0 };
        for (index, name) in variables.iter().enumerate() {
            let node = translator.add(Operation::Variable(index), tree.place())?;
            translator.scope.push((name.clone(), node));
        }
        let root = translator.typed(tree, is_truth)?;
        let mut nodes = translator.nodes;
        // The result is the last node; what follows it is not used.
        nodes.truncate(root + 1);
        Ok(Graph(nodes))
    }

    fn fail<T>(&self, message: impl Into<String>, place: Range<usize>) -> Result<T, ExpressionError> {
        Err(ExpressionError::new(self.source, message, place))
    }

    fn add(&mut self, operation: Operation, place: Range<usize>) -> Result<usize, ExpressionError> {
        if self.nodes.len() == MAX_NODES {
            return self.fail(format!("expected at most {MAX_NODES} operations"), place);
        }
        let is_truth = match &operation {
            Operation::If([_, yes, _]) => self.nodes[*yes].is_truth,
            Operation::Truth(_) | Operation::Compare(..) | Operation::Connect { .. } | Operation::Not(_) => true,
            _ => false,
        };
        self.nodes.push(Node { operation, is_truth, place });
        Ok(self.nodes.len() - 1)
    }

    /// Translates a subtree that must be a number, or a truth value.
    fn typed(&mut self, tree: &Tree, is_truth: bool) -> Result<usize, ExpressionError> {
        let node = self.node(tree)?;
        match (self.nodes[node].is_truth, is_truth) {
            (true, false) => self.fail("expected a number, found a truth value", tree.place()),
            (false, true) => self.fail("expected a truth value, found a number", tree.place()),
            _ => Ok(node),
        }
    }

    fn all_typed(&mut self, trees: &[Tree], is_truth: bool) -> Result<Vec<usize>, ExpressionError> {
        trees.iter().map(|tree| self.typed(tree, is_truth)).collect()
    }

    fn node(&mut self, tree: &Tree) -> Result<usize, ExpressionError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return self.fail(format!("expected at most {MAX_DEPTH} nested operations"), tree.place());
        }
        let node = self.node_within(tree)?;
        self.depth -= 1;
        Ok(node)
    }

    fn node_within(&mut self, tree: &Tree) -> Result<usize, ExpressionError> {
        let place = tree.place();
        let items = match tree {
            Tree::Atom(name, _) => return self.atom(name, place),
            Tree::List(items, _) => items,
        };
        let Some((Tree::Atom(head, _), operands)) = items.split_first() else {
            return self.fail("expected the name of an operation", place);
        };
        match (head.as_str(), operands) {
            ("if", [condition, yes, no]) => {
                let condition = self.typed(condition, true)?;
                let chosen = self.node(yes)?;
                let other = self.typed(no, self.nodes[chosen].is_truth)?;
                self.add(Operation::If([condition, chosen, other]), place)
            }
            ("let" | "let*", [Tree::List(bindings, _), body]) => self.binding(bindings, body, head == "let*"),
            ("and" | "or", _) => {
                let operands = self.all_typed(operands, true)?;
                self.add(Operation::Connect { all: head == "and", operands }, place)
            }
            ("not", [operand]) => {
                let operand = self.typed(operand, true)?;
                self.add(Operation::Not(operand), place)
            }
            ("digits", [m, e, b]) => {
                let words = [m, e, b].map(|word| word.atom().unwrap_or_default());
                match numbers::with_base(words[0], words[1], words[2]) {
                    Some((n, d)) => self.add(Operation::Number(n, d), place),
                    None => self.fail("expected `(digits m e b)`, three integers", place),
                }
            }
            (_, [first, ..]) if let Some(comparison) = NumberComparison::named(head) => {
                self.comparison(comparison, first, operands, place)
            }
            ("+" | "-" | "*" | "/", [first, second, rest @ ..]) if !rest.is_empty() => {
                let from = first.place().start;
                let pair = Tree::List(vec![items[0].clone(), first.clone(), second.clone()], from..second.place().end);
                let mut left = self.typed(&pair, false)?;
                for operand in rest {
                    let right = self.typed(operand, false)?;
                    let function = Function::named(head, 2).unwrap_or(Function::Add);
                    left = self.add(Operation::Apply(function, vec![left, right]), place.clone())?;
                }
                Ok(left)
            }
            _ => self.call(head, operands, place),
        }
    }

    fn atom(&mut self, name: &str, place: Range<usize>) -> Result<usize, ExpressionError> {
        if let Some((_, node)) = self.scope.iter().rev().find(|(known, _)| known == name) {
            return Ok(*node);
        }
        if let Some((n, d)) = numbers::parse(name) {
            return self.add(Operation::Number(n, d), place);
        }
        match (name, Constant::named(name)) {
            (_, Some(constant)) => self.add(Operation::Constant(constant), place),
            ("TRUE" | "FALSE", _) => self.add(Operation::Truth(name == "TRUE"), place),
            _ => {
                let is_number =
                    name.trim_start_matches(['+', '-']).starts_with(|c: char| c.is_ascii_digit() || c == '.');
                let other =
                    if is_number { numbers::EXPECTED } else { "expected a number, a constant or a name in scope" };
                let reason = self.reason(name).unwrap_or(other);
                self.fail(format!("`{name}`: {reason}"), place)
            }
        }
    }

    fn reason(&self, name: &str) -> Option<&'static str> {
        REFUSED.iter().find(|(names, _)| names.split(' ').any(|refused| refused == name)).map(|(_, reason)| *reason)
    }

    /// Bindings of `let` see only the names before it; bindings of `let*` also see earlier bindings.
    fn binding(&mut self, bindings: &[Tree], body: &Tree, is_sequential: bool) -> Result<usize, ExpressionError> {
        let depth = self.scope.len();
        let mut bound = Vec::new();
        for binding in bindings {
            let Some([Tree::Atom(name, _), value]) = binding.list() else {
                return self.fail("expected `[NAME VALUE]`", binding.place());
            };
            let node = self.node(value)?;
            if is_sequential { &mut self.scope } else { &mut bound }.push((name.clone(), node));
        }
        self.scope.extend(bound);
        let node = self.node(body)?;
        self.scope.truncate(depth);
        Ok(node)
    }

    /// With several operands, each neighboring pair is compared; with `!=`, every pair.
    fn comparison(
        &mut self,
        comparison: NumberComparison,
        first: &Tree,
        operands: &[Tree],
        place: Range<usize>,
    ) -> Result<usize, ExpressionError> {
        if operands.len() < 2 {
            return self.fail("expected two numbers or more to compare", first.place());
        }
        let numbers = self.all_typed(operands, false)?;
        let distance = if comparison.is_inequality() { numbers.len() } else { 2 };
        let mut pairs = Vec::new();
        for (index, &left) in numbers.iter().enumerate() {
            for &right in numbers.iter().take(index + distance).skip(index + 1) {
                pairs.push(self.add(Operation::Compare(comparison, [left, right]), place.clone())?);
            }
        }
        match pairs[..] {
            [pair] => Ok(pair),
            _ => self.add(Operation::Connect { all: true, operands: pairs }, place),
        }
    }

    fn call(&mut self, name: &str, operands: &[Tree], place: Range<usize>) -> Result<usize, ExpressionError> {
        let Some(function) = Function::named(name, operands.len()) else {
            let counts = Function::operands(name);
            if let Some(count) = counts.first() {
                let found = operands.len();
                return self.fail(format!("`{name}`: expected operands: {count}, found {found}"), place);
            }
            let reason = self.reason(name).unwrap_or("no operation of this name is known");
            return self.fail(format!("`{name}`: {reason}"), place);
        };
        let operands = self.all_typed(operands, false)?;
        self.add(Operation::Apply(function, operands), place)
    }
}
