!!FP1.0
# A patch's number.
# TEX0: in-patch coordinates, depth, 1 in front and 0 behind; TEX3: the patch's texel, its number from 1, negative from behind.
MOVR o[COLR], f[TEX3].z;
MOVR o[DEPR].z, f[TEX0].z;
END
