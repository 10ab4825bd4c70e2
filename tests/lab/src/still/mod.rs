//! Moves that arrive still, judged: the page's tables and the campaign over random moves.

pub mod campaign;
pub mod campaign_page;
pub mod document;
pub mod duration;
pub mod interruption;
