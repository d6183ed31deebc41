//! Crossbar: global illumination on the first programmable graphics cards, emulated to the bit.
//!
//! The emulated cards are in [`refsim`]; the systems that ran on them, the studies and the program are here.
//!
//! A system runs on any card and any executor, and its answer can be held against exact arithmetic:
//!
//! ```
//! use crossbar::geom::{Mesh, Ray, Sides, exact};
//! use crossbar::ray_engine::Crossbar;
//! use refsim::{device::Profile, machine::ExecutorKind};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
//! let mesh = Mesh::new(corners, vec![[0, 1, 2]])?;
//! let ray = Ray::new([0.25, 0.25, 2.0], [0.0, 0.0, -1.0])?;
//!
//! let truth = exact::nearest(&mesh, &ray, Sides::Front).ok_or("the ray hits")?;
//! assert_eq!((truth.triangle, truth.t.to_f32()), (0, 2.0));
//!
//! let radeon = Crossbar::new(Profile::named("r200")?, ExecutorKind::Scalar);
//! let hit = radeon.intersect_list(&mesh, &[ray], Sides::Front)?[0].ok_or("the card sees it too")?;
//! assert_eq!(hit.triangle, truth.triangle);
//! assert!((hit.t - 2.0).abs() < 0.01, "in 16-bit fixed point: {}", hit.t);
//! # Ok(())
//! # }
//! ```

pub mod card;
pub mod case;
pub mod cli;
pub mod compare;
pub mod elementary;
pub mod geom;
pub mod io;
pub mod linalg;
pub mod oracle;
pub mod radiosity;
pub mod ray_engine;
pub mod renderer;
pub mod report;
pub mod scene;
pub mod shader;
pub mod study;
pub mod tracer;
