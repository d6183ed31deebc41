//! Integration tests of the studies and of the modules that they use, through the public interface of the library.

mod case;
mod kept;
mod options;
mod report;
mod study;
