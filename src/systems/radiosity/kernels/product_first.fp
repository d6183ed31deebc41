// A block of the product of two matrices whose quarters lie in the four channels (reference 8 of the paper). A fragment is a texel
// of the product: the first pass starts from 0.
//   TEX0  the left matrix     f[TEX0]  x: the block's first step; y: the row; z: the column
//   TEX1  the right matrix
!!FP1.0
MOVR R0, f[TEX0];
MOVR R1, {0, 0, 0, 0};
# a texel
TEX  R2, R0, TEX0, RECT;
TEX  R3, R0.zxxx, TEX1, RECT;
MADR R1, R2.xxzz, R3.xyxy, R1;
MADR R1, R2.yyww, R3.zwzw, R1;
ADDR R0.x, R0, {1}.x;
# end of a texel
MOVR o[COLR], R1;
END
