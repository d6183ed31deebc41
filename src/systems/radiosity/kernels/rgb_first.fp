// A block of matrix times vector, one element of three matrices a texel (section 3).
// First pass of an iteration: B + e - sum A B. A fragment is a row of the matrix.
//   TEX0  A, columns across, rows down    f[TEX0]  x: the block's first column; y: the row; z: the only row of a vector
//   TEX1  B, one row                      f[TEX1]  the fragment's own texel of a vector
//   TEX2  e, one row
!!FP1.0
MOVR R0, f[TEX0];
TEX  R1, f[TEX1], TEX1, RECT;
TEX  R2, f[TEX1], TEX2, RECT;
ADDR R1, R1, R2;
# a texel
TEX  R2, R0, TEX0, RECT;
TEX  R3, R0.xzzz, TEX1, RECT;
MADR R1, -R2, R3, R1;
ADDR R0.x, R0, {1}.x;
# end of a texel
MOVR o[COLR], R1;
END
