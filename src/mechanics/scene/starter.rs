//! The scene that a newcomer starts from.

/// A small scene to build on, as the text of a scene file.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::starter())?;
/// assert!(scene.frames().len() > 1);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn starter() -> &'static str {
    include_str!("../../../assets/starter.json")
}
