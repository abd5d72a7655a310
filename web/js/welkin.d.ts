// A sky on a canvas: the types of welkin.js.

/** What draws. `auto` is WebGPU where the browser gives an adapter, else WebGL2. */
export type Backend = 'webgpu' | 'webgl2';

/** The files of a pack by name: `pack.json` and those that it names. */
export type Files = Map<string, Uint8Array> | Record<string, Uint8Array>;

/** A pack: the address of its folder, against the document's, or its files. */
export type PackSource = string | URL | Files;

/** A setting's value. Lists are written with commas between their parts. */
export type Value = string | number | boolean | readonly (string | number)[];

// Settings, as the table in runtime/src/params/table.rs has them: a test holds this block to it.
/** A system that makes the clouds. */
export type MethodName = 'packed' | 'octaves' | 'fbm' | 'lit' | 'sprites';

/** The name of a setting. */
export type SettingName =
  | 'cover'
  | 'height'
  | 'density'
  | 'sunset'
  | 'speed'
  | 'time'
  | 'method'
  | 'shading'
  | 'upper'
  | 'photo'
  | 'octaves'
  | 'octaves-sharpness'
  | 'octaves-interval'
  | 'domes'
  | 'palette'
  | 'fbm-sharpness'
  | 'lit'
  | 'shaded'
  | 'layers'
  | 'dome-radius'
  | 'flattening'
  | 'k1'
  | 'k2'
  | 'm'
  | 'lit-interval'
  | 'behind'
  | 'behind-cover'
  | 'sight'
  | 'ring'
  | 'billboards'
  | 'hours'
  | 'formation'
  | 'sky'
  | 'haze'
  | 'ground'
  | 'sea'
  | 'waves'
  | 'turbidity'
  | 'cie'
  | 'perez'
  | 'sun'
  | 'moon'
  | 'stars'
  | 'flare'
  | 'starburst'
  | 'skybox'
  | 'rays'
  | 'rain'
  | 'date'
  | 'lat'
  | 'lon'
  | 'exposure-ev'
  | 'auto-exposure'
  | 'tonemap'
  | 'flashes'
  | 'at'
  | 'rate'
  | 'day-length'
  | 'lightning'
  | 'azimuth'
  | 'elevation'
  | 'fov'
  | 'east'
  | 'north'
  | 'up';

