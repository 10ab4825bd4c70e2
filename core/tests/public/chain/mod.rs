//! Chains of links: against solutions that another program computed, and what must hold for all.

mod accuracy;
mod axes;
mod closing;
mod one_link;
mod power;
mod random;
mod refusals;
mod scenes;
mod still;
mod stop;
