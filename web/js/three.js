// A sky behind a three.js scene, and its light. Nothing of three.js is imported here: it comes as an argument, so that there is one of it.

const DEGREES = 180 / Math.PI;

/**
 * Turns and moves a sky's camera as one of three.js, whose axes are Welkin's: +X east, +Y up, -Z north. Draw the scene over it: a canvas with
 * `alpha: true` above the sky's, and no `scene.background`.
 */
export function follow(sky, camera) {
  camera.updateWorldMatrix(true, false);
  const e = camera.matrixWorld.elements;
  // The third column looks back.
  const [x, y, z] = [-e[8], -e[9], -e[10]];
  return sky.set({
    azimuth: Math.atan2(x, -z) * DEGREES,
    elevation: Math.asin(Math.max(-1, Math.min(1, y / Math.hypot(x, y, z)))) * DEGREES,
    fov: camera.getEffectiveFOV(),
    east: e[12], up: Math.max(0, e[13]), north: -e[14],
  });
}

/** Azimuth and elevation of the faces in three.js's order, which sees a cube from outside: +X and -X are exchanged, and so east and west. */
const FACES = [[270, 0], [90, 0], [180, 90], [180, -90], [180, 0], [0, 0]];

/**
 * The sky as a cube texture, for `scene.background` and, through `PMREMGenerator.fromCubemap`, for `scene.environment`: what a display shows of it, tone curve and all.
 * The sky's canvas is drawn six times and left as it was; a face is as sharp as the canvas has pixels.
 */
export async function cubeTexture(THREE, sky, canvas, size = 256) {
  const before = sky.get();
  const bitmaps = [];
  try {
    for (const [azimuth, elevation] of FACES) {
      const { width, height } = canvas;
      // A square in the middle of the picture has a right angle each way.
      const side = Math.min(width, height);
      const fov = 2 * Math.atan(height / side) * DEGREES;
      sky.set({ azimuth, elevation, fov, flare: 0 }).draw();
      const place = [(width - side) >> 1, (height - side) >> 1, side, side];
      bitmaps.push(createImageBitmap(canvas, ...place, { resizeWidth: size, resizeHeight: size, resizeQuality: 'high' }));
    }
  } finally {
    sky.set(before).draw();
  }
  const faces = await Promise.all(bitmaps);
  const texture = new THREE.CubeTexture(faces);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}
