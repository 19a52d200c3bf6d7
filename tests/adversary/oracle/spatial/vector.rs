//! Vectors in space.

/// x, y, z.
pub type Vector = [f64; 3];

pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn subtract(a: Vector, b: Vector) -> Vector {
    add(a, times(-1.0, b))
}

pub fn times(factor: f64, a: Vector) -> Vector {
    [factor * a[0], factor * a[1], factor * a[2]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// The solution of a square system, by elimination with pivots; `None` of a singular one.
pub fn solve(mut rows: Vec<Vec<f64>>, right: &[f64]) -> Option<Vec<f64>> {
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
