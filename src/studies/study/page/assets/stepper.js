// Stepping through a program at one pixel.

const OUTCOMES = ["nothing drawn", "killed by the program", "alpha test failed", "depth test failed", "drawn"];
const CELL = 18;

const chosen = { program: 0, variant: 0, pixel: 0, step: 0 };
const chosenVariant = () => VARIANTS[chosen.program][chosen.variant];
// Instructions follow the input registers.
const firstStep = ({ entries }) => entries.findIndex(({ line }) => line !== null);
const placeOf = (pixel) => `(${pixel % STEPS.side}, ${Math.floor(pixel / STEPS.side)})`;

const drawPixels = () => {
  const variant = chosenVariant();
  const canvas = at("pixels");
  const side = STEPS.side;
  Object.assign(canvas, { width: side * CELL, height: side * CELL });
  const context = canvas.getContext("2d");
  const style = getComputedStyle(document.documentElement);
  for (let pixel = 0; pixel < PIXELS; pixel += 1) {
    const [x, y] = [(pixel % side) * CELL, Math.floor(pixel / side) * CELL];
    context.fillStyle = `rgb(${variant.colors.subarray(3 * pixel, 3 * pixel + 3).join(",")})`;
    context.fillRect(x, y, CELL, CELL);
    if (variant.wrong && variant.wrong[pixel] >= 0) {
      Object.assign(context, { strokeStyle: style.getPropertyValue("--bad"), lineWidth: 3 });
      context.strokeRect(x + 2, y + 2, CELL - 4, CELL - 4);
    }
  }
  const [x, y] = [(chosen.pixel % side) * CELL, Math.floor(chosen.pixel / side) * CELL];
  Object.assign(context, { strokeStyle: style.getPropertyValue("--paper"), lineWidth: 4 });
  context.strokeRect(x + 1, y + 1, CELL - 2, CELL - 2);
  Object.assign(context, { strokeStyle: style.getPropertyValue("--link"), lineWidth: 2 });
  context.strokeRect(x, y, CELL, CELL);
};

const verdictOf = (variant) => {
  if (!variant.wrong) { return ["Stored trace: nothing is compared.", ""]; }
  const pixels = variant.wrong.filter((k) => k >= 0).length;
  const steps = `${variant.entries.length} inputs and steps at ${PIXELS} pixels`;
  return pixels === 0
    ? [`Your GPU's whole numbers: ${steps} have the emulator's bits.`, "equal"]
    : [`Your GPU's whole numbers differ at ${counted(pixels, "pixel")}, first at ${placeOf(variant.wrong.findIndex((k) => k >= 0))}.`, "wrong"];
};

// Table of the components that the step wrote.
const showWritten = (variant, k) => {
  const { pixel } = chosen;
  const body = at("written");
  body.replaceChildren();
  const entry = variant.entries[k];
  const { name, words, width } = variant.formats[entry.format];
  const digits = Math.ceil(width / 4);
  const [found, native] = [variant.found && patternsOf(variant, pixel, k), nativeOf(variant, pixel, k)];
  entry.names.forEach((register, c) => {
    const bits = variant.stored[pixel][k][c];
    const value = numberOf(bits, words);
    const row = add(body, "tr");
    add(row, "th", { scope: "row" }, register);
    add(row, "td", { className: "number" }, decimal(value));
    add(add(row, "td", { className: "number" }), "code", {}, hex(bits, digits));
    const own = add(row, "td", { className: "number" });
    if (found) { add(own, "code", {}, hex(found[c], digits)); } else { own.append(variant.found ? "another step" : "-"); }
    if (variant.found) { own.classList.add(found && found[c] === bits ? "equal" : "wrong"); }
    if (!native) {
      ["-", "-", "-"].forEach((text) => add(row, "td", { className: "number" }, text));
      return;
    }
    const single = singleOf(native[c]);
    const apart = Math.abs(single - value) / unitOf(Number.isFinite(value) ? value : 1, words);
    add(row, "td", { className: "number" }, decimal(single));
    add(add(row, "td", { className: "number" }), "code", {}, hex(native[c], 8));
    add(row, "td", { className: "number" }, sameNumber(single, value) ? "0" : decimal(Number(apart.toPrecision(3))));
  });
  at("written-caption").textContent = `${entry.line === null ? "An input register" : "What the instruction writes"}, in ${name}`;
};

// The registers' values after the step.
const showRegisters = (variant, k) => {
  const registers = new Map();
  variant.entries.slice(0, k + 1).forEach(({ names, format }, at) => names.forEach((name, c) => {
    const [register, component] = name.split(/\.(?=[xyzw]$)/);
    if (!registers.has(register)) { registers.set(register, {}); }
    const text = decimal(numberOf(variant.stored[chosen.pixel][at][c], variant.formats[format].words));
    registers.get(register)[component ?? "x"] = { text, now: at === k };
  }));
  const body = at("registers");
  body.replaceChildren();
  [...registers.keys()].sort().forEach((register) => {
    const row = add(body, "tr");
    add(row, "th", { scope: "row" }, register);
    ["x", "y", "z", "w"].forEach((c) => {
      const value = registers.get(register)[c];
      add(row, "td", { className: value?.now ? "number now" : "number" }, value?.text ?? "");
    });
  });
};

