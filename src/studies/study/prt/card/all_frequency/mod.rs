//! All-frequency transfer on an emulated card: a picture with its errors and its time ([`AllFrequencyOnCard`]), and
//! number formats, maps and filters, varied one after the other ([`factored_precision`]).

mod coding;
mod pixels;
mod precision;
mod report;
mod subject;

pub use precision::factored_precision;
pub use subject::AllFrequencyOnCard;
