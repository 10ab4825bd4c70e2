//! Paths that come over the wire row by row.

use stillbeam::motion::{Path, PathPiece, RowError, Waypoint};
use stillbeam_protocol::Refusal;

/// The path of an axis, if one is under way, planned beside the ticks.
///
/// `take` hands a piece over between two ticks: it calls `Axis::take_piece`. The memory is that of
/// one path, however many rows come.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    path: Option<Path>,
    /// The reason why the path has ended before its last row, for the next request.
    refusal: Option<Refusal<'static>>,
}

impl Rows {
    /// Begins a path. One that is under way is given up: the hub stops behind its last row.
    pub fn begin(&mut self, path: Path) {
        *self = Self { path: Some(path), refusal: None };
    }

    /// True if rows may wait to be taken: [`Self::advance`] is due with every tick.
    pub fn is_open(&self) -> bool {
        self.path.is_some()
    }

    /// Puts a row behind the others, the `last` one or not, and takes what there is room for.
    ///
    /// # Errors
    /// [`Refusal::Queue`] if there is no room: nothing has changed, and the row is to be offered
    /// again. A row that the path refuses; the path goes on. Anything else has ended the path: a
    /// limit, rows that came too late, an axis that was given another motion.
    pub fn offer(
        &mut self,
        row: Waypoint,
        last: bool,
        mut take: impl FnMut(&mut Path, &PathPiece) -> Result<bool, RowError>,
    ) -> Result<(), Refusal<'static>> {
        self.advance(&mut take);
        self.check()?;
        let path = self.path.as_mut().ok_or(Refusal::NoPath)?;
        path.offer(row).map_err(|refused| refused.error)?;
        if last {
            path.close();
        }
        self.advance(&mut take);
        self.check()
    }

    /// Takes what there is room for. What ends the path is kept for the next row.
    pub fn advance(
        &mut self,
        mut take: impl FnMut(&mut Path, &PathPiece) -> Result<bool, RowError>,
    ) {
        let Some(path) = &mut self.path else { return };
        let outcome = loop {
            let taken = match path.next_piece() {
                Ok(Some(piece)) => take(path, &piece),
                Ok(None) => Ok(false),
                Err(refused) => Err(refused),
            };
            match taken {
                Ok(true) => {}
                Ok(false) => break Ok(()),
                Err(refused) => break Err(refused),
            }
        };
        if path.is_done() || outcome.is_err() {
            self.path = None;
        }
        self.refusal = outcome.err().map(|refused| refused.error.into());
    }

    fn check(&mut self) -> Result<(), Refusal<'static>> {
        self.refusal.take().map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use stillbeam::motion::Spline;

    use super::*;
    use crate::axes::{CONFIGURATIONS, Joint};
    use crate::bench::{enabled, tick};

    fn offer(
        joint: &mut Joint,
        rows: &mut Rows,
        row: Waypoint,
        last: bool,
    ) -> Result<(), Refusal<'static>> {
        rows.offer(row, last, |path, piece| joint.axis.take_piece(path, piece))
    }

    /// A hundred rows through eight segments: offered again while there is no room, all passed.
    #[test]
    fn a_path_of_any_length_goes_through_the_queue() {
        let (mut joint, mut rows) = (enabled(&CONFIGURATIONS[0]), Rows::default());
        rows.begin(joint.axis.path(Spline::Cubic).expect("an enabled axis"));
        let row = |k: u32| Waypoint::at(0.1 * f64::from(k), 0.015 * f64::from(k % 2));
        let (mut next, mut full, mut passed) = (1, 0, 0);
        for count in 0..1100_u32 {
            while next <= 100 {
                match offer(&mut joint, &mut rows, row(next), next == 100) {
                    Ok(()) => next += 1,
                    Err(Refusal::Queue { .. }) => {
                        full += 1;
                        break;
                    }
                    Err(refusal) => panic!("{refusal}"),
                }
            }
            rows.advance(|path, piece| joint.axis.take_piece(path, piece));
            let angle = tick(&mut joint).angle.radians();
            if count % 10 == 0 && (1..=100).contains(&(count / 10)) {
                let Waypoint { angle: expected, .. } = row(count / 10);
                assert!((angle - expected).abs() < 1e-5, "{count}: {angle}");
                passed += 1;
            }
        }
        assert!(passed == 100 && full > 10, "{passed} {full}");
        assert!(!rows.is_open() && joint.axis.rests());
    }

    /// Rows that come too late, or behind a stop, are refused, and the path is over.
    #[test]
    fn a_path_that_ends_before_its_time_says_why() {
        let (mut joint, mut rows) = (enabled(&CONFIGURATIONS[0]), Rows::default());
        let late = Waypoint::at(3.0, 0.0).turning(0.0);
        assert_eq!(offer(&mut joint, &mut rows, late, true), Err(Refusal::NoPath));
        rows.begin(joint.axis.path(Spline::Cubic).expect("an enabled axis"));
        let first = Waypoint::at(0.2, 0.1).turning(0.5);
        assert_eq!(offer(&mut joint, &mut rows, first, false), Ok(()));
        let fast = Waypoint::at(0.25, 2.0).turning(0.0);
        let refused = offer(&mut joint, &mut rows, fast, false);
        assert!(matches!(refused, Err(Refusal::Range { .. })), "{refused:?}");
        assert_eq!(offer(&mut joint, &mut rows, late, true), Err(Refusal::NoPath));
        for _ in 0..200 {
            tick(&mut joint);
        }
        assert!(joint.axis.rests(), "it stops behind the row before");

        rows.begin(joint.axis.path(Spline::Cubic).expect("an enabled axis"));
        assert_eq!(offer(&mut joint, &mut rows, first, false), Ok(()));
        for _ in 0..40 {
            tick(&mut joint);
        }
        assert_eq!(offer(&mut joint, &mut rows, late, true), Err(Refusal::Starved));
    }
}
