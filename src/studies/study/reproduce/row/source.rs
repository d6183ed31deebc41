//! Runs that values of rows are from.

/// Run that the value of a row is from.
#[derive(Clone, Copy, Debug, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum RowSource {
    /// This run.
    Computed,
    /// A recorded run at full size.
    Recorded,
    /// A recorded run at full size, and this one, with the same bits.
    #[strum(to_string = "recorded and computed")]
    Confirmed,
    /// Computed in this run at full size; the recorded value has other bits.
    #[strum(to_string = "computed, not as recorded")]
    Differs {
        /// Recorded value.
        recorded: f64,
    },
}
