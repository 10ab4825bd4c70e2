#![forbid(unsafe_code)]
//! The desktop side of stillbeam: runs the core on scene files and judges it.
//!
//! The modules in the order of the data: a scene file ([`scene_file`], [`scenes`], [`solver`]), its
//! commanded motion ([`trajectory`]), the core's run ([`run`], [`dispatch`]), its table ([`table`],
//! [`output`]), and the differences of two tables ([`compare`]). [`limits`] checks what a motion
//! asks of the drive. [`residual`] measures the vibration after it.
//!
//! Reference solutions ([`mod@reference`], as tables [`truth`]) judge the core. The paper's figures
//! are computed in [`study`], moves that arrive still in [`mod@plan`]. [`report`] and [`plot`] show
//! both, [`animation`] shows an arm as it moves. Campaigns and the pages of `docs/` are the lab's
//! (`tests/lab`).
//!
//! `talk` runs beside the firmware, in QEMU or on a board, and compares what it sends.

pub mod advice;
pub mod animation;
pub mod arm;
pub mod axis_units;
pub mod compare;
pub mod console;
pub mod dispatch;
pub mod document;
pub mod error;
pub mod export;
mod flight;
pub mod identify;
pub mod limits;
pub mod mechanism;
pub mod motion_file;
pub mod number;
pub mod output;
pub mod plan;
pub mod plant;
pub mod playground;
pub mod plot;
pub mod progress;
pub mod reference;
pub mod report;
pub mod residual;
pub mod run;
pub mod samples;
pub mod scene_file;
pub mod scenes;
pub mod servo;
pub mod sketch;
pub mod solver;
pub mod starter;
pub mod step;
pub mod study;
pub mod table;
#[cfg(feature = "talk")]
pub mod talk;
pub mod trajectory;
pub mod truth;
pub mod waypoints;
