//! The program as a user meets it: arguments in; text, exit code and files out.

mod all_frequency;
mod all_frequency_card;
mod alu;
mod atlas;
mod bad_input;
mod bi_scale;
mod case;
mod check;
mod claims;
mod commands;
mod compare;
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
mod program;
mod prt;
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

use program::{Ran, crossbar, crossbar_in, start};
