//! Rests among samples, and the parts in between, in which the hub moves.
//!
//! A spline whose acceleration is continuous rounds off one that jumps, over a few knots. Most
//! jumps are where a motion begins or ends. Between two rests the motion is a spline of its own,
//! whose ends are at rest and whose acceleration is free there.

use super::Part;
use super::spline::Knots;

/// Fewest samples of a rest, and fewest of a part that moves.
const FEWEST: usize = 8;

/// Fewest intervals between knots that a rest lasts, and a part that moves.
const SHORTEST: usize = 4;

/// Standard deviations of the quietest samples within which an angle counts as the same.
const SURE: f64 = 6.0;

/// Share of the angle turned within which an angle counts as the same, as numbers of a file do.
const ROUNDING: f64 = 1e-9;

/// Returns the parts in which the hub moves, or none if it does not rest in between or is at rest
/// all the time.
pub(super) fn parts(times: &[f64], angles: &[f64], knots: Knots) -> Vec<Part> {
    let rests = rests(times, angles, knots);
    let mut parts = Vec::new();
    // The knot, and the sample in the middle of the rest, at which a part begins.
    let mut begin = (0, 0);
    for rest in rests.iter().chain(&[Rest::none_at(knots.count, times.len())]) {
        if rest.first_knot > begin.0 {
            let (samples, last) = (begin.1..rest.middle, rest.first_knot);
            let part = part(times, angles, knots, [begin.0, last], samples);
            if part.times.len() < FEWEST || part.knots.count < SHORTEST {
                return Vec::new();
            }
            parts.push(part);
        }
        begin = (rest.last_knot, rest.middle);
    }
    if rests.is_empty() { Vec::new() } else { parts }
}

/// A stretch of samples in which the hub rests.
struct Rest {
    first_knot: usize,
    last_knot: usize,
    /// Sample in its middle.
    middle: usize,
}

impl Rest {
    /// The end of the samples, without a rest.
    fn none_at(knot: usize, samples: usize) -> Self {
        Self { first_knot: knot, last_knot: knot, middle: samples }
    }
}

/// Returns the rests, each as long as it lasts.
fn rests(times: &[f64], angles: &[f64], knots: Knots) -> Vec<Rest> {
    let same = 2.0 * same(angles);
    let mut rests = Vec::new();
    let mut first = 0;
    while first < angles.len() {
        let (mut low, mut high, mut end) = (angles[first], angles[first], first);
        while end < angles.len() {
            (low, high) = (low.min(angles[end]), high.max(angles[end]));
            if high - low > same {
                break;
            }
            end += 1;
        }
        // From the knot on or after the first sample up to the one before the last.
        let first_knot = (times[first] / knots.width - 1e-6).ceil() as usize;
        let whole = end == angles.len();
        let last_knot = (times[end - 1] / knots.width + 1e-6).floor() as usize;
        let last_knot = if whole { knots.count } else { last_knot.min(knots.count) };
        if end - first >= FEWEST && last_knot >= first_knot + SHORTEST {
            let middle = match (first, whole) {
                (0, _) => 0,
                (_, true) => end,
                _ => first + (end - first) / 2,
            };
            rests.push(Rest { first_knot, last_knot, middle });
            first = end;
        } else {
            first += 1;
        }
    }
    rests
}

/// Returns the distance within which an angle counts as the same, rad: by the quietest samples.
fn same(angles: &[f64]) -> f64 {
    let deviation = |window: &[f64]| {
        let mean = window.iter().sum::<f64>() / window.len() as f64;
        (window.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / window.len() as f64).sqrt()
    };
    let quietest = angles.windows(FEWEST).map(deviation).fold(f64::INFINITY, f64::min);
    let [low, high] = angles
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)]);
    (SURE * quietest).max(ROUNDING * (high - low))
}

/// Cuts a part out, its samples' times held between its knots: those of half a rest on either side
/// say where its ends are.
fn part(
    times: &[f64],
    angles: &[f64],
    knots: Knots,
    [first, last]: [usize; 2],
    samples: std::ops::Range<usize>,
) -> Part {
    let knots = Knots { count: last - first, ..knots };
    let [begin, length] = [first, last - first].map(|knot| knot as f64 * knots.width);
    let own = |t: &f64| (t - begin).clamp(0.0, length);
    Part {
        first,
        knots,
        times: times[samples.clone()].iter().map(own).collect(),
        angles: angles[samples].to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp between two rests: it begins and ends at the knots where the rests do.
    #[test]
    fn a_ramp_between_two_rests_is_one_part() {
        let times: Vec<f64> = (0..=60).map(|k| 0.01 * f64::from(k)).collect();
        let angles: Vec<f64> = times.iter().map(|t| t.clamp(0.2, 0.35)).collect();
        let knots = Knots { width: 0.01, count: 60 };
        let parts = parts(&times, &angles, knots);
        let [part] = &parts[..] else { panic!("{} parts", parts.len()) };
        assert_eq!((part.first, part.knots.count), (20, 15));
        assert!(part.times.iter().all(|t| (0.0..=0.15).contains(t)));
        assert_eq!(part.times.len(), times.len());
        assert!(super::parts(&times, &times, knots).is_empty(), "no rest");
        assert!(super::parts(&times, &vec![0.3; times.len()], knots).is_empty(), "no motion");
    }
}
