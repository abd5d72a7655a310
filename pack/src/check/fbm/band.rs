//! Where the energy of interpolated noise lies.
//!
//! Random numbers on a lattice of `c` points, interpolated by a kernel `h`, have the spectrum
//! `F(k) = W(k mod c) H(k)`: the numbers' own spectrum `W`, repeated, times the kernel's. In two dimensions
//! the kernel is a product, so `H(k) = H(kx) H(ky)`. `W` is white: at each of the `c^2` lattice waves its
//! energy is an independent chi squared variable. So the share of the energy in a band is a ratio of sums
//! of such variables whose weights are known, and Chernoff's bound tells how far it may stray.

/// One in a million, as a logarithm.
const LOG_FALSE_ALARMS: f64 = -13.815_510_557_964_274;

/// Halvings of an interval: to four digits of a share.
const HALVINGS: usize = 16;

/// The lattice and the kernel of one octave.
pub(super) struct Interpolation {
    cells: usize,
    /// `H(k)^2` of the wave numbers 0 to half the texels of a row.
    kernel: Vec<f64>,
}

/// The energy of a lattice wave in all, and in the band; and how many waves have the same.
type Wave = [f64; 3];

impl Interpolation {
    /// `size` texels a side, a power of two; `cells` lattice cells, a smaller one that is not 0.
    pub(super) fn new(size: u32, cells: u32) -> Interpolation {
        let (size, cells) = (size as usize, cells as usize);
        let kernel = (0..=size / 2).map(|k| {
            let h = response(k, size, size / cells);
            h * h
        });
        Interpolation {
            cells,
            kernel: kernel.collect(),
        }
    }

    /// The least and the greatest share of the energy that wave numbers up to `cut` in both directions hold,
    /// but for one sound octave in a million each.
    pub(super) fn share_below(&self, cut: u32) -> [f64; 2] {
        let waves = self.waves(cut as usize);
        let sum = |i: usize| waves.iter().map(|w| w[i] * w[2]).sum::<f64>();
        let mean = sum(1) / sum(0);
        let least = |share: f64| surprise(&waves, |w| w[1] - share * w[0]) <= LOG_FALSE_ALARMS;
        let most = |share: f64| surprise(&waves, |w| share * w[0] - w[1]) <= LOG_FALSE_ALARMS;
        [
            bisect(0.0, mean, |share| !least(share))[0],
            bisect(mean, 1.0, most)[1],
        ]
    }

    /// Every lattice wave but 0. The kernel is even, so a quarter of a quarter stands for all.
    fn waves(&self, cut: usize) -> Vec<Wave> {
        let half = self.cells / 2;
        let lines: Vec<[f64; 2]> = (0..=half).map(|q| self.line(q, cut)).collect();
        let count = |q: usize| if q == 0 || q == half { 1.0 } else { 2.0 };
        let pairs = (0..=half).flat_map(|y| (0..=half).map(move |x| (x, y)));
        pairs
            .filter(|&(x, y)| x + y > 0)
            .map(|(x, y)| {
                let product = |i: usize| lines[x][i] * lines[y][i];
                [product(0), product(1), count(x) * count(y)]
            })
            .collect()
    }

    /// Sums of the kernel's energy over all aliases of a wave number: all of them, and those up to `cut`.
    fn line(&self, q: usize, cut: usize) -> [f64; 2] {
        let size = 2 * (self.kernel.len() - 1);
        let mut sums = [0.0; 2];
        for k in (q..size).step_by(self.cells) {
            let k = k.min(size - k);
            sums[0] += self.kernel[k];
            sums[1] += if k <= cut { self.kernel[k] } else { 0.0 };
        }
        sums
    }
}

/// The transform of the kernel `1 - t^2 (3 - 2t)`, t in cells of `step` texels, at wave number `k`.
fn response(k: usize, size: usize, step: usize) -> f64 {
    let weight = |i: usize| {
        let t = i as f64 / step as f64;
        1.0 - t * t * (3.0 - 2.0 * t)
    };
    let angle = |i: usize| std::f64::consts::TAU * (k * i % size) as f64 / size as f64;
    let sides = (1..step).map(|i| weight(i) * libm::cos(angle(i)));
    1.0 + 2.0 * sides.sum::<f64>()
}

/// The logarithm of a bound of the probability that `sum weight(w) Z_w^2` is at most 0, for independent normal
/// Z: the least of `-1/2 sum ln(1 + 2 theta weight)` over theta.
///
/// H. Chernoff, "A measure of asymptotic efficiency for tests of a hypothesis based on the sum of
/// observations", Annals of Mathematical Statistics 23, 1952.
fn surprise(waves: &[Wave], weight: impl Fn(&Wave) -> f64) -> f64 {
    let weights: Vec<[f64; 2]> = waves.iter().map(|w| [weight(w), w[2]]).collect();
    let sum = |f: &dyn Fn(f64) -> f64| weights.iter().map(|[a, n]| n * f(*a)).sum::<f64>();
    if sum(&|a| a) <= 0.0 {
        return 0.0;
    }
    let least = weights.iter().map(|[a, _]| *a).fold(f64::MAX, f64::min);
    if least >= 0.0 {
        return f64::NEG_INFINITY;
    }
    // The logarithms end at this theta; their sum grows there without bounds.
    let end = -0.5 / least;
    let falls = |theta: f64| sum(&|a| a / (1.0 + 2.0 * theta * a)) > 0.0;
    let [theta, _] = bisect(0.0, end, |theta| !falls(theta));
    -0.5 * sum(&|a| libm::log1p(2.0 * theta * a))
}

/// Two close numbers between `low` and `high`, at the first of which `is_beyond` is false and at the other true.
fn bisect(mut low: f64, mut high: f64, is_beyond: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_beyond(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    [low, high]
}
