//! Hub motions that show an arm's first mode.

use clap::ValueEnum;
use stillbeam::{Limits, PlainMove, Profile};

use crate::error::Error;
use crate::number::Digits;

/// A motion that is fit for identification.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Excitation {
    /// Cubics of half a first period, to both sides, with time to ring behind each.
    #[default]
    Cubic,
    /// Cubics back and forth without a pause, faster and faster: from half the first frequency to
    /// twice as much. Their accelerations join without a jump.
    Sweep,
}

/// Share of the limits that a motion takes unless a turn is asked for.
const SHARE: f64 = 0.8;

/// Largest turns unless asked otherwise, rad. A sweep rings at resonance.
const CUBIC: f64 = 0.1;
const SWEEP: f64 = 0.03;

/// Largest turn that can be asked for, rad.
const LARGEST: f64 = 1.0;

/// Turns of a sweep.
const TURNS: usize = 24;

/// Periods that the arm rings for, behind each cubic and behind a sweep.
const CUBIC_RINGS: f64 = 4.0;
const SWEEP_RINGS: f64 = 6.0;

impl Excitation {
    /// Returns the moves of a hub at 0 rad whose arm has the first frequency `frequency`, Hz.
    ///
    /// The hub turns by `turn` rad at most, to one side or to both, and ends where it began.
    /// Without a `turn` it takes 0.8 of what the limits of rate and acceleration allow, at most 0.1
    /// rad of a cubic and 0.03 rad of a sweep.
    ///
    /// # Errors
    /// A turn that is not above 0 and at most 1 rad, or that the limits do not allow.
    pub fn moves(
        self,
        frequency: f64,
        limits: &Limits,
        turn: Option<f64>,
    ) -> Result<Vec<PlainMove>, Error> {
        let period = 1.0 / frequency;
        let durations = self.durations(period);
        let shortest = durations.iter().copied().fold(f64::INFINITY, f64::min);
        let most = largest_turn(limits, shortest);
        let default = if self == Self::Cubic { CUBIC } else { SWEEP };
        let turn = turn.unwrap_or(default.min(SHARE * most));
        let most = most.min(LARGEST);
        if !(turn > 0.0 && turn <= most) {
            return Err(Error::new(format_args!(
                "--turn = {turn} rad: must be above 0 and at most {} rad, which the limits of rate \
                 and acceleration allow in {} s",
                Digits::Three.show(most),
                Digits::Three.show(shortest)
            )));
        }
        let to = |duration, to| PlainMove::To { profile: Profile::Cubic, duration, to };
        let ring = |periods: f64| PlainMove::Dwell { duration: periods * period };
        // Both end where they began.
        Ok(match self {
            Self::Cubic => [turn, 0.0, -turn, 0.0]
                .into_iter()
                .flat_map(|end| [to(shortest, end), ring(CUBIC_RINGS)])
                .collect(),
            Self::Sweep => {
                let ends = [turn, 0.0].into_iter().cycle();
                let turns = durations.iter().zip(ends).map(|(duration, end)| to(*duration, end));
                turns.chain([ring(SWEEP_RINGS)]).collect()
            }
        })
    }

    /// Durations of the turns, s.
    fn durations(self, period: f64) -> Vec<f64> {
        match self {
            Self::Cubic => vec![0.5 * period],
            // Two turns are a cycle: a turn of a whole period is half the frequency.
            Self::Sweep => {
                (0..TURNS).map(|k| period * 0.25_f64.powf(k as f64 / (TURNS - 1) as f64)).collect()
            }
        }
    }
}

/// Returns the turn by a cubic in that time which the limits allow, rad: its peak rate is 1.5 and
/// its peak acceleration 6 of a turn by 1 in a time of 1.
fn largest_turn(limits: &Limits, duration: f64) -> f64 {
    let of = |limit: Option<f64>| limit.unwrap_or(f64::INFINITY);
    let acceleration = of(limits.acceleration).min(of(limits.deceleration));
    (of(limits.rate) * duration / 1.5).min(acceleration * duration * duration / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: Limits = Limits {
        rate: Some(2.0),
        acceleration: Some(15.0),
        deceleration: Some(12.0),
        jerk: None,
        torque: None,
        moment: None,
    };

    fn ends(moves: &[PlainMove]) -> Vec<(f64, f64)> {
        let of = |motion: &PlainMove| match *motion {
            PlainMove::To { duration, to, .. } => Some((duration, to)),
            _ => None,
        };
        moves.iter().filter_map(of).collect()
    }

    #[test]
    fn cubics_of_half_a_period_go_to_both_sides_and_come_back() {
        let moves = Excitation::Cubic.moves(2.0, &LIMITS, None).expect("moves");
        let turns = ends(&moves);
        let angles: Vec<f64> = turns.iter().map(|(_, to)| *to).collect();
        // 12 rad/s² for 0.25 s: 0.125 rad, of which 0.8.
        for (angle, expected) in angles.iter().zip([0.1, 0.0, -0.1, 0.0]) {
            assert!((angle - expected).abs() < 1e-12, "{angles:?}");
        }
        assert!(turns.iter().all(|(duration, _)| (duration - 0.25).abs() < 1e-12));
        assert_eq!(moves[1], PlainMove::Dwell { duration: 2.0 });
    }

    #[test]
    fn a_sweep_goes_from_half_the_frequency_to_twice_and_ends_where_it_began() {
        let moves = Excitation::Sweep.moves(2.0, &LIMITS, None).expect("moves");
        let turns = ends(&moves);
        let (first, last) = (turns[0], turns[TURNS - 1]);
        assert_eq!(turns.len(), TURNS);
        assert!((first.0 - 0.5).abs() < 1e-12 && (last.0 - 0.125).abs() < 1e-12);
        assert_eq!(last.1, 0.0);
        // 12 rad/s² in 0.125 s.
        let expected = 0.8 * 12.0 * 0.125 * 0.125 / 6.0;
        assert!((first.1 - expected).abs() < 1e-12, "{first:?}");
    }

    #[test]
    fn a_turn_that_the_limits_do_not_allow_is_refused_with_what_they_do() {
        for turn in [0.0, -0.1, f64::NAN, 0.126, 2.0] {
            let refused = Excitation::Cubic.moves(2.0, &LIMITS, Some(turn));
            let error = refused.expect_err("a turn").to_string();
            let begin = format!("--turn = {turn} rad: must be above 0 and at most 0.125 rad,");
            assert!(error.starts_with(&begin), "{error}");
        }
        let fits = Excitation::Cubic.moves(2.0, &LIMITS, Some(0.12)).expect("a turn");
        assert_eq!(ends(&fits)[0].1, 0.12);
    }
}
