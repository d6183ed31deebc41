//! The paper's counts of instructions, passes and floating-point operations (sections 3 and 3.1).

/// Maximum number of instructions of a GeForce FX fragment program.
pub const MAX_INSTRUCTIONS: u32 = 1024;
/// Instructions per texel: fetch the matrix, fetch the vector, multiply and subtract, step the texture coordinates.
pub const PER_TEXEL: u32 = 4;
/// Instructions of a pass outside of its texels: 1024 = 254 x 4 + 8.
pub const OVERHEAD: u32 = 8;
/// Texels of a block on a card of [`MAX_INSTRUCTIONS`]: the paper's 254.
pub const BLOCK: u32 = block(MAX_INSTRUCTIONS);

/// Texels of a block that a program of this many instructions can process, at least 1.
pub const fn block(instructions: u32) -> u32 {
    let fits = instructions.saturating_sub(OVERHEAD) / PER_TEXEL;
    if fits == 0 { 1 } else { fits }
}

/// Passes of an iteration: ceil(N / 254) with one element per texel, ceil(N / 1016) with four.
pub const fn passes(patches: u32, elements_a_texel: u32, block: u32) -> u32 {
    patches.div_ceil(elements_a_texel).div_ceil(block)
}

/// Floating-point operations of an iteration as the paper counts them: 2 N^2 for one channel, without indexing.
pub fn operations(patches: u32) -> f64 {
    2.0 * f64::from(patches) * f64::from(patches)
}

/// Converts iterations per second to MFLOP/s.
pub fn mflops(patches: u32, iterations_per_s: f64) -> f64 {
    operations(patches) * iterations_per_s / 1e6
}

/// Bytes that an iteration reads from the matrix; `bytes` is the size of a texel.
pub fn matrix_bytes(patches: u32, elements_a_texel: u32, bytes: u32) -> f64 {
    f64::from(patches) * f64::from(patches.div_ceil(elements_a_texel)) * f64::from(bytes)
}
