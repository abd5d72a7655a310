// When a frame is drawn: as often as the screen wants while something moves, else once after each change.

/** How long a pause between two frames may count; a hidden page does not leap when it is seen again. */
const LONGEST_S = 0.25;

/**
 * @param {(seconds: number) => boolean} frame draws one, `seconds` after the last; whether another shall follow
 */
export function createLoop(frame) {
  let asked = 0;
  let last = null;
  const tick = (now_ms) => {
    asked = 0;
    const seconds = last === null ? 0 : Math.min((now_ms - last) / 1000, LONGEST_S);
    const goes_on = frame(seconds);
    last = goes_on ? now_ms : null;
    if (goes_on) wake();
  };
  const wake = () => { asked ||= requestAnimationFrame(tick); };
  return {
    /** Asks for a frame. */
    wake,
    /** Asks for none any more. */
    stop() {
      cancelAnimationFrame(asked);
      asked = 0;
      last = null;
    },
  };
}

/** The median time between frames that follow each other, in milliseconds; null before there are a few. */
export function createClock(most = 30) {
  const spans = [];
  return {
    add(seconds) {
      if (seconds > 0) spans.push(seconds * 1000);
      if (spans.length > most) spans.shift();
    },
    median() {
      if (spans.length < 5) return null;
      return [...spans].sort((a, b) => a - b)[spans.length >> 1];
    },
  };
}
