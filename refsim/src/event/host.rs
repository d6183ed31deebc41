//! Kinds of work that the host does between two calls.

use std::fmt;

macro_rules! operations {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $weight:literal, $source:literal;)*) => {
        /// A kind of host operation.
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

            /// Relative cost of the operation; a guess of the host model.
            pub(crate) const fn weight(self) -> u64 {
                match self {
                    $(Self::$variant => $weight,)*
                }
            }

            /// Source of the weight.
            pub(crate) const fn source(self) -> &'static str {
                match self {
                    $(Self::$variant => $source,)*
                }
            }
        }
    };
}

operations! {
    /// Visit of a triangle octree cell by a ray or a bucket.
    OctreeCell = "octree-cell", 25, "three slab distances and a choice of the next cell; no source was found";
    /// Ray-triangle intersection test.
    RayTriangleTest = "ray-triangle-test", 50, "two cross and four dot products, a division; no source was found";
    /// Visit of a ray tree node by a ray on its way to its bucket.
    RayTreeNode = "ray-tree-node", 10, "a comparison of one of five coordinates, sometimes a cache miss; no source was found";
    /// Insertion of a ray into a bucket, or its transfer to another bucket.
    BucketInsert = "bucket-insert", 25, "six numbers and an index copied; no source was found";
    /// Generation of a ray, by the camera or at a hit.
    RayGenerated = "ray-generated", 40, "a direction and its length; no source was found";
    /// Writing of a ray into the textures of a pass.
    RayPacked = "ray-packed", 10, "six numbers written in sequence; assumed equal to result-read";
    /// Evaluation of a result read back from the card.
    ResultRead = "result-read", 10, "an index, and a distance that is kept if nearer; no source was found";
    /// Submission of a vertex with its attributes to the driver.
    VertexSent = "vertex-sent", 20, "about twenty numbers copied; no source was found";
    /// Gathering of a triangle from the scene for the card.
    TriangleSent = "triangle-sent", 20, "nine numbers gathered; no source was found";
    /// Multiply-add in sums over matrices and vectors.
    MultiplyAdd = "multiply-add", 2, "a product and an addition; no source was found";
    /// Shading of a hit.
    Shade = "shade", 100, "a normal, a light, a material; no source was found";
}

impl HostOperation {
    /// Index in [`HostOperation::ALL`].
    pub(crate) const fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for HostOperation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
