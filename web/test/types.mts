// A program that uses all of the interface: it must compile with strict types, as its users' programs do.

import { bake, check, controls, createSky, fetchPack } from '../js/welkin.js';
import { WelkinSky } from '../js/element.js';
import { cubeTexture, follow, type PerspectiveCamera } from '../js/three.js';
import type { Files, Finding, Key, Sky } from '../js/welkin.js';

export async function everything(canvas: HTMLCanvasElement): Promise<Finding[]> {
  const sky: Sky = await createSky(canvas, 'pack/', {
    backend: 'auto',
    resize: true,
    settings: { method: 'lit', cover: 0.5 },
    onprogress: (done, total) => console.log(done / total),
    onlost: (why) => console.log(why.length),
  });
  sky.set({ method: 'sprites', sun: true, domes: [1, 0.5, 0.5], 'fbm-sharpness': '0.5' }).start().stop();
  sky.preset('storm', 4).advance(0.5, { time: false }).drag([10, -4]).zoom(1).pilot({ forward: 1 }, 0.1).draw(12.5);
  const texts: Record<string, string> = sky.get();
  const pairs: [string, string][] = sky.changes();
  const keys: Key[] = (await controls()).keys;
  console.log(texts, pairs, keys.length, sky.info.backend, sky.pack.seed, sky.lacks, sky.weather(), sky.options());
  const files: Files = await bake('seed = 1', {
    seed: 3n,
    onprogress: (share, step) => console.log(share, step),
    signal: AbortSignal.timeout(1000),
  });
  await sky.load(files);
  await sky.load(await fetchPack(new URL('pack/', 'https://example.org')));
  const findings = [...sky.check().findings, ...check(files).findings];
  sky.destroy();
  // @ts-expect-error: there is no such method.
  sky.set({ method: 'volumes' });
  return findings;
}

/** The element and three.js. */
export async function beside(camera: PerspectiveCamera, THREE: { CubeTexture: new (images: ImageBitmap[]) => { needsUpdate: boolean }; SRGBColorSpace: string }) {
  const element: WelkinSky = document.createElement('welkin-sky');
  const canvas = document.createElement('canvas');
  if (!element.sky) return null;
  follow(element.sky, camera).draw();
  const cube = await cubeTexture(THREE, element.sky, canvas, 128);
  return cube.needsUpdate;
}
