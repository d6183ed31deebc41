//! Numbers, and prose with them.

use crate::report::digits::{Quantity, shown};

/// Formats a number with `decimals` decimals.
pub(super) fn number(value: f64, decimals: u8) -> String {
    shown(value, Quantity::Decimals(decimals))
}

/// Value in a sentence: a number without decimals, a number with a number of decimals, or words.
pub(super) trait Said {
    fn said(&self) -> String;
}

macro_rules! said {
    ($($of:ty: $value:ident => $said:expr;)*) => {
        $(impl Said for $of {
            fn said(&self) -> String {
                let $value = self;
                $said
            }
        })*
    };
}

said! {
    f64: value => number(*value, 0);
    u32: value => number(f64::from(*value), 0);
    u64: value => number(*value as f64, 0);
    usize: value => number(*value as f64, 0);
    (f64, u8): value => number(value.0, value.1);
    &str: words => (*words).to_owned();
    String: words => words.clone();
}

/// Returns a paragraph: a template whose `{}` are replaced by values, in order.
pub(super) fn paragraph(template: &str, values: &[&dyn Said]) -> String {
    let mut parts = template.split("{}");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (value, part) in values.iter().zip(parts) {
        text.push_str(&value.said());
        text.push_str(part);
    }
    text
}

/// Smallest and largest of some numbers; infinite if there are none.
pub(super) fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}
