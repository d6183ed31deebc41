!!FP1.0
# Pass 1 by vertex, more lights: adds what the pass before wrote. p[0]: the largest value of the map.
# texture 0: what the pass before wrote; TEX0: irradiance of these lights.
TEX R0, f[WPOS], TEX0, RECT;
ADDR R0, R0, f[TEX0];
MINR o[COLR], R0, p[0];
END
