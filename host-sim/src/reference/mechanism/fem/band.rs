//! Linear equations with a band matrix.

/// A square matrix with entries next to its diagonal only.
#[derive(Clone, Debug)]
pub(super) struct Band {
    size: usize,
    /// Diagonals above the main one, and below it.
    width: usize,
    /// Row by row, `2·width + 1` entries each, the diagonal in the middle.
    entries: Vec<f64>,
}

impl Band {
    pub fn new(size: usize, width: usize) -> Self {
        Self { size, width, entries: vec![0.0; size * (2 * width + 1)] }
    }

    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry. What lies outside the matrix is left out.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if row < self.size && column < self.size {
            let at = self.at(row, column);
            self.entries[at] += value;
        }
    }

    fn at(&self, row: usize, column: usize) -> usize {
        debug_assert!(row.abs_diff(column) <= self.width, "({row}, {column}) outside the band");
        row * (2 * self.width + 1) + self.width + column - row
    }

    /// Replaces `b` by the solution, without pivoting: a mass or a stable stiffness dominates. The
    /// matrix is used up. Returns `None` if a pivot is zero or not finite; with `positive` also if
    /// one is negative.
    pub fn solve(&mut self, b: &mut [f64], positive: bool) -> Option<()> {
        let n = self.size;
        for k in 0..n {
            let pivot = self.entries[self.at(k, k)];
            if pivot == 0.0 || !pivot.is_finite() || (positive && pivot < 0.0) {
                return None;
            }
            for i in k + 1..n.min(k + self.width + 1) {
                let factor = self.entries[self.at(i, k)] / pivot;
                if factor == 0.0 {
                    continue;
                }
                for j in k + 1..n.min(k + self.width + 1) {
                    let above = self.entries[self.at(k, j)];
                    let at = self.at(i, j);
                    self.entries[at] -= factor * above;
                }
                b[i] -= factor * b[k];
            }
        }
        for k in (0..n).rev() {
            let mut sum = b[k];
            for j in k + 1..n.min(k + self.width + 1) {
                sum -= self.entries[self.at(k, j)] * b[j];
            }
            b[k] = sum / self.entries[self.at(k, k)];
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    #[test]
    fn solves_as_a_full_matrix_does() {
        let (n, width) = (9, 3);
        let mut band = Band::new(n, width);
        let mut full = DMatrix::zeros(n, n);
        for i in 0..n {
            for j in i.saturating_sub(width)..n.min(i + width + 1) {
                let off = ((7 * i + 3 * j) % 11) as f64 / 11.0;
                let value = if i == j { 4.0 + off } else { off };
                band.add(i, j, value);
                full[(i, j)] = value;
            }
        }
        // Torques stand behind the unknowns and have no columns.
        band.add(n, 0, 1.0);
        let exact = DVector::from_fn(n, |i, _| 1.0 + i as f64);
        let mut b: Vec<f64> = (full * &exact).iter().copied().collect();
        assert!(band.solve(&mut b, true).is_some());
        for (found, exact) in b.iter().zip(exact.iter()) {
            assert!((found - exact).abs() < 1e-12);
        }
    }

    #[test]
    fn tells_a_negative_pivot() {
        let mut band = Band::new(2, 1);
        band.add(0, 0, 1.0);
        band.add(0, 1, 2.0);
        band.add(1, 0, 2.0);
        band.add(1, 1, 1.0);
        assert!(band.clone().solve(&mut [1.0, 1.0], true).is_none());
        assert!(band.solve(&mut [1.0, 1.0], false).is_some());
    }
}
