//! Errors of the timing model.

/// A question that the model has no answer to.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum TimingError {
    /// The device does not state a figure that the model needs.
    #[error("`{device}` has no figure `{figure}`, so it has no time; use one of the cards that have it: {have}")]
    Missing { device: String, figure: &'static str, have: String },
    /// No figure of this name can be scaled.
    #[error("`{key}` is no guess of `{device}`; its guesses are: {known}")]
    NoGuess { device: String, key: String, known: String },
    /// A figure cannot be scaled by nothing, or by an infinite factor.
    #[error("a figure cannot be scaled by {numerator}/{denominator}; both must be above 0")]
    Scale { numerator: u64, denominator: u64 },
    /// No cache has this shape.
    #[error(
        "a texture cache of {bytes} bytes in lines of {line_bytes} bytes, {ways} ways, cannot be; lines must be a power of \
         two of at least 16 bytes, and the size a whole number of sets of {ways} lines"
    )]
    CacheShape { bytes: u64, line_bytes: u64, ways: u64 },
}
