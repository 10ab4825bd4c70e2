//! Line charts and scatter pictures as SVG text.
//!
//! ```
//! use stillbeam_sim::plot::{Axis, Chart, Series};
//!
//! let chart = Chart::new("Error over cost", Axis::log("cost, instructions"), Axis::log("error"))
//!     .with(Series::scatter("tried", [(100.0, 1e-2), (200.0, 1e-2), (300.0, 1e-3)]))
//!     .with(Series::front("best", [(100.0, 1e-2), (300.0, 1e-3)]));
//! assert!(chart.svg().unwrap().starts_with("<svg"));
//! ```

mod axis;
mod clip;
mod draw;
mod palette;

pub use axis::Axis;
pub use palette::Colour;

use crate::error::Error;

/// A chart with one pair of axes.
///
/// The legend stands above the plotting area, never on it. A single series has none.
#[derive(Clone, Debug)]
pub struct Chart {
    title: String,
    x: Axis,
    y: Axis,
    size: (u32, u32),
    series: Vec<Series>,
    marks: Vec<(f64, String)>,
    equal: bool,
}

/// Points that belong together.
#[derive(Clone, Debug)]
pub struct Series {
    label: String,
    points: Vec<(f64, f64)>,
    colour: Option<Colour>,
    dash: Option<Dash>,
    width: u32,
    marker: Option<Marker>,
    stairs: bool,
}

/// Style of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Without gaps.
    Solid,
    /// Long strokes.
    Dashed,
    /// Short strokes.
    Dotted,
}

/// Shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// Small and filled.
    Dot,
    /// An open circle.
    Ring,
    /// Large and filled.
    Disc,
    /// ×.
    Cross,
}

impl Chart {
    /// Creates an empty chart of 520 × 340 units, half the width of a page.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        let (series, marks) = (Vec::new(), Vec::new());
        Self { title: title.into(), x, y, size: (520, 340), series, marks, equal: false }
    }

    /// Sets another size, in units of which text is 13 to 15 high.
    pub fn sized(mut self, width: u32, height: u32) -> Self {
        self.size = (width, height);
        self
    }

    /// Adds a series. A series without a colour of its own takes the palette's next.
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds several series.
    pub fn with_all(self, series: impl IntoIterator<Item = Series>) -> Self {
        series.into_iter().fold(self, Self::with)
    }

    /// Adds a vertical line at `x` with a label above it.
    pub fn mark(mut self, x: f64, label: impl Into<String>) -> Self {
        self.marks.push((x, label.into()));
        self
    }

    /// Draws one unit of `y` as long as one of `x`, for paths in the plane. Needs linear axes.
    pub fn equal_scales(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Returns the picture: one `<svg>` element that takes the width it is given.
    pub fn svg(&self) -> Result<String, Error> {
        draw::svg(self).map_err(|error| Error::new(format_args!("{}: {error}", self.title)))
    }
}

impl Series {
    fn new(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self {
            label: label.into(),
            points,
            colour: None,
            dash: None,
            width: 2,
            marker: None,
            stairs: false,
        }
    }

    /// Creates a curve.
    pub fn line(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { dash: Some(Dash::Solid), ..Self::new(label, points) }
    }

    /// Creates points that are not joined.
    pub fn scatter(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { marker: Some(Marker::Dot), ..Self::new(label, points) }
    }

    /// Creates the points of a front where less is better on both axes. A staircase joins them over
    /// the region that they dominate.
    pub fn front(label: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut line = Self::line(label, points).colour(Colour::Vermilion).marker(Marker::Disc);
        line.points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { stairs: true, ..line }
    }

    /// Sets the colour.
    pub fn colour(mut self, colour: Colour) -> Self {
        self.colour = Some(colour);
        self
    }

    /// Sets the style of the line.
    pub fn dash(mut self, dash: Dash) -> Self {
        self.dash = Some(dash);
        self
    }

    /// Sets the width of the line, units. The default is 2.
    pub fn width(mut self, width: u32) -> Self {
        self.width = width;
        self
    }

    /// Sets a marker on every point.
    pub fn marker(mut self, marker: Marker) -> Self {
        self.marker = Some(marker);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_marks_its_points_and_not_its_corners() {
        let front = Series::front("front", [(2.0, 1.0), (1.0, 3.0), (4.0, 0.5)]);
        let chart = Chart::new("", Axis::linear("x"), Axis::linear("y")).with(front);
        assert_eq!(chart.svg().unwrap().matches("<circle").count(), 3);
    }

    #[test]
    fn text_is_escaped() {
        let chart = Chart::new("a < b & \"c\"", Axis::linear("<x>"), Axis::linear("y"));
        let picture = chart.svg().unwrap();
        assert!(picture.contains("aria-label=\"a &lt; b &amp; &quot;c&quot;\""));
        assert!(picture.contains("&lt;x&gt;") && !picture.contains("<x>"));
    }
}
