//! A planar chain of links as its user describes it: SI units, validated.
//!
//! ```
//! use stillbeam::mechanism::{Joint, Link, Mechanism};
//!
//! let strip = Link::flexible(0.3, 0.0168, 0.46);
//! let mut arm = Mechanism::new(&[strip, strip])?;
//! arm.joints[1] = Joint { mass: 0.05, ..Joint::DRIVEN };
//! arm.payload.mass = 0.02;
//! arm.validate()?;
//! # Ok::<(), stillbeam::Error>(())
//! ```

mod closure;
mod joint;
mod link;
mod names;

pub use closure::{Closing, Closure};
use heapless::Vec;
pub use joint::Joint;
pub use link::{Link, Stiffness};

use crate::Error;
use crate::scene::{Damping, Payload};
use names::indexed;
pub(crate) use names::of_joint;

/// Most links of a chain.
pub const MAX_LINKS: usize = 8;

/// A planar chain of links on revolute joints, open or with its end on a pin.
///
/// Joint `j` carries link `j`. Joint 0 stands at the origin of the global frame, joint `j` at the
/// end of link `j − 1`. Its angle is that of its link against the end of the link before, of joint
/// 0 against global x, counter-clockwise. Gravity acts along global −y.
///
/// Fields are public so that a mechanism reads like its file; [`Mechanism::validate`] is called
/// wherever a model is built from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mechanism {
    /// The links, from the base to the tip.
    pub links: Vec<Link, MAX_LINKS>,
    /// The joints, one a link.
    pub joints: Vec<Joint, MAX_LINKS>,
    /// The payload at the end of the last link.
    pub payload: Payload,
    /// Rayleigh's damping of all links; a joint of its own is not damped.
    pub damping: Damping,
    /// Gravity, m/s²; 0 is a horizontal plane.
    pub gravity: f64,
    /// The pin that closes the chain to a loop.
    pub closure: Option<Closure>,
}

impl Mechanism {
    /// An open chain of these links on driven joints without mass, undamped, horizontal.
    ///
    /// # Errors
    /// No link, or more than [`MAX_LINKS`].
    pub fn new(links: &[Link]) -> Result<Self, Error> {
        Self::check_count(links.len())?;
        Ok(Self {
            // As many as there is room for, which is all: just counted.
            links: links.iter().copied().take(MAX_LINKS).collect(),
            joints: links.iter().map(|_| Joint::DRIVEN).take(MAX_LINKS).collect(),
            payload: Payload::default(),
            damping: Damping::default(),
            gravity: 0.0,
            closure: None,
        })
    }

    fn check_count(count: usize) -> Result<(), Error> {
        Error::check("links", count as f64, 1.0, MAX_LINKS as f64, "links").map(drop)
    }

    /// The mechanism itself if every field is finite and in range, else the first that is not.
    pub fn validate(&self) -> Result<&Self, Error> {
        Self::check_count(self.links.len())?;
        let (links, joints) = (self.links.len() as f64, self.joints.len() as f64);
        Error::check("joints", joints, links, links, "joints, one a link")?;
        for (index, link) in self.links.iter().enumerate() {
            link.validate(index)?;
        }
        for (index, joint) in self.joints.iter().enumerate() {
            joint.validate(index)?;
        }
        let Payload { mass, inertia, offset } = self.payload;
        Error::check("payload.mass", mass, 0.0, 1e5, "kg")?;
        Error::check("payload.inertia", inertia, 0.0, 1e6, "kg m^2")?;
        Error::check("payload.offset", offset, 0.0, 1e3, "m")?;
        let Damping { alpha, beta, joint } = self.damping;
        Error::check("damping.alpha", alpha, 0.0, 1e3, "1/s")?;
        Error::check("damping.beta", beta, 0.0, 1.0, "s")?;
        Error::check("damping.joint", joint, 0.0, 0.0, "s, as joints of a chain do not give")?;
        Error::check("gravity.acceleration", self.gravity, 0.0, 1e3, "m/s^2")?;
        if let Some(closure) = &self.closure {
            closure.validate(self)?;
        }
        self.check_passive_inertia()?;
        Ok(self)
    }

    /// Refuses a passive joint beyond which nothing has mass: nothing would say how it turns.
    fn check_passive_inertia(&self) -> Result<(), Error> {
        for (index, _) in self.joints.iter().enumerate().filter(|(_, joint)| joint.passive) {
            let mass: f64 = self.links[index..].iter().map(|link| link.mass).sum();
            Error::check(indexed!("links", "mass")[index], mass, 1e-7, 1e5, "kg")?;
        }
        Ok(())
    }

    /// Sum of the links' lengths, with hub radii and tip offsets, m: what errors of places are
    /// measured by.
    pub fn total_length(&self) -> f64 {
        let links = self.links.iter().map(|link| link.length + link.tip_offset);
        links.sum::<f64>() + self.joints.iter().map(|joint| joint.radius).sum::<f64>()
    }

    /// True if the joint is turned by a motor as long as the chain is open.
    pub fn is_driven(&self, joint: usize) -> bool {
        self.joints.get(joint).is_some_and(|joint| !joint.passive)
    }

    /// True if the joint turns freely after the chain has closed: it is passive, or released then.
    pub fn is_free_when_closed(&self, joint: usize) -> bool {
        let released = |closure: &Closure| closure.release.contains(&joint);
        !self.is_driven(joint) || self.closure.as_ref().is_some_and(released)
    }
}
