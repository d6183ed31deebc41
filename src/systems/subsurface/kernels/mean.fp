!!FP1.0
# A level of a float map: the mean of four texels of the finer one.
# texture 0: the finer level; TEX0: the corner between the four, in its texels.
ADDR R0, f[TEX0].xyxy, {-0.5, -0.5, 0.5, 0.5};
TEX R1, R0, TEX0, RECT;
TEX R2, R0.zyzw, TEX0, RECT;
TEX R3, R0.xwzw, TEX0, RECT;
TEX R4, R0.zwzw, TEX0, RECT;
ADDR R1, R1, R2;
ADDR R3, R3, R4;
ADDR R1, R1, R3;
MULR o[COLR], R1, {0.25}.x;
END
