mod attributes;
mod kernels;
mod levels;
mod texels;
