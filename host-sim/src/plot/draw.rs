//! Draws charts as SVG through plotters.

use std::error::Error as StdError;

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Ruler;
use super::clip::Bounds;
use super::palette::GRID;
use super::{Chart, Colour, Dash, Marker, Series};

/// Units of the picture: the chart's units times [`FINE`].
type BackendCoord = (i32, i32);

type Fault = Box<dyn StdError>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Plot<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ruler, Ruler>>;

/// Units of the picture in one of the chart's. plotters rounds to whole units; this many keep
/// curves smooth.
const FINE: u32 = 10;

/// Sizes of text, units of the chart.
const TITLE: u32 = 15;
const TEXT: u32 = 13;

/// Height of one row of the legend, and of the labels above marks.
const ROW: u32 = 20;

/// A colour with its place in the chart.
struct Styled<'a> {
    series: &'a Series,
    colour: RGBColor,
}

/// A marked place on the x axis.
struct Tick<'a> {
    place: f64,
    label: &'a str,
}

pub(super) fn svg(chart: &Chart) -> Result<String, Fault> {
    let (width, height) = chart.size;
    let mut text = String::new();
    {
        let root =
            SVGBackend::with_string(&mut text, (width * FINE, height * FINE)).into_drawing_area();
        picture(chart, &root)?;
        root.present()?;
    }
    // The element's own width and height would keep it from taking the width it is given.
    let body = text.find('>').map_or("", |end| &text[end..]);
    let name = escape(&chart.title);
    let (w, h) = (width * FINE, height * FINE);
    Ok(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" role=\"img\" \
         aria-label=\"{name}\"{body}"
    ))
}

fn picture(chart: &Chart, root: &Area<'_>) -> Result<(), Fault> {
    let width = chart.size.0;
    let mut cycle = Colour::CYCLE.into_iter().cycle();
    let series: Vec<Styled<'_>> = chart
        .series
        .iter()
        .map(|series| {
            let colour = series.colour.or_else(|| cycle.next()).unwrap_or(Colour::Ink).rgb();
            Styled { series, colour }
        })
        .collect();

    let mut top = 8;
    if !chart.title.is_empty() {
        let style = words(TITLE, FontStyle::Bold, HPos::Left, VPos::Top);
        root.draw_text(&chart.title, &style, at(12, top))?;
        top += 24;
    }
    if series.len() > 1 {
        top = legend(root, &series, width, top)?;
    }
    if !chart.marks.is_empty() {
        top += ROW - 4;
    }

    let values =
        |of: fn(&(f64, f64)) -> f64| chart.series.iter().flat_map(|series| &series.points).map(of);
    let mut x = chart.x.ruler(values(|p| p.0), (width / 75) as usize);
    let mut y = chart.y.ruler(values(|p| p.1), ((chart.size.1 - top) / 45).max(2) as usize);
    let labels = |y: &Ruler| y.ticks.iter().map(|&t| y.words(t).chars().count()).max().unwrap_or(1);
    let left = 34 + 8 * labels(&y) as u32;
    let (right, bottom) = (18, 48);
    if chart.equal {
        let (across, up) = (width - left - right, chart.size.1 - top - bottom - 4);
        let shape = f64::from(up) / f64::from(across);
        let half = 0.5 * (x.high - x.low).max((y.high - y.low) / shape);
        let about = |ruler: &Ruler, half: f64, count: u32| {
            let middle = 0.5 * (ruler.low + ruler.high);
            ruler.stretched(middle - half, middle + half, count as usize)
        };
        y = about(&y, half * shape, up / 45);
        x = about(&x, half, width / 75);
    }

    let bounds = Bounds { x: (x.low, x.high), y: (y.low, y.high) };
    let inner = root.margin(top * FINE, 4 * FINE, 0, right * FINE);
    let mut plot = ChartBuilder::on(&inner)
        .set_label_area_size(LabelAreaPosition::Left, left * FINE)
        .set_label_area_size(LabelAreaPosition::Bottom, (bottom - 4) * FINE)
        .build_cartesian_2d(x, y)?;
    plot.configure_mesh()
        .bold_line_style(GRID.stroke_width(FINE))
        .light_line_style(TRANSPARENT)
        .axis_style(Colour::Grey.rgb().stroke_width(FINE))
        .set_all_tick_mark_size(4 * FINE)
        .label_style(words(TEXT, FontStyle::Normal, HPos::Center, VPos::Center))
        .axis_desc_style(words(TEXT, FontStyle::Normal, HPos::Center, VPos::Center))
        .x_desc(chart.x.label.as_str())
        .y_desc(chart.y.label.as_str())
        .draw()?;
    for (value, label) in &chart.marks {
        if let Some(place) = chart.x.place(*value) {
            mark(root, &mut plot, &Tick { place, label }, bounds.y)?;
        }
    }
    for styled in &series {
        curve(chart, &mut plot, styled, &bounds)?;
    }
    Ok(())
}

