//! `refsim`: a bit-exact emulator of the first programmable graphics cards.

pub mod asm;
pub mod check;
pub mod device;
pub mod event;
pub mod exec;
pub mod isa;
pub mod machine;
pub mod num;
pub mod output;
pub mod raster;
pub mod texture;
