//! Arithmetic of the batch executor against `num`, and large textures.

mod array_operation;
#[path = "../common/environment.rs"]
mod environment;
mod lanes;
mod large_textures;
#[path = "../common/random.rs"]
mod random;
