mod dot;
mod leading;
mod leading_svd;
mod lu;
mod matrix;
