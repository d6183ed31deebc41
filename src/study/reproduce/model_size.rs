//! The size of models that stand for a paper's.

/// How large the models are that stand for a paper's, where an entry has a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ModelSize {
    /// Small: an entry takes seconds.
    #[default]
    Reduced,
    /// As printed: minutes to hours.
    Printed,
}
