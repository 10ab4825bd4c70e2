//! The commands on a mechanism's scene.

mod compare;
mod outputs;
mod plan;
mod reference;
mod report;
mod run;

pub use compare::compare;
pub use outputs::Outputs;
pub use plan::plan;
pub use reference::reference;
pub use run::{run, typed};
use stillbeam_sim::error::Error;

/// Refuses an option that is for an arm of one link.
pub fn refuse(option: &str, given: bool) -> Result<(), Error> {
    if given {
        return Err(Error::new(format_args!(
            "{option}: must be absent with a mechanism, which has [[links]]"
        )));
    }
    Ok(())
}

/// Refuses an option that is for mechanisms, where the scene has one link.
pub fn refuse_for_arm(option: &str, given: bool) -> Result<(), Error> {
    if given {
        return Err(Error::new(format_args!(
            "{option}: must be absent with an arm of one [link]; it is for mechanisms, which have \
             [[links]]"
        )));
    }
    Ok(())
}
