//! A defect of the raceway below a ball: where its edges are and how deep it is, counted from the point below the
//! ball's centre.

use brinell::surface::Surface;

/// A defect, and where the ball is on it.
#[derive(Debug, Clone)]
pub struct DefectBelow {
    /// Its depth.
    pub surface: Surface,
    /// Arc (m) of the ball from its middle.
    pub arc: f64,
}

impl DefectBelow {
    /// Where the depth jumps, along the raceway (m) from the point below the ball's centre.
    pub(crate) fn edges(&self) -> impl Iterator<Item = f64> {
        self.surface.edges().into_iter().map(|edge| edge - self.arc)
    }

    /// Adds its depth to that of each cell of a window.
    pub(crate) fn add_depth(&self, window: [[f64; 2]; 2], cell: [f64; 2], sum: &mut [f64]) {
        let [[x0, _], [y0, y1]] = window;
        let columns = ((window[0][1] - x0) / cell[0]).round() as usize;
        let side = |from: f64, i: usize, cell: f64| [from + i as f64 * cell, from + (i + 1) as f64 * cell];
        let row = |axial: [f64; 2]| -> Vec<f64> {
            (0..columns).map(|i| self.surface.mean_depth(side(self.arc + x0, i, cell[0]), axial)).collect()
        };
        // The same depth over the whole width.
        let profile = matches!(self.surface, Surface::Profile(_)).then(|| row([y0, y1]));
        for (j, line) in sum.chunks_exact_mut(columns).enumerate() {
            let depth = profile.clone().unwrap_or_else(|| row(side(y0, j, cell[1])));
            line.iter_mut().zip(depth).for_each(|(sum, d)| *sum += d);
        }
    }
}
