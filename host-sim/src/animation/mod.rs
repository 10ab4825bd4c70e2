//! Pictures that move: arms as they bend along motions, over and over.
//!
//! SVG with its own animation (SMIL), so that it moves without a script wherever a picture is
//! shown. On a page a script of a few lines adds a button and a slider. For readers who prefer
//! reduced motion, a file shows poses and the path of the tip instead, and a page begins paused.

mod draw;
mod pose;
mod shape;
mod view;

use maud::{Markup, PreEscaped, html};
use stillbeam::Scene;

pub use pose::INTERVALS;
pub use shape::Link;

/// The script of every page with an animation.
pub const CONTROL: &str = include_str!("control.js");

/// Class by which the script finds an animation.
pub const CLASS: &str = "moving";

/// Shortest playing time, s. A shorter run is shown slower.
const SHORTEST: f64 = 2.0;

/// Colour of an arm, in a light and in a dark theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The one that others are compared with.
    Grey,
    /// Orange.
    Orange,
    /// Vermilion.
    Vermilion,
    /// Blue.
    Blue,
}

/// One arm along one motion.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Name of the motion.
    pub label: String,
    /// Its colour.
    pub ink: Ink,
    /// The arm at even times, from 0 to the end of the run.
    pub frames: Vec<Frame>,
}

/// An arm at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Points of the centreline from the first joint or the hub's rim to the tip, m.
    pub line: Vec<[f64; 2]>,
    /// Joints behind the first, m.
    pub joints: Vec<[f64; 2]>,
    /// Deflection of each link, m.
    pub deflections: Vec<f64>,
}

/// A part of the picture: arms on one hub, and their deflections over time.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Arms that are drawn over each other, the first one below.
    pub arms: Vec<Arm>,
    /// Result of the motion, a few words.
    pub remark: String,
}

/// A run of one or more arms, drawn as it moves.
#[derive(Clone, Debug)]
pub struct Animation {
    /// Description for those who do not see it.
    pub label: String,
    /// Place at which the tip shall rest, m.
    pub goal: Option<[f64; 2]>,
    /// Title of the curves below the arms, with the unit of their scale.
    pub quantity: String,
    /// Units of [`Self::quantity`] per metre of deflection.
    pub factor: f64,
    /// Duration of the run, s.
    pub seconds: f64,
    /// The parts, side by side.
    pub panels: Vec<Panel>,
}

impl Ink {
    /// Class of what has this colour.
    fn class(self) -> &'static str {
        match self {
            Self::Grey => "moving-grey",
            Self::Orange => "moving-orange",
            Self::Vermilion => "moving-vermilion",
            Self::Blue => "moving-blue",
        }
    }
}

impl Animation {
    /// The arm of a link on a hub that turns, its deflection in mm. It shall rest at the hub angle
    /// `goal`, rad.
    pub fn of_link(arm: &Scene, label: String, goal: Option<f64>, seconds: f64) -> Self {
        Self {
            label,
            goal: goal.map(|angle| Link::of(arm).tip(angle)),
            quantity: "deflection, mm".to_owned(),
            factor: 1e3,
            seconds,
            panels: Vec::new(),
        }
    }

