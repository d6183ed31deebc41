//! System 4: radiance transfer at vertices, clustered principal components, their coherence, files and cards.

mod card;
mod coherence;
mod compression;
mod file;
mod transfer;
