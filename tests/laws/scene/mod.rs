//! The scenes that the project builds.

mod built;
