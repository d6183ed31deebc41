//! Crossbar: global illumination on the first programmable graphics cards, emulated to the bit.
//!
//! The emulated cards are in the crate `refsim`; the systems that ran on them, the studies and the program are here. So
//! is [`oracle`], which checks other ray-triangle intersectors by exact arithmetic:
//!
//! ```
//! use crossbar::geom::{Hit, Mesh, Ray, Sides};
//! use crossbar::oracle::{Oracle, Tolerance};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mesh = Mesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])?;
//! let ray = Ray::new([0.25, 0.25, 2.0], [0.0, 0.0, -1.0])?;
//! let mine = |ray: &Ray| Some(Hit { triangle: 0, t: ray.origin()[2] });
//! Oracle::new(&mesh, Sides::Front, Tolerance::ulps(4)).assert_agrees(&[ray], mine);
//! # Ok(())
//! # }
//! ```
//!
//! A system runs on any card and any executor, and its results can be compared with exact arithmetic:
//!
#![cfg_attr(feature = "systems", doc = "```")]
#![cfg_attr(not(feature = "systems"), doc = "```ignore")]
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
//!
//! # Features
//!
//! Without features there are [`geom`], [`elementary`], [`compare::f32_ulps`] and [`oracle`], which need neither the
//! emulator nor anything that reads files. `systems` adds the emulated cards' systems, the host renderers, scenes and
//! their files; `cli`, the default, the studies, their reports and the program. `wgpu` lets cards run on a GPU of the
//! host.

#[cfg(feature = "systems")]
pub mod all_frequency;
#[cfg(feature = "systems")]
pub mod atlas;
#[cfg(feature = "systems")]
pub mod bi_scale;
#[cfg(feature = "systems")]
pub mod card;
#[cfg(feature = "cli")]
pub mod case;
#[cfg(feature = "cli")]
pub mod cli;
pub mod compare;
#[cfg(feature = "systems")]
pub mod cpca;
pub mod elementary;
#[cfg(feature = "systems")]
pub mod fresnel;
pub mod geom;
#[cfg(feature = "systems")]
pub mod io;
#[cfg(feature = "systems")]
pub mod linalg;
#[cfg(feature = "systems")]
pub mod names;
pub mod oracle;
#[cfg(feature = "systems")]
pub mod picture;
#[cfg(feature = "systems")]
pub mod quadrature;
#[cfg(feature = "systems")]
pub mod radiosity;
#[cfg(feature = "systems")]
pub mod ray_engine;
#[cfg(feature = "systems")]
pub mod renderer;
#[cfg(feature = "cli")]
pub mod report;
#[cfg(feature = "systems")]
pub mod scene;
#[cfg(feature = "cli")]
pub mod shader;
#[cfg(feature = "systems")]
pub mod sphere;
#[cfg(feature = "cli")]
pub mod study;
#[cfg(feature = "systems")]
pub mod subsurface;
#[cfg(feature = "systems")]
pub mod tracer;
#[cfg(feature = "systems")]
pub mod transfer;
