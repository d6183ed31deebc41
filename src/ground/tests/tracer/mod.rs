mod octree;
mod offset;
mod scale;