    /// Every frame of every arm.
    fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.panels.iter().flat_map(|panel| &panel.arms).flat_map(|arm| &arm.frames)
    }

    /// Factor by which the run is shown slower than it is: 1, 2, 5, 10, 20, …, the smallest with
    /// which it takes 2 s.
    pub fn slowness(&self) -> f64 {
        let steps = (0..).flat_map(|decade| [1.0, 2.0, 5.0].map(|step| step * 10f64.powi(decade)));
        steps.take(30).find(|slow| self.seconds * slow >= SHORTEST).unwrap_or(1.0)
    }

    /// Says how fast the run is shown, e.g. `in real time`.
    pub fn speed(&self) -> String {
        match self.slowness() {
            1.0 => "in real time".to_owned(),
            slow => format!("{slow} times slower than real"),
        }
    }

    /// Returns the picture as a file, its parts side by side on a ground of their own.
    pub fn svg(&self) -> String {
        draw::whole(self)
    }

    /// Returns the picture for a page: its parts side by side where the page is wide enough, with
    /// a button and a slider, and a caption.
    pub fn figure(&self, caption: &Markup) -> Markup {
        let length = self.seconds * self.slowness();
        html! {
            figure class=(CLASS) data-seconds=(length) data-slow=(self.slowness()) {
                div.stage { @for part in draw::parts(self) { (PreEscaped(part)) } }
                div.steer hidden {
                    button type="button" { "Pause" }
                    input type="range" min="0" max=(length) step=(length / 200.0) value="0"
                        aria-label="time";
                    output aria-live="off" {}
                }
                figcaption { (caption) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One arm that turns by a right angle and swings by a tenth of its length.
    fn quarter(seconds: f64) -> Animation {
        let samples = (0..=50).map(|k| {
            let t = seconds * f64::from(k) / 50.0;
            (t, 1.5 * t / seconds, 0.04 * (20.0 * t / seconds).sin())
        });
        let link = Link { radius: 0.05, length: 0.4 };
        let frames = link.frames(samples, seconds, INTERVALS);
        let arm = Arm { label: "a < b".to_owned(), ink: Ink::Blue, frames };
        Animation {
            label: "An arm & its tip".to_owned(),
            goal: Some(link.tip(1.5)),
            quantity: "deflection, mm".to_owned(),
            factor: 1e3,
            seconds,
            panels: vec![Panel { arms: vec![arm], remark: "1 % left".to_owned() }],
        }
    }

    /// Values of an animated attribute, for each element that has it.
    fn animated(svg: &str, name: &str) -> Vec<Vec<String>> {
        let page = roxmltree::Document::parse(svg).expect("XML");
        page.descendants()
            .filter(|node| node.attribute("attributeName") == Some(name))
            .filter_map(|node| node.attribute("values"))
            .map(|values| values.split(';').map(str::to_owned).collect())
            .collect()
    }

    #[test]
    fn a_short_run_is_shown_slower_and_says_so() {
        for (seconds, slow, speed) in [
            (3.0, 1.0, "in real time"),
            (0.5, 5.0, "5 times slower than real"),
            (0.03, 100.0, "100 times slower than real"),
        ] {
            let animation = quarter(seconds);
            assert_eq!((animation.slowness(), animation.speed().as_str()), (slow, speed));
            let duration = format!("dur=\"{:.3}s\"", seconds * slow);
            assert!(animation.svg().contains(&duration), "{duration}");
        }
    }

    /// The arm's path has the length that is drawn, in every frame: the hub's rim is at the
    /// beginning, and the dot at the end.
    #[test]
    fn the_arm_moves_from_its_hub_to_its_tip() {
        let svg = quarter(3.0).svg();
        let paths = &animated(&svg, "d")[0];
        let tips = [&animated(&svg, "cx")[0], &animated(&svg, "cy")[0]];
        let mut first = None;
        for (k, path) in paths.iter().enumerate() {
            let points: Vec<[f64; 2]> = path[1..]
                .split('L')
                .map(|point| {
                    let (x, y) = point.split_once(' ').expect("x and y");
                    [x.parse().expect("px"), y.parse().expect("px")]
                })
                .collect();
            let steps = points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
            let length: f64 = steps.sum();
            let first = *first.get_or_insert(length);
            assert!((length / first - 1.0).abs() < 5e-3, "{k}: {length} of {first}");
            let [x, y] = points[points.len() - 1];
            assert_eq!(
                [format!("{x:.1}"), format!("{y:.1}")],
                [tips[0][k].clone(), tips[1][k].clone()]
            );
        }
        assert!(paths.len() > 100);
    }

    #[test]
    fn words_are_escaped_and_still_pictures_stand_by() {
        let animation = quarter(3.0);
        let svg = animation.svg();
        roxmltree::Document::parse(&svg).expect("XML");
        assert!(svg.contains("a &lt; b") && svg.contains("An arm &amp; its tip"));
        assert!(svg.contains("prefers-reduced-motion") && svg.contains("prefers-color-scheme"));
        let poses = svg.matches("moving-pose").count();
        assert!(poses >= 6, "{poses}");
        let page = animation.figure(&html! { "caption" }).into_string();
        assert!(page.contains("<button") && page.contains("type=\"range\""));
    }
}
