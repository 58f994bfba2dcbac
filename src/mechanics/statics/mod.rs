//! Models one frame of a scene as bodies, contacts and loads.

pub mod interface;

pub mod assembly;

pub mod effect;

pub mod resultant;