/// Draws the legend in rows from `top` on and returns where it ends.
fn legend(root: &Area<'_>, series: &[Styled<'_>], width: u32, top: u32) -> Result<u32, Fault> {
    let (sample, left) = (26, 12);
    let (mut x, mut y) = (left, top);
    let style = words(TEXT, FontStyle::Normal, HPos::Left, VPos::Center);
    for styled in series.iter().filter(|styled| !styled.series.label.is_empty()) {
        let label = &styled.series.label;
        let needed = sample + 6 + TEXT * 62 * label.chars().count() as u32 / 100 + 16;
        if x > left && x + needed > width {
            (x, y) = (left, y + ROW);
        }
        let middle = y + ROW / 2;
        if styled.series.dash.is_some() {
            root.draw(&stroke(styled, vec![at(x, middle), at(x + sample, middle)]))?;
        }
        if let Some(kind) = styled.series.marker {
            let centre = EmptyElement::at(at(x + sample / 2, middle));
            root.draw(&(centre + marker(kind, styled.colour)))?;
        }
        root.draw_text(label, &style, at(x + sample + 6, middle))?;
        x += needed;
    }
    Ok(y + ROW + 4)
}

fn curve(
    chart: &Chart,
    plot: &mut Plot<'_, '_>,
    styled: &Styled<'_>,
    bounds: &Bounds,
) -> Result<(), Fault> {
    let place = |&(x, y): &(f64, f64)| chart.x.place(x).zip(chart.y.place(y));
    let points: Vec<(f64, f64)> = styled.series.points.iter().filter_map(place).collect();
    if styled.series.dash.is_some() {
        let line = if styled.series.stairs { staircase(&points) } else { points.clone() };
        for piece in bounds.clip(&line) {
            plot.draw_series(std::iter::once(stroke(styled, piece)))?;
        }
    }
    if let Some(kind) = styled.series.marker {
        let inside = points.iter().filter(|&&point| bounds.holds(point));
        let marks = inside.map(|&p| EmptyElement::at(p) + marker(kind, styled.colour));
        plot.draw_series(marks)?;
    }
    Ok(())
}

/// Returns the staircase through the points: along x first, then along y, from point to point.
fn staircase(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let stairs = points.windows(2).flat_map(|pair| [pair[0], (pair[1].0, pair[0].1)]);
    stairs.chain(points.last().copied()).collect()
}

/// Draws a vertical line over the height of the plot, with its label above it.
fn mark(
    root: &Area<'_>,
    plot: &mut Plot<'_, '_>,
    x: &Tick<'_>,
    y: (f64, f64),
) -> Result<(), Fault> {
    let style = Colour::Grey.rgb().stroke_width(FINE);
    let line = vec![(x.place, y.0), (x.place, y.1)];
    let line = DashedPathElement::new(line, 4 * FINE, 3 * FINE, style);
    plot.draw_series(std::iter::once(line))?;
    let (across, up) = plot.backend_coord(&(x.place, y.1));
    let words = words(TEXT - 1, FontStyle::Normal, HPos::Center, VPos::Bottom);
    root.draw_text(x.label, &words, (across, up - 2 * FINE as i32))?;
    Ok(())
}

/// Returns the line of a series through points in any coordinates.
fn stroke<'b, C: Clone + 'static>(
    styled: &Styled<'_>,
    points: Vec<C>,
) -> DynElement<'static, SVGBackend<'b>, C> {
    let style = styled.colour.stroke_width(styled.series.width * FINE);
    let dashes = |long: u32, gap: u32| {
        DashedPathElement::new(points.clone(), long * FINE, gap * FINE, style)
    };
    match styled.series.dash {
        Some(Dash::Dashed) => dashes(8, 4).into_dyn(),
        Some(Dash::Dotted) => dashes(2, 3).into_dyn(),
        _ => PathElement::new(points, style).into_dyn(),
    }
}

/// Returns a marker about the origin, in the picture's own units.
fn marker<'b>(kind: Marker, colour: RGBColor) -> DynElement<'static, SVGBackend<'b>, BackendCoord> {
    let line = colour.stroke_width(2 * FINE);
    match kind {
        Marker::Dot => Circle::new((0, 0), 3 * FINE, colour.filled()).into_dyn(),
        Marker::Ring => Circle::new((0, 0), 4 * FINE, line).into_dyn(),
        Marker::Disc => Circle::new((0, 0), 5 * FINE, colour.filled()).into_dyn(),
        Marker::Cross => Cross::new((0, 0), 4 * FINE, line).into_dyn(),
    }
}

/// Returns a text style in the colour of text.
fn words(size: u32, style: FontStyle, across: HPos, up: VPos) -> TextStyle<'static> {
    // The SVG backend writes size / 1.24.
    let font = ("sans-serif", 1.24 * f64::from(size * FINE), style).into_font();
    font.color(&Colour::Ink.rgb()).pos(Pos::new(across, up))
}

/// Converts the chart's units to the picture's.
fn at(x: u32, y: u32) -> BackendCoord {
    ((x * FINE) as i32, (y * FINE) as i32)
}

/// Escapes text for an attribute's value.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
