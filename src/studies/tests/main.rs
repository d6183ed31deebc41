//! Tests of the studies through what they are asked and what they find.

mod study;
mod vision;
