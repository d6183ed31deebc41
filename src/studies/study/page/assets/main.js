// The live view, and the order of all steps.

const ROUNDINGS = ["to nearest, ties to even", "to nearest, ties away", "toward zero", "down"];
const FIXED_OVERFLOWS = ["saturates", "wraps"];
const TURN = 0.08;

// The camera on a sphere about the point that the fixed view looks at.
const orbitOf = ({ eye, target }) => {
  const offset = V.sub(eye, target);
  const distance = V.length(offset);
  return { target, distance, turn: Math.atan2(offset[1], offset[0]), height: Math.asin(offset[2] / distance) };
};
const eyeOf = ({ target, distance, turn, height }) => V.narrow(V.add(target, [
  distance * Math.cos(height) * Math.cos(turn), distance * Math.cos(height) * Math.sin(turn), distance * Math.sin(height),
]));

const field = (form, label) => {
  const row = add(form, "label", { className: "field" });
  add(row, "span", {}, label);
  return row;
};
const slider = (form, id, label, low, high, value) => {
  const row = field(form, label);
  const input = add(row, "input", { id, type: "range", min: low, max: high, value });
  const shown = add(row, "output", { htmlFor: id }, String(value));
  input.addEventListener("input", () => { shown.textContent = input.value; });
  return input;
};
const choice = (form, id, label, names) => {
  const select = add(field(form, label), "select", { id });
  names.forEach((name, value) => add(select, "option", { value }, name));
  return select;
};

const formatName = ([kind, upper, frac, rounding, overflow]) => {
  const name = kind === FIXED ? `s${upper}.${frac}` : `e${upper}m${frac}`;
  const suffix = ["", ":rna", ":rtz", ":rdn"][rounding];
  return name + suffix + (kind === FIXED && overflow === 1 ? ":wrap" : "");
};

// Reads the controls of the live view.
const controls = (redraw) => {
  const form = at("controls");
  form.onsubmit = () => false;
  const kind = choice(form, "kind", "Numbers", ["fixed point sI.F", "floating point eXmY"]);
  // At most 24 bits: for more, the program converts coordinates at other instructions.
  const fixed = [slider(form, "integers-of", "Integer bits I", 0, 7, 3), slider(form, "fractions-of", "Fraction bits F", 4, 16, 12)];
  const float = [slider(form, "exponent-of", "Exponent bits X", 4, 8, 5), slider(form, "mantissa-of", "Mantissa bits Y", 2, 23, 10)];
  const rounding = choice(form, "rounding", "Rounding", ROUNDINGS);
  const overflow = choice(form, "overflow", "Overflow", FIXED_OVERFLOWS);
  const views = add(form, "div", { className: "views" });
  const parts = { fixed: [...fixed, overflow], float };
  const arrange = () => {
    const isFixed = kind.value === "0";
    parts.fixed.forEach((input) => { input.parentElement.hidden = !isFixed; });
    parts.float.forEach((input) => { input.parentElement.hidden = isFixed; });
  };
  form.addEventListener("input", () => { arrange(); redraw(); });
  arrange();
  const format = () => {
    const value = (input) => Number(input.value);
    return kind.value === "0"
      ? [0, value(fixed[0]), value(fixed[1]), value(rounding), value(overflow), 0, 0, 0]
      : [1, value(float[0]), value(float[1]), value(rounding), 2, 0, 0, 0];
  };
  return { format, views };
};

