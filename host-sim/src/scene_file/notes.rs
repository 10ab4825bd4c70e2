//! Notes printed before a run: durations that are not whole ticks, and the time a shaper adds.

use super::SceneFile;
use crate::axis_units;
use crate::error::Error;
use crate::table::significant;
use crate::trajectory::Trajectory;

/// Lines of one kind that are printed. The rest is counted.
const MOST: usize = 4;

impl SceneFile {
    /// Returns notes on durations that were rounded to whole ticks and on the delay of a shaper.
    /// Moves that are rounded alike share a line.
    pub fn roundings(&self, tick: f64) -> Result<Vec<String>, Error> {
        let trajectory = self.trajectory(tick)?;
        let mut plans = trajectory.plans().iter();
        let (mut rounded, mut found) = (Groups::default(), Groups::default());
        for (index, step) in self.moves.iter().enumerate() {
            let settle = (step.settle > 0.0).then_some(("settle", step.settle));
            let key = if step.motion.as_move().is_some() { "duration" } else { "waypoints" };
            for (key, asked) in [(key, step.motion.duration())].into_iter().chain(settle) {
                let Some(plan) = plans.next() else { break };
                let whole = f64::from(plan.summary.ticks) * tick;
                let whole = (whole * 1e9).round() / 1e9;
                if key == "duration" && self.shortest.contains(&index) {
                    // One that was found is in whole ticks; a time-optimal move's own need not be.
                    let own = whole - if asked > 0.0 { 0.0 } else { plan.summary.rounded_by };
                    let own = (own * 1e9).round() / 1e9;
                    found.add(index, format!("duration = {own} s, the shortest within the limits"));
                    continue;
                }
                // Not worth a word: what a decimal fraction of a second lacks in binary, and a move
                // that has asked for no duration.
                if asked > 0.0 && plan.summary.rounded_by.abs() > 1e-9 * asked {
                    rounded.add(
                        index,
                        format!(
                            "{key} = {asked} s is no multiple of the tick ({tick} s): rounded to \
                             {whole} s"
                        ),
                    );
                }
            }
        }
        let shaped = self.shaper.as_ref().map(|shaper| {
            let (delay, pulses) = (shaper.delay(), shaper.pulses().len());
            format!("the shaper\u{2019}s {pulses} pulses add {delay:.4} s to the motion")
        });
        let units = axis_units::of(self.arm.mount.axis);
        for &(index, rate) in &self.blended {
            let text = if rate == 0.0 {
                "blend = true, but the hub stops: it turns back, or a limit is exceeded".to_owned()
            } else {
                let rate = significant(rate, 6);
                format!("blend = true, passes its end at {rate} {}", units.rate)
            };
            found.add(index, text);
        }
        let found = found.lines(self.moves.len()).into_iter();
        let lines = found.chain(rounded.lines(self.moves.len()));
        Ok(lines.chain(shaped).chain(self.longer_rest(&trajectory)).collect())
    }

    /// Returns a line on the rest that is added behind the moves, if any is.
    fn longer_rest(&self, trajectory: &Trajectory) -> Option<String> {
        let added = trajectory.plans().get(self.motions().len())?;
        let rest = trajectory.duration() - trajectory.arrivals().last()?;
        Some(format!(
            "the run goes on at rest for {} s after the last arrival, {} s longer than the moves say: \
             over a first period its residual vibration shows",
            (rest * 1e9).round() / 1e9,
            (f64::from(added.summary.ticks) * trajectory.tick() * 1e9).round() / 1e9
        ))
    }
}

/// Notes on moves. Moves with the same note are grouped.
#[derive(Default)]
pub(super) struct Groups(Vec<(String, Vec<usize>)>);

impl Groups {
    /// Adds a note on the move of that index.
    pub fn add(&mut self, index: usize, text: String) {
        match self.0.iter_mut().find(|(known, _)| *known == text) {
            Some((_, moves)) => moves.push(index),
            None => self.0.push((text, vec![index])),
        }
    }

    /// Returns a line for each note, which names its moves, of `count` in all. After [`MOST`] lines
    /// one more counts the rest.
    pub fn lines(&self, count: usize) -> Vec<String> {
        let mut lines: Vec<String> = self
            .0
            .iter()
            .take(MOST)
            .map(|(text, moves)| {
                if count == 1 {
                    format!("move.{text}")
                } else {
                    format!("{}: {text}", names(moves))
                }
            })
            .collect();
        let rest: usize = self.0.iter().skip(MOST).map(|(_, moves)| moves.len()).sum();
        if rest > 0 {
            lines.push(format!("{rest} more like these, from {}", names(&self.0[MOST].1[..1])));
        }
        lines
    }
}

/// Names the moves, e.g. `moves[3], moves[7] and 38 more`.
fn names(moves: &[usize]) -> String {
    let name = |index: &usize| super::place_of(*index);
    match moves {
        [] => String::new(),
        [one] => name(one),
        [first, second] => format!("{} and {}", name(first), name(second)),
        [first, second, rest @ ..] => {
            format!("{}, {} and {} more", name(first), name(second), rest.len())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alike_notes_share_a_line() {
        let mut groups = Groups::default();
        for index in 0..40 {
            groups.add(index, "duration = 0.333 s".to_owned());
        }
        groups.add(7, "settle = 0.001 s".to_owned());
        let lines = groups.lines(40);
        assert_eq!(lines[0], "moves[0], moves[1] and 38 more: duration = 0.333 s");
        assert_eq!(lines[1], "moves[7]: settle = 0.001 s");
        for index in 0..40 {
            groups.add(index, format!("duration = {index} s"));
        }
        let lines = groups.lines(40);
        assert_eq!(lines.len(), MOST + 1);
        assert_eq!(lines[MOST], "38 more like these, from moves[2]");
    }
}
