//! Bi-scale transfer: pictures of a model from its transfer and its bidirectional textures, and the causes of their
//! errors.

mod causes;
mod render;
mod subject;

pub(in crate::study) use causes::CausePictures;
pub(in crate::study) use render::BiScaleDrawing;
pub use subject::{BiScaleRendering, SurfaceTexture, TexturedSurface, creased};
