//! Eigenvalues by their formulas, vectors of equal eigenvalues, and what is refused.
#![allow(clippy::unwrap_used)]

use brinell_eigen::{EigenError, c64, eigenpairs, null_space};

#[test]
fn a_damped_oscillator_and_a_free_mass_have_the_eigenvalues_of_their_formulas() {
    // x'' = −100 x − 4 x', y'' = −3 y'; state [x, y, x', y'].
    let matrix = [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [-100.0, 0.0, -4.0, 0.0], [0.0, 0.0, 0.0, -3.0]];
    let mut pairs = eigenpairs(&matrix.map(|row| row.to_vec())).unwrap();
    pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()));
    let expected = [c64::new(0.0, 0.0), c64::new(-3.0, 0.0), c64::new(-2.0, 96f64.sqrt())];
    for (pair, expected) in pairs.iter().zip(expected) {
        // Roundings of a matrix of norm 100.
        assert!((pair.value - expected).norm() < 1e-12, "{} against {expected}", pair.value);
    }
    assert_eq!(pairs.len(), 3);
    let free = null_space(&[vec![-100.0, 0.0], vec![0.0, 0.0]], 1e-12).unwrap();
    assert_eq!((free.len(), free[0][0].abs(), free[0][1].abs()), (1, 0.0, 1.0));
}

#[test]
fn equal_eigenvalues_have_vectors_of_their_own() {
    // ω, −ω and −2ζω of nine elements between held rings, four of them mirror images of four others.
    let alone = [
        [306979.41417318094, -306979.414173181, -188655.36938332662],
        [233876.54096458433, -233876.54096458427, -36892.11069810774],
        [31019.46926682775, -31019.469266827746, -0.8517439558798716],
        [39725.10670012327, -39725.10670012328, -3.757447325232282],
        [41529.446442818335, -41529.44644281834, -4.904999999999419],
        [39725.10670012563, -39725.10670012563, -3.757447325233621],
        [31019.469266826523, -31019.469266826523, -0.8517439558796698],
        [233876.54096458433, -233876.54096458427, -36892.11069810774],
        [306979.41417318094, -306979.414173181, -188655.36938332667],
    ];
    let mut matrix = vec![vec![0.0; 18]; 18];
    for (i, entries) in alone.into_iter().enumerate() {
        [matrix[i][9 + i], matrix[9 + i][i], matrix[9 + i][9 + i]] = entries;
    }
    let pairs = eigenpairs(&matrix).unwrap();
    assert_eq!(pairs.len(), 9);
    for (k, a) in pairs.iter().enumerate() {
        for b in &pairs[..k] {
            let product: c64 = a.vector.iter().zip(&b.vector).map(|(a, b)| a.conj() * b).sum();
            // Parallel vectors would have 1; what is left between them is any amount below.
            assert!(product.norm() < 0.99, "{} and {}: {}", a.value, b.value, product.norm());
        }
    }
}

#[test]
fn a_matrix_that_is_not_finite_is_refused() {
    assert_eq!(eigenpairs(&[vec![f64::NAN]]), Err(EigenError::NotFinite));
    assert_eq!(null_space(&[vec![f64::INFINITY]], 1e-12), Err(EigenError::NotFinite));
}
