//! Paths that come row by row, one an axis, planned at the lowest priority. With the feature
//! `path`; what it takes stands in docs/firmware.md.

#[cfg(feature = "path")]
mod paths {
    use embassy_futures::select::{Either, select};
    use embassy_time::{Duration, Timer};
    use stillbeam::motion::{Path, PathPiece, RowError, Spline, Waypoint};
    use stillbeam_protocol::Refusal;
    use stillbeam_wiring::Rows;
    use stillbeam_wiring::axes::AXES;

    use crate::plan::{JOBS, Job};
    use crate::shared::{self, Outcome, on};
    use crate::tick::MICROSECONDS;

    const NO_AXIS: Refusal<'static> = Refusal::Axis(AXES as u8);

    #[derive(Default)]
    pub struct Paths([Rows; AXES]);

    impl Paths {
        /// Waits for a job; meanwhile takes rows of the paths under way, a tick after the other.
        pub async fn next_job(&mut self) -> Job {
            let tick = Duration::from_micros(MICROSECONDS.into());
            while self.0.iter().any(Rows::is_open) {
                if let Either::First(job) = select(JOBS.receive(), Timer::after(tick)).await {
                    return job;
                }
                for (axis, rows) in self.0.iter_mut().enumerate() {
                    rows.advance(|path, piece| take(axis, path, piece).map(|(taken, _)| taken));
                }
            }
            JOBS.receive().await
        }

        /// Begins a path at the end of the axis' moves.
        // Not inlined, as the next: one job needs no stack for another.
        #[inline(never)]
        pub fn begin(&mut self, axis: usize, spline: Spline) -> Outcome<u32> {
            let rows = self.0.get_mut(axis).ok_or(NO_AXIS)?;
            let (path, tick) = shared::with(|s| {
                let joint = s.joints.get(axis).ok_or(NO_AXIS)?;
                Ok::<_, Refusal<'static>>((joint.axis.path(spline)?, joint.axis.clock()))
            })?;
            rows.begin(path);
            Ok(tick)
        }

        /// Takes a row of a path. Returns the number of the tick before which the first piece is
        /// taken; of the next one if none is.
        #[inline(never)]
        pub fn offer(&mut self, axis: usize, row: Waypoint, last: bool) -> Outcome<u32> {
            let rows = self.0.get_mut(axis).ok_or(NO_AXIS)?;
            let mut first = None;
            rows.offer(row, last, |path, piece| {
                let (taken, tick) = take(axis, path, piece)?;
                first = first.or(taken.then_some(tick));
                Ok(taken)
            })?;
            first.map_or_else(|| on(axis, |_| Ok(())), Ok)
        }
    }

    /// Hands a piece over with the tick masked. Returns true if there was room, and the number of
    /// the next tick.
    #[inline(never)]
    fn take(axis: usize, path: &mut Path, piece: &PathPiece) -> Result<(bool, u32), RowError> {
        shared::with(|s| match s.joints.get_mut(axis) {
            Some(joint) => Ok((joint.axis.take_piece(path, piece)?, joint.axis.clock())),
            None => Ok((false, 0)),
        })
    }
}

#[cfg(not(feature = "path"))]
mod paths {
    use stillbeam::motion::{Spline, Waypoint};
    use stillbeam_protocol::Refusal;

    use crate::plan::{JOBS, Job};
    use crate::shared::Outcome;

    // With braces: `Paths::default()` is written for both, and for a unit struct clippy objects.
    #[derive(Default)]
    pub struct Paths {}

    impl Paths {
        pub async fn next_job(&mut self) -> Job {
            JOBS.receive().await
        }

        pub fn begin(&mut self, _: usize, _: Spline) -> Outcome<u32> {
            Err(Refusal::NoPaths)
        }

        pub fn offer(&mut self, _: usize, _: Waypoint, _: bool) -> Outcome<u32> {
            Err(Refusal::NoPaths)
        }
    }
}

pub use paths::Paths;
