//! Tests of `refsim::texture`: decoding and filtering compared with big rationals, addressing with a naive model,
//! stores exhaustively, and robustness against arbitrary bit patterns.

#[path = "common/sampling.rs"]
mod sampling;

mod texture {
    mod addressing;
    mod decoding;
    mod filtering;
    mod mipmaps;
    mod rational;
    mod robust;
    mod storing;
}
