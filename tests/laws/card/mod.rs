//! Meshes drawn by cards of systems 3 to 6.

mod front_faces;
