//! Axes: ranges, ticks and labels.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// One axis.
#[derive(Clone, Debug)]
pub struct Axis {
    pub(super) label: String,
    log: bool,
    limits: Option<(f64, f64)>,
    tight: bool,
}

/// An axis with a known range. Positions on it are linear, or decades on a logarithmic axis.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    log: bool,
    pub low: f64,
    pub high: f64,
    pub ticks: Vec<f64>,
    decimals: usize,
}

impl Axis {
    /// Creates a linear axis with a margin at both ends. The label names quantity and unit.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), log: false, limits: None, tight: false }
    }

    /// Creates a linear axis that ends at the outermost points, for time.
    pub fn tight(label: impl Into<String>) -> Self {
        Self { tight: true, ..Self::linear(label) }
    }

    /// Creates a logarithmic axis. Points that are not positive are left out.
    pub fn log(label: impl Into<String>) -> Self {
        Self { log: true, ..Self::linear(label) }
    }

    /// Fixes both ends.
    pub fn limits(mut self, low: f64, high: f64) -> Self {
        self.limits = Some((low, high));
        self
    }

    /// Returns the position of a value on the axis, or `None` if it has none.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        let place = if self.log { value.log10() } else { value };
        (place.is_finite() && (!self.log || value > 0.0)).then_some(place)
    }

    /// Returns the range that holds all `values`, with about `count` ticks.
    pub(super) fn ruler(&self, values: impl Iterator<Item = f64>, count: usize) -> Ruler {
        let ends = match self.limits {
            Some((low, high)) => self.place(low).zip(self.place(high)),
            None => values.filter_map(|value| self.place(value)).fold(None, |ends, place| {
                let (low, high) = ends.unwrap_or((place, place));
                Some((place.min(low), place.max(high)))
            }),
        };
        let (mut low, mut high) = ends.unwrap_or((0.0, 1.0));
        if high - low <= 1e-9 * low.abs().max(high.abs()).max(1e-12) {
            let half = if self.log { 0.5 } else { 0.5 * low.abs().max(1.0) };
            (low, high) = (low - half, high + half);
        } else if self.limits.is_none() && !self.tight {
            let air = 0.05 * (high - low);
            (low, high) = (low - air, high + air);
        }
        Ruler::new(self.log, low, high, count)
    }
}

impl Ruler {
    fn new(log: bool, low: f64, high: f64, count: usize) -> Self {
        if log {
            return Self { log, low, high, ticks: decades(low, high, count), decimals: 0 };
        }
        let ends = |step: f64| ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
        let mut step = nice_step((high - low) / count as f64);
        // Fewer than three ticks say little of the scale.
        while ends(step).1 - ends(step).0 < 2.0 {
            step = nice_step(0.4 * step);
        }
        let (first, last) = ends(step);
        let ticks = (0..=(last - first) as usize).map(|k| (first + k as f64) * step).collect();
        let decimals = (-(step.log10() + 1e-9).floor()).max(0.0) as usize;
        Self { log, low, high, ticks, decimals }
    }

    /// Returns the ruler of the same kind over another range.
    pub fn stretched(&self, low: f64, high: f64, count: usize) -> Self {
        Self::new(self.log, low, high, count)
    }

    /// Returns the label of the tick at that position.
    pub fn words(&self, position: f64) -> String {
        let text =
            if self.log { power(position) } else { format!("{:.*}", self.decimals, position) };
        let zero = text.trim_start_matches('-').chars().all(|c| matches!(c, '0' | '.'));
        if zero { text.trim_start_matches('-').into() } else { text.replace('-', "\u{2212}") }
    }
}

/// Passes the range and ticks of the axis to plotters, which decides nothing itself.
impl Ranged for Ruler {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        limit.0 + (share * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Ruler {
    fn format_ext(&self, value: &f64) -> String {
        self.words(*value)
    }
}

/// Returns 1, 2 or 5 times a power of ten, nearest above `step`.
fn nice_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= step * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

/// Returns the positions of whole decades, of 1, 2 and 5 if there are few, of every other if many.
fn decades(low: f64, high: f64, count: usize) -> Vec<f64> {
    let span = high - low;
    let within = |position: &f64| (low - 1e-9..=high + 1e-9).contains(position);
    let every = ((span / count as f64).ceil() as i32).max(1);
    let whole = (low.floor() as i32..=high.ceil() as i32).filter(|k| k % every == 0);
    let parts: &[f64] = if span < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
    whole
        .flat_map(|k| parts.iter().map(move |part| f64::from(k) + part.log10()))
        .filter(within)
        .collect()
}

/// Formats 10 to that power: plain from a thousandth to a hundred thousand.
fn power(exponent: f64) -> String {
    let value = 10f64.powf(exponent);
    if (-3.01..5.01).contains(&exponent) {
        let decimals = (-(exponent + 1e-9).floor()).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let ruler = Axis::linear("x").ruler([0.0, 0.4].into_iter(), 5);
        let words: Vec<_> = ruler.ticks.iter().map(|&tick| ruler.words(tick)).collect();
        assert_eq!(words, ["0.0", "0.1", "0.2", "0.3", "0.4"]);
        let ruler = Axis::tight("t").ruler([-2.0, 2.0].into_iter(), 4);
        let words: Vec<_> = ruler.ticks.iter().map(|&tick| ruler.words(tick)).collect();
        assert_eq!(words, ["\u{2212}2", "\u{2212}1", "0", "1", "2"]);
    }

    #[test]
    fn three_ticks_at_least() {
        for span in [1.0, 1.7, 2.4, 3.0, 4.9, 7.7, 9.3] {
            let ruler = Axis::linear("y").ruler([-0.47 * span, 0.53 * span].into_iter(), 2);
            assert!(ruler.ticks.len() >= 3, "{span}: {:?}", ruler.ticks);
        }
    }

    #[test]
    fn logarithmic_ticks() {
        let ruler = Axis::log("x").ruler([1e-6, 1e-1].into_iter(), 6);
        let words: Vec<_> = ruler.ticks.iter().map(|&tick| ruler.words(tick)).collect();
        assert_eq!(words, ["1e\u{2212}6", "1e\u{2212}5", "1e\u{2212}4", "0.001", "0.01", "0.1"]);
        let ruler = Axis::log("x").limits(1.0, 100.0).ruler(std::iter::empty(), 6);
        let words: Vec<_> = ruler.ticks.iter().map(|&tick| ruler.words(tick)).collect();
        assert_eq!(words, ["1", "2", "5", "10", "20", "50", "100"]);
    }

    #[test]
    fn no_points_and_equal_points_have_a_range() {
        for values in [vec![], vec![3.0, 3.0], vec![f64::NAN]] {
            let ruler = Axis::linear("x").ruler(values.into_iter(), 5);
            assert!(ruler.high > ruler.low && ruler.ticks.len() > 1);
        }
    }
}
