// Helpers: elements, data, buffers and pipelines.

const DATA = JSON.parse(document.getElementById("data").textContent);
const at = (id) => document.getElementById(id);

const add = (parent, tag, properties = {}, text = "") => {
  const element = document.createElement(tag);
  Object.entries(properties).forEach(([name, value]) => {
    if (name in element) { element[name] = value; } else { element.setAttribute(name, value); }
  });
  element.append(text);
  parent.append(element);
  return element;
};

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const wordsOf = (text) => new Uint32Array(bytesOf(text).buffer);
const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
const hex = (bits, digits) => bits.toString(16).toUpperCase().padStart(digits, "0");
const count = (n) => n.toLocaleString("en-US");
const counted = (n, noun) => `${count(n)} ${noun}${n === 1 ? "" : "s"}`;
const said = (text) => { at("status").textContent = text; };

// Results, shown as JSON.
const FOUND = { page: `crossbar ${DATA.version}`, adapter: null, operations: [], native: [], programs: [], teapot: [] };
const show = () => { at("json").value = JSON.stringify(FOUND, null, 1); };

// Buffers of words on a device.
const storageOf = (device, words, more = 0) => {
  const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST;
  const buffer = device.createBuffer({ size: Math.max(4 * words.length, 16), usage: usage | more });
  device.queue.writeBuffer(buffer, 0, words);
  return buffer;
};

// Reads back words of a buffer.
const readBack = async (device, buffer, first, length) => {
  const staging = device.createBuffer({ size: 4 * length, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyBufferToBuffer(buffer, 4 * first, staging, 0, 4 * length);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const words = new Uint32Array(staging.getMappedRange().slice(0));
  staging.destroy();
  return words;
};

// Compiles a shader without blocking the page.
const compiled = async (device, text, entryPoint) => {
  const module = device.createShaderModule({ code: text });
  const { messages } = await module.getCompilationInfo();
  const error = messages.find(({ type }) => type === "error");
  if (error) { throw new Error(`${entryPoint}, line ${error.lineNum}: ${error.message}`); }
  return device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint } });
};

const run = (device, pipeline, buffers, x, y = 1) => {
  const entries = Object.entries(buffers).map(([binding, buffer]) => ({ binding: Number(binding), resource: { buffer } }));
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
  pass.dispatchWorkgroups(x, y);
  pass.end();
  device.queue.submit([encoder.finish()]);
};

// Handles keys on an element; keys with a modifier are left to the browser.
const onKeys = (element, keys) => {
  element.addEventListener("keydown", (event) => {
    if (keys[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      keys[event.key]();
    }
  });
};

// Lets the browser show the page's current state.
const breathe = () => new Promise((resolve) => { setTimeout(resolve, 0); });

// Saves text as a file on the visitor's computer.
const save = (name, text) => {
  const link = add(document.body, "a", { href: URL.createObjectURL(new Blob([text], { type: "text/plain" })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
  link.remove();
};
