//! Systems of linear equations.

/// The solution of a square system, by elimination with pivots; `None` of a singular one.
pub(crate) fn solve(mut rows: Vec<Vec<f64>>, right: &[f64]) -> Option<Vec<f64>> {
    let n = right.len();
    for (row, value) in rows.iter_mut().zip(right) {
        row.push(*value);
    }
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs()))?;
        rows.swap(i, pivot);
        if rows[i][i] == 0.0 || !rows[i][i].is_finite() {
            return None;
        }
        for k in i + 1..n {
            let share = rows[k][i] / rows[i][i];
            for c in i..=n {
                rows[k][c] -= share * rows[i][c];
            }
        }
    }
    let mut found = vec![0.0; n];
    for i in (0..n).rev() {
        let behind: f64 = (i + 1..n).map(|k| rows[i][k] * found[k]).sum();
        found[i] = (rows[i][n] - behind) / rows[i][i];
    }
    Some(found)
}
