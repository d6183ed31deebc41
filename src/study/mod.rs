//! Studies: one file a question. Parameters go in, rows and a verdict come out; nothing is printed here.

pub mod configuration;
pub mod leaky_teapot;
pub mod leaky_teapot_report;
pub mod radiosity;
pub mod reproduce;
pub mod shade;
pub mod timeline_trace;
