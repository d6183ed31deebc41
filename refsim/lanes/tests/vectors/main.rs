//! Tests arithmetic units of cards against vectors of real cards, every row and column, bit for bit; examples of their
//! rules; and laws of the adder that aligns its addends.

mod examples;
mod gt200;
mod laws;
mod nv;
mod table;
