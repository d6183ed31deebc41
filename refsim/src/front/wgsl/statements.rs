//! Statements: every fragment executes all of them, and values are selected where paths join. Loops are unrolled, and
//! function calls are inlined.

use std::collections::BTreeMap;

use naga::valid::FunctionInfo;
use naga::{Block, Expression, Function, Handle, Literal, Span, Statement, SwitchValue};

use super::super::Refusal;
use super::translator::{Exit, Frame, Meaning, Translator, Variables, place};
use super::values::{Component, Value};

type Result<T = ()> = std::result::Result<T, Refusal>;

/// The variable slot of a function's result.
pub(super) const RESULT: usize = 0;
/// Maximum nesting depth of blocks and calls.
const MAX_DEPTH: usize = 64;

impl<'a> Translator<'a> {
    /// Inlines a function and returns its result; empty if the function has none.
    pub(super) fn call(
        &mut self,
        function: &'a Function,
        info: &'a FunctionInfo,
        arguments: Vec<Meaning>,
        depth: usize,
    ) -> Result<Value> {
        let mut frame = Frame { function, info, arguments, locals: BTreeMap::new(), values: BTreeMap::new() };
        let names = function.named_expressions.iter().map(|(handle, name)| (*handle, name.as_str()));
        let locals =
            function.local_variables.iter().filter_map(|(_, local)| Some((local.init?, local.name.as_deref()?)));
        names.chain(locals).try_for_each(|(init, name)| self.is_whole_number(function, init, name))?;
        for (handle, local) in function.local_variables.iter() {
            let value = match local.init {
                Some(init) => self.value(&mut frame, init)?,
                None => self.zero_of(local.ty)?,
            };
            let slot = self.variable(value);
            frame.locals.insert(handle, slot);
        }
        let before = self.live;
        self.returns.push(Exit::default());
        self.block(&mut frame, &function.body, depth)?;
        if self.live != Component::Bool(false) {
            self.leave(|this| this.returns.last_mut())?;
        }
        if let Some(Exit(Some((_, variables)))) = self.returns.pop() {
            self.variables = variables;
        }
        frame.locals.values().for_each(|slot| drop(self.variables.remove(slot)));
        self.live = before;
        Ok(self.variables.remove(&RESULT).unwrap_or_default())
    }

    /// Returns an error if a variable without a declared type is initialized with an integer that exceeds i32: naga
    /// would infer another type.
    fn is_whole_number(&self, function: &Function, init: Handle<Expression>, name: &str) -> Result {
        let expression = &function.expressions[init];
        let Some(span) = place(function.expressions.get_span(init)) else { return Ok(()) };
        let (before, own) = (&self.text[..span.start as usize], &self.text[span.start as usize..span.end as usize]);
        let has_no_type = || before.trim_end().strip_suffix('=').is_some_and(|rest| rest.trim_end().ends_with(name));
        let is_other = matches!(expression, Expression::Literal(literal) if !matches!(literal, Literal::I32(_)));
        if is_other && own.bytes().all(|byte| byte.is_ascii_digit()) && has_no_type() {
            let message = format!("expected a number that an i32 holds, found {own}");
            return Err(Refusal::new(message, span).with_help(format!("write its type: `{own}u`, `{own}.0`")));
        }
        Ok(())
    }

    pub(super) fn block(&mut self, frame: &mut Frame<'a>, block: &'a Block, depth: usize) -> Result {
        if depth > MAX_DEPTH {
            return self.builder.refuse(format!("blocks and calls are nested more than {MAX_DEPTH} deep"));
        }
        for (statement, span) in block.span_iter() {
            self.step(place(*span))?;
            self.statement(frame, statement, *span, depth + 1)?;
            if self.live == Component::Bool(false) {
                break;
            }
        }
        Ok(())
    }

