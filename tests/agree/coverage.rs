//! What the dice reach.
