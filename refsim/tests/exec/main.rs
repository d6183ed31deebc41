//! Programs and draws on the scalar executor: instructions against the specification, formats, machines, and what is
//! logged.

mod arithmetic;
mod device;
mod event_log;
mod flow;
mod instruction_formats;
mod laws;
#[path = "../common/legal.rs"]
mod legal;
mod machine;
#[path = "../common/quads.rs"]
mod quads;
#[path = "../common/random.rs"]
mod random;
mod rules;
#[path = "../common/running.rs"]
mod running;
mod step_budget;
mod storage_formats;
