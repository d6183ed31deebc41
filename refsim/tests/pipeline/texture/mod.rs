//! Tests of `refsim::texture`: filtering compared with big rationals, addressing with a naive model, stores
//! exhaustively, and robustness against arbitrary bit patterns.

mod addressing;
mod filtering;
mod layout;
mod mipmaps;
mod pixels;
mod rational;
mod robust;
mod storing;
