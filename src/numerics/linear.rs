//! Small systems of linear equations.

/// Gaussian elimination of four equations with row pivoting; a singular system gives non-finite values.
pub fn solve4(mut a: [[f64; 4]; 4], mut b: [f64; 4]) -> [f64; 4] {
    for i in 0..4 {
        let pivot = (i..4).fold(i, |best, k| if a[k][i].abs() > a[best][i].abs() { k } else { best });
        a.swap(i, pivot);
        b.swap(i, pivot);
        for k in i + 1..4 {
            let factor = a[k][i] / a[i][i];
            let pivot_row = a[i];
            for (value, above) in a[k].iter_mut().zip(pivot_row).skip(i) {
                *value -= factor * above;
            }
            b[k] -= factor * b[i];
        }
    }
    let mut x = [0.0; 4];
    for i in (0..4).rev() {
        let sum: f64 = (i + 1..4).map(|k| a[i][k] * x[k]).sum();
        x[i] = (b[i] - sum) / a[i][i];
    }
    x
}
