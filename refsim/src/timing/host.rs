//! What the host's own work costs: counted operations, times one weight per kind, times one scale.
//!
//! The weights are relative and guessed; the scale is found from one printed figure ([`CPU_ONLY_RAYS_PER_SECOND`]) and
//! the counts of the run that it was printed for, and then left alone. So the model can be wrong about where the host's
//! time goes, but not about how much of it there is in that run.

use std::fmt;
use std::ops::AddAssign;

use super::Picoseconds;
use crate::device::{Confidence, FigureRow};

/// Rays per second of the host alone on the teapot room: Ray Engine paper, Table 3, first row. The one figure that the
/// scale of [`HostModel`] is calibrated on.
pub const CPU_ONLY_RAYS_PER_SECOND: u64 = 135_812;

macro_rules! operations {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $weight:literal, $source:literal;)*) => {
        /// A kind of operation of the host.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum HostOperation {
            $($(#[$doc])* $variant,)*
        }

        impl HostOperation {
            /// All kinds.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)*];

            /// The name in logs and reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            const fn weight(self) -> u64 {
                match self {
                    $(Self::$variant => $weight,)*
                }
            }

            const fn source(self) -> &'static str {
                match self {
                    $(Self::$variant => $source,)*
                }
            }
        }
    };
}

operations! {
    /// A cell of the triangle octree that a ray or a bucket meets.
    OctreeCell = "octree-cell", 25, "three slab distances and a choice of the next cell; no source was found";
    /// A ray against a triangle.
    RayTriangleTest = "ray-triangle-test", 50, "two cross and four dot products, a division; no source was found";
    /// A node of the ray tree on the way of a ray to its bucket.
    RayTreeNode = "ray-tree-node", 10, "a comparison of one of five coordinates, a miss in the cache now and then; no source was found";
    /// A ray put into a bucket, or moved to another.
    BucketInsert = "bucket-insert", 25, "six numbers and an index copied; no source was found";
    /// A ray made: by the camera, or by a hit.
    RayGenerated = "ray-generated", 40, "a direction and its length; no source was found";
    /// A ray written into the textures of a pass.
    RayPacked = "ray-packed", 10, "six numbers written one after the other; taken like a result that is read";
    /// A result looked at that came from the card.
    ResultRead = "result-read", 10, "an index and a distance kept if nearer; no source was found";
    /// A vertex handed to the driver, with its attributes.
    VertexSent = "vertex-sent", 20, "some twenty numbers copied; no source was found";
    /// A triangle taken from the scene for the card.
    TriangleSent = "triangle-sent", 20, "nine numbers gathered; no source was found";
    /// A product added to a sum, of matrices and vectors.
    MultiplyAdd = "multiply-add", 2, "a product and an addition; no source was found";
    /// A hit shaded.
    Shade = "shade", 100, "a normal, a light, a material; no source was found";
}

impl HostOperation {
    /// The place in [`HostOperation::ALL`].
    const fn index(self) -> usize {
        self as usize
    }

    /// The operation of this name.
    ///
    /// # Errors
    /// [`HostError::UnknownOperation`] with the names that exist.
    pub fn named(name: &str) -> Result<Self, HostError> {
        Self::ALL.iter().copied().find(|operation| operation.name() == name).ok_or_else(|| {
            let known: Vec<&str> = Self::ALL.iter().map(|operation| operation.name()).collect();
            HostError::UnknownOperation { name: name.chars().take(60).collect(), known: known.join(" ") }
        })
    }
}

impl fmt::Display for HostOperation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Why there is no host model, or no time.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error, miette::Diagnostic)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum HostError {
    /// The run to calibrate on did nothing.
    #[error("expected counted operations with some weight to calibrate the host on, found none")]
    #[diagnostic(code(timing::host_counts), help("count the operations of the run that the printed figure is of"))]
    NoCounts,
    /// The run to calibrate on cast no rays.
    #[error("expected at least one ray to calibrate the host on, found none")]
    #[diagnostic(code(timing::host_rays), help("count the rays of the run that the printed figure is of"))]
    NoRays,
    /// The printed figure is 0.
    #[error("expected at least one ray a second to calibrate the host on, found 0")]
    #[diagnostic(code(timing::host_rate), help("take the printed figure"))]
    NoRate,
    /// A log names an operation that the model does not know.
    #[error("unknown host operation `{name}`; expected one of {known}")]
    #[diagnostic(code(timing::host_operation))]
    UnknownOperation { name: String, known: String },
}

/// How often each operation happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct HostCounts([u64; HostOperation::ALL.len()]);

impl HostCounts {
    /// `count` more of an operation.
    pub const fn add(&mut self, operation: HostOperation, count: u64) {
        let held = &mut self.0[operation.index()];
        *held = held.saturating_add(count);
    }

