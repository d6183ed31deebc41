//! Bi-scale transfer: pictures of a model from its transfer and its bidirectional textures, and the causes of their
//! errors.

mod causes;
mod drawing;
mod render;
mod subject;
mod surface;

pub(in crate::study) use causes::CausePictures;
pub(in crate::study) use drawing::BiScaleDrawing;
pub use subject::{BiScaleRendering, SurfaceTexture};
pub use surface::{TexturedSurface, creased};
