//! An animation as SVG.

use std::fmt::Write;

use maud::html;

use super::view::{View, WIDTH};
use super::{Animation, Arm, Panel};
use crate::number::Digits;

/// Room for the words above the arms, px.
const HEAD: f64 = 46.0;

/// Room for the curves below the arms, px: the words, and the curves themselves.
const WORDS: f64 = 22.0;
const CURVES: f64 = 64.0;

/// Left and right margin of words and curves, px.
const MARGIN: f64 = 20.0;

/// Poses that stay in the picture, beside the last one.
const POSES: usize = 6;

/// Lines of the deflections of the first link, the second and the third.
const DASHES: [&str; 3] = ["", " stroke-dasharray=\"7 5\"", " stroke-dasharray=\"1 4\""];

/// Colours in light and in dark, and what is shown to those who prefer reduced motion.
const STYLE: &str = "<style>.moving-paper{fill:#fff}.moving-ink{stroke:#222;fill:#222}\
    .moving-quiet{stroke:#888;fill:none}.moving-words{font:14px system-ui,sans-serif;fill:#222}\
    .moving-soft{font:12px system-ui,sans-serif;fill:#5a5a5a}\
    .moving-grey{stroke:#777}.moving-orange{stroke:#b87400}.moving-vermilion{stroke:#c64f00}\
    .moving-blue{stroke:#0072b2}.moving-words .moving-grey{fill:#666}\
    .moving-words .moving-orange{fill:#9a6100}.moving-words .moving-vermilion{fill:#b84900}\
    .moving-words .moving-blue{fill:#0072b2}.moving-words tspan{stroke:none;font-weight:600}\
    .moving-line{fill:none;stroke-linecap:round;stroke-linejoin:round}\
    .moving-pose{stroke-width:2;opacity:.25}.moving-trail{stroke-width:1;opacity:.7}\
    .moving-dot{stroke-width:0}.moving-dot.moving-grey{fill:#777}.moving-dot.moving-orange{fill:#b87400}\
    .moving-dot.moving-vermilion{fill:#c64f00}.moving-dot.moving-blue{fill:#0072b2}\
    @media(prefers-color-scheme:dark){.moving-paper{fill:#16181b}.moving-ink{stroke:#ddd;fill:#ddd}\
    .moving-words{fill:#e6e6e6}.moving-soft{fill:#a5a8ad}.moving-grey{stroke:#aaa}\
    .moving-orange{stroke:#e69f00}.moving-vermilion{stroke:#ff9447}.moving-blue{stroke:#5bb8f0}\
    .moving-words .moving-grey,.moving-dot.moving-grey{fill:#aaa}\
    .moving-words .moving-orange,.moving-dot.moving-orange{fill:#e69f00}\
    .moving-words .moving-vermilion,.moving-dot.moving-vermilion{fill:#ff9447}\
    .moving-words .moving-blue,.moving-dot.moving-blue{fill:#5bb8f0}}\
    @media(prefers-reduced-motion:reduce){.moving-live{display:none}.moving-pose{opacity:.6}\
    .steered .moving-live{display:inline}.steered .moving-pose{opacity:.25}}</style>";

/// Data that all panels of a picture share.
struct Stage<'a> {
    animation: &'a Animation,
    view: View,
    /// Largest |deflection|, m.
    most: f64,
    /// Playing time, s.
    duration: f64,
}

/// Returns the picture with its panels side by side, as a file.
pub(super) fn whole(animation: &Animation) -> String {
    let stage = Stage::of(animation);
    let width = WIDTH * animation.panels.len() as f64;
    let mut text = stage.begin(&animation.label, width, "100%");
    let height = stage.height();
    let _ = write!(text, "<rect class=\"moving-paper\" width=\"{width}\" height=\"{height}\"/>");
    for (index, panel) in animation.panels.iter().enumerate() {
        let _ = write!(text, "<g transform=\"translate({} 0)\">", WIDTH * index as f64);
        stage.draw(&mut text, panel);
        text.push_str("</g>");
    }
    text.push_str("</svg>\n");
    text
}