const markLines = (variant, k) => {
  const { pixel } = chosen;
  const parting = partingOf(variant, pixel);
  const wrongLine = variant.wrong && variant.wrong[pixel] >= 0 ? variant.entries[variant.wrong[pixel]]?.line : null;
  [...at("source").children].forEach((item, line) => {
    const isNow = variant.entries[k].line === line;
    item.className = "";
    item.removeAttribute("aria-current");
    if (parting >= 0 && variant.entries[parting].line === line) { item.classList.add("parts"); }
    if (wrongLine === line) { item.classList.add("wrong"); }
    if (isNow) {
      item.classList.add("now");
      item.setAttribute("aria-current", "step");
      const [list, top] = [at("source"), item.offsetTop - at("source").offsetTop];
      if (top < list.scrollTop || top > list.scrollTop + list.clientHeight - 40) { list.scrollTop = top - list.clientHeight / 3; }
    }
  });
  at("parting").disabled = parting < 0;
  if (!variant.native) { return "There are no results of the GPU's own floats."; }
  if (parting < 0) { return "The GPU's own floats, rounded to the format, are the emulator's numbers at every step."; }
  const entry = variant.entries[parting];
  const where = entry.line === null ? `the input ${entry.names[0].split(".")[0]}` : `line ${entry.line + 1}`;
  return `The GPU's own floats, rounded to the format, first differ from the emulator at ${where}.`;
};

const showStep = () => {
  const variant = chosenVariant();
  const count = variant.entries.length;
  chosen.step = Math.min(Math.max(chosen.step, 0), count - 1);
  const entry = variant.entries[chosen.step];
  showWritten(variant, chosen.step);
  showRegisters(variant, chosen.step);
  at("parting-said").textContent = markLines(variant, chosen.step);
  const text = entry.line === null ? `input ${entry.names[0].split(".")[0]}` : `line ${entry.line + 1}`;
  at("step-of").textContent = `${chosen.step + 1} of ${count}: ${text}`;
  at("pixel-said").textContent = `Pixel ${placeOf(chosen.pixel)}: ${OUTCOMES[variant.outcomes[chosen.pixel]] ?? "?"}.`;
  at("first").disabled = at("back").disabled = chosen.step === 0;
  at("forward").disabled = at("last").disabled = chosen.step === count - 1;
  Object.assign(at("stepper").dataset, { step: chosen.step, pixel: chosen.pixel });
};

const showVariant = () => {
  const variant = chosenVariant();
  drawPixels();
  const [text, className] = verdictOf(variant);
  Object.assign(at("program-verdict"), { textContent: text, className });
  showStep();
};

const showProgram = () => {
  const program = STEPS.programs[chosen.program];
  at("about").textContent = program.about;
  const list = at("source");
  list.replaceChildren();
  program.source.forEach((text, line) => {
    add(add(list, "li"), "code", {}, text || " ").onclick = () => {
      const step = chosenVariant().entries.findIndex((entry) => entry.line === line);
      if (step >= 0) { goTo(step); }
    };
  });
  const select = at("variant");
  select.replaceChildren();
  VARIANTS[chosen.program].forEach(({ device, format }, value) => add(select, "option", { value }, `${format}, ${value === 0 ? "as" : "other registers in"} ${device}`));
  showVariant();
};

const goTo = (step) => {
  chosen.step = step;
  showStep();
};

const choosePixel = (x, y) => {
  const most = STEPS.side - 1;
  const inside = (c) => Math.min(Math.max(c, 0), most);
  chosen.pixel = inside(y) * STEPS.side + inside(x);
  drawPixels();
  showStep();
};

const stepperControls = () => {
  const form = at("program-controls");
  form.onsubmit = () => false;
  const program = choice(form, "program", "Program", STEPS.programs.map(({ title }) => title));
  const variant = choice(form, "variant", "Registers", []);
  program.onchange = () => {
    Object.assign(chosen, { program: Number(program.value), variant: 0 });
    chosen.step = firstStep(chosenVariant());
    showProgram();
  };
  variant.onchange = () => { chosen.variant = Number(variant.value); showVariant(); };
  const canvas = at("pixels");
  canvas.onpointerdown = (event) => {
    const { left, top, width } = canvas.getBoundingClientRect();
    const cell = width / STEPS.side;
    choosePixel(Math.floor((event.clientX - left) / cell), Math.floor((event.clientY - top) / cell));
  };
  const moved = (dx, dy) => () => choosePixel((chosen.pixel % STEPS.side) + dx, Math.floor(chosen.pixel / STEPS.side) + dy);
  onKeys(canvas, { ArrowLeft: moved(-1, 0), ArrowRight: moved(1, 0), ArrowUp: moved(0, -1), ArrowDown: moved(0, 1) });
  const moves = {
    first: () => goTo(0), back: () => goTo(chosen.step - 1), forward: () => goTo(chosen.step + 1),
    last: () => goTo(chosenVariant().entries.length - 1), parting: () => goTo(partingOf(chosenVariant(), chosen.pixel)),
  };
  Object.entries(moves).forEach(([id, move]) => { at(id).onclick = move; });
  onKeys(at("stepper"), {
    ArrowLeft: moves.back, ArrowUp: moves.back, ArrowRight: moves.forward, ArrowDown: moves.forward, Home: moves.first, End: moves.last,
  });
  at("save-case").disabled = false;
  at("save-case").onclick = () => {
    const [{ name, case: [head, rest] }, { named }] = [STEPS.programs[chosen.program], chosenVariant()];
    save(`${name}.toml`, `${head}${named ? `format = "${named}"\n` : ""}${rest}`);
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawPixels);
  chosen.pixel = (PIXELS + STEPS.side) / 2;
  chosen.step = firstStep(chosenVariant());
  showProgram();
};
