//! Bi-scale transfer: pictures of a model from its transfer and its bidirectional textures, and what their errors come
//! from.

mod cause_pictures;
mod causes;
mod drawing;
mod light;
mod render;
mod subject;
mod surface;

pub(in crate::study) use cause_pictures::CausePictures;
pub(in crate::study) use drawing::BiScaleDrawing;
pub use light::LocalLight;
pub use subject::{BiScaleRendering, SurfaceTexture};
pub use surface::{TexturedSurface, creased};
