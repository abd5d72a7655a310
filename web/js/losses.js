// What draws after a browser has taken the graphics device away.

/** Losing the device more often than this in `SPAN_MS` is no accident. */
const MOST_LOSSES = 3;
const SPAN_MS = 60_000;
/** As often WebGPU is tried again; then WebGL2 has its turn, whose driver is another one. */
const WEBGPU_LOSSES = 2;

/** Counts losses. */
export function createLosses(now = Date.now) {
  let times = [];
  return {
    /** The backends to try after a loss, in their order: none once it is no accident any more. `wanted` may be `auto`, `drew` is what was lost. */
    next(wanted, drew) {
      const at = now();
      times = [...times.filter((then) => at - then < SPAN_MS), at];
      if (wanted === 'auto' && drew === 'webgpu') {
        return times.length < WEBGPU_LOSSES ? ['auto', 'webgl2'] : ['webgl2'];
      }
      return times.length > MOST_LOSSES ? [] : [wanted];
    },
    /** From the start. */
    forget() { times = []; },
  };
}
