//! Output of studies: pages, tables, messages.

mod messages;
mod pages;
mod tables;
