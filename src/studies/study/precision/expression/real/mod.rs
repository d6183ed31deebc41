//! Real numbers as intervals of dyadic numbers, of any required width, with ends rounded outward.
//!
//! Sums, products, quotients and roots are rounded outward to a number of bits. The elementary functions `exp`, `log`,
//! `atan`, `sin` and `cos` are enclosed at a point by an integer series with a bound on its error; all others are built
//! from these. More bits give a narrower interval, so a rounded result is found by asking for more bits until both ends
//! round alike (Ziv's strategy). Nothing here depends on the host's floats.

mod dyadic;
mod functions;
mod interval;
mod operations;
mod power;
mod series;

pub(super) use dyadic::{Dyadic, End};
pub(super) use interval::{Real, RealInterval};
pub(super) use operations::{Constant, Function, apply};
