// A sky on a canvas: the types of welkin.js.

/** What draws. `auto` is WebGPU where the browser gives an adapter, else WebGL2. */
export type Backend = 'webgpu' | 'webgl2';

/** The files of a pack by name: `pack.json` and those that it names. */
export type Files = Map<string, Uint8Array> | Record<string, Uint8Array>;

/** A pack: the address of its folder, against the document's, or its files. */
export type PackSource = string | URL | Files;

/** A setting's value. Lists are written with commas between their parts. */
export type Value = string | number | boolean | readonly (string | number)[];

/**
 * Settings by name. All of them, with words and ranges, are what {@link controls} gives; these are the most used. Those that are left out stay
 * as they are.
 */
export interface Settings {
  /** Which system makes the clouds. */
  method?: 'packed' | 'octaves' | 'fbm' | 'lit' | 'sprites';
  /** Amount of cloud, 0 (clear) to 1 (overcast). */
  cover?: number;
  /** Height of the clouds, 0 (low) to 1 (high). */
  height?: number;
  /** Density of the clouds, 0 (bumpy and bright) to 1 (smooth with dark cores). */
  density?: number;
  /** Red on the clouds of a sunset, 0 to 1. */
  sunset?: number;
  /** Speed of the clouds, 0 (still) to 1. */
  speed?: number;
  /** Time of day, 0 to 1: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset. */
  time?: number;
  /** Layers of clouds of the method `lit`, `KIND[:SHARE[:HEIGHT[:EAST:SOUTH]]]` between commas; EAST and SOUTH are a velocity in metres a second. */
  layers?: string;
  /** Whether the lens flare's picture of the sun is a starburst instead of a disc. */
  starburst?: boolean;
  /** Moment of the animation in seconds, 0 to 1e9. */
  at?: number;
  /** Where one looks, in degrees from north (0) towards east (90), -360 to 360. */
  azimuth?: number;
  /** Degrees above the horizon, -90 to 90. */
  elevation?: number;
  /** Vertical field of view in degrees, 1 to 150. */
  fov?: number;
  [name: string]: Value | undefined;
}

export interface SkyOptions {
  /** `auto` if it is left out. */
  backend?: 'auto' | Backend;
  /** Settings of the first picture. */
  settings?: Settings;
  /** Gives the canvas the pixels of its place in the page, two a CSS pixel at most, and draws anew when that changes. Off if it is left out. */
  resize?: boolean;
  /** Told with bytes that have come and bytes that there are, while the pack is fetched. */
  onprogress?(done: number, total: number): void;
  /**
   * The browser took the graphics device away, and the sky draws no more: destroy it and create another one, on a new canvas. `why` is a
   * sentence.
   */
  onlost?(why: string): void;
}

/** What draws. */
export interface Info {
  backend: Backend;
  /** The adapter's name; browsers may keep it to themselves, and it is empty then. */
  adapter: string;
  driver: string;
  /** The canvas, in pixels. */
  width: number;
  height: number;
  /** The most pixels a side. */
  maxSide: number;
  /** Bytes of the textures that only the method of the settings reads; null before there is a pack. */
  methodBytes: number | null;
}

/** What a pack says of itself. */
export interface PackInfo {
  name: string;
  /** Seed of its random streams, a whole number below 2 to the 64 in decimal digits. */
  seed: string;
  /** Its recipe, in TOML. */
  recipe: string;
  /** The program that baked it, with its version. */
  baker: string;
  /** Bytes of all its files. */
  bytes: number;
}

/** Keys that are held, each -1, 0 or 1. */
export interface HeldKeys {
  turnRight?: number;
  turnUp?: number;
  forward?: number;
  right?: number;
  up?: number;
  /** Five times as fast. */
  haste?: boolean;
}

