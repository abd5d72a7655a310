// Where a number is on its slider.

/** Beyond this, equal steps of a slider say nothing. */
const WIDE = 1e5;

/**
 * @typedef {object} Scale
 * @property {number} min of the slider
 * @property {number} max
 * @property {number} step
 * @property {(value: number) => number} place where a value is
 * @property {(place: number) => number} value of a place, in as few digits as the step has
 */

/**
 * The scale of a range: even, or by shares where the range asks for it or is very wide.
 * @param {{low: number, high: number, unit?: string, logarithmic?: boolean, whole?: boolean}} range
 * @returns {Scale}
 */
export function scale({ low, high, unit = '', logarithmic = false, whole = false }) {
  if (logarithmic || high - low > WIDE) return shares(low, high);
  const step = whole || unit === 'degrees' ? 1 : niceStep((high - low) / 100);
  const clean = (value) => clamp(Number(value.toPrecision(7)), low, high);
  return { min: low, max: high, step, place: (value) => clamp(value, low, high), value: clean };
}

function shares(low, high) {
  const clean = (value) => clamp(Number(value.toPrecision(3)), low, high);
  if (low > 0) {
    const way = Math.log(high / low);
    return {
      min: 0, max: 1, step: 0.005,
      place: (value) => Math.log(clamp(value, low, high) / low) / way,
      value: (place) => clean(low * Math.exp(place * way)),
    };
  }
  // With 0 in the range, small numbers are even and large ones shares; both sides of 0 alike.
  const way = Math.log1p(Math.max(high, -low));
  return {
    min: low < 0 ? -1 : 0, max: 1, step: 0.005,
    place(value) {
      const inside = clamp(value, low, high);
      return (Math.sign(inside) * Math.log1p(Math.abs(inside))) / way;
    },
    value: (place) => clean(Math.sign(place) * Math.expm1(Math.abs(place) * way)),
  };
}

/** The step of 1, 2 or 5 of some power of ten that is not larger. */
export function niceStep(step) {
  const power = 10 ** Math.floor(Math.log10(step) + 1e-9);
  const times = [5, 2, 1].find((n) => n * power <= step * (1 + 1e-9));
  return Number((times * power).toPrecision(1));
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** The hour of a time of day from 0 to 1. */
export function clock(time) {
  const minutes = Math.round(time * 1440) % 1440;
  const two = (number) => String(number).padStart(2, '0');
  return `${two(Math.floor(minutes / 60))}:${two(minutes % 60)}`;
}

/** Linear red, green and blue of 0..1 as a colour for an input, and back. */
export function toHex(linear) {
  const byte = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  return `#${linear.map((v) => byte(clamp(v, 0, 1)).toString(16).padStart(2, '0')).join('')}`;
}

export function fromHex(hex) {
  const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  return [1, 3, 5].map((at) => Number(linear(parseInt(hex.slice(at, at + 2), 16) / 255).toFixed(4)));
}
