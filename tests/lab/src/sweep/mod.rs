//! Run time against error: every combination of solvers and scenes, judged by the reference rod.
//!
//! The modules in the order of the data: a spec ([`spec`]) becomes a numbered list of cases
//! ([`plan`]). Each case gives its error ([`measure`]) and, one at a time, its cost ([`cost`]).
//! [`execute`] collects the rows ([`row`]). The results are the front ([`pareto`]), the answers to
//! a reader's questions ([`answers`]), a page with pictures ([`picture`], [`page`]) and README's
//! tables ([`tables`]).
//!
//! A new method comes in with `solver` (its name, which keys it reads) and `dispatch` (its
//! stepper); a new key with `solver`, which also names its column, and the list in [`spec::Grid`].

pub mod answers;
pub mod cost;
pub mod execute;
pub mod measure;
pub mod page;
pub mod pareto;
pub mod picture;
pub mod plan;
pub mod row;
pub mod spec;
pub mod tables;
