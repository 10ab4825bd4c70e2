//! A picture that moves: the arm as it bends along a quintic and along the still move, in real
//! time.
//!
//! SVG with its own animation, so that it moves wherever a picture is shown. The shapes are those
//! of the core's exact kinematics in two modes.

use std::fmt::Write;

use stillbeam::model::Rod;
use stillbeam::planner::ShortestMove;
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Generator, HubState, Move, Profile};

use super::Request;
use super::shortest::{self, INTERVALS};
use crate::error::Error;
use crate::number::{Digits, percent};
use crate::run;
use crate::step::Motion;

/// Time for which the arm is watched after the move, first periods.
const AFTER: f64 = 3.0;

/// Most pictures of an arm. Between them the lines move evenly.
const FRAMES: u64 = 120;

/// Straight parts of an arm's centreline.
const PARTS: usize = 24;

/// Side of an arm's square in the picture, and what is left free around it, px.
const SIDE: f64 = 320.0;
const MARGIN: f64 = 26.0;

/// Room for the line of text above an arm, px.
const HEAD: f64 = 30.0;

/// One arm along one motion.
struct Arm {
    name: &'static str,
    class: &'static str,
    /// Fraction of L that is left.
    residual: f64,
    /// Centrelines in the global frame, m, at even times.
    frames: Vec<Vec<[f64; 2]>>,
}

/// Box in m that holds every frame.
#[derive(Clone, Copy)]
struct View {
    low: [f64; 2],
    high: [f64; 2],
}

/// Draws a quintic beside the still move. `residual` is what each leaves, fraction of L. Returns
/// `None` on a linear axis, and where the arm bends further than two modes follow.
///
/// # Errors
/// A move or an arm that the core refuses.
pub fn picture(
    request: &Request,
    plan: &ShortestMove<INTERVALS>,
    residual: [f64; 2],
) -> Result<Option<String>, Error> {
    let rod = Rod::<2>::new(&request.arm)?;
    let (_, most) = Elastica::<f64, 2>::BEND;
    let duration = plan.duration();
    let quintic = Move::To { profile: Profile::Quintic, duration, to: request.to };
    // A quintic's peak, 10/√3 of the angle over the duration squared, and the plan's own.
    let peak = 10.0 / 3f64.sqrt() * (request.to - request.from).abs() / (duration * duration);
    let bend = rod.bend(peak.max(plan.peaks().acceleration));
    if request.arm.mount.is_linear() || request.arm.mount.carrier != 0.0 || bend > most {
        return Ok(None);
    }
    let stepper = Elastica::<f64, 2>::new(&rod, request.tick, Quality::Fine, bend)?;
    let ticks = u64::from(plan.ticks()) + (AFTER * rod_period(&rod) / request.tick).ceil() as u64;
    let every = ticks.div_ceil(FRAMES).max(1);
    let shown = |name, class, residual, motion: &Motion| -> Result<Arm, Error> {
        let frames = frames(&rod, &stepper, request.from, motion, ticks, every)?;
        Ok(Arm { name, class, residual, frames })
    };
    let arms = [
        shown("quintic", "moving-other", residual[0], &quintic.into())?,
        shown("still move", "moving-still", residual[1], &shortest::motion(plan))?,
    ];
    let seconds = (arms[0].frames.len() - 1) as f64 * every as f64 * request.tick;
    Ok(Some(svg(request, &arms, seconds)))
}

fn rod_period(rod: &Rod<2>) -> f64 {
    std::f64::consts::TAU / rod.frequency()[0]
}

/// Runs a move and the rest after it. Returns the centreline at every `every`th tick.
fn frames(
    rod: &Rod<2>,
    stepper: &Elastica<f64, 2>,
    from: f64,
    motion: &Motion,
    ticks: u64,
    every: u64,
) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    let slopes: Vec<[f64; 2]> =
        (0..PARTS).map(|k| rod.slopes_at((k as f64 + 0.5) / PARTS as f64)).collect();
    let mut generator = Generator::new(*stepper, from)?;
    let (mut taken, mut feeding) = (false, None);
    let mut frames = Vec::new();
    for k in 0..=ticks {
        if !taken {
            taken = run::take(&mut generator, motion, &mut feeding)?.is_some();
        }
        generator.tick();
        if k % every == 0 {
            let hub = generator.hub();
            let arm = generator.stepper().arm_state(generator.state(), hub);
            frames.push(centreline(rod, &slopes, arm.coordinate, hub));
        }
    }
    Ok(frames)
}

/// Returns the points of the centreline in the global frame, m, by the midpoint rule.
fn centreline(
    rod: &Rod<2>,
    slopes: &[[f64; 2]],
    coordinate: [f64; 2],
    hub: &HubState<f64>,
) -> Vec<[f64; 2]> {
    let (scene, theta) = (rod.scene(), hub.angle.radians());
    let step = scene.link.length / slopes.len() as f64;
    let (sin, cos) = theta.sin_cos();
    let mut point = [scene.hub.radius * cos, scene.hub.radius * sin];
    let mut points = vec![point];
    for slope in slopes {
        let (sin, cos) = (theta + slope[0] * coordinate[0] + slope[1] * coordinate[1]).sin_cos();
        point = [point[0] + step * cos, point[1] + step * sin];
        points.push(point);
    }
    points
}

impl View {
    /// Holds the hub and every point of every frame.
    fn of(arms: &[Arm]) -> Self {
        let mut view = Self { low: [0.0; 2], high: [0.0; 2] };
        for point in arms.iter().flat_map(|arm| arm.frames.iter().flatten()) {
            for i in 0..2 {
                view.low[i] = view.low[i].min(point[i]);
                view.high[i] = view.high[i].max(point[i]);
            }
        }
        view
    }

