mod channel;
mod display;
mod exr;
mod flip;
mod luminance;
mod png;
mod ssim;
