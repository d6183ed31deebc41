//! A mesh in a square of texels: the multiresolution meshed atlas.
//!
//! Every face has a rectangle of texels of its own, and every texel lies on one face. Faces are clustered in a binary
//! tree whose nodes are squares and 2:1 rectangles, so that a texel of a coarser level is the mean of a cluster.
