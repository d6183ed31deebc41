//! Crossbar: global illumination on the first programmable graphics cards, emulated to the bit.
//!
//! The emulated cards are in the crate `refsim`; this crate has the systems that run on them, the studies and the
//! program. It also has [`oracle`], which checks other ray-triangle intersectors with exact arithmetic:
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
//! # Where next
//!
//! - [`oracle`]: every wrong hit of your intersector, and rays on which intersectors differ
//! - [`ray_engine`], [`radiosity`], [`subsurface`], [`cpca`], [`all_frequency`], [`bi_scale`]: the six systems; each
//!   has its paper's equations on the host, the programs of the card, and a module `paper`, to be read with the paper
//! - [`scene`], [`geom`], [`tracer`], [`renderer`]: models and scenes, meshes and rays, a fast caster and pictures
//! - [`study`]: the computations of the program's commands, from parameters to findings
//! - `refsim`: programs, cards, number formats, durations
//!
//! # Features
//!
//! Without features there are [`geom`], [`elementary`], [`compare::f32_ulps`] and [`oracle`], which need neither the
//! emulator nor anything that reads files. `systems` adds the systems on emulated cards, the host renderers, scenes and
//! their files; `cli`, the default, adds the studies, their reports and the program. `wgpu` lets cards run on a GPU of
//! the host.
#![cfg_attr(
    not(feature = "cli"),
    allow(rustdoc::broken_intra_doc_links, reason = "without features some of the modules are not there")
)]

#[cfg(feature = "cli")]
pub mod cli;

#[doc(inline)]
pub use crossbar_base::{compare, elementary, error, geom, oracle};
#[cfg(feature = "systems")]
#[doc(inline)]
pub use crossbar_ground::{atlas, card, fresnel, io, linalg, names, picture, quadrature, scene, sphere, tracer};
#[cfg(feature = "cli")]
#[doc(inline)]
pub use crossbar_studies::{case, kept, options, report, shader, study};
#[cfg(feature = "systems")]
#[doc(inline)]
pub use crossbar_systems::{
    all_frequency, bi_scale, clustering, cpca, radiosity, ray_engine, renderer, subsurface, transfer,
};
