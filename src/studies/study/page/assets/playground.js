// The playground: the emulator itself, if the page contains it.

const PLAY_CELL = 9;

// The emulator as a function from requests to answers, by the name of the module's function.
const emulator = async () => {
  const packed = new Blob([bytesOf(at("emulator").textContent)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const module = await WebAssembly.compile(await new Response(packed).arrayBuffer());
  let calls = null;
  return async (request, name = "refsim_answer") => {
    calls ??= (await WebAssembly.instantiate(module)).exports;
    try {
      new TextEncoder().encode(JSON.stringify(request)).forEach((byte) => calls.refsim_push(byte));
      const length = calls[name]();
      const words = Uint32Array.from({ length: Math.ceil(length / 4) }, (_, k) => calls.refsim_read(4 * k));
      return new TextDecoder().decode(new Uint8Array(words.buffer, 0, length));
    } catch (error) {
      // A trap leaves the instance in an undefined state.
      calls = null;
      throw error;
    }
  };
};

const linkOf = (request, name = "program") => {
  const bytes = new TextEncoder().encode(JSON.stringify(request));
  return `#${name}=${btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
};
const linkedRequest = (name = "program") => {
  const [, text] = location.hash.split(`#${name}=`);
  if (!text) { return null; }
  try {
    return JSON.parse(new TextDecoder().decode(bytesOf(text.replaceAll("-", "+").replaceAll("_", "/"))));
  } catch {
    return null;
  }
};

const playRequest = () => {
  const device = (name) => ({ device: at(name).value, format: at(`${name}-format`).value.trim() || null });
  const request = { text: at("program-text").value, ...device("play-device"), pixel: playground.pixel };
  return at("play-other").value ? { ...request, other: device("play-other") } : request;
};

const playground = { ask: null, pixel: [9, 9], state: "idle" };

// The line of a place from a little before it, with carets below it.
const quoted = (text, start, end) => {
  const from = Math.max(text.lastIndexOf("\n", start - 1) + 1, start - 32);
  const [line] = text.slice(from).split("\n", 1);
  const before = line.slice(0, start - from).replace(/[^\t]/gu, " ");
  return `${line}\n${before}${"^".repeat(Math.max(1, Math.min(end - start, line.length - before.length)))}`;
};

// Shows errors and warnings about the text of one element in the list of another.
const showRemarks = ({ errors, warnings = [] }, textId = "program-text", listId = "remarks") => {
  const [list, source] = [at(listId), at(textId)];
  list.replaceChildren();
  const remarks = [...errors.map((remark) => [remark, "error"]), ...warnings.map((remark) => [remark, "warning"])];
  remarks.forEach(([{ message, help, line, column, start, end }, kind]) => {
    const item = add(list, "li", { className: kind === "error" ? "wrong" : "" });
    if (line > 0) {
      add(item, "button", { type: "button" }, `line ${line}, column ${column}`).onclick = () => {
        source.focus();
        source.setSelectionRange(start, Math.max(end, start + 1));
      };
    }
    item.append(` ${kind}: ${message}`);
    if (line > 0) { add(item, "pre", {}, quoted(source.value, start, end)); }
    add(item, "div", { className: "small" }, help);
  });
  source.setAttribute("aria-invalid", String(errors.length > 0));
};

const differentPixels = ({ drawn, other }) => (
  drawn && other ? Array.from({ length: drawn.picture.length / 3 }, (_, p) => p).filter((p) => [0, 1, 2].some((c) => drawn.picture[3 * p + c] !== other.picture[3 * p + c])) : []
);

const showPicture = ({ side, drawn }) => {
  const canvas = at("play-picture");
  Object.assign(canvas, { width: side * PLAY_CELL, height: side * PLAY_CELL });
  const context = canvas.getContext("2d");
  for (let p = 0; drawn && p < side * side; p += 1) {
    context.fillStyle = `rgb(${drawn.picture.slice(3 * p, 3 * p + 3).join(",")})`;
    context.fillRect((p % side) * PLAY_CELL, Math.floor(p / side) * PLAY_CELL, PLAY_CELL, PLAY_CELL);
  }
  const [x, y] = playground.pixel;
  Object.assign(context, { strokeStyle: getComputedStyle(document.documentElement).getPropertyValue("--link"), lineWidth: 2 });
  context.strokeRect(x * PLAY_CELL, y * PLAY_CELL, PLAY_CELL, PLAY_CELL);
};

const showPlayTrace = ({ trace, difference, other, drawn }) => {
  const body = at("play-trace");
  body.replaceChildren();
  const texts = at("program-text").value.split("\n");
  const rows = [...(trace?.inputs.length ? [{ line: 0, written: trace.inputs, flags: [] }] : []), ...(trace?.steps ?? [])];
  rows.forEach(({ line, written, flags }) => written.forEach(({ name, value, bits }, c) => {
    const row = add(body, "tr", { className: difference && line > 0 && difference.line === line ? "parts" : "" });
    add(row, "td", { className: "number" }, c === 0 && line > 0 ? String(line) : "");
    add(add(row, "td"), "code", {}, c > 0 ? "" : line > 0 ? texts[line - 1] ?? "" : "inputs");
    add(row, "th", { scope: "row" }, name);
    add(row, "td", { className: "number" }, value);
    add(add(row, "td"), "code", {}, bits);
    add(row, "td", { className: "small" }, c === 0 ? flags.join(", ") : "");
  }));
  const [x, y] = playground.pixel;
  const words = [trace ? `Pixel (${x}, ${y}) in ${drawn.format}: ${trace.outcome}.` : ""];
  if (other) {
    const different = differentPixels({ drawn, other }).length;
    words.push(`${counted(different, "pixel")} of the picture differ in ${other.format}.`);
    words.push(difference
      ? `At this pixel, they first differ in ${difference.stage}${difference.line ? `, line ${difference.line}` : ""}: ${difference.values.map(({ name, left, right }) => `${name} is ${left} and ${right}`).join("; ")}.`
      : "At this pixel, both write the same values at every step.");
  }
  at("play-said").textContent = words.join(" ");
};

const play = async () => {
  if (playground.state !== "idle") { playground.state = "again"; return; }
  do {
    playground.state = "busy";
    const request = playRequest();
    at("play-link").href = linkOf(request);
    try {
      const text = await playground.ask(request);
      const found = JSON.parse(text);
      showRemarks(found);
      showPicture(found);
      showPlayTrace(found);
      Object.assign(at("playground").parentElement.dataset, { request: JSON.stringify(request), answer: text });
    } catch (error) {
      at("play-said").textContent = `The emulator stopped: ${error}`;
    }
  } while (playground.state === "again");
  playground.state = "idle";
};

const choosePlayed = (request) => {
  at("program-text").value = request.text ?? "";
  [["play-device", request], ["play-other", request.other]].forEach(([id, device]) => {
    at(id).value = device?.device ?? "";
    at(`${id}-format`).value = device?.format ?? "";
  });
  if (Array.isArray(request.pixel)) { playground.pixel = request.pixel.slice(0, 2).map(Number); }
};

const playControls = ({ devices, examples }) => {
  const form = at("play-controls");
  form.onsubmit = () => false;
  const example = choice(form, "play-example", "Example", examples.map(({ title }) => title));
  const names = (id, label, first) => {
    const select = add(field(form, label), "select", { id });
    [...first, ...devices].forEach((name) => add(select, "option", { value: name }, name || "none"));
    add(field(form, `${label}: registers`), "input", { id: `${id}-format`, size: 12, placeholder: "the device's own", spellcheck: false });
  };
  names("play-device", "Device", []);
  names("play-other", "Compared with", [""]);
  example.onchange = () => {
    choosePlayed({ ...examples[Number(example.value)], other: null });
    play();
  };
  let waiting = null;
  const later = () => {
    clearTimeout(waiting);
    waiting = setTimeout(play, 300);
  };
  at("program-text").addEventListener("input", later);
  form.addEventListener("input", later);
  const canvas = at("play-picture");
  const moveTo = (x, y) => {
    const most = canvas.width / PLAY_CELL - 1;
    playground.pixel = [x, y].map((c) => Math.min(Math.max(c, 0), most));
    play();
  };
  canvas.onpointerdown = (event) => {
    const { left, top, width } = canvas.getBoundingClientRect();
    const cell = (width * PLAY_CELL) / canvas.width;
    moveTo(Math.floor((event.clientX - left) / cell), Math.floor((event.clientY - top) / cell));
  };
  const moved = (dx, dy) => () => moveTo(playground.pixel[0] + dx, playground.pixel[1] + dy);
  onKeys(canvas, { ArrowLeft: moved(-1, 0), ArrowRight: moved(1, 0), ArrowUp: moved(0, -1), ArrowDown: moved(0, 1) });
  window.addEventListener("hashchange", () => {
    const linked = linkedRequest();
    if (linked) {
      choosePlayed(linked);
      play();
    }
  });
};

const beginPlayground = async () => {
  playground.ask = await emulator();
  const begun = JSON.parse(await playground.ask({ text: "", device: "" }));
  playControls(begun);
  choosePlayed(linkedRequest() ?? { ...begun.examples[0], other: { device: "r300" } });
  await play();
  at("playground").parentElement.dataset.state = "ready";
};
