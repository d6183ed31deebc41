// Traces of programs: traces stored by the emulator, and traces on the visitor's GPU.

const STEPS = DATA.programs;
const PIXELS = STEPS.side * STEPS.side;
const [RECORD_HEAD, STEP_WORDS, RECORD_FRAGMENT, RECORD_UNFINISHED] = STEPS.record;

// Stored patterns of a variant, by pixel, entry and written component.
const storedOf = (variant) => {
  const bytes = bytesOf(variant.values);
  let at = 0;
  const pattern = (size) => {
    let bits = 0;
    for (let k = 0; k < size; k += 1) { bits += bytes[at + k] * 2 ** (8 * k); }
    at += size;
    return bits;
  };
  return Array.from({ length: PIXELS }, () => variant.entries.map(({ names, format }) => {
    const size = Math.ceil(variant.formats[format].width / 8);
    return names.map(() => pattern(size));
  }));
};

// All data of a variant that the page shows.
const VARIANTS = STEPS.programs.map((program) => program.variants.map((variant) => ({
  ...variant, stored: storedOf(variant), outcomes: bytesOf(variant.fates), colors: bytesOf(variant.picture), found: null, wrong: null,
})));

// Runs a trace of all pixels; per pixel the fragment's outcome, and what each entry wrote, in the machine's raw values.
const traceOn = async (device, pipeline, job) => {
  const words = (name) => wordsOf(STEPS.buffers[job[name]]);
  const before = words("video");
  const video = new Uint32Array(before.length + PIXELS * job.record_words);
  video.set(before);
  const buffers = [
    words("draw"), words("setups"), words("tiles"), words("samplers"), video, words("code"),
    new Uint32Array(job.scratch_words), new Uint32Array(job.count_words),
  ].map((contents) => storageOf(device, contents));
  let found = null;
  do {
    run(device, pipeline, buffers, PIXELS);
    found = await readBack(device, buffers[4], before.length, PIXELS * job.record_words);
    device.queue.writeBuffer(buffers[0], 4 * STEPS.resumes, Uint32Array.of(1));
  } while (found.some((word, at) => at % job.record_words === 0 && word === RECORD_UNFINISHED));
  buffers.forEach((buffer) => buffer.destroy());
  return Array.from({ length: PIXELS }, (_, pixel) => {
    const record = found.subarray(pixel * job.record_words, (pixel + 1) * job.record_words);
    if (record[0] !== RECORD_FRAGMENT) { return { outcome: 0, entries: [] }; }
    const entries = Array.from({ length: record[2] / STEP_WORDS }, (__, k) => {
      const [instruction, mask, ...raw] = record.subarray(RECORD_HEAD + STEP_WORDS * k, RECORD_HEAD + STEP_WORDS * (k + 1));
      return { instruction, mask, raw: raw.filter((___, c) => (mask >> c) & 1) };
    });
    return { outcome: record[1], entries };
  });
};

// Patterns of an entry on the visitor's GPU; null where it ran another instruction, or wrote other components.
const patternsOf = (variant, pixel, k) => {
  const [entry, found] = [variant.entries[k], variant.found[pixel].entries[k]];
  if (!found || found.instruction !== entry.instruction || found.mask !== entry.mask) { return null; }
  return found.raw.map((raw) => patternOf(raw, variant.formats[entry.format].words));
};

const isEqual = (variant, pixel, k) => {
  const patterns = patternsOf(variant, pixel, k);
  return patterns !== null && patterns.every((bits, c) => bits === variant.stored[pixel][k][c]);
};

// Compares all pixels of a variant: wrong[pixel] is its first wrong entry, or -1; an outcome counts as one more entry.
const judgeVariant = (program, variant) => {
  const last = variant.entries.length;
  variant.wrong = variant.found.map(({ outcome, entries }, pixel) => {
    const k = variant.entries.findIndex((_, at) => !isEqual(variant, pixel, at));
    if (k >= 0) { return k; }
    return entries.length === last && outcome === variant.outcomes[pixel] ? -1 : last;
  });
  const wrong = variant.wrong.filter((k) => k >= 0).length;
  const line = { program: program.name, device: variant.device, format: variant.format, pixels: PIXELS, steps: last, wrong };
  if (wrong > 0) {
    const pixel = variant.wrong.findIndex((k) => k >= 0);
    line.first = { x: pixel % STEPS.side, y: Math.floor(pixel / STEPS.side), line: (variant.entries[variant.wrong[pixel]]?.line ?? -1) + 1 };
  }
  FOUND.programs.push(line);
  return wrong;
};

// Runs all programs, by the number library and in the GPU's own floats; returns how many pixels differ.
const runPrograms = async (device, changed) => {
  let wrong = 0;
  said("Compiling the programs' machine ...");
  const exact = await compiled(device, STEPS.shaders[0], STEPS.entry);
  for (const [p, program] of STEPS.programs.entries()) {
    for (const variant of VARIANTS[p]) {
      variant.found = await traceOn(device, exact, variant.job);
      wrong += judgeVariant(program, variant);
    }
    changed();
    await breathe();
  }
  said("Compiling the programs' machine in the GPU's own floats ...");
  const native = await compiled(device, STEPS.shaders[1], STEPS.entry);
  for (const [p, program] of STEPS.programs.entries()) {
    const found = await traceOn(device, native, program.native);
    VARIANTS[p].forEach((variant) => { variant.native = found; });
  }
  changed();
  show();
  return wrong;
};

// Results of the GPU's own floats for an entry, as numbers; null if another instruction ran, or none yet.
const nativeOf = (variant, pixel, k) => {
  const [entry, found] = [variant.entries[k], variant.native?.[pixel].entries[k]];
  return found && found.instruction === entry.instruction && found.mask === entry.mask ? found.raw : null;
};

// The first entry at which the GPU's own floats, rounded to the format, differ; -1 if there is none.
const partingOf = (variant, pixel) => (variant.native ? variant.entries.findIndex(({ format }, k) => {
  const raw = nativeOf(variant, pixel, k);
  const { words } = variant.formats[format];
  return raw === null || raw.some((bits, c) => !sameNumber(roundedTo(singleOf(bits), words), numberOf(variant.stored[pixel][k][c], words)));
}) : -1);