/** A sky on a canvas. What changes settings does not draw: {@link Sky.draw} does, or the loop that {@link Sky.start} begins. */
export interface Sky {
  /** Gives settings their values: all of them or, if one is wrong, none, and an Error says what was expected. */
  set(values: Settings): this;
  /** Every setting's text. `set` takes them back. */
  get(): Record<string, string>;
  /** Names and texts of the settings that are not the usual ones: what a link holds. */
  changes(): [string, string][];
  /** Names of the settings that the sky looks at, with these settings. */
  applies(): string[];
  /** Gives a setting its usual value, or all of them. */
  reset(name?: string): this;
  /** Goes over to a preset, in so many seconds of {@link Sky.advance}; at once if they are left out. */
  preset(name: string, seconds?: number): this;
  /** Whether the way to a preset goes on. */
  readonly blending: boolean;
  /** The preset whose settings these are. */
  weather(): string | null;
  /** The options of `welkin-view render` that draw this picture. */
  options(): string[];
  /** Lets so many seconds go by: the way to a preset and, unless `time` is false, the animation and the day. */
  advance(seconds: number, options?: { time?: boolean }): this;
  /** Turns the view as a drag by so many CSS pixels, to the right and down, on a picture of this height. */
  drag(way_px: [number, number], height_px?: number): this;
  /** Notches of a wheel away from the person: a narrower view, a tenth each. */
  zoom(notches: number): this;
  /** Turns and flies as keys that are held for so many seconds. */
  pilot(keys: HeldKeys, seconds: number): this;
  /** Draws a frame: at the moment of the settings, or at this one in seconds. The canvas has the picture until the task ends and the page is painted. */
  draw(seconds?: number): this;
  /** Draws a frame whenever the screen wants one, and lets time go by. */
  start(): this;
  stop(): this;
  /** Draws another pack. If it is broken, the promise is rejected with what is wrong, and the sky stays as it is. */
  load(source: PackSource): Promise<this>;
  /** What `welkin check --json` finds in the pack. */
  check(): Report;
  readonly info: Info;
  readonly pack: PackInfo;
  /** The pack's files. */
  readonly files: Map<string, Uint8Array>;
  /** Why the pack cannot draw the method of the settings, which then draws less; null if it can. */
  readonly lacks: string | null;
  /** Gives the graphics device back. Nothing else may be called after it. */
  destroy(): void;
}

/** One rule applied to one thing; docs/checks.md describes the rules. */
export interface Finding {
  rule: string;
  severity: 'error' | 'warning';
  subject: string;
  outcome: 'passed' | 'failed' | 'skipped';
  figure: number | null;
  expected: string;
  note: string;
}

export interface Report {
  sound: boolean;
  findings: Finding[];
}

/** How a person gives a setting. */
export type Input =
  | { kind: 'slider'; low: number; high: number; unit: string; logarithmic: boolean; whole: boolean }
  | { kind: 'switch' }
  | { kind: 'choice'; choices: string[] }
  | { kind: 'numbers'; names: string[]; ranges: [number, number][]; optional: boolean }
  | { kind: 'colour' }
  | { kind: 'layers' }
  | { kind: 'text'; form: string };

/** A setting, with its words for a person. */
export interface Key {
  name: string;
  label: string;
  help: string;
  group: 'sky' | 'clouds' | 'air' | 'light' | 'weather' | 'time' | 'camera';
  input: Input;
  /** The methods that look at it. */
  methods: string[];
}

export interface Preset {
  name: string;
  help: string;
  values: [string, string][];
  hour: 'day' | 'night';
}

export interface Controls {
  keys: Key[];
  presets: Preset[];
  /** What the setting `layers` may be made of. */
  layers: { kinds: string[]; most: number };
}

export interface BakeOptions {
  /** Seed of every random stream, a whole number below 2 to the 64; the recipe's if it is left out or empty. */
  seed?: string | number | bigint;
  /**
   * The files that the recipe names, by those names. A recipe without a photograph wants `built-in photograph`, which is
   * assets-src/photos/god-rays-1024.png.
   */
  files?: Files;
  /**
   * Told the share of the steps that are done, 0 to 1, and the step that begins; and what whoever wants the pack should know of
   * it, such as how much light of a skybox was cut, if there is anything.
   */
  onprogress?(share: number, step: string, notice?: string): void;
  /** Ends the bake; the promise is then rejected with the signal's reason. */
  signal?: AbortSignal;
}

/**
 * Opens a sky on a canvas. The promise is rejected, with a sentence for people, if there is no graphics adapter or the pack is broken.
 *
 * A canvas has one backend in its life: take a new canvas for another one.
 */
export function createSky(canvas: HTMLCanvasElement, pack: PackSource, options?: SkyOptions): Promise<Sky>;

/** Fetches the files of a pack: its manifest, then all that it names at once. A file that is not there is left out. */
export function fetchPack(address: string | URL, onprogress?: (done: number, total: number) => void): Promise<Map<string, Uint8Array>>;

/** Every setting, the presets, what layers may be. */
export function controls(): Promise<Controls>;

/**
 * What `welkin check --json` finds in these files; throws if the manifest cannot be read at all. Only after {@link controls} or
 * {@link createSky} has come. `place` stands before file names in what is told.
 */
export function check(files: Files, place?: string): Report;

/** Bakes a recipe, in TOML, in a worker: byte for byte the files that the program `welkin` writes. */
export function bake(recipe: string, options?: BakeOptions): Promise<Map<string, Uint8Array>>;
