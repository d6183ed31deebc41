// A block of matrix times vector, one element of three matrices a texel (section 3).
// First pass of an iteration: B + e - sum A B. A fragment is a row of the matrix.
//   TEX0  A, columns across, rows down    f[TEX0]  x: the block's first column; y: the row; z: the only row of a vector
//   TEX1  B, one row                      f[TEX1]  the fragment's own texel of a vector
//   TEX2  e, one row
// In half precision but for the coordinates, which have to count beyond 1024.
!!FP1.0
MOVR R0, f[TEX0];
TEX  H2, f[TEX1], TEX1, RECT;
TEX  H3, f[TEX1], TEX2, RECT;
ADDH H2, H2, H3;
# a texel
TEX  H3, R0, TEX0, RECT;
TEX  H4, R0.xzzz, TEX1, RECT;
MADH H2, -H3, H4, H2;
ADDR R0.x, R0, {1}.x;
# end of a texel
MOVH o[COLH], H2;
END
