// The adapter's own floats, compared with the exact results rounded to nearest.

const DISTANCES = [[0, 0, "0"], [1, 1, "1"], [2, 2, "2"], [3, 4, "3 to 4"], [5, 16, "5 to 16"], [17, Infinity, "more"]];
const REAL = {
  f32: {
    head: "alias real = f32;\nfn from_bits(x: u32) -> real { return bitcast<f32>(x); }\nfn to_bits(x: real) -> u32 { return bitcast<u32>(x); }\n",
    mantissa: 23, exponent: 8,
  },
  f16: {
    head: "enable f16;\nalias real = f16;\nfn from_bits(x: u32) -> real { return bitcast<vec2<f16>>(x).x; }\nfn to_bits(x: real) -> u32 { return bitcast<u32>(vec2<f16>(x, 0h)); }\n",
    mantissa: 10, exponent: 5,
  },
};

// Maps consecutive numbers to consecutive integers; both zeros are 0.
const orderOf = (bits, { mantissa, exponent }) => {
  const size = bits & (2 ** (mantissa + exponent) - 1);
  return bits >= 2 ** (mantissa + exponent) ? -size : size;
};
const classOf = (bits, { mantissa, exponent }) => {
  const field = (bits >>> mantissa) & (2 ** exponent - 1);
  const rest = bits & (2 ** mantissa - 1);
  if (field === 2 ** exponent - 1) { return "special"; }
  return field === 0 && rest !== 0 ? "subnormal" : "normal";
};

const judgeNative = (row, column, type, found) => {
  const real = REAL[type];
  const { name: operation, operands, accuracy } = SUM.operations[row];
  const [words, expected] = [operandsOf(row, column), expectedOf(row, column)];
  const line = {
    type, operation, sets: 0, distances: DISTANCES.map(() => 0), largest: 0, subnormal: 0, subnormalDiffer: 0, special: 0,
    accuracy: type === "f32" ? accuracy : null,
  };
  for (let set = 0; set < SUM.sets; set += 1) {
    const bits = found[set];
    const order = orderOf(bits, real);
    const all = [...words.subarray(3 * set, 3 * set + operands), expected[set]].map((x) => classOf(x, real));
    // The emulator takes the reciprocal root of the magnitude, as Direct3D does.
    const isNegativeRoot = operation === "rsq" && orderOf(words[3 * set], real) < 0;
    if (all.includes("special") || isNegativeRoot) { line.special += 1; continue; }
    const distance = classOf(bits, real) === "special" ? Infinity : Math.abs(order - orderOf(expected[set], real));
    if (all.includes("subnormal")) {
      line.subnormal += 1;
      line.subnormalDiffer += distance === 0 ? 0 : 1;
      continue;
    }
    line.sets += 1;
    line.distances[DISTANCES.findIndex(([low, high]) => low <= distance && distance <= high)] += 1;
    line.largest = Math.max(line.largest, distance);
  }
  line.largest = Number.isFinite(line.largest) ? line.largest : "infinite";
  return line;
};

const nativeTable = (type, format) => {
  const scroll = add(at("native"), "div", { className: "scroll", tabindex: 0, role: "region", "aria-label": `Errors of ${type}` });
  const table = add(scroll, "table");
  add(table, "caption", {}, `${type}, on the operands of ${format}: results by distance in ULP`);
  const head = add(add(table, "thead"), "tr");
  const names = ["operation", ...DISTANCES.map(([, , name]) => name), "largest", "subnormal sets that differ"];
  (type === "f32" ? [...names, "WGSL requires"] : names).forEach((name) => add(head, "th", { scope: "col" }, name));
  return add(table, "tbody");
};

const showNative = (body, line) => {
  const row = add(body, "tr");
  add(row, "th", { scope: "row" }, line.operation);
  line.distances.forEach((n, i) => {
    const cell = add(row, "td", { className: "number share" }, n === 0 ? "" : count(n));
    cell.style.setProperty("--share", `${(100 * n) / Math.max(line.sets, 1)}%`);
    if (i === 0) { cell.classList.add("exact"); }
  });
  add(row, "td", { className: "number" }, typeof line.largest === "number" ? count(line.largest) : line.largest);
  add(row, "td", { className: "number" }, `${count(line.subnormalDiffer)} of ${count(line.subnormal)}`);
  if (line.type === "f32") { add(row, "td", {}, line.accuracy); }
};

// Runs the adapter's own operations in the types that it supports.
const runNative = async (device) => {
  for (const [column, { native: type, name }] of SUM.formats.entries()) {
    if (!type || (type === "f16" && !device.features.has("shader-f16"))) { continue; }
    said(`Compiling the GPU's own ${type} ...`);
    const pipeline = await compiled(device, REAL[type].head + SUM.native.constants + SUM.native.text, "native_main");
    const cells = SUM.operations.map((_, row) => [row, column]);
    const found = await runCells(device, pipeline, cells);
    const body = nativeTable(type, name);
    cells.forEach(([row], cell) => {
      const line = judgeNative(row, column, type, found.subarray(SUM.sets * cell, SUM.sets * (cell + 1)));
      FOUND.native.push(line);
      showNative(body, line);
    });
    show();
    await breathe();
  }
  if (!device.features.has("shader-f16")) { add(at("native"), "p", {}, "This GPU, or its driver, has no f16 in shaders."); }
};
