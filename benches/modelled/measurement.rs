//! Modelled time as criterion measures it.

use criterion::Throughput;
use criterion::measurement::{Measurement, ValueFormatter};

/// Picoseconds of a timeline. There is no clock to start: benches hand over what they found (`iter_custom`).
pub(crate) struct ModelledTime;

impl Measurement for ModelledTime {
    type Intermediate = ();
    type Value = f64;

    fn start(&self) {}

    fn end(&self, (): ()) -> f64 {
        0.0
    }

    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }

    fn zero(&self) -> f64 {
        0.0
    }

    fn to_f64(&self, value: &f64) -> f64 {
        *value
    }

    fn formatter(&self) -> &dyn ValueFormatter {
        &Formatter
    }
}

struct Formatter;

/// Picoseconds in a unit of readable size.
fn unit(typical: f64) -> (f64, &'static str) {
    match typical {
        t if t < 1e3 => (1.0, "ps"),
        t if t < 1e6 => (1e-3, "ns"),
        t if t < 1e9 => (1e-6, "us"),
        t if t < 1e12 => (1e-9, "ms"),
        _ => (1e-12, "s"),
    }
}

impl ValueFormatter for Formatter {
    fn scale_values(&self, typical: f64, values: &mut [f64]) -> &'static str {
        let (factor, unit) = unit(typical);
        values.iter_mut().for_each(|v| *v *= factor);
        unit
    }

    fn scale_throughputs(&self, _typical: f64, throughput: &Throughput, values: &mut [f64]) -> &'static str {
        let (count, unit) = match *throughput {
            Throughput::Bytes(n) | Throughput::BytesDecimal(n) => (n, "MB/s modelled"),
            Throughput::Bits(n) => (n, "Mbit/s modelled"),
            Throughput::Elements(n) | Throughput::ElementsAndBytes { elements: n, .. } => (n, "Mtests/s modelled"),
        };
        // Picoseconds to things a second, in millions.
        values.iter_mut().for_each(|v| *v = count as f64 / *v * 1e6);
        unit
    }

    fn scale_for_machines(&self, _values: &mut [f64]) -> &'static str {
        "ps"
    }
}
