//! The `[[moves]]` of a mechanism's scene file.

use serde::Deserialize;
use stillbeam::mechanism::{Closing, Mechanism};
use stillbeam::{Move, Profile};

use super::scene::{JointTable, joint_index};
use super::{JointDrive, is_passive};
use crate::error::Error;

/// A `[[moves]]` table.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MoveTable {
    joint: i64,
    profile: String,
    duration: f64,
    from: Option<f64>,
    to: f64,
    #[serde(default)]
    start: f64,
}

/// Builds the moves, and puts every driven joint of the mechanism where its first move begins.
pub(super) fn build(
    tables: &[MoveTable],
    joints: &[JointTable],
    mechanism: &mut Mechanism,
) -> Result<Vec<JointDrive>, Error> {
    let mut drives = Vec::new();
    for (index, table) in tables.iter().enumerate() {
        drives.push(table.build(index, mechanism)?);
    }
    for joint in 0..mechanism.joints.len() {
        let mut own: Vec<usize> = (0..tables.len()).filter(|&k| drives[k].joint == joint).collect();
        own.sort_by(|&a, &b| tables[a].start.total_cmp(&tables[b].start));
        let mut here = joints[joint].angle;
        for (nth, &k) in own.iter().enumerate() {
            let begin = tables[k].from.or(here).unwrap_or(0.0);
            if nth == 0 {
                mechanism.joints[joint].angle = begin;
            }
            if let Some(here) = here.filter(|here| *here != begin) {
                let place = if nth == 0 { "joints say" } else { "move before it ends" };
                return Err(Error::new(format_args!(
                    "moves[{k}].from = {begin}: must be {here}, where the {place}, or absent"
                )));
            }
            here = Some(tables[k].to);
        }
    }
    Ok(drives)
}

impl MoveTable {
    fn build(&self, index: usize, mechanism: &Mechanism) -> Result<JointDrive, Error> {
        let place = format!("moves[{index}]");
        let count = mechanism.joints.len();
        let joint = joint_index(self.joint, count, &format!("{place}.joint"))?;
        if !(0.0..=1e6).contains(&self.start) {
            return Err(Error::new(format_args!(
                "{place}.start = {}: must be 0 to 1000000 s",
                self.start
            )));
        }
        self.check_driven(&place, joint, mechanism)?;
        let profile = Profile::named(&self.profile).ok_or_else(|| {
            let names = Profile::ALL.map(Profile::name).join(", ");
            Error::new(format_args!(
                "{place}.profile = \"{}\": must be one of {names}",
                self.profile
            ))
        })?;
        let (duration, to) = (self.duration, self.to);
        let motion = Move::To { profile, duration, to }.into();
        Ok(JointDrive { joint, start: self.start, motion })
    }

    /// Refuses a joint that has no drive, or whose drive lets go before the move has ended.
    fn check_driven(&self, place: &str, joint: usize, mechanism: &Mechanism) -> Result<(), Error> {
        let number = self.joint;
        if is_passive(mechanism, joint, false) {
            return Err(Error::new(format_args!(
                "{place}.joint = {number}: joint {number} is passive, must be a driven one; take \
                 another joint, or leave out joints[{joint}].passive"
            )));
        }
        if !is_passive(mechanism, joint, true) {
            return Ok(());
        }
        let closes = match mechanism.closure.as_ref().map(|closure| closure.begins) {
            Some(Closing::At(time)) => time,
            Some(Closing::OnPin(_)) => 0.0,
            None => return Ok(()),
        };
        let ends = self.start + self.duration;
        if ends <= closes + 1e-9 {
            return Ok(());
        }
        Err(Error::new(format_args!(
            "{place}.joint = {number}: joint {number} is released at {closes} s and passive from \
             then on, must have ended its moves by then; this one ends at {ends} s"
        )))
    }
}
