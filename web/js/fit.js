// The size of a canvas in pixels.

/** More pixels than the eye tells apart cost time for nothing. */
const MOST_PIXELS_A_PX = 2;

/** Gives a canvas the pixels of a place in the page, its own unless told otherwise. */
export function fit(canvas, place = canvas) {
  const scale = Math.min(devicePixelRatio, MOST_PIXELS_A_PX);
  const [width, height] = [place.clientWidth, place.clientHeight].map((px) => Math.max(1, Math.round(px * scale)));
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
}
