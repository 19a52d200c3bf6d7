//! Natural frequencies, damping ratios and mode shapes of an [`Assembly`] at rest.
//!
//! Small motions about the static equilibrium are sums of e^(λt); with A = ∂(state')/∂(state) there, every λ is an
//! eigenvalue of A and its vector the shape:
//! ```text
//! λ = −ζω ± iω √(1 − ζ²)     f = |λ|/2π undamped,  |Im λ|/2π damped,  ζ = −Re λ/|λ|
//! ```
//! Of an overdamped pair both λ are real, ω² is their product and 2ζω the negative of their sum; the shape is that of
//! the faster. A direction in which nothing holds the assembly has λ = 0, and with damping a single real λ beside it.
//!
//! Before the eigenvalues are sought, velocities are multiplied by √m and positions by √m and the frequency ω of each
//! freedom alone: entries are then alike, and without damping the matrix is nearly normal. A loose element is left out.

use super::assembly::{Assembly, AtRest, Body, Freedom, Hold};
use crate::statics::StaticError;
use brinell_eigen::{self as eigen, EigenError, Eigenpair, c64};
use std::f64::consts::TAU;

/// Why there are no modes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum ModesError {
    /// The equilibrium is missing.
    #[error(transparent)]
    Static(#[from] StaticError),
    /// The eigenproblem has no solution that can be trusted.
    #[error("cage angle {cage_angle_deg} degrees: {cause}")]
    Eigen { cage_angle_deg: f64, cause: EigenError },
}

/// How a mode moves by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// To and fro.
    Oscillating,
    /// Back without crossing, by two exponentials.
    Overdamped,
    /// To another position, at one rate: damped, but held by nothing.
    Decaying,
    /// Away at constant speed: held by nothing.
    Free,
    /// Away ever faster: the equilibrium is one on a ridge.
    Unstable,
}

/// One mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// How it moves.
    pub kind: Kind,
    /// Its eigenvalues λ (1/s), real and imaginary part: of a complex pair the one with positive imaginary part, of an
    /// overdamped one the faster first; of a free one none.
    pub eigenvalues: Vec<[f64; 2]>,
    /// Amplitude of each degree of freedom, the largest being 1, and its phase ahead of that (rad).
    pub shape: Vec<[f64; 2]>,
    /// Share of each degree of freedom in the kinetic energy; their sum is 1.
    pub energy: Vec<f64>,
    /// The same mode at other cage angles has the same number, if [`sweep`](super::lines::sweep) has followed it.
    pub line: Option<usize>,
    /// Velocities times √m, of length 1.
    pub(crate) motion: Vec<c64>,
}

/// All modes at one cage angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Angle of element 1 (rad).
    pub cage_angle: f64,
    /// Angle of each element (rad), counter-clockwise from +x, in [−π, π].
    pub angles: Vec<f64>,
    /// What holds each element.
    pub holds: Vec<Hold>,
    /// The modes, by ascending magnitude of the eigenvalue.
    pub modes: Vec<Mode>,
    /// Whether the inner and the outer raceway press on each element.
    pub(crate) carried: Vec<[bool; 2]>,
}

/// Share of the largest frequency up to which one counts as 0: a double eigenvalue 0 comes out as the root of a
/// rounding.
const NOTHING: f64 = 1e-6;
/// Share of the largest eigenvalue up to which a positive real part is rounding.
const ROUNDING: f64 = 1e-10;

impl Mode {
    /// Undamped natural frequency (Hz), of what oscillates or would do so without damping.
    pub fn undamped_frequency(&self) -> Option<f64> {
        match (self.kind, &self.eigenvalues[..]) {
            (Kind::Oscillating, &[[re, im]]) => Some(libm::hypot(re, im) / TAU),
            (Kind::Overdamped, &[[fast, _], [slow, _]]) => Some((fast * slow).sqrt() / TAU),
            _ => None,
        }
    }

    /// Frequency with damping (Hz), of what oscillates.
    pub fn damped_frequency(&self) -> Option<f64> {
        (self.kind == Kind::Oscillating).then(|| self.eigenvalues[0][1] / TAU)
    }

    /// Damping ratio ζ; above 1 of an overdamped pair.
    pub fn damping_ratio(&self) -> Option<f64> {
        let sum = match (self.kind, &self.eigenvalues[..]) {
            (Kind::Oscillating, &[[re, _]]) => 2.0 * re,
            (Kind::Overdamped, &[[fast, _], [slow, _]]) => fast + slow,
            _ => return None,
        };
        // 0 rather than −0 without damping.
        Some(0.0 - 0.5 * sum / (TAU * self.undamped_frequency()?))
    }

    /// How alike this mode's motion is to another's: the modal assurance criterion weighted with the masses, 0 to 1.
    pub fn similarity(&self, other: &Self) -> f64 {
        similarity(&self.motion, &other.motion)
    }
}

