// The table of operations by formats, in integers: operands (operands.rs has the same generator), runs, comparison.

const SUM = DATA.arithmetic;

// The PCG RXS-M-XS permutation of a word, after one step of its congruential generator.
const mixed = (word) => {
  const state = (Math.imul(word, 747796405) + 2891336453) >>> 0;
  const permuted = Math.imul((state >>> ((state >>> 28) + 4)) ^ state, 277803737) >>> 0;
  return ((permuted >>> 22) ^ permuted) >>> 0;
};

const operandOf = ({ sign, high, low, near, shift, middle }, counter, k, before) => {
  const random = mixed((Math.imul(counter, 4) + k) >>> 0);
  const choice = mixed((random ^ 0x9e3779b9) >>> 0);
  const bits = random & (sign | high | low);
  const kind = choice & 15;
  if (kind >= 8 && kind <= 11 && k > 0) { return (before ^ (bits & near)) >>> 0; }
  if ((kind === 12 || kind === 13) && middle > 0) { return ((bits & ~high) | ((middle + ((choice >>> 8) & 7)) << shift)) >>> 0; }
  const kinds = [
    () => bits & ~low, () => bits | low, () => bits & ~high, () => bits | high, () => bits & sign,
    () => bits | high | low, () => (bits & sign) | high, () => (bits & sign) | 1,
  ];
  return (kind < kinds.length ? kinds[kind]() : bits) >>> 0;
};

// Operands of a cell, three per set.
const operandsOf = (row, column) => {
  const { bits } = SUM.formats[column];
  const words = new Uint32Array(3 * SUM.sets);
  for (let set = 0; set < SUM.sets; set += 1) {
    const counter = (row * SUM.formats.length + column) * SUM.sets + set;
    let before = 0;
    for (let k = 0; k < 3; k += 1) {
      before = operandOf(bits, counter, k, before);
      words[3 * set + k] = before;
    }
  }
  return words;
};

// Results of a cell that the emulator computed.
const expectedOf = (row, column) => {
  const bytes = bytesOf(SUM.expected[row][column]);
  const width = bytes.length / SUM.sets;
  return Uint32Array.from({ length: SUM.sets }, (_, set) => {
    let bits = 0;
    for (let b = width - 1; b >= 0; b -= 1) { bits = ((bits << 8) | bytes[width * set + b]) >>> 0; }
    return bits;
  });
};

// Runs cells, given as row and column, with one pipeline; the results of all cells, one after the other.
const runCells = async (device, pipeline, cells) => {
  const jobs = new Uint32Array(12 * cells.length);
  const operands = new Uint32Array(3 * SUM.sets * cells.length);
  cells.forEach(([row, column], cell) => {
    jobs.set([...SUM.formats[column].words, SUM.operations[row].word, cell * SUM.sets, SUM.sets], 12 * cell);
    operands.set(operandsOf(row, column), 3 * SUM.sets * cell);
  });
  const results = storageOf(device, new Uint32Array(SUM.sets * cells.length));
  const buffers = { 0: storageOf(device, jobs), 1: storageOf(device, operands), 2: results };
  run(device, pipeline, buffers, Math.ceil(SUM.sets / 64), cells.length);
  const found = await readBack(device, results, 0, SUM.sets * cells.length);
  Object.values(buffers).forEach((buffer) => buffer.destroy());
  return found;
};

const sayDifference = (row, column, { operation, format, wrong, first }) => {
  const item = add(at("differences"), "p", { id: `cell-${row}-${column}`, className: "failed" });
  item.append(`${operation} in ${format}: wrong results: ${count(wrong)}. First: operands ${first.operands.join(" ")}, `);
  item.append(`expected ${first.expected}, found ${first.found}.`);
  return item.id;
};

// Compares a cell and shows it.
const judgeCell = (row, column, found) => {
  const { name: format, width } = SUM.formats[column];
  const { name: operation, operands } = SUM.operations[row];
  const expected = expectedOf(row, column);
  const cell = { operation, format, sets: SUM.sets, wrong: 0 };
  for (let set = 0; set < SUM.sets; set += 1) {
    if (found[set] !== expected[set]) {
      if (cell.wrong === 0) {
        const digits = Math.ceil(width / 4);
        const taken = operandsOf(row, column).subarray(3 * set, 3 * set + operands);
        cell.first = {
          operands: Array.from(taken, (bits) => hex(bits, digits)), expected: hex(expected[set], digits), found: hex(found[set], digits),
        };
      }
      cell.wrong += 1;
    }
  }
  FOUND.operations.push(cell);
  const place = at(`at-${row}-${column}`);
  place.textContent = "";
  place.className = `number ${cell.wrong === 0 ? "equal" : "wrong"}`;
  if (cell.wrong === 0) {
    place.textContent = "0";
  } else {
    add(place, "a", { href: `#${sayDifference(row, column, cell)}` }, count(cell.wrong));
  }
  return cell.wrong;
};

const cellTable = () => {
  const table = at("cells");
  add(table, "caption", {}, `Number of wrong results among the ${count(SUM.sets)} operand sets of each cell`);
  const head = add(add(table, "thead"), "tr");
  add(head, "th", { scope: "col" }, "operation");
  SUM.formats.forEach(({ name, title }) => {
    const cell = add(head, "th", { scope: "col" }, name);
    if (title !== name) { add(add(cell, "div", { className: "small" }), "span", {}, title); }
  });
  const body = add(table, "tbody");
  SUM.operations.forEach(({ name }, row) => {
    const line = add(body, "tr");
    add(line, "th", { scope: "row" }, name);
    SUM.formats.forEach((_, column) => add(line, "td", { id: `at-${row}-${column}`, className: "number" }, "-"));
  });
};

// Runs all cells, shader by shader; returns the number of wrong results.
const runArithmetic = async (device) => {
  let wrong = 0;
  for (const [number, { entry, text }] of SUM.shaders.entries()) {
    said(`Compiling operations (${number + 1} of ${SUM.shaders.length}) ...`);
    const pipeline = await compiled(device, text, entry);
    const rows = SUM.operations.flatMap(({ shader }, row) => (shader === number ? [row] : []));
    for (const row of rows) {
      const cells = SUM.formats.map((_, column) => [row, column]);
      const found = await runCells(device, pipeline, cells);
      cells.forEach(([, column], cell) => {
        wrong += judgeCell(row, column, found.subarray(SUM.sets * cell, SUM.sets * (cell + 1)));
      });
      show();
      await breathe();
    }
  }
  return wrong;
};

// All cells as lines: operation, format, operands, expected result, in hexadecimal.
const vectorText = () => {
  const lines = [`# crossbar ${DATA.version}: operation;format;operands;result, bit patterns in hexadecimal`];
  SUM.operations.forEach(({ name, operands }, row) => {
    SUM.formats.forEach(({ name: format, width }, column) => {
      const digits = Math.ceil(width / 4);
      const [words, expected] = [operandsOf(row, column), expectedOf(row, column)];
      for (let set = 0; set < SUM.sets; set += 1) {
        const taken = Array.from(words.subarray(3 * set, 3 * set + operands), (bits) => hex(bits, digits));
        lines.push(`${name};${format};${taken.join(" ")};${hex(expected[set], digits)}`);
      }
    });
  });
  return `${lines.join("\n")}\n`;
};
