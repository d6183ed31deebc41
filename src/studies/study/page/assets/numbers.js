// Conversion of numbers in any format from and to bits. A format is eight words, as in shaders.

// Converts a raw value of the machine to a pattern of the format.
const patternOf = (raw, [kind, upper, frac]) => {
  const width = 1 + upper + frac;
  if (kind === 0) { return width === 32 ? raw : raw & (2 ** width - 1); }
  const top = 2 ** upper - 1;
  const sign = (raw >>> 31) * 2 ** (upper + frac);
  if ((raw & 0x7fffffff) > 0x7f800000) { return (top * 2 ** frac + 2 ** (frac - 1)) >>> 0; }
  const size = Math.abs(singleOf(raw));
  if (size === Infinity) { return (sign + top * 2 ** frac) >>> 0; }
  const bias = 2 ** (upper - 1) - 1;
  const exponent = Math.max(exponentOf(size), 1 - bias);
  // The leading digit of a normal number adds one to the field.
  return (sign + (exponent + bias - 1) * 2 ** frac + size / 2 ** (exponent - frac)) >>> 0;
};

const singleOf = (bits) => new Float32Array(Uint32Array.of(bits).buffer)[0];

// The exponent of the largest power of two that is at most a positive number.
const exponentOf = (size) => {
  if (size === 0) { return -Infinity; }
  let exponent = Math.floor(Math.log2(size));
  while (2 ** exponent > size) { exponent -= 1; }
  while (2 ** (exponent + 1) <= size) { exponent += 1; }
  return exponent;
};

// The number that a pattern represents; doubles hold the numbers of all formats.
const numberOf = (pattern, [kind, upper, frac, , , , , over]) => {
  if (kind === 0) {
    const spare = 31 - upper - frac;
    return ((pattern << spare) >> spare) / (over || 2 ** frac);
  }
  const sign = pattern >= 2 ** (upper + frac) ? -1 : 1;
  const field = Math.floor(pattern / 2 ** frac) % 2 ** upper;
  const mantissa = pattern % 2 ** frac;
  if (field === 2 ** upper - 1) { return mantissa === 0 ? sign * Infinity : NaN; }
  const bias = 2 ** (upper - 1) - 1;
  return sign * (mantissa + (field === 0 ? 0 : 2 ** frac)) * 2 ** (Math.max(field, 1) - bias - frac);
};

// An integer near x: ties to even, ties away, toward zero, down.
const integerOf = (x, rounding) => {
  if (rounding === 2) { return Math.trunc(x); }
  const below = Math.floor(x);
  const rest = x - below;
  if (rounding === 3 || rest < 0.5) { return below; }
  if (rest > 0.5) { return below + 1; }
  return rounding === 1 ? below + (x > 0 ? 1 : 0) : below + Math.abs(below % 2);
};

// A unit in the last place of the format at a number.
const unitOf = (x, [kind, upper, frac, , , , , over]) => (
  kind === 0 ? 1 / (over || 2 ** frac) : 2 ** (Math.max(exponentOf(Math.abs(x)), 2 - 2 ** (upper - 1)) - frac)
);

// The number to which the format rounds x.
const roundedTo = (x, format) => {
  const [kind, upper, frac, rounding, overflow, flushes] = format;
  if (!Number.isFinite(x)) { return x; }
  const unit = unitOf(x, format);
  const steps = integerOf(x / unit, rounding);
  if (kind === 0) {
    const count = 2 ** (upper + frac);
    const wrapped = ((((steps + count) % (2 * count)) + 2 * count) % (2 * count)) - count;
    return (overflow === 1 ? wrapped : Math.min(Math.max(steps, -count), count - 1)) * unit;
  }
  const most = (2 - 2 ** -frac) * 2 ** (2 ** (upper - 1) - 1);
  const size = Math.abs(steps) * unit;
  if (size > most) { return Math.sign(x) * (overflow === 0 || rounding === 2 ? most : Infinity); }
  return flushes === 1 && size < 2 ** (2 - 2 ** (upper - 1)) ? 0 : steps * unit;
};

const sameNumber = (a, b) => a === b || (Number.isNaN(a) && Number.isNaN(b));

const decimal = (x) => (Number.isFinite(x) ? String(Number(x.toPrecision(9))) : Number.isNaN(x) ? "NaN" : x > 0 ? "infinity" : "-infinity");
