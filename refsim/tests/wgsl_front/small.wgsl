// vignette
let d = length(uv - vec2f(0.5)); return vec4f(vec3f(1.0 - smoothstep(0.3, 0.8, d)), 1.0);

// checker
let c = floor(uv * 4.0); return vec4f(vec3f((c.x + c.y) % 2.0 * 0.8 + 0.1), 1.0);

// hue
let k = abs(fract(vec3f(uv.x) + vec3f(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - vec3f(3.0)) - vec3f(1.0);
return vec4f(mix(vec3f(1.0), saturate(k), uv.y), 1.0);

// turned_box
let turn = mat2x2f(cos(0.5), sin(0.5), -sin(0.5), cos(0.5)); let p = turn * (uv - vec2f(0.5));
let q = abs(p) - vec2f(0.2, 0.1); return vec4f(vec3f(saturate(max(q.x, q.y) * 8.0)), 1.0);

// julia
var z = uv * 2.0 - vec2f(1.0); var n = 0.0;
for (var i = 0; i < 6; i++) {
if (dot(z, z) > 4.0) { break; }
z = vec2f(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + vec2f(-0.4, 0.6);
n += 1.0;
}
return vec4f(vec3f(n / 6.0), 1.0);

// gaussian
let d = uv * 6.0 - vec2f(3.0); return vec4f(vec3f(exp(-0.5 * dot(d, d))), 1.0);

// octahedron
var n = vec3f(uv * 2.0 - vec2f(1.0), 0.0); n.z = 1.0 - abs(n.x) - abs(n.y); let t = max(-n.z, 0.0);
n.x += select(t, -t, n.x >= 0.0); n.y += select(t, -t, n.y >= 0.0);
return vec4f(normalize(n) * 0.5 + vec3f(0.5), 1.0);

// fog
let far = 1.0 - exp2(-uv.y * uv.y * 4.0);
return vec4f(mix(vec3f(uv.x, 0.3, 0.1), vec3f(0.6, 0.7, 0.8), far), 1.0);

// hard_light
let a = vec3f(uv.x, 0.5, uv.y); let b = vec3f(uv.y, uv.x, 0.3);
return vec4f(select(1.0 - 2.0 * (1.0 - a) * (1.0 - b), 2.0 * a * b, b < vec3f(0.45)), 1.0);

// glass
let xy = uv * 1.4 - vec2f(0.7); let n = vec3f(xy, sqrt(1.0 - dot(xy, xy)));
return vec4f(refract(vec3f(0.0, 0.0, -1.0), n, 1.0 / 1.5) * 0.5 + vec3f(0.5), 1.0);

// luma
let c = vec3f(uv, 0.4); let y = dot(c, vec3f(0.2126, 0.7152, 0.0722));
return vec4f(vec3f(y) + (c - vec3f(y)) * 1.5, 1.0);

// contour
let h = sin(uv.x /* of a, ( /* nested */ comment */ * 5.0) * cos(uv.y * /* ) */ 4.0); let line = abs(fract(h * 4.0 + 0.3) - 0.5);
return vec4f(vec3f(smoothstep(0.02, 0.1, line)), 1.0);
