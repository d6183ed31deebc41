//! Tests the program as a user runs it: arguments in; text, exit code and files out.

mod all_frequency;
mod alu;
mod answers;
mod atlas;
mod bad_input;
mod bi_scale;
mod case;
mod check;
mod commands;
mod compare;
mod completions;
mod cpca;
mod devices;
mod diff;
#[path = "../../refsim/tests/common/environment.rs"]
mod environment;
mod examples;
mod factor;
#[path = "../support/pages.rs"]
mod generated;
mod help;
mod hostile;
mod materials;
mod models;
mod options;
mod page;
mod precision;
mod program;
mod progress;
mod radiosity;
#[path = "../../refsim/tests/common/random.rs"]
mod random;
mod render;
mod reproduce;
mod resolved;
mod scene;
mod shown;
mod subsurface;
mod tables;
mod timeline;
mod tracing;
mod tree;
mod values;

use program::{ProgramOutput, crossbar, crossbar_in, start};
