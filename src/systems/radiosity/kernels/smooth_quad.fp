!!FP1.0
# A patch of four corners, between the radiosities at them.
# TEX0: in-patch coordinates, depth, 1 in front and 0 behind; TEX1, TEX2: the corners' texels.
# texture 0: radiosities at corners; p[0]: from radiosity to color.
# Differences first: where all four are the same, so is what comes out.
TEX R0, f[TEX1], TEX0, RECT;
TEX R1, f[TEX1].zwzw, TEX0, RECT;
TEX R2, f[TEX2], TEX0, RECT;
TEX R3, f[TEX2].zwzw, TEX0, RECT;
ADDR R1, R1, -R0;
MADR R0, R1, f[TEX0].x, R0;
ADDR R2, R2, -R3;
MADR R3, R2, f[TEX0].x, R3;
ADDR R3, R3, -R0;
MADR R0, R3, f[TEX0].y, R0;
MULR R0, R0, f[TEX0].w;
MULR o[COLR], R0, p[0];
MOVR o[DEPR].z, f[TEX0].z;
END
