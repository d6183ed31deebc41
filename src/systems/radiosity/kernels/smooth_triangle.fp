!!FP1.0
# A patch of three corners, between the radiosities at them.
# TEX0: shares of the second and third corner, depth, 1 in front and 0 behind; TEX1, TEX2: the corners' texels.
# texture 0: radiosities at corners; p[0]: from radiosity to color.
TEX R0, f[TEX1], TEX0, RECT;
TEX R1, f[TEX1].zwzw, TEX0, RECT;
TEX R2, f[TEX2], TEX0, RECT;
ADDR R1, R1, -R0;
ADDR R2, R2, -R0;
MADR R0, R1, f[TEX0].x, R0;
MADR R0, R2, f[TEX0].y, R0;
MULR R0, R0, f[TEX0].w;
MULR o[COLR], R0, p[0];
MOVR o[DEPR].z, f[TEX0].z;
END
