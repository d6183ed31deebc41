// A shader of the visitor's own: the emulator's picture in a number format, beside the GPU's of the same text.

const ownShader = { device: null, values: {}, state: "idle" };

// Draws on the GPU; returns colors, or errors of its compiler with their places.
const drawnByGpu = async (device, text, { entry, vertex, buffers }, side) => {
  const size = [side, side];
  const [module, corners] = [text, vertex].map((code) => device.createShaderModule({ code }));
  const { messages } = await module.getCompilationInfo();
  const errors = messages.filter(({ type }) => type === "error").map(({ message, lineNum, linePos, offset, length }) => (
    { message: `your GPU's browser: ${message}`, help: "", line: lineNum, column: linePos, start: offset, end: offset + length }
  ));
  if (errors.length > 0) { return { errors }; }
  const groups = Array.from({ length: Math.max(0, ...buffers.map(({ group }) => group + 1)) }, (_, group) => buffers.filter((b) => b.group === group));
  const layouts = groups.map((group) => device.createBindGroupLayout({
    entries: group.map(({ binding }) => ({ binding, visibility: GPUShaderStage.FRAGMENT, buffer: {} })),
  }));
  const pipeline = await device.createRenderPipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: layouts }),
    vertex: { module: corners },
    fragment: { module, entryPoint: entry, targets: [{ format: "rgba32float" }] },
    // Shaders may write depth.
    depthStencil: { format: "depth32float", depthWriteEnabled: false, depthCompare: "always" },
  });
  const texture = (format, usage) => device.createTexture({ size, format, usage: GPUTextureUsage.RENDER_ATTACHMENT | usage });
  const [target, depth] = [texture("rgba32float", GPUTextureUsage.COPY_SRC), texture("depth32float", 0)];
  const staging = device.createBuffer({ size: 16 * side * side, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginRenderPass({
    colorAttachments: [{ view: target.createView(), loadOp: "clear", storeOp: "store", clearValue: [0, 0, 0, 0] }],
    depthStencilAttachment: { view: depth.createView(), depthLoadOp: "clear", depthStoreOp: "discard", depthClearValue: 1 },
  });
  pass.setPipeline(pipeline);
  groups.forEach((group, at) => {
    const entries = group.map(({ binding, bytes }) => {
      const buffer = device.createBuffer({ size: bytes.length, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
      device.queue.writeBuffer(buffer, 0, Uint8Array.from(bytes));
      return { binding, resource: { buffer } };
    });
    pass.setBindGroup(at, device.createBindGroup({ layout: layouts[at], entries }));
  });
  pass.draw(3);
  pass.end();
  encoder.copyTextureToBuffer({ texture: target }, { buffer: staging, bytesPerRow: 16 * side }, size);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const colors = new Float32Array(staging.getMappedRange().slice(0));
  [target, depth, staging].forEach((resource) => resource.destroy());
  return { colors, errors: [] };
};

// The GPU's picture; what it refuses is an error without a place.
const gpuPicture = async (text, found) => {
  const { device } = ownShader;
  if (!device || !found.gpu) { return { errors: [] }; }
  device.pushErrorScope("validation");
  let [drawn, refused] = [{ errors: [] }, null];
  try {
    drawn = await drawnByGpu(device, text, found.gpu, found.side);
  } catch (error) {
    refused = error;
  }
  refused = await device.popErrorScope() ?? refused;
  if (drawn.errors.length === 0 && refused) {
    drawn = { errors: [{ message: `your GPU: ${refused.message}`, help: "the emulator's picture is below", line: 0 }] };
  }
  return drawn;
};

const colorOf = (x) => (x >= 0 ? Math.min(x, 1) : 0);
const paintColors = (canvas, side, color) => {
  Object.assign(canvas, { width: side, height: side });
  const image = new ImageData(side, side);
  for (let p = 0; p < side * side; p += 1) { image.data.set([...color(p).map((x) => Math.round(255 * x)), 255], 4 * p); }
  canvas.getContext("2d").putImageData(image, 0, 0);
};
const picturesOf = ({ side }, own, gpu) => {
  const rgb = (colors) => (p) => [0, 1, 2].map((c) => colorOf(colors[4 * p + c]));
  const apart = Array.from({ length: gpu ? side * side : 0 }, (_, p) => Math.max(...rgb(own)(p).map((x, c) => 255 * Math.abs(x - rgb(gpu)(p)[c]))));
  const most = Math.max(0, ...apart);
  paintColors(at("shader-own"), side, rgb(own));
  at("shader-gpu").parentElement.hidden = !gpu;
  at("shader-apart").parentElement.hidden = !gpu;
  if (gpu) {
    paintColors(at("shader-gpu"), side, rgb(gpu));
    paintColors(at("shader-apart"), side, (p) => [0, 1, 2].map(() => (most > 0 ? apart[p] / most : 0)));
  }
  const code = (colors, p) => rgb(colors)(p).map((x) => Math.round(255 * x));
  const other = apart.filter((_, p) => gpu && code(own, p).some((x, c) => x !== code(gpu, p)[c])).length;
  return { most, other, worst: apart.indexOf(most), numbers: (colors, p) => rgb(colors)(p).map((x) => (255 * x).toFixed(2)).join(", ") };
};

const showShader = (found, { colors, errors }, format) => {
  showRemarks({ errors: [...found.errors, ...errors] }, "shader-text", "shader-remarks");
  at("shader-pictures").hidden = !found.drawn;
  at("shader-said").textContent = "";
  if (!found.drawn) { return; }
  const own = new Float32Array(Uint32Array.from(found.drawn.bits).buffer);
  const { most, other, worst, numbers } = picturesOf(found, own, colors);
  at("shader-format-said").textContent = format;
  at("shader-scale").textContent = most > 0 ? `white is ${most.toPrecision(3)} of 255` : "none";
  at("shader-apart").dataset.most = String(most);
  const place = `(${worst % found.side}, ${Math.floor(worst / found.side)})`;
  const words = [];
  if (!ownShader.device) { words.push("This browser has no WebGPU here, so there is no picture of your GPU."); }
  if (colors) { words.push(`${count(other)} of ${counted(found.side ** 2, "pixel")} have a different 8-bit color.`); }
  if (colors && most > 0) {
    words.push(`The largest difference is ${most.toPrecision(3)} of 255, at pixel ${place}: the emulator has ${numbers(own, worst)}, your GPU ${numbers(colors, worst)}.`);
  }
  at("shader-said").textContent = words.join(" ");
};

// A field of numbers for each uniform; the numbers stay while the text changes.
const uniformFields = (uniforms, draw) => {
  const form = at("shader-uniforms");
  const names = uniforms.map(({ name, values }) => `${name} ${values.length}`).join();
  if (form.dataset.names === names) { return; }
  form.dataset.names = names;
  form.replaceChildren();
  uniforms.forEach(({ name, values }) => {
    const row = add(form, "div", { className: "field" });
    add(row, "span", {}, name);
    const numbers = add(row, "div", { className: "numbers" });
    ownShader.values[name] = values;
    values.forEach((value, c) => {
      const input = add(numbers, "input", { type: "number", step: "any", value, "aria-label": values.length > 1 ? `${name}.${"xyzw"[c]}` : name });
      input.oninput = () => {
        if (Number.isFinite(input.valueAsNumber)) { ownShader.values[name][c] = input.valueAsNumber; draw(); }
      };
    });
  });
};

const drawShader = async () => {
  if (ownShader.state !== "idle") { ownShader.state = "again"; return; }
  do {
    ownShader.state = "busy";
    const format = at("shader-other-format").value.trim() || at("shader-format").value;
    const request = { text: at("shader-text").value, format, uniforms: ownShader.values };
    at("shader-link").href = linkOf(request, "shader");
    try {
      const found = JSON.parse(await playground.ask(request, "refsim_shader"));
      if (found.drawn) { uniformFields(found.uniforms, drawShader); }
      showShader(found, await gpuPicture(request.text, found), format);
      at("shader").parentElement.dataset.drawn = JSON.stringify(request);
    } catch (error) {
      const help = "Shorter expressions and fewer functions within functions take less of the browser's stack.";
      showShader({ errors: [{ message: `the emulator stopped: ${error}`, help, line: 0 }] }, { errors: [] });
    }
  } while (ownShader.state === "again");
  ownShader.state = "idle";
};

const chooseShader = ({ text, format, uniforms }) => {
  at("shader-text").value = text ?? "";
  ownShader.values = { ...uniforms };
  at("shader-uniforms").dataset.names = "";
  if (format) {
    at("shader-format").value = format;
    const isListed = at("shader-format").value === format;
    at("shader-other-format").value = isListed ? "" : format;
    if (!isListed) { at("shader-format").selectedIndex = 0; }
  }
};

const shaderControls = ({ examples, formats }) => {
  const form = at("shader-controls");
  form.onsubmit = () => false;
  const example = choice(form, "shader-example", "Example", examples.map(({ title }) => title));
  const select = add(field(form, "Numbers"), "select", { id: "shader-format" });
  formats.forEach(([value, name]) => add(select, "option", { value }, name));
  add(field(form, "or another format"), "input", { id: "shader-other-format", size: 12, placeholder: "such as e6m9:rtz", spellcheck: false });
  const exampleOf = (index) => ({ ...examples[index], uniforms: Object.fromEntries(examples[index].uniforms) });
  example.onchange = () => {
    chooseShader(exampleOf(Number(example.value)));
    drawShader();
  };
  let waiting = null;
  const later = () => {
    clearTimeout(waiting);
    waiting = setTimeout(drawShader, 300);
  };
  at("shader-text").addEventListener("input", later);
  form.addEventListener("input", later);
  chooseShader(linkedRequest("shader") ?? { ...exampleOf(0), format: "fp16" });
  window.addEventListener("hashchange", () => {
    const linked = linkedRequest("shader");
    if (linked) {
      chooseShader(linked);
      drawShader();
    }
  });
};

const beginShader = async (device) => {
  ownShader.device = device;
  device?.lost.then(() => { ownShader.device = null; });
  try {
    shaderControls(JSON.parse(await playground.ask({ text: "", format: "" }, "refsim_shader")));
  } catch (error) {
    at("shader-said").textContent = `The emulator does not start: ${error}`;
    return;
  }
  await drawShader();
  at("shader").parentElement.dataset.state = "ready";
};