    fn statement(&mut self, frame: &mut Frame<'a>, statement: &'a Statement, span: Span, depth: usize) -> Result {
        match statement {
            Statement::Emit(range) => range.clone().try_for_each(|handle| self.evaluate(frame, handle).map(drop)),
            Statement::Block(block) => self.block(frame, block, depth),
            Statement::If { condition, accept, reject } => {
                let at = place(frame.function.expressions.get_span(*condition));
                let condition = self.value(frame, *condition)?[0];
                // Later selections have the condition's span.
                self.builder.span = at.unwrap_or(self.builder.span);
                self.branch(frame, condition, [accept, reject], depth)
            }
            Statement::Switch { selector, cases } => {
                let [Component::Int(selector)] = self.value(frame, *selector)?[..] else {
                    return self.builder.unknown();
                };
                let is = |value: &SwitchValue| match value {
                    SwitchValue::I32(value) => i64::from(*value) == selector,
                    SwitchValue::U32(value) => i64::from(*value) == selector,
                    SwitchValue::Default => false,
                };
                let default = || cases.iter().position(|case| case.value == SwitchValue::Default);
                let first = cases.iter().position(|case| is(&case.value)).or_else(default).unwrap_or(cases.len());
                let before = self.live;
                self.breaks.push(Exit::default());
                for case in &cases[first..] {
                    self.block(frame, &case.body, depth)?;
                    if !case.fall_through || self.live == Component::Bool(false) {
                        break;
                    }
                }
                if self.live != Component::Bool(false) {
                    self.leave(|this| this.breaks.last_mut())?;
                }
                let exit = self.breaks.pop().unwrap_or_default();
                self.resume(exit, before);
                Ok(())
            }
            Statement::Loop { body, continuing, break_if } => {
                self.unrolled(frame, body, continuing, *break_if, span, depth)
            }
            Statement::Break => self.leave(|this| this.breaks.last_mut()),
            Statement::Continue => self.leave(|this| this.continues.last_mut()),
            Statement::Return { value } => {
                if let Some(value) = value {
                    let value = self.value(frame, *value)?;
                    self.variables.insert(RESULT, value);
                }
                self.builder.span = place(span).unwrap_or(self.builder.span);
                self.leave(|this| this.returns.last_mut())
            }
            Statement::Kill => {
                self.builder.half = false;
                self.killed = self.builder.or(self.killed, self.live)?;
                Ok(())
            }
            Statement::Store { pointer, value } => {
                let (to, value) = (self.entry(frame, *pointer)?, self.value(frame, *value)?);
                self.store(&to, &value)
            }
            Statement::Call { function, arguments, result } => {
                let given = arguments.iter().map(|part| self.entry(frame, *part)).collect::<Result<Vec<_>>>()?;
                let value = self.call_of(*function, given, span, depth)?;
                if let Some(result) = result {
                    frame.values.insert(*result, Meaning::Value(value));
                }
                Ok(())
            }
            _ => self.refuse_this(),
        }
    }

    /// Inlines a call in the text; returns an error if a variable is written under one name and used under another.
    fn call_of(
        &mut self,
        callee: Handle<Function>,
        mut given: Vec<Meaning>,
        span: Span,
        depth: usize,
    ) -> Result<Value> {
        let mut outer = std::mem::take(&mut self.accesses);
        let mut paths = BTreeMap::new();
        for meaning in &mut given {
            if let Meaning::Pointer { path, .. } = meaning {
                self.slots += 1;
                paths.insert(self.slots, std::mem::replace(path, self.slots));
            }
        }
        let value = self.call(&self.module.functions[callee], &self.info[callee], given, depth)?;
        let inner = std::mem::take(&mut self.accesses);
        for (slot, path, _) in inner.iter().filter(|(.., is_written)| *is_written) {
            let of_parameter = |path: &usize| paths.contains_key(path);
            let is_alias = |(other, way, _): &(usize, usize, bool)| {
                other == slot && way != path && (of_parameter(way) || of_parameter(path))
            };
            if inner.iter().any(is_alias) {
                let message = "expected pointers to different variables, found a variable that is written under one name \
                               and used under another";
                return Err(Refusal::new(message, place(span).unwrap_or_default())
                    .with_help("WGSL forbids aliases: pass a copy, or return the value"));
            }
        }
        outer.extend(inner.into_iter().map(|(slot, path, write)| (slot, *paths.get(&path).unwrap_or(&path), write)));
        self.accesses = outer;
        Ok(value)
    }

    fn store(&mut self, to: &Meaning, value: &[Component]) -> Result {
        let target = match to {
            Meaning::Pointer { slot, offset, length, path } if *length == value.len() => {
                self.accesses.insert((*slot, *path, true));
                self.variables.get_mut(slot).and_then(|whole| whole.get_mut(*offset..*offset + *length))
            }
            _ => None,
        };
        match target {
            Some(target) => {
                target.copy_from_slice(value);
                Ok(())
            }
            None => self.builder.refuse("only whole variables, members, elements and components can be written"),
        }
    }

