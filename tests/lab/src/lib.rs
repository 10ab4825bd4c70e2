#![forbid(unsafe_code)]
//! The proof behind stillbeam's pages: campaigns that no user runs, and the blocks they write into
//! docs/.
//!
//! [`sweep`] measures run time against error, beside [`baseline`]; [`stress`] runs random scenes
//! and long runs; [`stability`] maps where the methods are stable; [`choice`] tries `auto` on
//! random arms; [`still`] judges moves that arrive still; [`fastest`] holds their durations against
//! other motions'; [`faults`] injects what can go wrong around an axis; [`plant`] lets random axes
//! turn random machines; [`identify`] finds random arms in synthetic logs; [`shortest`] holds
//! time-optimal motions against Ruckig's; [`mod@reference`] lets the two reference solvers converge
//! to each other. All of them run their cases in [`campaign`].
//! [`pages`] writes what they find into the pages, between [`markers`].

pub mod baseline;
pub mod campaign;
pub mod choice;
pub mod fastest;
pub mod faults;
mod figures;
pub mod identify;
pub mod markers;
pub mod mechanisms;
pub mod pages;
pub mod plant;
pub mod random;
pub mod reference;
pub mod shortest;
pub mod stability;
pub mod still;
pub mod stress;
pub mod sweep;
pub mod table;
