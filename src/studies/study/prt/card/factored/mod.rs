//! All-frequency transfer on an emulated card: a picture with its errors and its time ([`AllFrequencyOnCard`]), and one
//! thing after the other made coarse ([`factored_precision`]).

mod coding;
mod pixels;
mod precision;
mod report;
mod subject;
mod tables;

pub use precision::{FactoredPrecision, factored_precision, factored_precision_table};
pub use subject::{AllFrequencyCardError, AllFrequencyOnCard};
pub(in crate::study::prt::card) use tables::{Blame, report_blame};