const liveView = (gpu) => {
  const canvas = at("view");
  let [view, camera, state, scene] = [TEAPOT.views[0], null, "idle", null];
  const redraw = async () => {
    if (state !== "idle") { state = "again"; return; }
    do {
      state = "busy";
      scene ??= camera ? sceneOf(eyeOf(camera), camera.target) : fixedScene(view);
      const [now, words, begun] = [scene, ask.format(), performance.now()];
      const hits = await draw(gpu, now, words);
      now.first ??= Int32Array.from(firstHits(now.rays, now.buckets));
      const verdicts = verdictsOf(hits, now.first, now.ties ?? new Map());
      paint(canvas, now, hits, verdicts);
      const number = (verdict) => verdicts.filter((other) => other === verdict).length;
      const judged = now.ties ? "exact arithmetic" : "a ray caster in double precision";
      const told = [
        counted(number(VERDICT_LEAK), "leak"), counted(number(VERDICT_FALSE), "false hit"),
        counted(number(VERDICT_NEIGHBOUR) + number(VERDICT_TRIANGLE), "wrong triangle"),
      ];
      at("told").textContent = `${formatName(words)}: ${told.join(", ")} in ${count(verdicts.length)} pixels, `
        + `judged by ${judged}; ${Math.round(performance.now() - begun)} ms.`;
      canvas.dataset.drawn = `${formatName(words)} ${digestOf(hits)}`;
    } while (state === "again");
    state = "idle";
  };
  const look = (change) => {
    camera ??= orbitOf(view);
    change(camera);
    camera.height = Math.min(Math.max(camera.height, -1.5), 1.5);
    camera.distance = Math.min(Math.max(camera.distance, 3), 20);
    scene = null;
    redraw();
  };
  const ask = controls(redraw);
  TEAPOT.views.forEach((other) => {
    add(ask.views, "button", { type: "button" }, `View ${other.name}`).onclick = () => {
      [view, camera, scene] = [other, null, null];
      redraw();
    };
  });
  const looking = (change) => () => look(change);
  onKeys(canvas, {
    ArrowLeft: looking((c) => { c.turn -= TURN; }), ArrowRight: looking((c) => { c.turn += TURN; }),
    ArrowUp: looking((c) => { c.height += TURN; }), ArrowDown: looking((c) => { c.height -= TURN; }),
    "+": looking((c) => { c.distance /= 1.1; }), "-": looking((c) => { c.distance *= 1.1; }),
  });
  canvas.onpointerdown = (event) => { canvas.setPointerCapture(event.pointerId); };
  canvas.onpointermove = (event) => {
    if (event.buttons === 1) { look((c) => { c.turn -= event.movementX / 150; c.height += event.movementY / 150; }); }
  };
  return redraw();
};

const describe = ({ info, limits }) => {
  const { vendor, architecture, device, description } = info ?? {};
  FOUND.adapter = { vendor, architecture, device, description, browser: navigator.userAgent };
  [["GPU", [vendor, architecture, device, description].filter(Boolean).join(", ") || "not named by the browser"],
    ["Storage buffer", `${count(limits.maxStorageBufferBindingSize)} bytes`],
    ["Browser", navigator.userAgent]].forEach(([name, value]) => {
    add(at("adapter"), "dt", {}, name);
    add(at("adapter"), "dd", {}, value);
  });
};

const end = (state, text) => {
  document.body.dataset.state = state;
  said(text);
  show();
};

const openDevice = async () => {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) { return null; }
  const features = adapter.features.has("shader-f16") ? ["shader-f16"] : [];
  const device = await adapter.requestDevice({ requiredFeatures: features });
  describe(adapter);
  return device;
};

const begin = async () => {
  cellTable();
  stepperControls();
  if (at("emulator")) { await beginPlayground(); }
  at("vectors").disabled = false;
  at("vectors").onclick = () => save(`crossbar-${DATA.version}-vectors.txt`, vectorText());
  at("copy").disabled = false;
  at("copy").onclick = async () => {
    at("json").select();
    try {
      await navigator.clipboard.writeText(at("json").value);
      at("copied").textContent = "Copied.";
    } catch {
      at("copied").textContent = "The browser does not allow copying: the text is selected, copy it yourself.";
    }
  };
  show();
  let device = null;
  try {
    device = await openDevice();
  } catch (error) {
    said(String(error));
  }
  if (at("shader")) { await beginShader(device); }
  if (!device) {
    at("live").parentElement.hidden = true;
    end("without", "This browser has no WebGPU here, so nothing runs: the traces and pictures below are the emulator's, stored in the page.");
    return;
  }
  device.lost.then(({ message }) => end("lost", `The browser lost the GPU: ${message}. Load the page again.`));
  try {
    const gpu = await teapotPipelines(device);
    said("Drawing the teapot ...");
    await liveView(gpu);
    const wrong = await runArithmetic(device);
    await runNative(device);
    const untrue = await runPrograms(device, showVariant);
    const different = await runFixedViews(gpu);
    const traces = untrue === 0 ? "every step of the programs has the emulator's bits" : `programs differ at ${counted(untrue, "pixel")}`;
    const pictures = different === 0 ? "so has every pixel of the fixed views" : `${counted(different, "fixed view")} differ`;
    end(wrong + untrue + different === 0 ? "equal" : "different", `${count(wrong)} wrong results in whole numbers; ${traces}; ${pictures}.`);
  } catch (error) {
    FOUND.error = String(error);
    end("failed", `The GPU or its driver reports an error: ${error}`);
  }
};
begin();