impl Assembly {
    /// Names of the degrees of freedom, in the order of [`Mode::shape`].
    pub fn freedom_names(&self) -> Vec<String> {
        self.freedoms().into_iter().map(|freedom| freedom.name).collect()
    }

    /// Share of a mode's kinetic energy in the bodies that `of` picks.
    pub fn share(&self, mode: &Mode, of: impl Fn(Body) -> bool) -> f64 {
        let freedoms = self.freedoms();
        freedoms.iter().zip(&mode.energy).filter(|(freedom, _)| of(freedom.body)).map(|(_, energy)| energy).sum()
    }

    /// The modes with element 1 at `cage_angle` (rad).
    ///
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell_analysis::modes::Assembly;
    /// use brinell_analysis::modes::Mode;
    ///
    /// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).shaft_load([0.0, -1500.0]).build()?;
    /// let modes = Assembly::new(&scene, None, None)?.modes(-std::f64::consts::FRAC_PI_2)?.modes;
    /// // The ball under the load swings between its raceways: ω² = (k_i + k_o)/m, k = 1.5 Q/δ of some 1e8 N/m each.
    /// let fastest = modes.iter().filter_map(Mode::undamped_frequency).fold(0.0, f64::max);
    /// assert!((3e4..6e4).contains(&fastest));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// No equilibrium; an eigenproblem without a solution that can be trusted.
    pub fn modes(&self, cage_angle: f64) -> Result<Modes, ModesError> {
        let rest = self.at_rest(cage_angle)?;
        let modes = Linear::new(&self.freedoms(), &rest)
            .modes()
            .map_err(|cause| ModesError::Eigen { cage_angle_deg: cage_angle.to_degrees(), cause })?;
        Ok(Modes { cage_angle, angles: rest.angles, holds: rest.holds, modes, carried: rest.carried })
    }
}

/// The linear problem of the degrees of freedom that something can hold.
struct Linear<'a> {
    all: &'a [Freedom],
    /// Those among them that are not loose, by number.
    held: Vec<usize>,
    rest: &'a AtRest,
}

impl<'a> Linear<'a> {
    fn new(all: &'a [Freedom], rest: &'a AtRest) -> Self {
        let is_held = |freedom: &Freedom| !matches!(freedom.body, Body::Element(j) if rest.holds[j] == Hold::Loose);
        let held = (0..all.len()).filter(|&i| is_held(&all[i])).collect();
        Self { all, held, rest }
    }

    fn count(&self) -> usize {
        self.held.len()
    }

    fn freedom(&self, i: usize) -> &Freedom {
        &self.all[self.held[i]]
    }

    /// −∂(acceleration)/∂(position) (1/s²), weighted with √m.
    fn stiffness(&self) -> Vec<Vec<f64>> {
        let entry = |i: usize, k: usize| {
            let (row, column) = (self.freedom(i), self.freedom(k));
            -self.rest.matrix[row.velocity][column.position] * (row.mass / column.mass).sqrt()
        };
        (0..self.count()).map(|i| (0..self.count()).map(|k| entry(i, k)).collect()).collect()
    }

