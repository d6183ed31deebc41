//! The program as a user meets it: arguments in; text, exit code and files out.

mod all_frequency;
mod all_frequency_card;
mod alu;
mod atlas;
mod bad_input;
mod bi_scale;
mod case;
mod check;
mod commands;
mod compare;
mod cpca;
mod devices;
mod diff;
mod examples;
mod factor;
mod help;
mod hostile;
mod interrupted;
mod materials;
mod memory;
mod models;
mod moved;
mod options;
mod program;
mod radiosity;
mod render;
mod reproduce;
mod scene;
mod shown;
mod subsurface;
mod tables;
mod timeline;
mod trace_format;
mod tracing;
mod tree;

use program::{Ran, crossbar, crossbar_in, start};
