#[cfg(feature = "refsim")]
mod number;
mod single;
#[cfg(feature = "refsim")]
mod surface;
