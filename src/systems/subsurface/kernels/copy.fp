!!FP1.0
# A level of a float map, copied to its place among the others. texture 0: the level; TEX0: the texel.
TEX o[COLR], f[TEX0], TEX0, RECT;
END
