//! The kernels against closed forms, and against steppers so plain that one sees what they do. They use nothing but what
//! the crate hands out, as any user does.

mod across;
mod anchors;
mod bonds;
mod flexible;
mod flight;
mod friction_laws;
mod numbers;
mod plane;
mod plane_laws;
mod plane_rocking;
mod rigid;
mod rocking;
mod stack;
mod surroundings;
