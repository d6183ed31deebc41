!!FP1.0
# Pass 1 by vertex: what the vertex program computed, interpolated. p[0]: the largest value of the map.
# TEX0: irradiance in a texture coordinate, since OpenGL clamps colors to [0, 1].
MINR o[COLR], f[TEX0], p[0];
END
