// Vectors, camera and buckets of rays, in doubles: the same operations as on the emulator's host, so the same bits.

const V = {
  add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
  sub: (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
  times: (a, s) => [a[0] * s, a[1] * s, a[2] * s],
  over: (a, s) => [a[0] / s, a[1] / s, a[2] / s],
  abs: (a) => [Math.abs(a[0]), Math.abs(a[1]), Math.abs(a[2])],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]],
  length: (a) => Math.sqrt(V.dot(a, a)),
  unit: (a) => V.over(a, V.length(a)),
  largest: (a) => Math.max(Math.abs(a[0]), Math.abs(a[1]), Math.abs(a[2])),
  narrow: (a) => [Math.fround(a[0]), Math.fround(a[1]), Math.fround(a[2])],
};

// Exponent of the largest power of two that is at most x.
const floorLog2 = (x) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, x);
  return ((view.getUint32(0) >>> 20) & 0x7ff) - 1023;
};
// 2^n as a normal double, built from its bits.
const powerOfTwo = (n) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setUint32(0, Math.min(Math.max(n + 1023, 1), 2046) * 2 ** 20);
  return view.getFloat64(0);
};
const ceilPowerOfTwo = (x) => {
  if (x === 0) { return 1; }
  const floor = powerOfTwo(floorLog2(x));
  return floor === x ? floor : 2 * floor;
};
const scaleInto = (extent, range) => (extent === 0 ? 1 : 1 / ceilPowerOfTwo(extent / range));
// A direction times a power of two, so that its largest component lies in [1/2, 1).
const normalized = (direction) => {
  const power = powerOfTwo(-1 - floorLog2(V.largest(direction)));
  return [V.times(direction, power), power];
};

// The teapot.
const MESH = (() => {
  const [numbers, indices] = [floatsOf(DATA.teapot.positions), wordsOf(DATA.teapot.triangles)];
  const positions = Array.from({ length: numbers.length / 3 }, (_, i) => Array.from(numbers.subarray(3 * i, 3 * i + 3)));
  const triangles = Array.from({ length: indices.length / 3 }, (_, i) => Array.from(indices.subarray(3 * i, 3 * i + 3)));
  const corners = triangles.map((triangle) => triangle.map((index) => positions[index]));
  const bound = (pick) => [0, 1, 2].map((axis) => positions.reduce((all, p) => pick(all, p[axis]), positions[0][axis]));
  const normals = positions.map(() => [0, 0, 0]);
  triangles.forEach((triangle, t) => {
    const [a, b, c] = corners[t];
    const normal = V.cross(V.sub(b, a), V.sub(c, a));
    triangle.forEach((index) => { normals[index] = V.add(normals[index], normal); });
  });
  return { triangles, corners, low: bound(Math.min), high: bound(Math.max), normals: normals.map(V.unit) };
})();

// Eye rays of a square picture: the eye and a direction per pixel, in single precision.
const eyeRays = (eye, target, side) => {
  const forward = V.unit(V.sub(target, eye));
  const sideways = V.unit(V.cross(forward, [0, 0, 1]));
  const upward = V.cross(sideways, forward);
  const half = Math.fround(DATA.teapot.tan_half_height);
  const [right, up] = [V.times(sideways, half), V.times(upward, half)];
  const directions = [];
  for (let y = 0; y < side; y += 1) {
    for (let x = 0; x < side; x += 1) {
      const [across, upwards] = [(2 * (x + 0.5)) / side - 1, 1 - (2 * (y + 0.5)) / side];
      directions.push(V.narrow(V.add(V.add(forward, V.times(right, across)), V.times(up, upwards))));
    }
  }
  return { eye, side, directions };
};

const MARGIN_SHARE = 0.25;
const MARGIN = 1 / 256;
const BUCKET = 32;

