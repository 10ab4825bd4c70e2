//! Runs of a motion: a row every tick, as `stillbeam-sim run` writes them.

use core::ops::Deref;

use heapless::Vec;
use stillbeam::model::Rod;
use stillbeam::motion::{Segment, Shaped};
use stillbeam::stepper::{AnyMotion, Elastica2, Quality, Response, Stepper};
use stillbeam::{AxisKind, Generator, HubState, Setpoint, UniformScene};

use crate::arm::{Arm, TICK};
use crate::motion::{Motion, Refusal};
use crate::residual;

/// Columns of a row: time, hub angle, rate and acceleration, tip x and y in the global frame,
/// deflection, torque, as in the table of `run`; then the two modal coordinates, m √kg.
pub const COLUMNS: usize = 10;

/// Most rows of a run.
const CAPACITY: usize = 4096;

/// Segments of the longest motion and its rest.
const SEGMENTS: usize = 14;

/// A row of the table.
pub type Row = [f64; COLUMNS];

/// Memory for the rows of a run.
#[derive(Debug)]
pub struct Rows([Row; CAPACITY]);

impl Rows {
    /// No rows.
    pub const EMPTY: Self = Self([[0.0; COLUMNS]; CAPACITY]);
}

impl Deref for Rows {
    type Target = [Row];

    fn deref(&self) -> &[Row] {
        &self.0
    }
}

/// A motion on an arm.
#[derive(Debug)]
pub struct Run<'a> {
    scene: UniformScene,
    motion: &'a Motion,
    rod: Rod<2>,
}

impl<'a> Run<'a> {
    /// Takes a motion to the arm whose frequencies differ by the fraction `error`.
    pub fn of(
        arm: &Option<Arm>,
        motions: &'a [Result<Motion, Refusal>],
        kind: usize,
        error: f64,
    ) -> Result<Self, Refusal> {
        let arm = arm.as_ref().ok_or(Refusal::NotSetUp)?;
        let motion = motions.get(kind).ok_or(Refusal::NotSetUp)?.as_ref().map_err(|why| *why)?;
        let scene = arm.detuned(error);
        Ok(Self { rod: Rod::new(&scene)?, scene, motion })
    }

    /// Writes a row for every tick, from t = 0 to the end of the rest. Returns their number.
    pub fn write(&self, rows: &mut Rows) -> Result<usize, Refusal> {
        // As `run` does: the bend to expect of the motion before it passes the shaper.
        let bend = self.rod.bend(self.motion.summary().peaks.acceleration);
        let (_, most) = Elastica2::<f32>::BEND;
        if bend > most {
            return Err(Refusal::BendsTooFar { bend, most });
        }
        let stepper = Elastica2::<f32>::new(&self.rod, TICK, Quality::Fine, bend)?;
        match self.motion.shaper {
            None => self.generated(stepper, rows),
            Some(_) => self.shaped(&stepper, rows),
        }
    }

    fn generated(&self, stepper: Elastica2<f32>, rows: &mut Rows) -> Result<usize, Refusal> {
        let mut generator = Generator::<_, SEGMENTS>::new(stepper, 0.0)?;
        let mut ticks = 0;
        for motion in &self.motion.moves {
            ticks += generator.push(motion)?.ticks;
        }
        let arrival = self.motion.summary().ticks;
        let rows = rows.0.get_mut(..=ticks as usize).ok_or(Refusal::TooLong)?;
        for (k, row) in rows.iter_mut().enumerate() {
            let setpoint = generator.tick();
            let ends = k == arrival as usize || k == ticks as usize && arrival == ticks;
            let shown = if ends { generator.setpoint_before() } else { setpoint };
            let arm = generator.stepper().arm_state(generator.state(), generator.hub());
            *row = columns(k, &shown, arm.coordinate);
        }
        Ok(rows.len())
    }

    fn shaped(&self, stepper: &Elastica2<f32>, rows: &mut Rows) -> Result<usize, Refusal> {
        let Some(shaper) = &self.motion.shaper else { return Err(Refusal::NotSetUp) };
        let segments: Vec<Segment<f32>, SEGMENTS> =
            self.motion.segments().map(Segment::cast).collect();
        let motion = Shaped::new(&segments, shaper, TICK);
        let rows = rows.0.get_mut(..=motion.ticks() as usize).ok_or(Refusal::TooLong)?;
        let mut state = stepper.equilibrium(&stepper.gravity().aimed(&motion.hub(0)));
        for (k, row) in (0..).zip(rows.iter_mut()) {
            if k > 0 {
                motion.advance(stepper, &mut state, k - 1);
            }
            let arrives = k == self.motion.arrival_tick();
            let hub = if arrives { motion.arrival(k) } else { motion.hub(k) };
            let hub = stepper.gravity().aimed(&hub);
            let Response { torque, tip } = stepper.response::<AnyMotion>(&state, &hub);
            let HubState { angle, rate, acceleration, .. } = hub;
            let setpoint = Setpoint { angle, rate, acceleration, torque, tip };
            *row = columns(k as usize, &setpoint, stepper.arm_state(&state, &hub).coordinate);
        }
        Ok(rows.len())
    }

    /// Returns the vibration that the rows of [`Self::write`] show after arrival, fraction of the
    /// length.
    pub fn residual(&self, rows: &[Row]) -> f64 {
        let period = core::f64::consts::TAU / self.rod.frequency()[0];
        let after = rows.get(self.motion.arrival_tick() as usize..).unwrap_or(&[]);
        residual::largest(after, TICK, period) / self.scene.link.length
    }
}

fn columns(k: usize, setpoint: &Setpoint<f32>, coordinate: [f32; 2]) -> Row {
    let [x, y] = setpoint.global_tip_on(AxisKind::Rotary).map(f64::from);
    let [first, second] = coordinate.map(f64::from);
    [
        k as f64 * TICK,
        setpoint.angle.radians(),
        f64::from(setpoint.rate),
        f64::from(setpoint.acceleration),
        x,
        y,
        f64::from(setpoint.deflection()),
        f64::from(setpoint.torque),
        first,
        second,
    ]
}
