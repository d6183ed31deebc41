//! System 2: matrix radiosity. Diffuse light in a room of patches as a linear system, solved as fragment programs would solve it.
//!
//! docs/papers/radiosity.md maps each equation.
//!
//! - [`Patches`]: a scene cut into patches;
//! - [`FormFactors`]: how much of each patch's light reaches each other one, with visibility asked of a [`crate::tracer::Caster`];
//! - [`System`]: form factors, reflectances and emittances, and the matrix of equation 2;
//! - [`solve`]: Jacobi, Gauss-Seidel, over-relaxation, shooting, and a direct solve as truth;
//! - [`packing`], [`card_order`]: textures, and the Jacobi step in the order of a card's passes, in f32;
//! - [`kernels`], [`on_card`]: the same as fragment programs on an emulated card;
//! - [`bound`]: how far that step's rounding can lead; [`bias`]: where it leads on average in half precision;
//! - [`model`], [`rate`]: the paper's passes and operation counts, and how fast a card would be;
//! - [`display`]: pictures drawn by the card, and radiosities at corners; [`gather`]: irradiance at points;
//! - [`rooms`]: closed boxes to try it on.
//!
//! ```
//! use crossbar::radiosity::{FormFactors, Patches, Subdivision, System, rooms, solve};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let patches = Patches::new(&rooms::furnace(0.5), Subdivision::PerSide(2))?;
//! let mut factors = FormFactors::unoccluded(&patches)?;
//! factors.enforce_closure()?;
//! let system = System::new(factors, patches.reflectances(), patches.emittances())?;
//! let red = system.solve_channel(0, solve::Solver::GaussSeidel, &solve::Options::default(), None)?;
//! assert!(red.radiosity.iter().all(|b| (b - 1.0).abs() < 1e-5), "a white furnace: as bright everywhere as a black body");
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
mod patches;
pub mod rate;
pub mod solve;
mod subdivide;
mod system;

pub use crate::scene::built::rooms;
pub use draw::DrawError;
pub use form_factor::{FormFactorError, FormFactors};
pub use on_card::{CardError, CardOptions, CardSolution, CardSolver, Storage};
pub use patch::Patch;
pub use patches::{MOST_PATCHES, PatchError, Patches, Subdivision};
pub use system::{RgbSolution, System, SystemError};