// Triangles that rays of a bucket may hit, in ascending order (section 5.3 of the paper; `bundle.rs`).
const nearTriangles = ({ eye, side, directions }, left, top) => {
  const all = [];
  for (let y = top; y < Math.min(top + BUCKET, side); y += 1) {
    for (let x = left; x < Math.min(left + BUCKET, side); x += 1) { all.push(V.unit(directions[y * side + x])); }
  }
  const forward = V.unit(all.reduce(V.add, [0, 0, 0]));
  const right = V.unit(V.cross(forward, Math.abs(forward[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0]));
  const axes = [right, V.cross(right, forward)];
  const project = (v) => {
    const depth = V.dot(v, forward);
    return depth > 1e-3 * V.length(v) ? axes.map((axis) => V.dot(v, axis) / depth) : null;
  };
  const points = all.map(project);
  if (points.includes(null)) { return MESH.corners.map((_, triangle) => triangle); }
  const bounds = [0, 1].map((axis) => {
    const low = points.reduce((least, p) => Math.min(least, p[axis]), Infinity);
    const high = points.reduce((most, p) => Math.max(most, p[axis]), -Infinity);
    const margin = MARGIN_SHARE * (high - low) + MARGIN;
    return [low - margin, high + margin];
  });
  const mayMeet = (corners) => {
    const offsets = corners.map((p) => V.sub(p, eye));
    const [a, b, c] = offsets.map(project);
    if (!a || !b || !c) { return offsets.some((p) => V.dot(p, forward) > 0); }
    return bounds.every(([low, high], axis) => (
      Math.max(a[axis], b[axis], c[axis]) >= low && Math.min(a[axis], b[axis], c[axis]) <= high
    ));
  };
  return MESH.corners.flatMap((corners, triangle) => (mayMeet(corners) ? [triangle] : []));
};

// The buckets of a picture, row by row, each with its triangles.
const bucketsOf = (rays) => {
  const buckets = [];
  for (let top = 0; top < rays.side; top += BUCKET) {
    for (let left = 0; left < rays.side; left += BUCKET) { buckets.push(nearTriangles(rays, left, top)); }
  }
  return buckets;
};

// Equations 1 to 8 of the paper in doubles.
const crossingOf = (o, d, [a, b, c]) => {
  const [ab, ac, bc] = [V.sub(b, a), V.sub(c, a), V.sub(c, b)];
  const n = V.cross(ab, ac);
  const [ao, bo] = [V.sub(o, a), V.sub(o, b)];
  const nd = V.dot(n, d);
  const aod = V.cross(ao, d);
  return { nd, t: -V.dot(n, ao) / nd, u: V.dot(ac, aod), v: -V.dot(ab, aod), w: -V.dot(bc, V.cross(bo, d)) };
};

// First front face per pixel, in doubles; -1 for none. Not exact: for views without exact hits in the page.
const firstHits = (rays, buckets) => {
  const columns = Math.ceil(rays.side / BUCKET);
  return rays.directions.map((d, pixel) => {
    const [x, y] = [pixel % rays.side, Math.floor(pixel / rays.side)];
    let [first, nearest] = [-1, Infinity];
    buckets[Math.floor(y / BUCKET) * columns + Math.floor(x / BUCKET)].forEach((triangle) => {
      const { nd, t, u, v, w } = crossingOf(rays.eye, d, MESH.corners[triangle]);
      if (nd < 0 && t >= 0 && t < nearest && u >= 0 && v >= 0 && w >= 0) { [first, nearest] = [triangle, t]; }
    });
    return first;
  });
};

// Color of a ray's hit: two lights on smooth normals, as in the emulator's pictures.
const shadeOf = (eye, direction, triangle) => {
  if (triangle < 0) { return [0.012, 0.016, 0.024]; }
  const { nd, u, v, w } = crossingOf(eye, direction, MESH.corners[triangle]);
  const sign = nd < 0 ? 1 : -1;
  const weights = [w, u, v].map((x) => Math.max(x * sign, 0));
  const sum = weights[0] + weights[1] + weights[2];
  const shares = sum > 0 ? weights.map((x) => x / sum) : [1 / 3, 1 / 3, 1 / 3];
  const indices = MESH.triangles[triangle];
  const normal = V.unit(shares.reduce((all, share, i) => V.add(all, V.times(MESH.normals[indices[i]], share)), [0, 0, 0]));
  const view = V.unit(V.times(direction, -1));
  const facing = V.dot(normal, view) < 0 ? V.times(normal, -1) : normal;
  const key = V.unit([-0.35, -0.55, 0.9]);
  const diffuse = 0.05 + 0.25 * Math.max(V.dot(facing, view), 0) + 0.75 * Math.max(V.dot(facing, key), 0);
  const highlight = Math.max(V.dot(facing, V.unit(V.add(key, view))), 0) ** 32;
  return [0.78, 0.6, 0.42].map((albedo) => albedo * diffuse + 0.25 * highlight);
};