    fn branch(&mut self, frame: &mut Frame<'a>, condition: Component, blocks: [&'a Block; 2], depth: usize) -> Result {
        match condition {
            Component::Bool(known) => return self.block(frame, blocks[usize::from(!known)], depth),
            Component::Place(..) => {}
            _ => return self.builder.unknown(),
        }
        let (before, span, start) = (self.live, self.builder.span, self.variables.clone());
        self.charge()?;
        let not = self.builder.not(condition)?;
        let [accept, reject] = blocks;
        let (then_live, then_whole) = self.path(frame, accept, [before, condition], depth)?;
        let then = std::mem::replace(&mut self.variables, start);
        self.builder.span = span;
        let (else_live, else_whole) = self.path(frame, reject, [before, not], depth)?;
        let otherwise = std::mem::take(&mut self.variables);
        self.builder.half = false;
        self.builder.span = span;
        self.live = match then_whole && else_whole {
            true => before,
            false => self.builder.or(then_live, else_live)?,
        };
        self.variables = match (then_live, else_live) {
            (Component::Bool(false), _) => otherwise,
            (_, Component::Bool(false)) => then,
            _ => self.merged(condition, then, otherwise)?,
        };
        Ok(())
    }

    /// Executes a block where two conditions hold. Returns the mask of fragments that reach its end, and `true` if no
    /// fragment has left.
    fn path(
        &mut self,
        frame: &mut Frame<'a>,
        block: &'a Block,
        [before, holds]: [Component; 2],
        depth: usize,
    ) -> Result<(Component, bool)> {
        self.builder.half = false;
        let entered = self.builder.and(before, holds)?;
        self.live = entered;
        self.block(frame, block, depth)?;
        Ok((self.live, self.live == entered))
    }

    /// Merges the variables of two paths: takes the first path's values where the condition holds.
    fn merged(&mut self, condition: Component, mut first: Variables, second: Variables) -> Result<Variables> {
        let (mut accept, mut reject) = (Value::new(), Value::new());
        for (slot, value) in &first {
            if let Some(other) = second.get(slot).filter(|other| other.len() == value.len()) {
                accept.extend(value);
                reject.extend(other);
            }
        }
        let mut chosen = if accept.is_empty() {
            Value::new().into_iter()
        } else {
            self.builder.select(&[condition], &accept, &reject)?.into_iter()
        };
        for (slot, other) in second {
            match first.get_mut(&slot) {
                Some(value) if value.len() == other.len() => {
                    let count = value.len();
                    *value = chosen.by_ref().take(count).collect();
                }
                Some(_) => {}
                None => {
                    first.insert(slot, other);
                }
            }
        }
        Ok(first)
    }

    /// Makes the active fragments leave by an exit, which saves their variables.
    fn leave(&mut self, exit: impl Fn(&mut Self) -> Option<&mut Exit>) -> Result {
        self.builder.half = false;
        self.charge()?;
        let kept = exit(self).and_then(|exit| exit.0.take());
        let joined = match kept {
            None => (self.live, self.variables.clone()),
            Some((left, variables)) => {
                let all = self.builder.or(left, self.live)?;
                (all, self.merged(self.live, self.variables.clone(), variables)?)
            }
        };
        match exit(self) {
            Some(exit) => exit.0 = Some(joined),
            None => return self.builder.refuse("there is no loop or switch to leave here"),
        }
        self.live = Component::Bool(false);
        Ok(())
    }

    /// Continues after a loop or a switch that the fragments in `before` have entered.
    fn resume(&mut self, Exit(exit): Exit, before: Component) {
        match exit {
            Some((left, variables)) => {
                // If no fragment has left an outer construct, all fragments that were active before continue.
                let left_further = [self.returns.last(), self.continues.last()];
                let all = left_further.into_iter().flatten().all(|Exit(exit)| exit.is_none());
                self.live = if all { before } else { left };
                self.variables = variables;
            }
            None => self.live = Component::Bool(false),
        }
    }

    fn unrolled(
        &mut self,
        frame: &mut Frame<'a>,
        body: &'a Block,
        continuing: &'a Block,
        break_if: Option<Handle<Expression>>,
        span: Span,
        depth: usize,
    ) -> Result {
        let before = self.live;
        self.breaks.push(Exit::default());
        self.builder.loops.push(self.builder.span);
        while self.live != Component::Bool(false) {
            self.step(place(span))?;
            self.continues.push(Exit::default());
            self.block(frame, body, depth)?;
            if let Some(Exit(Some((left, variables)))) = self.continues.pop() {
                self.builder.half = false;
                self.variables = match self.live {
                    Component::Bool(false) => variables,
                    _ => self.merged(left, variables, self.variables.clone())?,
                };
                self.live = self.builder.or(self.live, left)?;
            }
            if self.live == Component::Bool(false) {
                break;
            }
            self.block(frame, continuing, depth)?;
            if let Some(condition) = break_if {
                let condition = self.value(frame, condition)?[0];
                self.builder.half = false;
                let all = self.live;
                self.live = self.builder.and(all, condition)?;
                let stays = self.builder.not(condition)?;
                let stay = self.builder.and(all, stays)?;
                if self.live != Component::Bool(false) {
                    self.leave(|this| this.breaks.last_mut())?;
                }
                self.live = stay;
            }
        }
        self.builder.loops.pop();
        let exit = self.breaks.pop().unwrap_or_default();
        self.resume(exit, before);
        Ok(())
    }
}
