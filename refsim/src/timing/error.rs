//! Errors of the timing model.

/// A question that the model has no answer to.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimingError {
    /// The device does not state a figure that the model needs.
    #[error("`{device}` has no figure `{figure}`, so it has no time; use one of the cards that have it: {have}")]
    Missing {
        /// The device.
        device: String,
        /// The figure, as profiles name it.
        figure: &'static str,
        /// The cards that state it.
        have: String,
    },
    /// No figure of this name can be scaled.
    #[error("`{key}` is no guess of `{device}`; its guesses are: {known}")]
    NoGuess {
        /// The device.
        device: String,
        /// What was asked for.
        key: String,
        /// What there is.
        known: String,
    },
    /// A figure cannot be scaled by nothing, or by an infinite factor.
    #[error("a figure cannot be scaled by {numerator}/{denominator}; both must be above 0")]
    Scale {
        /// Asked for.
        numerator: u64,
        /// Asked for.
        denominator: u64,
    },
    /// No cache has this shape.
    #[error(
        "a texture cache of {bytes} bytes in lines of {line_bytes} bytes, {ways} ways, cannot be; lines must be a power of \
         two of at least 16 bytes, and the size a whole number of sets of {ways} lines"
    )]
    CacheShape {
        /// Size.
        bytes: u64,
        /// Line.
        line_bytes: u64,
        /// Ways.
        ways: u64,
    },
}
