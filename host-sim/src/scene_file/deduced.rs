//! Values of the arm that are deduced from measurements, and the lines that say so.

use serde::Serialize;
use stillbeam::{Damping, Scene};

use super::measured::{Fit, Unknown};
use super::values::Modes;

/// Values that a scene file does not give but measurements in it do. Absent where nothing was
/// deduced.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Deduced {
    /// EI from `link.frequency`, of a link that is not uniform as of one that a force at the tip
    /// bends as far, N m².
    #[serde(rename = "bending_stiffness_nm2", skip_serializing_if = "Option::is_none")]
    pub bending_stiffness: Option<f64>,
    /// That EI over the one of the link's material and section, where both are known.
    #[serde(rename = "stiffness_over_material", skip_serializing_if = "Option::is_none")]
    pub over_material: Option<f64>,
    /// k of the joint from `link.frequency`, N m/rad.
    #[serde(rename = "hub_stiffness_nm_rad", skip_serializing_if = "Option::is_none")]
    pub hub_stiffness: Option<f64>,
    /// Largest relative error that a frequency is left with, where more were measured than values
    /// are deduced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_misfit: Option<f64>,
    /// α from `damping.ratio`, 1/s.
    #[serde(rename = "damping_alpha_per_s", skip_serializing_if = "Option::is_none")]
    pub alpha: Option<f64>,
    /// β from `damping.ratio`, s.
    #[serde(rename = "damping_beta_s", skip_serializing_if = "Option::is_none")]
    pub beta: Option<f64>,
    /// β_J of the joint from `damping.joint_ratio`, or from `damping.ratio`, s.
    #[serde(rename = "damping_joint_s", skip_serializing_if = "Option::is_none")]
    pub joint: Option<f64>,
    /// `link.frequency` as given, Hz.
    #[serde(skip)]
    frequency: String,
    /// `damping.ratio` as given.
    #[serde(skip)]
    ratio: String,
    /// The ratio that the joint's damping is from.
    #[serde(skip)]
    joint_ratio: String,
}

impl Deduced {
    /// Notes what frequencies have told of the arm.
    pub(super) fn fitted(
        &mut self,
        arm: &Scene,
        fit: &Fit,
        unknown: Unknown,
        frequency: &Modes,
        is_material: bool,
    ) {
        self.frequency = frequency.text();
        if unknown != Unknown::Joint {
            self.bending_stiffness = Some(arm.link.bending_stiffness);
            self.over_material = is_material.then_some(fit.stiffness);
        }
        if unknown != Unknown::Link {
            self.hub_stiffness = fit.joint;
        }
        let unknowns = if unknown == Unknown::Both { 2 } else { 1 };
        self.frequency_misfit = (frequency.0.len() > unknowns).then_some(fit.misfit);
    }

    /// Notes the damping that a ratio was turned into: α and β, and the joint's if the ratio made
    /// that too.
    pub(super) fn damping(&mut self, damping: &Damping, joint: bool, ratio: String) {
        self.alpha = (damping.alpha > 0.0).then_some(damping.alpha);
        self.beta = (damping.beta > 0.0).then_some(damping.beta);
        if joint && self.alpha.is_none() && self.beta.is_none() {
            self.joint_damping(damping.joint, ratio.clone());
        }
        self.ratio = ratio;
    }

    /// Notes the joint's damping that a ratio was turned into.
    pub(super) fn joint_damping(&mut self, joint: f64, ratio: String) {
        self.joint = (joint > 0.0).then_some(joint);
        self.joint_ratio = ratio;
    }

    /// Says in a line each what was deduced, and from what.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let frequency = &self.frequency;
        if let Some(stiffness) = self.bending_stiffness {
            let against = self.over_material.map_or(String::new(), |factor| {
                let percent = 100.0 * (factor - 1.0);
                let side = if percent < 0.0 { "less" } else { "more" };
                format!(", {:.1} % {side} than material and section give", percent.abs())
            });
            lines.push(format!(
                "bending_stiffness = {stiffness:.5} N m^2, from link.frequency = {frequency} Hz{against}"
            ));
        }
        if let Some(stiffness) = self.hub_stiffness {
            lines.push(format!(
                "hub.stiffness = {stiffness:.5} N m/rad, from link.frequency = {frequency} Hz"
            ));
        }
        if let Some(misfit) = self.frequency_misfit {
            lines.push(format!(
                "link.frequency = {frequency} Hz is met to {:.2} %, by least squares",
                100.0 * misfit
            ));
        }
        for (name, value, unit, ratio) in [
            ("alpha", self.alpha, "1/s", &self.ratio),
            ("beta", self.beta, "s", &self.ratio),
            ("joint", self.joint, "s", &self.joint_ratio),
        ] {
            if let Some(value) = value {
                lines.push(format!(
                    "damping.{name} = {value:.4e} {unit}, from a damping ratio of {ratio}"
                ));
            }
        }
        lines
    }
}