/** Settings by name. Those that are left out stay as they are. */
export interface Settings {
  /** Cloud cover: 0 none, 1 all. From 0 to 1. */
  cover?: number | string;
  /** Height of the clouds: 0 low, 1 high. From 0 to 1. */
  height?: number | string;
  /** Density of the clouds: 0 thin and bumpy, 1 thick, smooth and dark. From 0 to 1. */
  density?: number | string;
  /** Amount of red on the clouds of a sunset. From 0 to 1. */
  sunset?: number | string;
  /** Speed of the clouds. From 0 to 1. */
  speed?: number | string;
  /** Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset. From 0 to 1. */
  time?: number | string;
  /** How the clouds are made. */
  method?: 'packed' | 'octaves' | 'fbm' | 'lit' | 'sprites';
  /** How clouds are shaded. */
  shading?: 'scattered' | 'paper';
  /** Amount of a thin upper layer, 0 (none) to 1. */
  upper?: number | string;
  /** How much of the clouds' large shapes is the photograph's, 0 (as published) to 1. */
  photo?: number | string;
  /** How many octaves are summed. */
  octaves?: number | string;
  /** How sharply clouds end. From 0 to 1. */
  'octaves-sharpness'?: number | string;
  /** Seconds in which clouds form anew. From 0.1 to 86400 seconds. */
  'octaves-interval'?: number | string;
  /** Cover of each dome as a share of the cover; 0 leaves it out. */
  domes?: Value;
  /** Colours of the clouds. */
  palette?: 'fair' | 'stormy';
  /** How sharply clouds end. From 0 to 1. */
  'fbm-sharpness'?: number | string;
  /** Reflectance where the light comes through, linear, each 0 to 1. */
  lit?: Value;
  /** Reflectance where clouds shade themselves, linear, each 0 to 1. */
  shaded?: Value;
  /** Layers of clouds, KIND:SHARE:HEIGHT between commas. */
  layers?: Value;
  /** Radius of the dome's rim in metres. From 1000 to 1000000. */
  'dome-radius'?: number | string;
  /** Height of the dome over its radius, 0.02 (flat) to 1 (a hemisphere). */
  flattening?: number | string;
  /** Light that clouds scatter to all sides. From 0 to 1. */
  k1?: number | string;
  /** Light that they scatter forwards, which shines around the sun. From 0 to 1. */
  k2?: number | string;
  /** How narrow the shine around the sun is and how fast shade deepens. From 0.5 to 16. */
  m?: number | string;
  /** Seconds in which clouds form anew. From 1 to 86400 seconds. */
  'lit-interval'?: number | string;
  /** Method of the dome behind the sprites; sprites is a clear one, with the thin upper layer alone. */
  behind?: 'packed' | 'octaves' | 'fbm' | 'lit' | 'sprites';
  /** Cover of that dome. From 0 to 1. */
  'behind-cover'?: number | string;
  /** How far clouds are seen, in metres. From 8000 to 60000. */
  sight?: number | string;
  /** Radius of the ring of impostors in metres, 4000 to 60000: clouds beyond it are pictures; 0 for no ring. */
  ring?: number | string;
  /** Distance beyond which a cloud is one billboard, in metres. From 2000 to 60000. */
  billboards?: number | string;
  /** Whether sprites are lit by the field's table of hours, as painted, not by the sky. */
  hours?: boolean | 'true' | 'false';
  /** The most that clouds have formed, 0 (nothing) to 1 (whole). */
  formation?: number | string;
  /** How the clear sky is computed. */
  sky?: 'table' | 'perez';
  /** Haze in the air: 0 as the pack's clear air, 1 as its hazy air. */
  haze?: number | string;
  /** Share of light that the ground reflects, linear, each 0 to 1. */
  ground?: Value;
  /** Whether a sea lies below the horizon, in place of the ground. */
  sea?: boolean | 'true' | 'false';
  /** How rough the sea is, 0 (calm) to 1 (a wind of 15 m/s). */
  waves?: number | string;
  /** Haze in the air, 1.7 (clear) to 10 (thick). */
  turbidity?: number | string;
  /** Luminance of a standard sky of ISO 15469, 1 (overcast) to 12 (clear) to 15. */
  cie?: Value;
  /** Luminance by five numbers of one's own. */
  perez?: Value;
  /** The sun's disc. */
  sun?: boolean | 'true' | 'false';
  /** Strength of the moon's light, 1 as it is. From 0 to 1. */
  moon?: number | string;
  /** Stars and galaxy. */
  stars?: boolean | 'true' | 'false';
  /** Strength of the lens flare, 0 (off) to 1. */
  flare?: number | string;
  /** Whether the flare's picture of the sun is a starburst instead of a disc. */
  starburst?: boolean | 'true' | 'false';
  /** How far the pack's skybox takes the place of the computed sky. From 0 to 1. */
  skybox?: number | string;
  /** Strength of the sun's rays between the clouds, 0 (off) to 1. */
  rays?: number | string;
  /** Strength of the rain, 0 (off) to 1. */
  rain?: number | string;
  /** Moment of universal time, which takes the place of the time of day. */
  date?: Value;
  /** Latitude of the place, north positive. From -90 to 90 degrees. */
  lat?: number | string;
  /** Longitude of the place, east positive. From -180 to 180 degrees. */
  lon?: number | string;
  /** Exposure of the picture in stops: each is twice as bright. From -16 to 16. */
  'exposure-ev'?: number | string;
  /** Whether the exposure follows the light of the sky, as a camera's does. */
  'auto-exposure'?: boolean | 'true' | 'false';
  /** How radiance becomes colour on a display. */
  tonemap?: 'neutral' | 'agx' | 'agx-punchy' | 'filmic' | 'none';
  /** Flashes of lightning a minute. From 0 to 30. */
  flashes?: number | string;
  /** Moment of the animation, in seconds. */
  at?: number | string;
  /** Seconds of the animation that go by in a second. From 0 to 1000. */
  rate?: number | string;
  /** Seconds that a day takes; 0 and the time of day stays. From 0 to 86400 seconds. */
  'day-length'?: number | string;
  /** One flash: kilometres to the east and to the south, second at which it begins, strength. */
  lightning?: Value;
  /** Azimuth of the view, from north (0) towards east (90). From -360 to 360 degrees. */
  azimuth?: number | string;
  /** Elevation of the view, -90 to 90: 0 is the horizon, 90 the zenith. */
  elevation?: number | string;
  /** Vertical field of view. From 1 to 150 degrees. */
  fov?: number | string;
  /** Where the viewer stands, metres to the east. From -1000000 to 1000000. */
  east?: number | string;
  /** Where the viewer stands, metres to the north. */
  north?: number | string;
  /** Where the viewer stands, metres up. */
  up?: number | string;
  [name: string]: Value | undefined;
}
// Settings end.

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
  changes(): [SettingName, string][];
  /** Names of the settings that the sky looks at, with these settings. */
  applies(): SettingName[];
  /** Gives a setting its usual value, or all of them. */
  reset(name?: SettingName): this;
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
  | { kind: 'choice'; choices: string[]; meanings: string[] }
  | { kind: 'numbers'; names: string[]; ranges: [number, number][]; optional: boolean }
  | { kind: 'colour' }
  | { kind: 'layers' }
  | { kind: 'text'; form: string };

/** A setting, with its words for a person. */
export interface Key {
  name: SettingName;
  label: string;
  help: string;
  group: 'sky' | 'clouds' | 'air' | 'light' | 'weather' | 'time' | 'camera';
  input: Input;
  /** The methods that look at it. */
  methods: MethodName[];
}

/** A system that makes the clouds. */
export interface Method {
  name: MethodName;
  /** What it is, in a few words. */
  title: string;
  /** Where it was published. */
  paper: string;
}

export interface Preset {
  name: string;
  help: string;
  values: [string, string][];
  hour: 'day' | 'night';
}

export interface Controls {
  keys: Key[];
  methods: Method[];
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

/** Every setting, the methods, the presets, what layers may be. */
export function controls(): Promise<Controls>;

/**
 * What `welkin check --json` finds in these files; throws if the manifest cannot be read at all. Only after {@link controls} or
 * {@link createSky} has come. `place` stands before file names in what is told.
 */
export function check(files: Files, place?: string): Report;

/** Bakes a recipe, in TOML, in a worker: byte for byte the files that the program `welkin` writes. */
export function bake(recipe: string, options?: BakeOptions): Promise<Map<string, Uint8Array>>;
