//! Proofs of the texture room: decoding and filtering against big rationals, addressing against a naive model, stores
//! exhaustively, and that no bit pattern makes it panic.

mod texture {
    mod addressing;
    mod decoding;
    mod filtering;
    mod mipmaps;
    mod rational;
    mod robust;
    mod storing;
}
