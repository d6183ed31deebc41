//! Programs and draws on the scalar executor: instructions against the specification, formats, machines, and the log.

mod arithmetic;
mod device;
mod event_log;
mod flow;
#[path = "../../../tests/agree/generate/mod.rs"]
mod generate;
mod instruction_formats;
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
mod sum_rules;
#[path = "../common/sums.rs"]
mod sums;
mod vertex_cache;
