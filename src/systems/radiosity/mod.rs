//! System 2: matrix radiosity. Diffuse light between patches as a linear system, solved by fragment programs.
//!
//! docs/papers/radiosity.md maps each equation.
//!
//! - [`Patches`]: a scene cut into patches;
//! - [`FormFactors`]: the fraction of each patch's light that reaches each other patch, visibility by a
//!   [`crate::tracer::Caster`];
//! - [`System`]: form factors, reflectances and emittances, and the matrix of equation 2;
//! - [`solve`]: Jacobi, Gauss-Seidel, over-relaxation, shooting, and a reference solution by LU;
//! - [`packing`], [`card_order`]: texture layouts, and the Jacobi step in f32 in the order of a card's passes;
//! - [`kernels`], [`on_card`]: the same as fragment programs on an emulated card;
//! - [`bound`]: error bounds of the f32 iteration; [`bias`]: the average effect of half precision;
//! - [`model`], [`rate`]: the paper's passes and operation counts, and iterations per second of a card;
//! - [`display`]: images drawn by the card, and radiosities at corners; [`gather`]: irradiance at points;
//! - [`rooms`]: closed boxes as test scenes.
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
//! let red = system.solve_channel(0, solve::Solver::GaussSeidel, &solve::Options::default(), None)?;
//! assert!(red.radiosity.iter().all(|b| (b - 1.0).abs() < 1e-5), "a furnace is as bright everywhere as a black body");
//! # Ok(())
//! # }
//! ```

pub mod bias;
pub mod bound;
pub mod card_order;
pub mod display;
mod draw;
pub mod form_factor;
pub mod gather;
pub mod kernels;
pub mod model;
pub mod on_card;
mod open;
pub mod packing;
mod patch;
mod patch_error;
mod patches;
pub mod rate;
pub mod solve;
mod subdivide;
mod system;

pub use crate::scene::built::rooms;
pub use draw::DrawError;
pub use form_factor::FormFactors;
pub use on_card::{CardOptions, CardSolution, CardSolver, Storage};
pub use patch::Patch;
pub use patch_error::MAX_PATCHES;
pub use patches::{Patches, Subdivision};
pub use system::{RgbSolution, System};
