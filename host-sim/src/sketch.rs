//! Small plots in letters, for a terminal.

use rasciigraph::{Config, plot};

/// Columns and rows of a plot's lines.
const SIZE: (u32, u32) = (64, 8);

/// Draws a quantity that is sampled at even times from 0 to `end` s. Values beyond all bounds are
/// left out, and nothing is drawn of fewer than two.
pub fn over_time(title: &str, values: impl Iterator<Item = f64>, end: f64) -> Option<String> {
    let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    if values.len() < 2 {
        return None;
    }
    let caption = format!("{title}, over 0 to {end} s");
    let (width, height) = SIZE;
    let config = Config::default().with_width(width).with_height(height).with_caption(caption);
    Some(plot(values, config).trim_end().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_shows_range_and_unit() {
        let sketch = over_time("deflection, mm", (0..100).map(|k| f64::from(k) - 50.0), 1.5);
        let sketch = sketch.expect("a plot");
        for words in ["deflection, mm, over 0 to 1.5 s", "49.00", "-50.00"] {
            assert!(sketch.contains(words), "{words} is not in:\n{sketch}");
        }
        assert!(sketch.lines().all(|line| line.chars().count() < 80), "{sketch}");
    }

    #[test]
    fn what_is_no_curve_is_not_drawn() {
        assert_eq!(over_time("x", [f64::NAN, 1.0, f64::INFINITY].into_iter(), 1.0), None);
    }
}
