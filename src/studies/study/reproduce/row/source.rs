//! Sources of the rows' values.

/// Source of a row's value.
#[derive(Clone, Copy, Debug, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum RowSource {
    /// Computed in this run.
    Computed,
    /// Read from a recorded run at full size.
    Recorded,
    /// Computed in this run at full size; the recorded value has the same bits.
    #[strum(to_string = "recorded and computed")]
    Confirmed,
    /// Computed in this run at full size; the recorded value has other bits.
    #[strum(to_string = "computed, not as recorded")]
    Differs {
        /// Recorded value.
        recorded: f64,
    },
}
