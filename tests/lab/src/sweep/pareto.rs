//! The cases that nothing beats in both time and error.

/// Returns the indices of the points that no other point dominates, by rising `x`. A point
/// dominates another if it is as small or smaller in both coordinates and smaller in one. Of equal
/// points the first counts. Points that are not finite are on no front.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let finite = |&i: &usize| points[i].0.is_finite() && points[i].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    // Stable: equal points stay in their order.
    order.sort_by(|&a, &b| {
        points[a].0.total_cmp(&points[b].0).then(points[a].1.total_cmp(&points[b].1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < least;
        least = least.min(points[i].1);
        better
    });
    order
}
