// A sky behind a three.js scene: the types of three.js.

import type { Sky } from './welkin.js';

/** What of a camera of three.js is asked for. */
export interface PerspectiveCamera {
  updateWorldMatrix(updateParents: boolean, updateChildren: boolean): void;
  readonly matrixWorld: { readonly elements: ArrayLike<number> };
  getEffectiveFOV(): number;
}

/** Turns and moves a sky's camera as one of three.js, metre for unit. Its horizon stays level. */
export function follow(sky: Sky, camera: PerspectiveCamera): Sky;

/**
 * The sky as a cube texture, for `scene.background` and, through `PMREMGenerator.fromCubemap`, for `scene.environment`: what a display shows of it, tone
 * curve and all. `canvas` is the sky's; it is drawn six times and left as it was. `size`: texels a side of a face, 256 if it is left out.
 */
export function cubeTexture<T>(
  THREE: { CubeTexture: new (images: ImageBitmap[]) => T; SRGBColorSpace: string },
  sky: Sky,
  canvas: HTMLCanvasElement,
  size?: number,
): Promise<T>;
