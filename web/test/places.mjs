// Where things are.

import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The repository. */
export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
/** The built page. */
export const SITE = process.env.WELKIN_SITE ?? join(ROOT, 'out/web');
/** The native programs. */
export const WELKIN = process.env.WELKIN ?? join(ROOT, 'target/release/welkin');
export const VIEW = process.env.WELKIN_VIEW ?? join(ROOT, 'target/release/welkin-view');
