//! The beam's matrices against closed forms.

mod modes;
mod statics;
mod trigonometry;
