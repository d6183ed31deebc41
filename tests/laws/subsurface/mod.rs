//! Laws of system 3.
