!!FP1.0
# A patch in its radiosity.
# TEX0: in-patch coordinates, depth, 1 in front and 0 behind; TEX3: the patch's texel.
# texture 0: radiosities; p[0]: from radiosity to color.
TEX R0, f[TEX3], TEX0, RECT;
MULR R0, R0, f[TEX0].w;
MULR o[COLR], R0, p[0];
MOVR o[DEPR].z, f[TEX0].z;
END
