//! `docs/stability.md`: the blocks that take seconds.

use std::fmt::Display;

use super::condition::{self, Loss};
use super::map::Map;
use super::probe::Verdict;
use super::rule::RULES;
use crate::markers::Block;
use crate::stress::document::ranges;
use crate::table::aligned;
use stillbeam_sim::error::Error;

/// Values of `ω₁h` in the table of conditions.
const TURNS: [f64; 4] = [1e-3, 1e-1, 1.0, 10.0];

/// Results from which the blocks are written.
pub struct Findings {
    /// Maps as [`super::map::all`] returns them: six over tick and frequency, six over rates, one
    /// of the trapezoidal rule.
    pub maps: Vec<Map>,
    /// Rounding errors.
    pub losses: Vec<Loss>,
}

impl Findings {
    /// Computes the findings, which takes seconds on all cores.
    pub fn compute(done: &(dyn Fn() + Sync)) -> Result<Self, Error> {
        let losses = condition::losses(&TURNS)?;
        Ok(Self { maps: super::map::all(done)?, losses })
    }

    /// Returns the maps over tick and frequency.
    pub fn moving(&self) -> &[Map] {
        &self.maps[..self.maps.len() / 2]
    }

    /// Returns the maps over rates.
    pub fn spinning(&self) -> &[Map] {
        &self.maps[self.maps.len() / 2..]
    }

    /// Returns the blocks, by name.
    pub fn blocks(&self) -> Vec<Block> {
        [
            ("ranges", ranges()),
            ("moves", self.moves()),
            ("spins", self.spins()),
            ("rules", rules()),
            ("condition", self.conditions()),
        ]
        .map(|(name, text)| Block::new(name, text))
        .to_vec()
    }

    fn moves(&self) -> String {
        let mut lines = vec![header(["method", "accurate to ω₁h", "stable to ω₁h"])];
        for map in self.moving() {
            let turn = |hertz: f64, tick: f64| std::f64::consts::TAU * hertz * tick;
            let to = |verdict| sized(map.holds_up_to(verdict, turn));
            lines.push(counted(map, [to(Verdict::Accurate), to(Verdict::Inaccurate)]));
        }
        aligned(&lines)
    }

    fn spins(&self) -> String {
        let mut lines = vec![header(["method", "accurate to θ̇h, rad", "stable to θ̇h, rad"])];
        for map in self.spinning() {
            let turned = |turn: f64, rate: f64| turn * rate;
            let to = |verdict| sized(map.holds_up_to(verdict, turned));
            lines.push(counted(map, [to(Verdict::Accurate), to(Verdict::Inaccurate)]));
        }
        aligned(&lines)
    }

    fn conditions(&self) -> String {
        let head = [
            "elements",
            "ω₁h",
            "condition, assembled",
            "scaled",
            "f32 solution off by, assembled",
            "scaled",
            "qᵀKq in f32 off by, assembled",
            "by elements",
        ];
        let mut lines = vec![head.map(str::to_owned).to_vec()];
        for loss in &self.losses {
            let mut line = vec![loss.elements.to_string(), loss.turn.to_string()];
            line.extend(
                [
                    loss.assembled,
                    loss.scaled,
                    loss.solved[0],
                    loss.solved[1],
                    loss.product[0],
                    loss.product[1],
                ]
                .map(|x| format!("{x:.0e}")),
            );
            lines.push(line);
        }
        aligned(&lines)
    }
}

/// Returns a table's header, with the counts of every verdict behind.
fn header<const N: usize>(names: [&str; N]) -> Vec<String> {
    let verdicts = Verdict::ALL.map(Verdict::name);
    names.into_iter().chain(verdicts).map(str::to_owned).collect()
}

fn counted(map: &Map, found: [String; 2]) -> Vec<String> {
    let counts = Verdict::ALL.map(|verdict| map.count(verdict).to_string());
    std::iter::once(map.title.clone()).chain(found).chain(counts).collect()
}

fn rules() -> String {
    let head = ["rule", "δ", "β", "stable to ωh", "period and decay true to 1 % to ωh"];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    for rule in RULES {
        lines.push(vec![
            rule.name.to_owned(),
            rule.delta.to_string(),
            format!("{:.4}", rule.beta),
            sized(rule.stable_up_to()),
            sized(rule.accurate_up_to()),
        ]);
    }
    aligned(&lines)
}

fn sized(value: f64) -> String {
    if value.is_finite() {
        digits(stillbeam_sim::table::significant(value, 2))
    } else {
        "any".into()
    }
}

fn digits(value: impl Display) -> String {
    value.to_string()
}
