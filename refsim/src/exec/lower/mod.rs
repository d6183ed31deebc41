//! Common intermediate representation of `batch` and `wgsl`: a program as a graph of component values under a device's
//! rules, independent of order, storage and arithmetic of execution. `scalar` does not use it.
//!
//! - [`Graph`]: values computed by [`crate::num::NumberOperation`]s; [`Formats`]: their number formats.
//! - `arith`, `macros`, `translate`, `translate_texture`, `fragment`: translation of instructions to nodes.
//! - `program`, `flow`: translation of programs without and with flow control.

mod arith;
mod flow;
mod formats;
mod fragment;
mod graph;
mod macros;
mod program;
mod translate;
mod translate_texture;

pub(super) use flow::{ACTIVE, COUNTER, DECIDED, KILLED, MaskedProgram};
pub(super) use formats::Formats;
pub(super) use graph::{Arith, Detail, Graph, NodeId, NodeKind};
pub(super) use program::{Ends, has_flow, translate_straight, translate_straight_vertex};
pub(super) use refsim_lanes::{Slot, TRUE};
pub(super) use translate::{CONSTANT_INPUTS, Effect, RegisterComponent, Translator};
