//! What the papers print, and what follows from it.

mod cpca_appendix;
mod radiosity;
mod ray_cache;
mod ray_engine;
mod reproduce;
mod subsurface_material;
