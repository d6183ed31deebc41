// The teapot on the visitor's GPU: pictures in any format; fixed views are compared bit for bit.

const TEAPOT = DATA.teapot;
const SINGLE_WORDS = [1, 8, 23, 0, 2, 0, 0, 0];
const NO_HIT = 0xffffffff;
// Triangles per dispatch, so that no dispatch runs for seconds.
const TRIANGLES_AT_ONCE = 32;
const IN_OUT_ROWS = 66;

const [VERDICT_NEIGHBOUR, VERDICT_TRIANGLE, VERDICT_FALSE, VERDICT_LEAK] = [2, 3, 4, 5];

// Raw value of 1 in a fixed-point format.
const oneOf = ([, upper, frac]) => (upper === 0 ? 2 ** frac - 1 : 2 ** frac);

// The program in the machine's code, for a format and a scale of depths.
const codeOf = (format, units) => {
  const program = units.fixed ? TEAPOT.fixed : TEAPOT.float;
  const words = Uint32Array.from(program.words);
  if (units.fixed) { program.ones.forEach((place) => { words[place] = oneOf(format); }); }
  return { words, slots: program.slots, scales: program.depth_scales };
};

// Data of a picture that do not depend on the format, computed once per view.
const sceneOf = (eye, target) => {
  const rays = eyeRays(eye, target, TEAPOT.side);
  return { rays, buckets: bucketsOf(rays) };
};

const drawWords = (format, units, components, slots, side) => {
  const words = new Uint32Array(160);
  for (let k = 0; k < 16; k += 1) { words.set(format, 8 * k); }
  words.set(SINGLE_WORDS, 16);
  if (units.fixed) { words[24 + 4] = 1; }
  words.set(SINGLE_WORDS, 32);
  const pixels = side * side;
  words.set([
    pixels / 4, side / 2, slots, Math.ceil(side / BUCKET), components.length, units.fixed ? 0 : 1, 12 * pixels, pixels,
    0, TRIANGLES_AT_ONCE, units.fixed ? 1 : 0,
  ], 128);
  words.set(components, 140);
  return words;
};

// Lists of the buckets' triangles: first word and number of each bucket, then the lists.
const listWords = (buckets) => {
  const words = [];
  let first = 2 * buckets.length;
  buckets.forEach((bucket) => { words.push(first, bucket.length); first += bucket.length; });
  return Uint32Array.from([...words, ...buckets.flat()]);
};

// Draws a view in a format; returns triangle and t per pixel.
const draw = async ({ device, trace, rays: rayPipeline }, scene, format) => {
  const { rays } = scene;
  const pixels = rays.directions.length;
  const units = unitsOf(format, rays);
  const components = units.fixed ? FIXED_COMPONENTS : FLOAT_COMPONENTS;
  const attributes = MESH.corners.map((corners) => attributesOf(units, corners));
  const setups = Float32Array.from(attributes.flatMap(({ values }) => values));
  const buckets = scene.buckets.map((bucket) => bucket.filter((triangle) => attributes[triangle].drawn));
  const code = codeOf(format, units);
  const scale = new Uint32Array(Float32Array.of(1 / units.tMax).buffer);
  const words = drawWords(format, units, components, code.slots, rays.side);
  const video = new Uint32Array(14 * pixels);
  video.set(rayWordsOf(units, rays));
  video.fill(NO_HIT, 12 * pixels, 13 * pixels);
  video.fill(units.fixed ? 0xffffff : 0x3f800000, 13 * pixels);
  // The constant 1 / t_max is converted to the register format, as the emulator converts constants.
  const scaleInFormat = units.fixed ? [] : await convertedScale({ device, rayPipeline }, format, scale);
  code.scales.forEach((place) => { if (!units.fixed) { [code.words[place]] = scaleInFormat; } });
  const buffers = {
    0: storageOf(device, words), 1: storageOf(device, new Uint32Array(setups.buffer)), 2: storageOf(device, listWords(buckets)),
    4: storageOf(device, video), 5: storageOf(device, code.words),
    6: storageOf(device, new Uint32Array(4 * (code.slots + IN_OUT_ROWS) * (pixels / 4))),
  };
  run(device, rayPipeline, { 0: buffers[0], 4: buffers[4] }, Math.ceil((12 * pixels) / 64));
  const longest = Math.max(...buckets.map((bucket) => bucket.length));
  for (let first = 0; first < longest; first += TRIANGLES_AT_ONCE) {
    device.queue.writeBuffer(buffers[0], 4 * 136, Uint32Array.of(first, TRIANGLES_AT_ONCE));
    run(device, trace, buffers, Math.ceil(pixels / 4 / 64));
  }
  const found = await readBack(device, buffers[4], 12 * pixels, 2 * pixels);
  Object.values(buffers).forEach((buffer) => buffer.destroy());
  return hitsOf(units, rays, found.subarray(0, pixels), found.subarray(pixels));
};

// Converts a word of single precision to the register format, with the kernel that fills ray textures.
const convertedScale = async ({ device, rayPipeline }, format, scale) => {
  const words = drawWords(format, { fixed: false }, [], 0, 2);
  const [draws, video] = [storageOf(device, words), storageOf(device, Uint32Array.from({ length: 48 }, () => scale[0]))];
  run(device, rayPipeline, { 0: draws, 4: video }, 1);
  const found = await readBack(device, video, 0, 4);
  [draws, video].forEach((buffer) => buffer.destroy());
  return found;
};

