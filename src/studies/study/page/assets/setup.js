// The host's work before a card draws: scales by powers of two (`units.rs`, `reach.rs`, `range.rs`), ray textures, and
// the vertex programs in single precision.

const FIXED = 0;
const ROOM = 1 + 1 / 32;
const f = Math.fround;

// Range of a format (struct Format of the number library) that the programs may use.
const rangeOf = ([kind, upper, frac]) => {
  if (kind === FIXED) { return { kind: "fixed", end: powerOfTwo(upper), step: powerOfTwo(-frac) }; }
  const bias = 2 ** (upper - 1) - 1;
  return upper < 8 ? { kind: "narrow", end: powerOfTwo(bias - 1), step: 0 } : { kind: "wide", end: powerOfTwo(bias - 10), step: 0 };
};
const room = ({ end }, errors) => Math.max(end - errors, end / 2);
const texelError = ({ step }) => (step === 0 ? 0 : powerOfTwo(-15) + 2 * step);
const crossError = (range) => 2 * range.end * texelError(range) + 8 * range.step;

// Boxes of vectors, [low, high], and intervals.
const scaled = (by, [low, high]) => (by < 0 ? [by * high, by * low] : [by * low, by * high]);
const summed = (a, b) => [a[0] + b[0], a[1] + b[1]];
const product = (a, b) => {
  const [first, second] = [scaled(a[0], b), scaled(a[1], b)];
  return [Math.min(first[0], second[0]), Math.max(first[1], second[1])];
};
const magnitude = ([low, high]) => Math.max(Math.abs(low), Math.abs(high));
const side = (box, axis) => [box[0][axis], box[1][axis]];
const included = ([low, high], v) => [low.map((x, i) => Math.min(x, v[i])), high.map((x, i) => Math.max(x, v[i]))];
const magnitudes = ([low, high]) => low.map((x, i) => Math.max(Math.abs(x), Math.abs(high[i])));
const boxDot = (box, v) => {
  const terms = [0, 1, 2].map((axis) => scaled(v[axis], side(box, axis)));
  return magnitude(summed(summed(terms[0], terms[1]), terms[2]));
};
// Largest magnitude of e . (v x d), with v in one box and d in another.
const boxTriple = (box, e, d) => {
  const term = (q) => {
    const [j, k] = [(q + 1) % 3, (q + 2) % 3];
    return product(summed(scaled(e[j], side(box, k)), scaled(-e[k], side(box, j))), side(d, q));
  };
  return magnitude(summed(summed(term(0), term(1)), term(2)));
};
const mostOfPartialSums = ([x, y, z], most) => {
  const sums = [[x, 0, 0], [0, y, 0], [0, 0, z], [x, y, 0], [x, y, z]];
  return Math.max(...sums.map(most));
};
const mix = (a, d) => [a[1] * d[2] + a[2] * d[1], a[2] * d[0] + a[0] * d[2], a[0] * d[1] + a[1] * d[0]];
const inner = (v, most) => V.dot(V.abs(v), most);
const broad = (x) => [x, x, x];

// Largest magnitudes of the teapot and a batch of eye rays.
const reachOf = ({ eye, directions }) => {
  const [p, q] = [V.sub(eye, MESH.low), V.sub(eye, MESH.high)];
  const farthest = [0, 1, 2].map((i) => Math.max(Math.abs(p[i]), Math.abs(q[i])));
  const offsets = included([p, p], q);
  const reach = {
    position: Math.max(V.largest(MESH.low), V.largest(MESH.high)), origin: V.largest(eye), offset: V.largest(farthest),
    cross: 0, t: 0, directions: null,
  };
  directions.forEach((direction) => {
    const [d] = normalized(direction);
    reach.directions = reach.directions ? included(reach.directions, d) : [d, d];
    if (V.largest(mix(farthest, V.abs(d))) > reach.cross) {
      const components = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => boxTriple(offsets, axis, [d, d]));
      const products = [[d[1], d[2], d[0]], [d[2], d[0], d[1]]].map((e) => V.largest(farthest.map((x, i) => x * e[i])));
      reach.cross = Math.max(reach.cross, V.largest(components), products[0], products[1]);
    }
    reach.t = Math.max(reach.t, (V.length(farthest) / V.length(d)) * ROOM);
  });
  return reach;
};

// Scale of positions on the card, and the t at depth 1.
const unitsOf = (format, rays) => {
  const [range, reach] = [rangeOf(format), reachOf(rays)];
  const vectors = range.kind === "wide" ? 4 : room(range, 4 * range.step);
  const corners = Math.min(range.end / 4, 4);
  const scale = format[0] === FIXED
    ? Math.min(scaleInto(reach.offset, vectors), scaleInto(reach.cross, room(range, crossError(range))))
    : Math.min(scaleInto(reach.position, corners), scaleInto(Math.max(reach.offset, reach.origin), range.end / 4));
  const origin = V.times(rays.eye, scale);
  return {
    range, scale, tMax: ceilPowerOfTwo(reach.t * scale), origins: [origin, origin], directions: reach.directions,
    origin: V.narrow(origin), fixed: format[0] === FIXED,
  };
};