/// Returns each panel as a picture of its own.
pub(super) fn parts(animation: &Animation) -> Vec<String> {
    let stage = Stage::of(animation);
    let part = |panel: &Panel| {
        let names: Vec<&str> = panel.arms.iter().map(|arm| arm.label.as_str()).collect();
        let label = format!("{}: {}", animation.label, names.join(", "));
        let mut text = stage.begin(&label, WIDTH, "min(100%,28rem)");
        stage.draw(&mut text, panel);
        text.push_str("</svg>");
        text
    };
    animation.panels.iter().map(part).collect()
}

impl<'a> Stage<'a> {
    fn of(animation: &'a Animation) -> Self {
        let deflections = animation.frames().flat_map(|frame| &frame.deflections);
        let most = deflections.fold(0.0, |most: f64, deflection| most.max(deflection.abs()));
        let duration = animation.seconds * animation.slowness();
        Self { animation, view: View::of(animation), most, duration }
    }

    /// Height of a panel, px.
    fn height(&self) -> f64 {
        HEAD + self.view.height() + WORDS + CURVES + 8.0
    }

    /// Returns the beginning of a picture that is drawn no wider than `most`, a length of CSS.
    fn begin(&self, label: &str, width: f64, most: &str) -> String {
        let (height, label) = (self.height(), escaped(label));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             style=\"max-width:{most};height:auto\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-label=\"{label}\">{STYLE}"
        )
    }

    fn draw(&self, text: &mut String, panel: &Panel) {
        self.words(text, panel);
        let _ = write!(text, "<g transform=\"translate(0 {HEAD})\">");
        let [x, y] = self.view.place([0.0, 0.0]);
        if let Some([to_x, to_y]) = self.animation.goal.map(|tip| self.view.place(tip)) {
            let _ = write!(
                text,
                "<path class=\"moving-quiet\" stroke-dasharray=\"4 4\" \
                 d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>"
            );
        }
        for (index, arm) in panel.arms.iter().enumerate() {
            self.arm(text, arm, panel.is_below(index));
        }
        let _ =
            write!(text, "<circle class=\"moving-ink\" r=\"7\" cx=\"{x:.1}\" cy=\"{y:.1}\"/></g>");
        self.curves(text, panel);
    }

    /// Writes the names of the arms, in their colours, and what came of them.
    fn words(&self, text: &mut String, panel: &Panel) {
        let _ = write!(text, "<text class=\"moving-words\" x=\"{MARGIN}\" y=\"20\">");
        for (index, Arm { label, ink, .. }) in panel.arms.iter().enumerate() {
            let gap = if index == 0 { "" } else { " dx=\"12\"" };
            let _ =
                write!(text, "<tspan class=\"{}\"{gap}>{}</tspan>", ink.class(), escaped(label));
        }
        let remark = escaped(&panel.remark);
        let _ = write!(
            text,
            "</text><text class=\"moving-soft\" x=\"{MARGIN}\" y=\"38\">{remark}</text>"
        );
    }

    /// Writes an arm: poses and the tip's path, which stay, and the arm that moves. One that others
    /// are drawn over is wider, so that it is seen.
    fn arm(&self, text: &mut String, arm: &Arm, is_below: bool) {
        let (width, radius_of_dot) = if is_below { (8.0, 8.0) } else { (4.0, 6.0) };
        let placed = |points: &[[f64; 2]]| points.iter().map(|&p| self.view.place(p)).collect();
        let frames: Vec<Vec<[f64; 2]>> =
            arm.frames.iter().map(|frame| placed(&frame.line)).collect();
        let class = arm.ink.class();
        let last = frames.len().saturating_sub(1);
        for k in 0..=POSES {
            let Some(frame) = frames.get(last * k / POSES) else { continue };
            let shape = path(frame);
            let _ = write!(text, "<path class=\"moving-line moving-pose {class}\" d=\"{shape}\"/>");
        }
        let tips: Vec<[f64; 2]> = frames.iter().filter_map(|frame| frame.last().copied()).collect();
        let trail = path(&tips);
        let shapes: Vec<String> = frames.iter().map(|frame| path(frame)).collect();
        let first = shapes.first().map_or("", String::as_str);
        let _ = write!(
            text,
            "<path class=\"moving-line moving-trail {class}\" d=\"{trail}\"/>\
             <g class=\"moving-live\"><path class=\"moving-line {class}\" stroke-width=\"{width}\" \
             d=\"{first}\">{}</path>{}{}</g>",
            self.moves("d", &shapes.join(";")),
            self.joints(arm),
            self.dot(radius_of_dot, class, &tips)
        );
    }

    /// Returns the joints behind the first, which move with their links.
    fn joints(&self, arm: &Arm) -> String {
        let count = arm.frames.first().map_or(0, |frame| frame.joints.len());
        let joint = |j: usize| {
            let places: Vec<[f64; 2]> =
                arm.frames.iter().map(|frame| self.view.place(frame.joints[j])).collect();
            self.dot(5.0, "moving-ink", &places)
        };
        (0..count).map(joint).collect()
    }

    /// Writes the deflections over time, all panels on one scale.
    fn curves(&self, text: &mut String, panel: &Panel) {
        let top = HEAD + self.view.height() + WORDS;
        let middle = top + 0.5 * CURVES;
        let animation = self.animation;
        let range = Digits::Three.show(self.most * animation.factor);
        let _ = write!(
            text,
            "<text class=\"moving-soft\" x=\"{MARGIN}\" y=\"{}\">{}, \u{b1}{range} over {} s</text>\
             <path class=\"moving-quiet\" d=\"M{MARGIN} {middle}H{}\"/>",
            top - 8.0,
            escaped(&animation.quantity),
            Digits::Three.show(animation.seconds),
            WIDTH - MARGIN
        );
        for (index, arm) in panel.arms.iter().enumerate() {
            let width = if panel.is_below(index) { 4.0 } else { 1.5 };
            for link in 0..arm.frames.first().map_or(0, |frame| frame.deflections.len()) {
                self.curve(text, arm, link, [middle, width]);
            }
        }
    }

    /// Writes the deflection of one link over time: the first link's line is solid, the second's
    /// dashed, the third's dotted.
    fn curve(&self, text: &mut String, arm: &Arm, link: usize, [middle, width]: [f64; 2]) {
        let last = arm.frames.len().saturating_sub(1).max(1) as f64;
        let scale = 0.5 * CURVES / self.most.max(f64::MIN_POSITIVE);
        let place = |(k, deflection): (usize, f64)| {
            let x = MARGIN + (WIDTH - 2.0 * MARGIN) * k as f64 / last;
            [x, middle - scale * deflection]
        };
        let deflections = arm.frames.iter().map(|frame| frame.deflections[link]);
        let points: Vec<[f64; 2]> = deflections.enumerate().map(place).collect();
        let (class, curve, dashes) = (arm.ink.class(), path(&points), DASHES[link % DASHES.len()]);
        let _ = write!(
            text,
            "<path class=\"moving-line {class}\" stroke-width=\"{width}\"{dashes} d=\"{curve}\"/>\
             <g class=\"moving-live\">{}</g>",
            self.dot(4.0, class, &points)
        );
    }

    /// Returns a dot that moves along points.
    fn dot(&self, radius: f64, class: &str, points: &[[f64; 2]]) -> String {
        let along = |i: usize| {
            let values: Vec<String> =
                points.iter().map(|point| format!("{:.1}", point[i])).collect();
            self.moves(["cx", "cy"][i], &values.join(";"))
        };
        format!(
            "<circle class=\"moving-dot {class}\" r=\"{radius}\">{}{}</circle>",
            along(0),
            along(1)
        )
    }

    /// Returns the animation of an attribute, over and over.
    fn moves(&self, what: &str, values: &str) -> String {
        format!(
            "<animate attributeName=\"{what}\" dur=\"{:.3}s\" repeatCount=\"indefinite\" \
             values=\"{values}\"/>",
            self.duration
        )
    }
}

impl Panel {
    /// True if another arm is drawn over the one at `index`.
    fn is_below(&self, index: usize) -> bool {
        index + 1 < self.arms.len()
    }
}

fn path(points: &[[f64; 2]]) -> String {
    let points = points.iter().map(|[x, y]| format!("{x:.1} {y:.1}"));
    format!("M{}", points.collect::<Vec<_>>().join("L"))
}

/// Returns words as they may stand in a text or an attribute.
fn escaped(words: &str) -> String {
    html! { (words) }.into_string()
}
