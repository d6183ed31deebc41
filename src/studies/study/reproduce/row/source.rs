//! Runs that values of rows are from.

/// Run that the value of a row is from.
#[derive(Clone, Copy, Debug, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum RowSource {
    /// This run, on models of full size or on none.
    Computed,
    /// A recorded run at full size. This run had reduced models.
    Recorded {
        /// Value on the reduced models.
        reduced: f64,
    },
    /// A recorded run at full size, and this one, with the same bits.
    #[strum(to_string = "recorded and computed")]
    Confirmed,
    /// This run, at full size. A recorded one has other bits.
    #[strum(to_string = "computed, not as recorded")]
    Differs {
        /// Recorded value.
        recorded: f64,
    },
    /// This run, on reduced models: no judgement.
    Reduced,
}
