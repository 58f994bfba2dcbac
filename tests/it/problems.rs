//! Every way a scene is wrong, as a person is told it.
