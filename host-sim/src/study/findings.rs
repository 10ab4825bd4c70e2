//! The study in a few sentences, for the terminal and for the report.

use super::Study;
use crate::report::parts::{fixed, ms, percent};

impl Study {
    /// Returns the findings, a sentence or two each, in plain text.
    pub fn findings(&self) -> Vec<String> {
        let mass = &self.link_mass;
        let mut lines = vec![format!(
            "The link of section 3 is member D with {} kg: its period is {} ms, where the paper \
             says 99.8 ms. The printed {} kg would give {} ms.",
            mass.used.link.mass,
            ms(mass.used.period, 2),
            mass.printed.link.mass,
            ms(mass.printed.period, 1),
        )];
        if let Some(one) = self.elements.meshes.first() {
            let off = |period: f64| percent((period / self.elements.theory - 1.0).abs(), 1);
            lines.push(format!(
                "One element with consistent mass is enough: its period is {} off, with lumped \
                 mass {}.",
                off(one.consistent.period),
                off(one.lumped.period),
            ));
        }
        if let Some(step) = self.steps.steps.iter().find(|step| step.run.solver.tick == 0.01) {
            lines.push(format!(
                "A tick of 10 ms is short enough for member A: the tip is never more than {} of L \
                 from where a step of {} ms puts it.",
                percent(step.tip_max, 2),
                ms(super::steps::FINEST, 1),
            ));
        }
        if let Some(member) = self.members.quiet() {
            lines.push(format!(
                "Undamped, member B arrives almost still: {} of its peak deflection remains. \
                 Damping raises that to {}. A cubic leaves nothing behind after {} periods, and \
                 the paper’s 2 s are {}.",
                percent(member.undamped.ratio(), 1),
                percent(member.damped.ratio(), 1),
                fixed(self.profiles.cubic_zeros[1], 3),
                fixed(self.profiles.paper, 3),
            ));
        }
        lines
    }
}
