//! Laws of clustered principal components, of their coherence, and of their files.

mod coherence;
mod compression;
mod file;
mod to_error;
