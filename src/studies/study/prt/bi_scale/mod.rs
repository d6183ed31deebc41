//! Bi-scale transfer: pictures of a model from its transfer and its bidirectional textures, and the causes of their
//! errors.

mod cause_pictures;
mod causes;
mod drawing;
mod light;
mod render;
mod subject;
mod surface;

pub(in crate::study) use cause_pictures::CausePictures;
pub(in crate::study) use drawing::BiScaleDrawing;
pub use subject::{BiScaleRendering, SurfaceTexture};
pub use surface::{TexturedSurface, creased};
