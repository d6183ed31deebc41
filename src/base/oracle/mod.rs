//! An oracle for tests of ray-triangle intersectors: it takes a mesh, rays and your hits, and returns every
//! disagreement with exact arithmetic. docs/examples/foreign_intersector.md is an introduction.
//!
//! An [`Oracle`] decides first hits on the f32 values as given ([`crate::geom::exact`]) and classifies each result that
//! differs as a [`DisagreementKind`]: a leak, a false hit, a neighbour in place of the correct triangle, a t beyond the
//! tolerance. If several triangles are hit at exactly the same t, as on a shared edge, each is a correct answer. At a
//! silhouette, where the two triangles of an edge face opposite ways, a miss is correct for a ray a few ULPs away
//! ([`DisagreementKind::Silhouette`]), and [`Oracle::assert_watertight`] accepts it. Where the two triangles face the
//! same way, a miss is a hole for all nearby rays. [`hard_rays`] generates rays on which intersectors differ. The
//! `assert_*` functions panic with the report at the caller's location; the functions without `assert_` return it as a
//! [`Result`].
//!
//! Three assertions, each stronger than the one before:
//!
//! | assertion | accepts |
//! |---|---|
//! | [`Oracle::assert_watertight`] | everything but leaks |
//! | [`Oracle::assert_faithful`] | results that are correct for a ray a few ULPs away: no leaks, no false hits |
//! | [`Oracle::assert_agrees`] | only the exact answer, with t within the tolerance |
//!
//! ```
//! # extern crate crossbar_base as crossbar;
//! use crossbar::geom::{Hit, Mesh, Ray, Sides};
//! use crossbar::oracle::{Aim, DisagreementKind, Oracle, Tolerance, hard_rays};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A square of two triangles, and somebody's intersector that never finds the second.
//! let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
//! let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]])?;
//! let mine = |ray: &Ray| {
//!     let [x, y, _] = ray.origin();
//!     (y <= x).then_some(Hit { triangle: 0, t: 2.0 })
//! };
//! let oracle = Oracle::new(&mesh, Sides::Front, Tolerance::ulps(4));
//! let down = |x, y| Ray::new([x, y, 2.0], [0.0, 0.0, -1.0]);
//!
//! // On the diagonal, either triangle is right.
//! oracle.assert_agrees(&[down(0.75, 0.25)?, down(0.5, 0.5)?], mine);
//!
//! let report = oracle.examine(&[down(0.75, 0.25)?, down(0.25, 0.75)?], mine);
//! assert_eq!(report.count(DisagreementKind::Leak), 1);
//! let leak = "ray 1 from (0.25, 0.75, 2) along (0, 0, -1): leak: expected triangle 1 at t = 2";
//! assert!(report.to_string().contains(leak));
//!
//! // Rays on which intersectors differ, for any mesh.
//! let rays = hard_rays(&mesh, 100, 1);
//! let report = oracle.examine(&rays, mine);
//! assert!(report.by_aim(&rays).leaks(Aim::Axis) > 0, "{}", report.by_aim(&rays));
//! assert!(oracle.watertight(&rays, mine).is_err());
//! # Ok(())
//! # }
//! ```

mod aims;
mod disagreement;
mod hard;
mod judge;
mod nearby;
mod report;
mod tolerance;

pub use aims::AimCounts;
pub use disagreement::{Disagreement, DisagreementKind};
pub use hard::{Aim, HardRay, JudgedRay, hard_rays};
pub use judge::Oracle;
pub use report::Report;
pub use tolerance::Tolerance;
