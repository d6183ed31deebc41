//! Scheduling of a graph as steps on slots.
//!
//! - `fuse`, `block`: fusion and scheduling of a graph, without unused nodes.
//! - `straight`, `flow`: whole programs without and with flow control.

mod block;
mod flow;
mod fuse;
mod straight;

pub(crate) use block::{BatchStep, FetchDetail, FetchStep, ResultSlots, StepBlock, schedule};
pub(crate) use flow::{FlowPlan, PlannedInstruction};
pub(crate) use straight::{StraightPlan, StraightProgram};
