//! Costs of a choice, everything else equal: pairs of rows that differ in one key.

use super::row::Row;
use stillbeam_sim::number::{self, Digits};
use stillbeam_sim::solver::{Mass, Scalar, Solver, SolverKeys};

/// A choice that a reader has to make.
pub struct Question {
    /// The question in words.
    pub text: &'static str,
    names: [&'static str; 2],
    set: [fn(&mut SolverKeys); 2],
}

/// The choices, each between a cheap and a dear side.
pub const QUESTIONS: [Question; 5] = [
    Question {
        text: "10 ms against 1 ms",
        names: ["10 ms", "1 ms"],
        set: [|keys| keys.tick = Some(0.010), |keys| keys.tick = Some(0.001)],
    },
    Question {
        text: "1 element against 4",
        names: ["1 element", "4 elements"],
        set: [|keys| keys.elements = Some(1), |keys| keys.elements = Some(4)],
    },
    Question {
        text: "f32 against f64",
        names: ["f32", "f64"],
        set: [|keys| keys.scalar = Some(Scalar::F32), |keys| keys.scalar = Some(Scalar::F64)],
    },
    Question {
        text: "lumped against consistent mass",
        names: ["lumped", "consistent"],
        set: [|keys| keys.mass = Some(Mass::Lumped), |keys| keys.mass = Some(Mass::Consistent)],
    },
    Question {
        text: "without spin terms against with them",
        names: ["no spin terms", "spin terms"],
        set: [|keys| keys.spin = Some(false), |keys| keys.spin = Some(true)],
    },
];

/// Answer to one question on one scene around one solver.
pub struct Answer<'a> {
    /// The question.
    pub question: &'static Question,
    /// The two rows.
    pub rows: [&'a Row; 2],
}

/// Returns the solvers around which the questions are asked. One is the paper's, with a long tick
/// and a coarse mesh. The other is its opposite, where neither hides the effect of the other
/// choices.
pub fn bases() -> [SolverKeys; 2] {
    let coarse = SolverKeys::from(Solver::PAPER).relevant();
    [coarse, SolverKeys { elements: Some(4), tick: Some(0.001), ..coarse }]
}

/// Answers the questions that the rows can answer on a scene around `base`.
pub fn answers<'a>(rows: &'a [Row], scene: &str, base: SolverKeys) -> Vec<Answer<'a>> {
    let find = |set: fn(&mut SolverKeys)| {
        let mut keys = base;
        set(&mut keys);
        rows.iter().find(|row| row.id.scene == scene && row.keys == keys)
    };
    QUESTIONS
        .iter()
        .filter_map(|question| {
            let [a, b] = question.set.map(find);
            Some(Answer { question, rows: [a?, b?] })
        })
        .collect()
}

impl Answer<'_> {
    /// Returns the difference in a sentence with its numbers.
    pub fn sentence(&self) -> String {
        let [a, b] = self.question.names;
        let [x, y] = self.rows.map(|row| row.errors);
        let mut text = format!(
            "{a}: tip error {}, torque error {}; {b}: {}, {}: {}",
            percent(x.tip_max),
            percent(x.torque),
            percent(y.tip_max),
            percent(y.torque),
            compare(a, b, x.tip_max, y.tip_max),
        );
        if let [Some(x), Some(y)] =
            self.rows.map(|row| row.cost.map(|c| (c, c.load_us(row.tick_s()))))
        {
            text += &format!(
                ". A tick takes {} ns against {} ns, a second of motion {} µs against {} µs",
                short(x.0.tick_ns),
                short(y.0.tick_ns),
                short(x.1),
                short(y.1),
            );
        }
        text + "."
    }
}

/// Names the larger of two errors and their ratio.
fn compare(a: &str, b: &str, x: f64, y: f64) -> String {
    let ratio = x.max(y) / x.min(y);
    let larger = if x > y { a } else { b };
    if x == y {
        "the same".into()
    } else if ratio.is_infinite() {
        format!("nothing to compare with {larger}")
    } else if ratio < 1.01 {
        "the same to 1 %".into()
    } else if ratio < 2.0 {
        format!("{:.0} % more with {larger}", 100.0 * (ratio - 1.0))
    } else {
        format!("{} times as much with {larger}", short(ratio))
    }
}

/// Formats three significant digits.
pub fn short(x: f64) -> String {
    Digits::Three.show(x)
}

/// Formats a fraction as a percentage of three significant digits.
pub fn percent(fraction: f64) -> String {
    number::percent(fraction, 1.0, Digits::Three)
}
