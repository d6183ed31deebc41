mod extremes;
mod hemisphere;
mod layout;
mod light;
mod parabolic;
mod rule;
mod sky;
