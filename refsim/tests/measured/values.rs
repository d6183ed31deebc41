//! Measured values and the drawn values that are compared with them.

/// A measured value and the drawn one, as colors: red, green and blue.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Value {
    pub(crate) measured: [u8; 3],
    pub(crate) drawn: [u8; 3],
    /// `true` if the drawn value equals the measured one; the colors may show only part of the compared value.
    pub(crate) right: bool,
}

/// All values of a rule, in the order of their file.
#[derive(Clone, Default, PartialEq, Eq)]
pub(crate) struct Values(pub(crate) Vec<Value>);

impl Values {
    pub(crate) fn add(&mut self, measured: [u8; 3], drawn: [u8; 3], right: bool) {
        self.0.push(Value { measured, drawn, right });
    }

    pub(crate) fn add_code(&mut self, measured: u8, drawn: u8) {
        self.add_grey(measured, drawn, measured == drawn);
    }

    /// Adds a code, shown as grey.
    pub(crate) fn add_grey(&mut self, measured: u8, drawn: u8, right: bool) {
        self.add([measured; 3], [drawn; 3], right);
    }

    /// Adds a yes-or-no value, shown as white or black.
    pub(crate) fn add_verdict(&mut self, measured: bool, drawn: bool) {
        let color = |verdict| if verdict { 255 } else { 0 };
        self.add_code(color(measured), color(drawn));
    }

    /// Number of values.
    pub(crate) fn all(&self) -> usize {
        self.0.len()
    }

    /// Number of drawn values that equal the measured ones.
    pub(crate) fn right(&self) -> usize {
        self.0.iter().filter(|value| value.right).count()
    }
}
