//! Space, in perspective: what is far away is small, pale and covered by what is near.

mod camera;
mod faces;
mod perspective;

pub(super) use faces::form;
pub(super) use perspective::Perspective;