    /// Pixels a metre.
    fn scale(&self) -> f64 {
        let size = f64::max(self.high[0] - self.low[0], self.high[1] - self.low[1]);
        (SIDE - 2.0 * MARGIN) / size
    }

    /// Returns a point's place in an arm's square, px.
    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let middle = |i: usize| 0.5 * (self.low[i] + self.high[i]);
        [
            0.5 * SIDE + (point[0] - middle(0)) * self.scale(),
            HEAD + 0.5 * SIDE - (point[1] - middle(1)) * self.scale(),
        ]
    }
}

/// Colours in light and in dark, and the words' face.
const STYLE: &str = "<style>.moving-ink{stroke:#222;fill:#222}.moving-quiet{stroke:#888;fill:none}\
    .moving-other{stroke:#D55E00;fill:#D55E00}.moving-still{stroke:#0072B2;fill:#0072B2}\
    .moving-arm{fill:none;stroke-width:4;stroke-linecap:round;stroke-linejoin:round}\
    .moving-words{font:15px sans-serif;fill:#222}@media(prefers-color-scheme:dark){\
    .moving-ink{stroke:#ddd;fill:#ddd}.moving-words{fill:#ddd}.moving-other{stroke:#ff9447;fill:#ff9447}\
    .moving-still{stroke:#5bb8f0;fill:#5bb8f0}}</style>";

fn svg(request: &Request, arms: &[Arm], seconds: f64) -> String {
    let (view, width, height) = (View::of(arms), SIDE * arms.len() as f64, SIDE + HEAD);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         style=\"max-width:100%;height:auto\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
         aria-label=\"The arm as it bends along a quintic and along the still move\">{STYLE}"
    );
    for (index, arm) in arms.iter().enumerate() {
        draw(&mut text, request, arm, &view, SIDE * index as f64, seconds);
    }
    text.push_str("</svg>\n");
    text
}

fn draw(text: &mut String, request: &Request, arm: &Arm, view: &View, left: f64, seconds: f64) {
    let [x, y] = view.place([0.0, 0.0]);
    let reach = request.arm.hub.radius + request.arm.link.length;
    let [to_x, to_y] = view.place([reach * request.to.cos(), reach * request.to.sin()]);
    let paths: Vec<String> = arm.frames.iter().map(|frame| path(frame, view)).collect();
    let tips = |i: usize| -> String {
        let tips = arm.frames.iter().filter_map(|frame| frame.last());
        tips.map(|tip| format!("{:.1}", view.place(*tip)[i])).collect::<Vec<_>>().join(";")
    };
    let moves = |what: &str, values: &str| {
        format!(
            "<animate attributeName=\"{what}\" dur=\"{seconds:.3}s\" repeatCount=\"indefinite\" \
             values=\"{values}\"/>"
        )
    };
    let left_over = percent(arm.residual, 1.0, Digits::Three);
    // Writing into a text does not fail.
    let _ = write!(
        text,
        "<g transform=\"translate({left} 0)\"><text class=\"moving-words\" x=\"{MARGIN}\" y=\"20\">\
         {}: {left_over} of L left</text>\
         <path class=\"moving-quiet\" stroke-dasharray=\"4 4\" d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>\
         <path class=\"moving-arm {}\" d=\"{}\">{}</path>\
         <circle class=\"{}\" r=\"7\" cx=\"0\" cy=\"0\">{}{}</circle>\
         <circle class=\"moving-ink\" r=\"9\" cx=\"{x:.1}\" cy=\"{y:.1}\"/></g>",
        arm.name,
        arm.class,
        paths[0],
        moves("d", &paths.join(";")),
        arm.class,
        moves("cx", &tips(0)),
        moves("cy", &tips(1)),
    );
}

fn path(frame: &[[f64; 2]], view: &View) -> String {
    let points = frame.iter().map(|point| {
        let [x, y] = view.place(*point);
        format!("{x:.1} {y:.1}")
    });
    format!("M{}", points.collect::<Vec<_>>().join("L"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Options;
    use crate::scenes;
    use stillbeam::Limits;

    fn request(to: f64) -> Request {
        let arm = scenes::open("b-tip30").expect("a scene").arm;
        let (limits, robust, tick) = (Limits::default(), None, 0.01);
        let options = Options::default();
        Request { arm, from: 0.0, to, duration: Some(1.0), limits, robust, options, tick }
    }

    #[test]
    fn both_arms_end_where_they_shall_and_one_is_still() {
        let request = request(1.2);
        let plan = request.plan().expect("a plan").plan;
        let svg = picture(&request, &ShortestMove::Still(plan), [0.1, 1e-4])
            .expect("a picture")
            .expect("one");
        let page = roxmltree::Document::parse(&svg).expect("XML");
        let values: Vec<Vec<f64>> = page
            .descendants()
            .filter(|node| node.attribute("attributeName") == Some("cy"))
            .filter_map(|node| node.attribute("values"))
            .map(|values| values.split(';').map(|y| y.parse().expect("px")).collect())
            .collect();
        assert_eq!(values.len(), 2);
        let swing = |y: &[f64]| {
            let rest = &y[y.len() / 2..];
            rest.iter().fold(0.0, |most: f64, y| most.max((y - rest[rest.len() - 1]).abs()))
        };
        assert!(swing(&values[1]) < 0.5, "{:?}", values[1]);
        assert!(swing(&values[0]) > 5.0 * swing(&values[1]), "{:?}", values[0]);
        assert!(svg.contains("10.0 % of L left") && svg.contains("0.0100 % of L left"));
    }
}
