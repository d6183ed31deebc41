!!FP1.0
# The mean over the patches that meet at a corner, four of them more.
# texture 0: their numbers + 1/2; texture 1: 1/k for the k-th patch of the mean, 0 for none; texture 2: the mean so far;
# texture 3: radiosities, whose texel i is at i p[0] + p[1]; TEX0: the texel.
# m + (b - m) / k: where all are the same, so is the mean.
TEX R0, f[TEX0], TEX0, RECT;
TEX R1, f[TEX0], TEX1, RECT;
TEX R2, f[TEX0], TEX2, RECT;
MOVR R4, p[1];
MADR R3, R0.x, p[0], R4;
TEX R3, R3, TEX3, RECT;
ADDR R3, R3, -R2;
MADR R2, R3, R1.x, R2;
MADR R3, R0.y, p[0], R4;
TEX R3, R3, TEX3, RECT;
ADDR R3, R3, -R2;
MADR R2, R3, R1.y, R2;
MADR R3, R0.z, p[0], R4;
TEX R3, R3, TEX3, RECT;
ADDR R3, R3, -R2;
MADR R2, R3, R1.z, R2;
MADR R3, R0.w, p[0], R4;
TEX R3, R3, TEX3, RECT;
ADDR R3, R3, -R2;
MADR o[COLR], R3, R1.w, R2;
END