// Triangles, and t in multiples of the rays' directions as bits of single precision.
const hitsOf = (units, rays, triangles, depths) => {
  const singles = new Float32Array(Uint32Array.from(depths).buffer);
  const t = Float32Array.from(rays.directions, (direction, pixel) => {
    if (triangles[pixel] === NO_HIT) { return Infinity; }
    const depth = units.fixed ? f(depths[pixel] / 0xffffff) : singles[pixel];
    return ((depth * units.tMax) / units.scale) * normalized(direction)[1];
  });
  return { triangles: Uint32Array.from(triangles), t: new Uint32Array(t.buffer) };
};

// FNV-1a of the words' bytes, 64 bits.
const digestOf = ({ triangles, t }) => {
  // Computed in two halves of 32 bits: the prime is 2^40 + 0x1b3.
  let [high, low] = [0xcbf29ce4, 0x84222325];
  const bytes = [triangles, t].flatMap((words) => [...new Uint8Array(words.buffer, words.byteOffset, words.byteLength)]);
  bytes.forEach((byte) => {
    low = (low ^ byte) >>> 0;
    const product = low * 0x1b3;
    high = (Math.imul(high, 0x1b3) + Math.floor(product / 2 ** 32) + (low << 8)) >>> 0;
    low = product >>> 0;
  });
  return hex(high, 8).toLowerCase() + hex(low, 8).toLowerCase();
};

const touching = (a, b) => MESH.corners[a].some((p) => MESH.corners[b].some((q) => p.every((x, i) => x === q[i])));

// Verdict per pixel, compared with the exact first triangles (-1 for none), including all that tie.
const verdictsOf = ({ triangles }, first, ties) => Array.from(triangles, (triangle, pixel) => {
  const hit = triangle === NO_HIT ? -1 : triangle;
  if (hit === first[pixel] || ties.get(pixel)?.includes(hit)) { return hit < 0 ? 0 : 1; }
  if (hit < 0) { return VERDICT_LEAK; }
  if (first[pixel] < 0) { return VERDICT_FALSE; }
  return touching(hit, first[pixel]) ? VERDICT_NEIGHBOUR : VERDICT_TRIANGLE;
});

const paint = (canvas, { rays }, { triangles }, verdicts) => {
  const side = TEAPOT.side;
  Object.assign(canvas, { width: side, height: side });
  const image = new ImageData(side, side);
  triangles.forEach((triangle, pixel) => {
    const color = verdicts[pixel] > 1
      ? TEAPOT.verdicts[verdicts[pixel]].color
      : shadeOf(rays.eye, rays.directions[pixel], triangle === NO_HIT ? -1 : triangle).map((x) => 255 * Math.sqrt(Math.min(Math.max(x, 0), 1)));
    image.data.set([...color, 255], 4 * pixel);
  });
  canvas.getContext("2d").putImageData(image, 0, 0);
};

// A fixed view with its exact hits.
const fixedScene = (view) => ({
  ...sceneOf(view.eye, view.target),
  first: Int32Array.from(wordsOf(view.exact)),
  ties: new Map(view.ties),
});

const wordsPerPixel = (hits) => ({ triangles: hits.slice(0, hits.length / 2), t: hits.slice(hits.length / 2) });

// Draws every fixed view and compares all bits; returns how many pictures differ.
const runFixedViews = async (gpu) => {
  let different = 0;
  for (const [v, view] of TEAPOT.views.entries()) {
    const scene = fixedScene(view);
    for (const [p, picture] of view.pictures.entries()) {
      said(`Drawing the teapot in ${picture.format}, seen ${view.name} ...`);
      const hits = await draw(gpu, scene, picture.words);
      const [digest, expected] = [digestOf(hits), wordsPerPixel(wordsOf(picture.hits))];
      const line = { view: view.name, format: picture.format, expected: picture.digest, found: digest };
      const figure = at(`fixed-${v}-${p}`);
      const canvas = document.createElement("canvas");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", figure.querySelector("img").alt.replace("The teapot", "The teapot on your GPU"));
      paint(canvas, scene, hits, verdictsOf(hits, scene.first, scene.ties));
      figure.querySelector("img").replaceWith(canvas);
      const place = figure.querySelector(".found");
      place.textContent = "";
      place.append("your GPU ");
      add(place, "code", {}, digest);
      if (digest === picture.digest) {
        figure.classList.add("equal");
        place.append(": equal");
      } else {
        different += 1;
        figure.classList.add("wrong");
        const pixel = hits.triangles.findIndex((triangle, i) => triangle !== expected.triangles[i] || hits.t[i] !== expected.t[i]);
        const told = ({ triangles, t }) => (triangles[pixel] === NO_HIT ? "nothing" : `triangle ${triangles[pixel]} at t ${hex(t[pixel], 8)}`);
        line.first = { x: pixel % TEAPOT.side, y: Math.floor(pixel / TEAPOT.side), expected: told(expected), found: told(hits) };
        place.append(`: pixel (${line.first.x}, ${line.first.y}) is ${line.first.found} in place of ${line.first.expected}`);
      }
      FOUND.teapot.push(line);
      show();
      await breathe();
    }
  }
  return different;
};

const teapotPipelines = async (device) => {
  said("Compiling the intersection program ...");
  const [trace, rays] = TEAPOT.shaders;
  return { device, trace: await compiled(device, trace, "trace_main"), rays: await compiled(device, rays, "rays_main") };
};
