//! System 4: radiance transfer at the vertices of a mesh.

mod models;
