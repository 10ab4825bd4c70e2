//! The steppers of an arm on a carrier that turns.

use stillbeam::Scene;
use stillbeam::stepper::OnCarrier;

use crate::Erasable;
use crate::build::{Refused, StepperVisitor};

/// Puts the stepper of an arm on the scene's carrier, for the visitor.
pub(crate) struct Carried<'a, V> {
    pub scene: &'a Scene,
    pub visitor: V,
}

impl<V: StepperVisitor> StepperVisitor for Carried<'_, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<S: Erasable>(self, stepper: S) -> Self::Output {
        Ok(self.visitor.visit(OnCarrier::new(self.scene, |_| Ok(stepper))?))
    }
}
