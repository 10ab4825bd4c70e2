//! Error against time: the chart of a scene and its tables.

use super::answers::{Answer, QUESTIONS, answers, bases, percent, short};
use super::pareto::front;
use super::row::Row;
use stillbeam_sim::plot::{Axis, Chart, Colour, Marker, Series};
use stillbeam_sim::report::parts::Table;
use stillbeam_sim::solver::{Mass, Method, SolverKeys};
use stillbeam_sim::table::significant;

/// Results of a sweep on one scene.
pub struct Picture<'a> {
    /// The scene.
    pub scene: String,
    /// Rows of the scene that have a cost.
    pub rows: Vec<&'a Row>,
    /// The rows on the front, by rising time.
    pub front: Vec<&'a Row>,
    /// Answers to the questions around each base.
    pub answers: Vec<(SolverKeys, Vec<Answer<'a>>)>,
}

/// Returns the scenes of a sweep in the order of its rows.
pub fn scenes(rows: &[Row]) -> Vec<&str> {
    let mut scenes: Vec<&str> = Vec::new();
    for row in rows {
        if !scenes.contains(&row.id.scene.as_str()) {
            scenes.push(&row.id.scene);
        }
    }
    scenes
}

impl<'a> Picture<'a> {
    /// Picks the rows of a scene.
    pub fn of(rows: &'a [Row], scene: &str) -> Self {
        let of_scene: Vec<&Row> =
            rows.iter().filter(|row| row.id.scene == scene && row.cost.is_some()).collect();
        let points: Vec<(f64, f64)> = of_scene.iter().map(|row| point(row)).collect();
        Self {
            scene: scene.to_owned(),
            front: front(&points).into_iter().map(|index| of_scene[index]).collect(),
            rows: of_scene,
            answers: bases().map(|base| (base, answers(rows, scene, base))).into(),
        }
    }

    /// Draws error against time, one mark a case, the front joined.
    pub fn chart(&self) -> Chart {
        let mut groups: Vec<(Group, Vec<(f64, f64)>)> = Vec::new();
        for row in &self.rows {
            let label = Group::of(row);
            match groups.iter_mut().find(|group| group.0 == label) {
                Some(group) => group.1.push(point(row)),
                None => groups.push((label, vec![point(row)])),
            }
        }
        let x = Axis::log("processor time for a second of motion on this machine, \u{b5}s");
        let y = Axis::log("largest tip error, fraction of L");
        let scatter = |(label, points): (Group, Vec<_>)| {
            Series::scatter(label.name(), points).colour(label.colour()).marker(label.marker())
        };
        Chart::new(format!("Error against time, {}", self.scene), x, y)
            .sized(760, 460)
            .with_all(groups.into_iter().map(scatter))
            .with(Series::front("front", self.front.iter().map(|row| point(row))))
    }

    /// Returns the front as a table.
    pub fn front_table(&self) -> Table {
        let header = vec![
            "solver",
            "tip error, % of L",
            "rms, % of L",
            "torque error, %",
            "ns a tick",
            "worst, ns",
            "\u{b5}s a second",
            "set-up, \u{b5}s",
            "state, bytes",
            "stepper, bytes",
        ];
        Table {
            caption: "The front: each of these is more accurate than all that are faster.".into(),
            header,
            rows: self.front.iter().map(|row| cells(row)).collect(),
            key: None,
        }
    }