    /// The same with `count` more of an operation.
    #[must_use]
    pub const fn with(mut self, operation: HostOperation, count: u64) -> Self {
        self.add(operation, count);
        self
    }

    /// How often it happened.
    pub const fn of(&self, operation: HostOperation) -> u64 {
        self.0[operation.index()]
    }
}

impl AddAssign for HostCounts {
    fn add_assign(&mut self, other: Self) {
        for operation in HostOperation::ALL {
            self.add(*operation, other.of(*operation));
        }
    }
}

/// What an operation costs, relative to the others: about so many additions of a processor of 2002. All guesses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostWeights([u64; HostOperation::ALL.len()]);

impl Default for HostWeights {
    fn default() -> Self {
        let mut weights = [0; HostOperation::ALL.len()];
        for operation in HostOperation::ALL {
            weights[operation.index()] = operation.weight();
        }
        Self(weights)
    }
}

impl HostWeights {
    /// The weight of an operation.
    pub const fn of(&self, operation: HostOperation) -> u64 {
        self.0[operation.index()]
    }

    /// The weights with source and confidence; keys start with `host.`.
    pub fn rows(&self) -> Vec<FigureRow> {
        let row = |operation: &HostOperation| FigureRow {
            key: format!("host.{operation}"),
            value: self.of(*operation).to_string(),
            unit: String::new(),
            source: operation.source().to_owned(),
            confidence: Confidence::Guess,
        };
        HostOperation::ALL.iter().map(row).collect()
    }

    /// The weight of this key, to be changed; `None` if there is no such key.
    pub fn figure_mut(&mut self, key: &str) -> Option<&mut u64> {
        let operation = HostOperation::named(key.strip_prefix("host.")?).ok()?;
        Some(&mut self.0[operation.index()])
    }

    /// All operations, each by its weight.
    fn total(&self, counts: &HostCounts) -> u128 {
        let weighted = |kind: &HostOperation| u128::from(counts.of(*kind)) * u128::from(self.of(*kind));
        HostOperation::ALL.iter().map(weighted).fold(0, u128::saturating_add)
    }
}

/// The cost of host work: weights and a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostModel {
    weights: HostWeights,
    /// A unit of weight lasts so many picoseconds, as a fraction: exact, so that the run of the calibration takes its
    /// printed time.
    picoseconds: u128,
    units: u128,
}

impl HostModel {
    /// The scale at which a run of these counts, casting so many rays (or drawing frames), casts `rays_per_second`;
    /// weights as guessed.
    ///
    /// # Errors
    /// [`HostError`] where one of them is 0.
    pub fn calibrate(counts: &HostCounts, rays: u64, rays_per_second: u64) -> Result<Self, HostError> {
        Self::calibrate_with(HostWeights::default(), counts, rays, rays_per_second)
    }

    /// The same with other weights: the scale is found anew, so that the run of the calibration takes the same time.
    ///
    /// # Errors
    /// [`HostError`] where one of them is 0, or all that was counted has no weight.
    pub fn calibrate_with(
        weights: HostWeights,
        counts: &HostCounts,
        rays: u64,
        rays_per_second: u64,
    ) -> Result<Self, HostError> {
        let units = weights.total(counts);
        if units == 0 {
            return Err(HostError::NoCounts);
        }
        if rays == 0 {
            return Err(HostError::NoRays);
        }
        if rays_per_second == 0 {
            return Err(HostError::NoRate);
        }
        // rays / rate seconds for all units: up to 2^104 by up to 2^64 times the units.
        let (picoseconds, units) = (u128::from(rays) * 1_000_000_000_000, units.saturating_mul(rays_per_second.into()));
        let common = gcd(picoseconds, units);
        Ok(Self { weights, picoseconds: picoseconds / common, units: units / common })
    }

    /// The weights.
    pub const fn weights(&self) -> &HostWeights {
        &self.weights
    }

    /// How long a unit of weight lasts, in picoseconds, for people to read.
    pub fn picoseconds_a_unit(&self) -> f64 {
        self.picoseconds as f64 / self.units as f64
    }

    /// How long so many operations of one kind take, rounded up to the next picosecond.
    pub fn time_of(&self, operation: HostOperation, count: u64) -> Picoseconds {
        self.time_of_all(&HostCounts::default().with(operation, count))
    }

    /// How long all of them take, rounded up once; the longest time there is where it would be longer.
    pub fn time_of_all(&self, counts: &HostCounts) -> Picoseconds {
        let exact = self.weights.total(counts).checked_mul(self.picoseconds).map(|time| time.div_ceil(self.units));
        Picoseconds(exact.and_then(|time| u64::try_from(time).ok()).unwrap_or(u64::MAX))
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    let (mut a, mut b) = (a, b);
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a.max(1)
}
