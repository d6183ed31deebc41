#[cfg(feature = "refsim")]
mod single;
#[cfg(feature = "refsim")]
mod surface;
