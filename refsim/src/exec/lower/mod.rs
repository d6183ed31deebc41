//! The executors' shared middle: a program as a graph of component values under a device's rules, before anybody
//! decides in which order, where and by what arithmetic they are computed. `batch` and `wgsl` start from it; `scalar`
//! does not use it.
//!
//! - [`Graph`]: values, computed by [`crate::num::NumberOperation`]s; [`Formats`]: in which number formats.
//! - `arith`, `macros`, `translate`, `translate_texture`, `fragment`: instructions as nodes.
//! - `program`, `flow`: whole programs without and with flow control.
//! - `raw`: how executors hold numbers.

mod arith;
mod flow;
mod formats;
mod fragment;
mod graph;
mod macros;
mod program;
mod raw;
mod translate;
mod translate_texture;

pub(super) use flow::{ACTIVE, COUNTER, DECIDED, KILLED, MaskedInstruction, MaskedProgram};
pub(super) use formats::Formats;
pub(super) use fragment::of_file;
pub(super) use graph::{Arith, Detail, Graph, NodeId, NodeKind, Slot, TRUE};
pub(super) use program::{Ends, has_flow, translate_straight, translate_straight_vertex};
pub(super) use raw::{FloatLayout, pow2};
pub(super) use translate::{CONSTANT_INPUTS, Effect, RegisterComponent, Translator};
