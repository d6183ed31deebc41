//! Errors of the timing model.

/// Error of constructing or changing a timing model.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages explain the fields")]
pub enum TimingError {
    /// The device does not state a figure that the model needs.
    #[error("`{device}` has no figure `{figure}`, so it has no timing; use one of the cards that have it: {have}")]
    Missing { device: String, figure: &'static str, have: String },
    /// The device has no scalable figure with this name.
    #[error("`{device}` has no guess named `{key}`; its guesses are: {known}")]
    NoGuess { device: String, key: String, known: String },
    /// The scale factor is zero or infinite.
    #[error("a figure cannot be scaled by {numerator}/{denominator}; both must be above 0")]
    Scale { numerator: u64, denominator: u64 },
    /// Invalid cache shape.
    #[error(
        "a texture cache of {bytes} bytes in lines of {line_bytes} bytes, {ways} ways, is invalid; lines must be a power \
         of two of at least 16 bytes, and the size a whole number of sets of {ways} lines"
    )]
    CacheShape { bytes: u64, line_bytes: u64, ways: u64 },
}