    /// Returns the answers around a base as a table, cheap side / dear side.
    pub fn answer_table(base: SolverKeys, answers: &[Answer<'_>]) -> Table {
        let header =
            vec!["choice", "tip error, % of L", "torque error, %", "ns a tick", "\u{b5}s a second"];
        let pair = |answer: &Answer<'_>, of: fn(&Row) -> f64| {
            let [a, b] = answer.rows.map(of);
            format!("{} / {}", short(a), short(b))
        };
        let row = |answer: &Answer<'_>| {
            vec![
                answer.question.text.to_owned(),
                pair(answer, |row| 100.0 * row.errors.tip_max),
                pair(answer, |row| 100.0 * row.errors.torque),
                pair(answer, |row| row.cost.map_or(f64::NAN, |cost| cost.tick_ns)),
                pair(answer, |row| row.cost.map_or(f64::NAN, |cost| cost.load_us(row.tick_s()))),
            ]
        };
        let rows = answers.iter().map(row).collect();
        Table { caption: format!("Around {}.", describe(base)), header, rows, key: None }
    }

    /// Returns the questions that no row could answer.
    pub fn unanswered(answers: &[Answer<'_>]) -> Vec<&'static str> {
        let asked = |text: &str| answers.iter().any(|answer| answer.question.text == text);
        QUESTIONS.iter().map(|question| question.text).filter(|text| !asked(text)).collect()
    }
}

/// Returns time and error of a row, the error to the three digits that are shown. A smaller
/// difference is no reason to be on the front.
fn point(row: &Row) -> (f64, f64) {
    let time = row.cost.map_or(f64::NAN, |cost| cost.load_us(row.tick_s()));
    (time, significant(row.errors.tip_max, 3))
}

/// Returns the largest tip errors of all scenes around one base, in % of L, cheap side / dear side.
/// They show the cost of each choice on each scene.
pub fn overview(pictures: &[Picture<'_>], base: usize) -> Option<Table> {
    let cell = |answers: &[Answer<'_>], text: &str| {
        let answer = answers.iter().find(|answer| answer.question.text == text);
        answer.map_or_else(
            || "\u{2013}".to_owned(),
            |answer| {
                let [a, b] = answer.rows.map(|row| short(100.0 * row.errors.tip_max));
                format!("{a} / {b}")
            },
        )
    };
    let row = |picture: &Picture<'_>| {
        let answers = &picture.answers.get(base)?.1;
        let cells = QUESTIONS.iter().map(|question| cell(answers, question.text));
        (!answers.is_empty()).then(|| [picture.scene.clone()].into_iter().chain(cells).collect())
    };
    let rows: Vec<Vec<String>> = pictures.iter().filter_map(row).collect();
    let keys = pictures.first()?.answers.get(base)?.0;
    let header = ["scene"].into_iter().chain(QUESTIONS.iter().map(|question| question.text));
    (!rows.is_empty()).then(|| Table {
        caption: format!("Largest tip error in % of L around {}.", describe(keys)),
        header: header.collect(),
        rows,
        key: None,
    })
}

/// Cases that share a mark: a method with its mass matrix, with or without spin terms.
#[derive(Clone, Copy, PartialEq)]
struct Group {
    method: Method,
    mass: Option<Mass>,
    spin: bool,
}

impl Group {
    fn of(row: &Row) -> Self {
        Self {
            method: row.keys.method.unwrap_or(Method::Newmark),
            mass: row.keys.mass,
            spin: row.keys.spin != Some(false),
        }
    }

    fn name(&self) -> String {
        let mass = self.mass.map_or(String::new(), |mass| format!(", {}", mass.name()));
        let spin = if self.spin { "" } else { ", no spin terms" };
        format!("{}{mass}{spin}", self.method.name())
    }

    fn colour(&self) -> Colour {
        match (self.method, self.mass) {
            (Method::Rigid, _) => Colour::Grey,
            (Method::Newmark, Some(Mass::Lumped)) => Colour::Orange,
            (Method::Newmark, _) => Colour::Blue,
            (Method::Modal, _) => Colour::Purple,
            (Method::Elastica, _) => Colour::Green,
            (Method::Pointwise, _) => Colour::Vermilion,
            (Method::Auto, _) => Colour::Sky,
        }
    }

    fn marker(&self) -> Marker {
        if self.spin { Marker::Dot } else { Marker::Ring }
    }
}

fn cells(row: &Row) -> Vec<String> {
    let mut cells = vec![
        describe(row.keys),
        short(100.0 * row.errors.tip_max),
        short(100.0 * row.errors.tip_rms),
        short(100.0 * row.errors.torque),
    ];
    if let Some(cost) = row.cost {
        cells.extend([
            short(cost.tick_ns),
            short(cost.worst_ns),
            short(cost.load_us(row.tick_s())),
            short(cost.setup_us),
            cost.state_bytes.to_string(),
            cost.stepper_bytes.to_string(),
        ]);
    }
    cells
}

/// Describes the two ends of the front in a sentence.
pub fn ends(picture: &Picture<'_>) -> String {
    match (picture.front.first(), picture.front.last()) {
        (Some(first), Some(last)) => format!(
            "Cheapest: {} with {} of L. Most accurate: {} with {} of L.",
            describe(first.keys),
            percent(first.errors.tip_max),
            describe(last.keys),
            percent(last.errors.tip_max)
        ),
        _ => "No case has both a finite error and a time.".into(),
    }
}

/// Describes a solver in a few words.
pub fn describe(keys: SolverKeys) -> String {
    keys.resolve().map(|solver| solver.describe()).unwrap_or_default()
}
