mod bodies;
mod camera;
mod ground;
mod model;
mod rooms;
