!!FP1.0
# Pass 1 by texel (4.2.2): light of OpenGL's kinds that enters the surface, over a geometry image and a normal map.
# TEX0: the texel. texture 0: positions, in w texel area / mean texel area; texture 1: unit normals.
# p[0]: eta^2 - 1, eta^2, eta, smallest squared distance to a light; p[1]: sky, in w the largest value of the map.
# Each light: p[2] position (w = 1) or direction towards it (w = 0); p[3] twice its color; p[4] attenuation k0, k1, k2.
# The transmittance of unpolarised light, c = cosine, g = sqrt(eta^2 - 1 + c^2): 2 c g (1/(c + g)^2 + (eta/(eta^2 c + g))^2).
TEX R0, f[TEX0], TEX0, RECT;
TEX R1, f[TEX0], TEX1, RECT;
MOVR R2.xyz, p[1];
# a light
MADR R3.xyz, R0, -p[2].w, p[2];
DP3R R3.w, R3, R3;
MAXR R3.w, R3.w, p[0].w;
RSQR R4.w, R3.w;
DSTR R5, R3.w, R4.w;
DP3R R5.w, R5, p[4];
RCPR R5.w, R5.w;
DP3R R4.x, R3, R1;
MULR_SAT R4.x, R4.x, R4.w;
MADR R4.y, R4.x, R4.x, p[0].x;
RSQR R4.z, R4.y;
MULR R4.y, R4.y, R4.z;
ADDR R4.z, R4.x, R4.y;
MADR R4.w, R4.x, p[0].y, R4.y;
RCPR R4.z, R4.z;
RCPR R4.w, R4.w;
MULR R4.w, R4.w, p[0].z;
MULR R4.zw, R4, R4;
ADDR R4.z, R4.z, R4.w;
MULR R4.x, R4.x, R4.x;
MULR R4.x, R4.x, R4.y;
MULR R4.x, R4.x, R4.z;
MULR R4.x, R4.x, R5.w;
MADR R2.xyz, R4.x, p[3], R2;
# end of a light
MULR R2.xyz, R2, R0.w;
MINR o[COLR], R2, p[1].w;
END
