// A block of matrix times vector, four elements of a row a texel (section 3). Drawn once for each channel of the target: rows 4x + c.
// First pass of an iteration: B + e - sum A B. A fragment is a row of the matrix.
//   TEX0  A, columns across, rows down    f[TEX0]  x: the block's first column; y: the row; z: the only row of a vector
//   TEX1  B, one row                      f[TEX1]  the fragment's own texel of a vector
//   TEX2  e, one row, four elements a texel
// Four partial sums start from 0 and are added from the left at the end of the block.
!!FP1.0
MOVR R0, f[TEX0];
MOVR R1, {0, 0, 0, 0};
# a texel
TEX  R2, R0, TEX0, RECT;
TEX  R3, R0.xzzz, TEX1, RECT;
MADR R1, -R2, R3, R1;
ADDR R0.x, R0, {1}.x;
# end of a texel
DP4R R1, R1, {1, 1, 1, 1};
TEX  R2, f[TEX1], TEX1, RECT;
TEX  R3, f[TEX1], TEX2, RECT;
ADDR R2, R2, R3;
ADDR o[COLR], R2, R1;
END
