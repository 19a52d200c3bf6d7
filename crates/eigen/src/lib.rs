//! Dense eigenproblems of a few dozen rows, solved by faer.
//!
//! A crate of its own: faer's methods are generic, and are compiled here once for all who use them.

use faer::Mat;
pub use faer::c64;
use faer::linalg::solvers::{Solve, SolveLstsq};

/// Why an eigenproblem has no solution that can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum EigenError {
    /// An entry of the matrix is no finite number.
    #[error("an entry of the matrix is not finite")]
    NotFinite,
    /// Least squares with fewer rows than unknowns, or other rows than known numbers.
    #[error("{rows} rows and {known} known numbers for {unknown} unknowns")]
    Shape { rows: usize, known: usize, unknown: usize },
    /// The iteration did not end.
    #[error("the iteration for eigenvalues did not converge")]
    NoConvergence,
    /// An eigenpair does not satisfy its equation.
    #[error("an eigenpair misses its equation by {residual:.1e} of the matrix's norm (limit {limit:.0e})")]
    Residual { residual: f64, limit: f64 },
}

/// Largest ‖Az − λz‖ of a pair, as a share of ‖A‖ ‖z‖: a thousand times the rounding of some fifty rows.
const RESIDUAL: f64 = 1e-11;
/// Distance from an eigenvalue, as a share of ‖A‖, at which A − λ can be inverted.
const ROUNDING: f64 = 1e-15;

/// An eigenvalue and its vector, of Euclidean length 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Eigenpair {
    /// The eigenvalue.
    pub value: c64,
    /// Its vector.
    pub vector: Vec<c64>,
}

/// The eigenvalues of a square real matrix, rows by columns, both of each complex pair.
///
/// # Errors
/// A matrix with an entry that is not finite; no convergence.
pub fn eigenvalues(matrix: &[Vec<f64>]) -> Result<Vec<c64>, EigenError> {
    to_faer(matrix)?.eigenvalues().map_err(|_| EigenError::NoConvergence)
}

/// The eigenpairs of a square real matrix, rows by columns; of each complex pair the one with positive imaginary part.
///
/// # Errors
/// A matrix with an entry that is not finite; no convergence; pairs that miss the equation.
pub fn eigenpairs(matrix: &[Vec<f64>]) -> Result<Vec<Eigenpair>, EigenError> {
    let size = matrix.len();
    let found = to_faer(matrix)?.eigen().map_err(|_| EigenError::NoConvergence)?;
    let (values, vectors) = (found.S(), found.U());
    let norm = matrix.iter().flatten().map(|entry| entry * entry).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    let mut pairs = Vec::with_capacity(size);
    for k in 0..size {
        let value = values[k];
        // NaN is kept, and refused below.
        if value.im < 0.0 {
            continue;
        }
        let mut vector = unit((0..size).map(|i| vectors[(i, k)]).collect());
        if !(miss(matrix, value, &vector) <= RESIDUAL * norm) {
            vector = refined(matrix, value + ROUNDING * norm, &vector);
        }
        let missing = miss(matrix, value, &vector);
        if !(missing <= RESIDUAL * norm) {
            return Err(EigenError::Residual { residual: missing / norm, limit: RESIDUAL });
        }
        pairs.push(Eigenpair { value, vector });
    }
    Ok(pairs)
}

/// ‖Az − λz‖ for a vector z of length 1.
fn miss(matrix: &[Vec<f64>], value: c64, vector: &[c64]) -> f64 {
    let rows = matrix.iter().zip(vector).map(|(row, own)| {
        let product: c64 = row.iter().zip(vector).map(|(&entry, z)| z * entry).sum();
        (product - value * own).norm_sqr()
    });
    rows.sum::<f64>().sqrt()
}

/// One step of inverse iteration beside an eigenvalue. Of eigenvalues that are equal to the last digit, as two elements
/// have that lie symmetrically between held rings, faer's vectors are good to 1e-5 only.
fn refined(matrix: &[Vec<f64>], beside: c64, vector: &[c64]) -> Vec<c64> {
    let size = matrix.len();
    let diagonal = |i: usize, k: usize| if i == k { beside } else { c64::new(0.0, 0.0) };
    let shifted = Mat::from_fn(size, size, |i, k| c64::new(matrix[i][k], 0.0) - diagonal(i, k));
    let solution = shifted.partial_piv_lu().solve(Mat::from_fn(size, 1, |i, _| vector[i]));
    unit((0..size).map(|i| solution[(i, 0)]).collect())
}

fn unit(vector: Vec<c64>) -> Vec<c64> {
    let length = vector.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt();
    vector.into_iter().map(|z| z / length).collect()
}

/// Directions that a square real matrix maps to nothing: right singular vectors whose singular value is at most `share`
/// of the largest.
///
/// # Errors
/// As for [`eigenpairs`].
pub fn null_space(matrix: &[Vec<f64>], share: f64) -> Result<Vec<Vec<f64>>, EigenError> {
    let size = matrix.len();
    let found = to_faer(matrix)?.svd().map_err(|_| EigenError::NoConvergence)?;
    let (values, vectors) = (found.S(), found.V());
    let largest = (0..size).map(|k| values[k]).fold(0.0, f64::max);
    let nothing = (0..size).filter(|&k| values[k] <= share * largest);
    Ok(nothing.map(|k| (0..size).map(|i| vectors[(i, k)]).collect()).collect())
}

/// The numbers for which the rows' products with them come nearest to `known`, by Householder's method with pivots.
///
/// # Errors
/// Fewer rows than columns have no nearest; entries or a result that are not finite.
pub fn least_squares(rows: &[Vec<f64>], known: &[f64]) -> Result<Vec<f64>, EigenError> {
    let columns = rows.first().map_or(0, Vec::len);
    if rows.len() < columns || rows.len() != known.len() {
        return Err(EigenError::Shape { rows: rows.len(), known: known.len(), unknown: columns });
    }
    if !rows.iter().flatten().chain(known).all(|entry| entry.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    let matrix = Mat::from_fn(rows.len(), columns, |i, k| rows[i][k]);
    let solution = matrix.col_piv_qr().solve_lstsq(Mat::from_fn(known.len(), 1, |i, _| known[i]));
    let found: Vec<f64> = (0..columns).map(|k| solution[(k, 0)]).collect();
    if found.iter().all(|number| number.is_finite()) { Ok(found) } else { Err(EigenError::NotFinite) }
}

/// A square matrix whose entries are all finite.
fn to_faer(matrix: &[Vec<f64>]) -> Result<Mat<f64>, EigenError> {
    if !matrix.iter().flatten().all(|entry| entry.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    Ok(Mat::from_fn(matrix.len(), matrix.len(), |i, k| matrix[i][k]))
}
