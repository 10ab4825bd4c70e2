//! Which of the lines in a record are the arm's first bending modes.

use super::lines::Line;
use crate::identify::log::Kind;

/// Ratio of a mode's frequency to the one below it: the least that an arm with a payload or a soft
/// joint has, and the most that is searched. A clamped uniform link has 6.27 and 2.80.
const RATIOS: [(f64, f64); 2] = [(3.5, 14.0), (1.7, 5.0)];

/// Relative distance from a multiple of the first frequency that makes a line a harmonic.
const HARMONIC: f64 = 2e-3;

/// Relative distance from the scene's frequency within which a line may be that mode.
const NEAR: f64 = 0.35;

/// A line with its amplitude at the beginning of the record.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub line: Line,
    pub amplitude: f64,
}

/// Treatment of multiples of the first frequency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Harmonics {
    /// They are no modes.
    Never,
    /// One is a mode if no other line may be it.
    IfNoOther,
}

/// Returns the indices of the first modes among the lines, `most` at most. `theory` are the
/// frequencies that the scene gives, Hz.
///
/// The first mode is the line that moves the arm most, near the scene's frequency if one is. Each
/// further mode is the strongest line within the ratios that arms have.
pub fn choose(
    found: &[Found],
    kind: Kind,
    theory: Option<&[f64]>,
    most: usize,
    harmonics: Harmonics,
) -> Vec<usize> {
    let Some(first) = first(found, kind, theory) else { return Vec::new() };
    let mut modes = vec![first];
    while modes.len() < most {
        let known: Vec<f64> = modes.iter().map(|&k| found[k].line.frequency()).collect();
        let (low, high) = range(&known, theory);
        let strongest = |harmonic: bool| {
            (0..found.len())
                .filter(|k| !modes.contains(k))
                .filter(|&k| (low..high).contains(&found[k].line.frequency()))
                .filter(|&k| harmonic_of(found[k].line, found[first].line).is_some() == harmonic)
                .max_by(|&i, &k| found[i].amplitude.total_cmp(&found[k].amplitude))
        };
        let harmonic = || if harmonics == Harmonics::IfNoOther { strongest(true) } else { None };
        match strongest(false).or_else(harmonic) {
            Some(k) => modes.push(k),
            None => break,
        }
    }
    modes
}

/// Returns the range of the next mode's frequency, Hz, from those below it.
pub fn range(known: &[f64], theory: Option<&[f64]>) -> (f64, f64) {
    let next = known.len();
    match theory {
        // The first mode tells by how much all of them are off.
        Some(theory) => {
            let expected = theory[next] * known[0] / theory[0];
            ((1.0 - NEAR) * expected, (1.0 + NEAR) * expected)
        }
        None => {
            let ratio = RATIOS[(next - 1).min(1)];
            (ratio.0 * known[next - 1], ratio.1 * known[next - 1])
        }
    }
}

/// Returns which multiple of the first mode a line is, if it is one.
pub fn harmonic_of(line: Line, first: Line) -> Option<usize> {
    let times = (line.omega / first.omega).round();
    let off = (line.omega / (times * first.omega) - 1.0).abs();
    (times >= 2.0 && off < HARMONIC).then_some(times as usize)
}

fn first(found: &[Found], kind: Kind, theory: Option<&[f64]>) -> Option<usize> {
    let strongest = |admits: &dyn Fn(f64) -> bool| {
        (0..found.len())
            .filter(|&k| admits(found[k].line.frequency()))
            .max_by(|&i, &k| moving(&found[i], kind).total_cmp(&moving(&found[k], kind)))
    };
    let near = theory
        .and_then(|theory| strongest(&|frequency| (frequency / theory[0] - 1.0).abs() < NEAR));
    near.or_else(|| strongest(&|_| true))
}

/// Returns a measure of how far a line moves the arm, of lines that a sensor of that kind shows.
/// An acceleration is divided by ω only, as a sensor's slow drift divided by ω² would exceed all.
pub fn moving(found: &Found, kind: Kind) -> f64 {
    let power = match kind {
        Kind::Acceleration => 1.0,
        Kind::Strain | Kind::Torque => 0.5,
        Kind::Deflection | Kind::Angle => 0.0,
    };
    found.amplitude / found.line.omega.powf(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(hz: f64, amplitude: f64) -> Found {
        Found { line: Line { omega: hz * std::f64::consts::TAU, ratio: 0.002 }, amplitude }
    }

    #[test]
    fn modes_of_a_struck_beam_are_told_from_torsion_and_higher_ones() {
        let lines = [568.6, 380.5, 41.39, 116.9, 6.62, 229.8, 192.2]
            .into_iter()
            .zip([5.0, 4.0, 0.9, 1.0, 0.49, 0.3, 0.1])
            .map(|(hz, amplitude)| found(hz, amplitude))
            .collect::<Vec<_>>();
        assert_eq!(choose(&lines, Kind::Acceleration, None, 3, Harmonics::Never), [4, 2, 3]);
        let theory = [7.2, 45.0, 126.0];
        assert_eq!(choose(&lines, Kind::Acceleration, Some(&theory), 2, Harmonics::Never), [4, 2]);
    }

    #[test]
    fn a_harmonic_is_a_mode_only_if_nothing_else_is() {
        let lines = [found(16.35, 70.0), found(98.1, 0.5), found(107.3, 0.2)];
        let choose =
            |lines: &[Found], harmonics| choose(lines, Kind::Acceleration, None, 2, harmonics);
        assert_eq!(choose(&lines, Harmonics::IfNoOther), [0, 2]);
        assert_eq!(choose(&lines[..2], Harmonics::IfNoOther), [0, 1]);
        assert_eq!(choose(&lines[..2], Harmonics::Never), [0]);
        assert_eq!(harmonic_of(lines[1].line, lines[0].line), Some(6));
    }
}
