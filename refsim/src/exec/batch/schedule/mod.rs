//! From a graph of values to steps on slots.
//!
//! - `fuse`, `block`: a graph as steps, without what nothing reads, and with what only one operation reads as part of
//!   that.
//! - `straight`, `flow`: whole programs without and with flow control; `code`: what steps consist of.

mod block;
mod code;
mod flow;
mod fuse;
mod straight;

pub(crate) use block::{BatchStep, FetchDetail, FetchStep, ResultSlots, StepBlock, schedule};
pub(crate) use code::{LaneCode, LaneOp};
pub(crate) use flow::{FlowPlan, PlannedInstruction};
pub(crate) use straight::{StraightPlan, StraightProgram};