    fn modes(&self) -> Result<Vec<Mode>, EigenError> {
        let count = self.count();
        if count == 0 {
            return Ok(Vec::new());
        }
        let stiffness = self.stiffness();
        let fastest = (0..count).map(|i| stiffness[i][i].abs()).fold(f64::MIN_POSITIVE, f64::max).sqrt();
        // Of a freedom alone; what nothing holds is weighted like the fastest.
        let rate = |i: usize| {
            let alone = stiffness[i][i].abs().sqrt();
            if alone > NOTHING * fastest { alone } else { fastest }
        };
        let scale: Vec<f64> = (0..2 * count)
            .map(|i| self.freedom(i % count).mass.sqrt() * if i < count { rate(i) } else { 1.0 })
            .collect();
        let index = |i: usize| {
            let freedom = self.freedom(i % count);
            if i < count { freedom.position } else { freedom.velocity }
        };
        let entry = |i: usize, k: usize| self.rest.matrix[index(i)][index(k)] * (scale[i] / scale[k]);
        let matrix: Vec<Vec<f64>> = (0..2 * count).map(|i| (0..2 * count).map(|k| entry(i, k)).collect()).collect();
        let free = eigen::null_space(&stiffness, NOTHING * NOTHING)?;
        let mut pairs = eigen::eigenpairs(&matrix)?;
        pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()));
        let largest = pairs.last().map_or(0.0, |pair| pair.value.norm());
        // Without damping a free direction has the eigenvalue 0 twice, a complex pair counting twice; with damping
        // once.
        let mut zeros = 0;
        pairs.retain(|pair| {
            let zero = zeros < 2 * free.len() && (zeros < free.len() || pair.value.norm() <= NOTHING * largest);
            zeros += if !zero {
                0
            } else if pair.value.im > 0.0 {
                2
            } else {
                1
            };
            !zero
        });
        let mut modes: Vec<Mode> = free.iter().map(|direction| self.free_mode(direction)).collect();
        let unpaired = (2 * free.len()).saturating_sub(zeros);
        modes.extend(
            sort_out(pairs, unpaired, largest).into_iter().map(|(kind, pairs)| self.mode(kind, &pairs, &scale)),
        );
        modes.sort_by(|a, b| magnitude(a).total_cmp(&magnitude(b)));
        Ok(modes)
    }

    fn mode(&self, kind: Kind, pairs: &[Eigenpair], scale: &[f64]) -> Mode {
        let vector = &pairs[0].vector;
        let displacements = (0..self.count()).map(|i| vector[i] / scale[i]).collect();
        let eigenvalues = pairs.iter().map(|pair| [pair.value.re, pair.value.im]).collect();
        self.described(kind, eigenvalues, displacements, vector[self.count()..].to_vec())
    }

    /// `direction`: displacements times √m.
    fn free_mode(&self, direction: &[f64]) -> Mode {
        let displacements: Vec<c64> =
            direction.iter().enumerate().map(|(i, d)| c64::new(d / self.freedom(i).mass.sqrt(), 0.0)).collect();
        // What the velocities are while the displacements grow steadily: w = u' + e_r·v_o.
        let velocity = |i: usize| {
            let row = &self.rest.matrix[self.freedom(i).position];
            let of_rings: c64 =
                (0..self.count()).filter(|&k| k != i).map(|k| displacements[k] * row[self.freedom(k).velocity]).sum();
            (displacements[i] - of_rings) * self.freedom(i).mass.sqrt()
        };
        let motion = (0..self.count()).map(velocity).collect();
        self.described(Kind::Free, Vec::new(), displacements, motion)
    }

    /// A mode in all degrees of freedom; loose ones stand still.
    fn described(&self, kind: Kind, eigenvalues: Vec<[f64; 2]>, displacements: Vec<c64>, velocities: Vec<c64>) -> Mode {
        let largest =
            displacements.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or(c64::new(1.0, 0.0));
        let length = velocities.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt();
        let (mut shape, mut motion) = (vec![[0.0; 2]; self.all.len()], vec![c64::new(0.0, 0.0); self.all.len()]);
        for (i, &freedom) in self.held.iter().enumerate() {
            let relative = displacements[i] / largest;
            shape[freedom] = [relative.norm(), libm::atan2(relative.im, relative.re)];
            motion[freedom] = velocities[i] / length;
        }
        let energy = motion.iter().map(|v| v.norm_sqr()).collect();
        Mode { kind, eigenvalues, shape, energy, line: None, motion }
    }
}

/// What the eigenvalues other than 0 are, real ones in pairs of similar motion except for `unpaired`. Instability has
/// none.
fn sort_out(pairs: Vec<Eigenpair>, unpaired: usize, largest: f64) -> Vec<(Kind, Vec<Eigenpair>)> {
    let (unstable, stable): (Vec<_>, Vec<_>) = pairs.into_iter().partition(|pair| pair.value.re > ROUNDING * largest);
    let (complex, mut real): (Vec<_>, Vec<_>) = stable.into_iter().partition(|pair| pair.value.im > 0.0);
    // A ridge has one eigenvalue on either side of 0.
    let single = unpaired + unstable.iter().filter(|pair| pair.value.im == 0.0).count();
    let mut found: Vec<(Kind, Vec<Eigenpair>)> = Vec::new();
    while real.len() > single + 1 {
        let motion = |pair: &Eigenpair| pair.vector[pair.vector.len() / 2..].to_vec();
        let alike = |&(i, k): &(usize, usize)| similarity(&motion(&real[i]), &motion(&real[k]));
        let all = (1..real.len()).flat_map(|k| (0..k).map(move |i| (i, k)));
        let Some((i, k)) = all.max_by(|a, b| alike(a).total_cmp(&alike(b))) else { break };
        // Sorted by magnitude: the faster is the later.
        let faster = real.remove(k);
        found.push((Kind::Overdamped, vec![faster, real.remove(i)]));
    }
    found.extend(real.into_iter().map(|pair| (Kind::Decaying, vec![pair])));
    found.extend(complex.into_iter().map(|pair| (Kind::Oscillating, vec![pair])));
    found.extend(unstable.into_iter().map(|pair| (Kind::Unstable, vec![pair])));
    found
}

fn similarity(a: &[c64], b: &[c64]) -> f64 {
    let length = |v: &[c64]| v.iter().map(|z| z.norm_sqr()).sum::<f64>();
    let product: c64 = a.iter().zip(b).map(|(a, b)| a.conj() * b).sum();
    product.norm_sqr() / (length(a) * length(b)).max(f64::MIN_POSITIVE)
}

fn magnitude(mode: &Mode) -> f64 {
    // Of an overdamped pair the geometric mean.
    let product: f64 = mode.eigenvalues.iter().map(|&[re, im]| libm::hypot(re, im)).product();
    if mode.eigenvalues.len() == 2 {
        product.sqrt()
    } else if mode.eigenvalues.is_empty() {
        0.0
    } else {
        product
    }
}
