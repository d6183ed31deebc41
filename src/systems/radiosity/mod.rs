//! System 2: matrix radiosity. Diffuse light between patches as a linear system, solved by fragment programs.
//!
//! - section 3, (1), (2): [`System`], the matrix of form factors, reflectances and emittances (`paper`; read it first);
//! - (3), (4): [`solve`], Jacobi and other solvers in f64; [`card_system`], [`packing`], [`kernels`] and [`on_card`],
//!   the Jacobi step in f32 as fragment programs on an emulated card;
//! - 3: [`bias`], the average effect of half precision; [`model`], passes and operation counts;
//! - 3.1: [`Patches`], the patches of a scene; [`FormFactors`] between them, visibility by a [`crate::tracer::Caster`];
//!   [`display`], images drawn by the card, and radiosities at corners; [`rate`], iterations per second;
//! - [`rooms`]: closed boxes as test scenes.
//!
//! docs/papers/radiosity.md says which file has which section.
//!
//! ```
//! # mod crossbar { pub use {crossbar_base::*, crossbar_ground::*, crossbar_systems::*}; }
//! use crossbar::radiosity::{FormFactors, Patches, Subdivision, System, rooms, solve};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(2))?;
//! let mut factors = FormFactors::unoccluded(&patches)?;
//! factors.enforce_closure()?;
//! let system = System::new(factors, patches.reflectances(), patches.emittances())?;
//! let red = system.solve_channel(0, solve::Solver::GaussSeidel, &solve::Options::default())?;
//! assert!(red.radiosity.iter().all(|b| (b - 1.0).abs() < 1e-5), "a furnace is as bright everywhere as a black body");
//! # Ok(())
//! # }
//! ```

pub mod bias;
pub mod card_system;
pub mod display;
mod draw;
pub mod form_factor;
pub mod kernels;
pub mod model;
pub mod on_card;
mod open;
pub mod packing;
mod paper;
mod patch;
mod patches;
pub mod rate;
pub mod solve;
mod subdivide;

pub use crate::scene::built::rooms;
pub use draw::DrawError;
pub use form_factor::FormFactors;
pub use on_card::{CardSolution, CardSolver, Storage};
pub use paper::{RgbSolution, System};
pub use patch::Patch;
pub use patches::{MAX_PATCHES, Patches, Subdivision};
