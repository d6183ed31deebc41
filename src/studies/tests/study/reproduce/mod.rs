//! The reproduction of the papers' figures.

mod compression;
mod entries;
mod figures;
mod page;
mod records;
mod rows;