// Power of two by which the vertex program scales the edges and the normal of a triangle.
const edgeScaleOf = (units, corners) => {
  const { range, origins, directions: d, tMax } = units;
  if (range.kind === "wide") { return 1; }
  const [a, b, c] = corners.map((corner) => V.times(corner, units.scale));
  const [ab, ac, bc] = [V.sub(b, a), V.sub(c, a), V.sub(c, b)];
  const n = V.cross(ab, ac);
  const [texel, error] = [texelError(range), crossError(range)];
  const [ao, bo] = [a, b].map((corner) => origins.map((o) => V.sub(o, corner)));
  const components = Math.max(...[ab, ac, bc, n].map(V.largest));
  const sums = room(range, range.step * (3 * range.end + 24));
  const scale = (sum) => {
    const fits = Math.min(1 / ceilPowerOfTwo(Math.max(sum, components) / sums), powerOfTwo(64));
    return range.kind === "fixed" ? Math.min(fits, 1) : Math.min(fits, Math.max(1 / ceilPowerOfTwo(V.largest(n)), 1));
  };
  const [aoMost, boMost, dMost] = [ao, bo, d].map(magnitudes);
  const [aod, bod] = [aoMost, boMost].map((v) => V.add(mix(v, dMost), broad(error)));
  const offset = texel + 2 * range.step;
  const ndMost = inner(n, V.add(dMost, broad(texel)));
  const naoMost = units.fixed ? inner(n, aoMost) / tMax : inner(n, V.add(aoMost, broad(offset)));
  const wMost = inner(bc, bod) + inner(n, broad(texel));
  const terms = Math.max(0, ndMost, naoMost, inner(ac, aod), inner(ab, aod), inner(bc, aod), wMost);
  if (scale(terms) === scale(0)) { return scale(0); }
  const turned = (e) => mostOfPartialSums(e, (part) => boxTriple(ao, part, d)) + inner(e, broad(error));
  const nd = mostOfPartialSums(n, (part) => boxDot(d, part)) + inner(n, broad(texel));
  const nao = units.fixed ? boxDot(ao, n) / tMax : mostOfPartialSums(n, (part) => boxDot(ao, part)) + inner(n, broad(offset));
  const w = boxTriple(bo, bc, d) + inner(bc, broad(error)) + inner(n, broad(texel));
  return scale(Math.max(0, nd, nao, turned(ac), turned(ab), turned(bc), w));
};

// Vertex programs, instruction by instruction in single precision: `one_origin.vsa` and `seven_vectors.vsa`.
const S = {
  times: (a, s) => a.map((x) => f(x * s)),
  sub: (a, b) => a.map((x, i) => f(x - b[i])),
  dot: (a, b) => f(f(f(a[0] * b[0]) + f(a[1] * b[1])) + f(a[2] * b[2])),
  cross: (a, b) => [[1, 2], [2, 0], [0, 1]].map(([j, k]) => f(f(-a[k] * b[j]) + f(a[j] * b[k]))),
};
const FIXED_COMPONENTS = [2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 16, 17, 18, 20, 21, 22];
const FLOAT_COMPONENTS = [4, 5, 6, 8, 9, 10, 12, 13, 14, 16, 17, 18, 20, 21, 22, 24, 25, 26, 35];

// Attributes of a triangle, and whether its quad is drawn.
const attributesOf = (units, corners) => {
  const k = f(edgeScaleOf(units, corners));
  const [a, b, c] = corners.map((corner) => S.times(corner, f(units.scale)));
  const [ab, ac, bc] = [S.sub(b, a), S.sub(c, a), S.sub(c, b)];
  const n = S.times(S.cross(ab, ac), k);
  const edges = [ab, ac, bc].flatMap((edge) => S.times(edge, k));
  if (!units.fixed) { return { drawn: true, values: [...a, ...b, ...n, ...edges, 1] }; }
  const ao = S.sub(units.origin, a);
  const nao = S.dot(n, ao);
  return { drawn: !(nao < 0), values: [f(nao * f(1 / units.tMax)), ...ao, ...n, ...edges] };
};

// Ray textures, 12 words per pixel: four for each sampler.
const rayWordsOf = (units, rays) => {
  const words = new Uint32Array(12 * rays.directions.length);
  const floats = new Float32Array(words.buffer);
  const most = Math.min(units.range.end - 2 * units.range.step, 1);
  const code = (x) => {
    const clamped = Math.min(Math.max(x, -most), most);
    return Math.sign(clamped) * Math.round(Math.abs(clamped) * 32767);
  };
  rays.directions.forEach((direction, pixel) => {
    const [d] = normalized(direction);
    if (units.fixed) {
      words.set(d.map(code), 12 * pixel + 4);
      // The third component is in the second texture.
      words[12 * pixel + 8] = words[12 * pixel + 6];
    } else {
      floats.set([...units.origin, 1, ...V.narrow(d), 1], 12 * pixel);
    }
  });
  return words;
};
